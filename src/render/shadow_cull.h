/* SPDX-License-Identifier: Apache-2.0 */
/* Finds shapes that cannot block the shadow rays from a part of a surface to a rectangular light; the result may miss
   some of these shapes, but contains no others. */
#ifndef KOKSMA_RENDER_SHADOW_CULL_H
#define KOKSMA_RENDER_SHADOW_CULL_H

#include "render/pipelines/batch.h"

/* A part of a surface, which lies in the convex hull of n spheres of this radius. */
typedef struct koksma__footprint {
    int n;
    double at[4][3], radius;
} koksma__footprint;

/* Whether `shape`, which must not move, blocks no ray from this part of a surface to the light, as the kernel
   `occlude` computes it. */
bool koksma__shadow_cull_clear(const koksma__footprint *part, const koksma__batch_light *light,
                               const koksma__batch_shape *shape);

#endif
