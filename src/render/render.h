/* SPDX-License-Identifier: Apache-2.0 */
/* Renders an image in parts, for several machines. */
#ifndef KOKSMA_RENDER_RENDER_H
#define KOKSMA_RENDER_RENDER_H

#include <koksma/render.h>

/* Whether each pixel can be rendered without the others. This is false if samples are splatted, if one pattern covers
   the image, or if the integrator first computes data for the whole image. */
bool koksma__rows_stand_alone(const koksma_render_options *options);

/* Renders rows first_row .. first_row + rows - 1, bit for bit as koksma_render does if rows are independent
   (koksma__rows_stand_alone). Allocates `out`, whose height is `rows`. Errors: koksma_render's. */
koksma_status koksma__render_rows(const koksma_scene *scene, const koksma_render_options *options, int first_row,
                                  int rows, const koksma_run *run, koksma_image *out);

#endif
