/* SPDX-License-Identifier: Apache-2.0 */
/* Which shapes a part of the film can see through a pinhole: never too few. */
#ifndef KOKSMA_RENDER_FRUSTUM_CULL_H
#define KOKSMA_RENDER_FRUSTUM_CULL_H

#include "render/pipelines/batch.h"

typedef struct koksma__sight koksma__sight;

/* None of the shapes may move. width, height: of the film. Errors: MEMORY. */
koksma_status koksma__sight_open(const koksma__batch_camera *camera, const koksma__batch_shapes *shapes, int width,
                                 int height, koksma__sight **out);
void koksma__sight_close(koksma__sight *sight);

/* The shapes that a ray through film places in [x[0], x[1]] x [y[0], y[1]] may meet, as batch->closest may find it:
   their numbers in ascending order, in seen, which has room for all. Their number. */
size_t koksma__sight_shapes(const koksma__sight *sight, const double x[2], const double y[2], size_t *seen);

#endif
