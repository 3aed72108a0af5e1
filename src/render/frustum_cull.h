/* SPDX-License-Identifier: Apache-2.0 */
/* Which shapes a part of the film can see through a pinhole: never too few. */
#ifndef KOKSMA_RENDER_FRUSTUM_CULL_H
#define KOKSMA_RENDER_FRUSTUM_CULL_H

#include "render/pipelines/batch.h"

typedef struct koksma__frustum_cull koksma__frustum_cull;

/* None of the shapes may move. width, height: of the film. Errors: MEMORY. */
koksma_status koksma__frustum_cull_open(const koksma__batch_camera *camera, const koksma__batch_shapes *shapes,
                                        int width, int height, koksma__frustum_cull **out);
void koksma__frustum_cull_close(koksma__frustum_cull *cull);

/* The shapes that a ray through film positions in [x[0], x[1]] x [y[0], y[1]] may meet, as batch->closest may find
   it: their numbers in ascending order, in seen, which has room for all. Their number. */
size_t koksma__frustum_cull_shapes(const koksma__frustum_cull *cull, const double x[2], const double y[2],
                                   size_t *seen);

#endif
