/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Culling for the lambert-lanes pipeline: which shapes a part of the film can see through a pinhole (the result may
 * include other shapes, but misses none of these), and which shapes cannot block the shadow rays from a part of a
 * surface to a rectangular light (the result may miss some of these, but contains no others).
 */
#ifndef KOKSMA_RENDER_CULLING_H
#define KOKSMA_RENDER_CULLING_H

#include "render/pipelines/batch.h"

/* ---- Shadow rays ------------------------------------------------------------------------------------------------ */

/* A part of a surface, which lies in the convex hull of n spheres of this radius. */
typedef struct koksma__footprint {
    int n;
    double at[4][3], radius;
} koksma__footprint;

/* Whether `shape`, which must not move, blocks no ray from this part of a surface to the light, as the kernel
   `occlude` computes it. */
bool koksma__shadow_cull_clear(const koksma__footprint *part, const koksma__batch_light *light,
                               const koksma__batch_shape *shape);

/* ---- Camera rays ------------------------------------------------------------------------------------------------ */

typedef struct koksma__frustum_cull koksma__frustum_cull;

/* Prepares culling for shapes that do not move. width, height: of the film. Errors: MEMORY. */
koksma_status koksma__frustum_cull_open(const koksma__batch_camera *camera, const koksma__batch_shapes *shapes,
                                        int width, int height, koksma__frustum_cull **out);
void koksma__frustum_cull_close(koksma__frustum_cull *cull);

/* Finds the shapes that the kernel `closest` may report for rays through film positions in [x[0], x[1]] x [y[0],
   y[1]]. Writes their indices in ascending order to `seen`, which has capacity for all shapes, and returns their
   number. */
size_t koksma__frustum_cull_shapes(const koksma__frustum_cull *cull, const double x[2], const double y[2],
                                   size_t *seen);

/* Bounds the positions where rays through this part of the film hit shape i. Returns false if the positions have no
   bound because some rays graze or miss the shape's plane. */
bool koksma__frustum_cull_footprint(const koksma__frustum_cull *cull, size_t i, const double x[2], const double y[2],
                                    koksma__footprint *out);

#endif
