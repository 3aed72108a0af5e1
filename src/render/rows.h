/* SPDX-License-Identifier: Apache-2.0 */
/* A picture in parts, for several machines. */
#ifndef KOKSMA_RENDER_ROWS_H
#define KOKSMA_RENDER_ROWS_H

#include <koksma/render.h>

/* Whether no pixel depends on others: not so where samples are splatted, one pattern covers the image, or something
   is made for the whole image before. */
bool koksma__rows_stand_alone(const koksma_render_options *options);

/* Rows first_row .. first_row + rows - 1, as koksma_render has them bit for bit where rows stand alone. Allocates
   out, which is as high as `rows`. Errors: koksma_render's. */
koksma_status koksma__render_rows(const koksma_scene *scene, const koksma_render_options *options, int first_row,
                                  int rows, const koksma_run *run, koksma_image *out);

#endif
