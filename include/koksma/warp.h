/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Points of the unit square mapped to where a renderer needs them: the disk of a lens, a triangle light, a
 * hemisphere. Every warp keeps areas in proportion, so that the measures of half-planes and disks can be taken on the
 * other side: how irregular the mapped points are against the uniform measure there.
 */
#ifndef KOKSMA_WARP_H
#define KOKSMA_WARP_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct koksma_warp {
    const char *name, *title, *cite;
    int dim;                                      /* coordinates of a mapped point: 2 or 3 */
    void (*map)(const double in[2], double *out); /* one point */
} koksma_warp;

/* Member i of the table, NULL past the end; by name, NULL if unknown. */
KOKSMA_API const koksma_warp *koksma_warp_at(size_t i);
KOKSMA_API const koksma_warp *koksma_warp_find(const char *name);

/* Evaluates a measure of the mapped points of the plane: `edge` (disk and triangle), `l2-edge` (half-planes; on the
   hemisphere, half-spaces through its centre) and `disk-sampled` (disk: disks that meet it, not on a torus).
   Errors: DIM, UNSUPPORTED (another measure, or law), MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_warp_evaluate(const koksma_warp *warp, const koksma_spec *measure,
                                              const koksma_points *points, const koksma_run *run, koksma_value *out);

#ifdef __cplusplus
}
#endif

#endif
