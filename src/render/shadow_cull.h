/* SPDX-License-Identifier: Apache-2.0 */
/* Finds shapes that cannot block the shadow rays from a part of a surface to a rectangular light; the result may leave
   such shapes out, but has no others. */
#ifndef KOKSMA_RENDER_SHADOW_CULL_H
#define KOKSMA_RENDER_SHADOW_CULL_H

#include "render/pipelines/batch.h"

/* A part of a surface: contained in the convex hull of n spheres of this radius. */
typedef struct koksma__footprint {
    int n;
    double at[4][3], radius;
} koksma__footprint;

/* Whether batch->occlude blocks no ray from this part of a surface to the light by a shape that does not move. */
bool koksma__shadow_cull_clear(const koksma__footprint *part, const koksma__batch_light *light,
                               const koksma__batch_shape *shape);

#endif
