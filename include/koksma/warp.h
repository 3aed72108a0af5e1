/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Points of the unit square mapped to where a renderer needs them: the disk of a lens, a triangle light, a
 * hemisphere. Every warp keeps the measure in proportion, so that the measures of half-planes and disks can be taken
 * on the other side: how irregular the mapped points are against the uniform measure there.
 */
#ifndef KOKSMA_WARP_H
#define KOKSMA_WARP_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum koksma_warp_domain {
    KOKSMA_DOMAIN_DISK,             /* x^2 + y^2 <= 1, uniform area */
    KOKSMA_DOMAIN_TRIANGLE,         /* x >= 0, y >= 0, x + y <= 1, uniform area: x, y and 1-x-y are the barycentric
                                       coordinates in a triangle of any shape */
    KOKSMA_DOMAIN_HEMISPHERE,       /* x^2 + y^2 + z^2 = 1, z >= 0, uniform solid angle */
    KOKSMA_DOMAIN_HEMISPHERE_COSINE /* the same, with density z/pi */
} koksma_warp_domain;

typedef struct koksma_warp {
    const char *name, *title, *cite;
    koksma_warp_domain domain;
    int dim;                                      /* coordinates of a mapped point: 2 or 3 */
    void (*map)(const double in[2], double *out); /* one point; out may be in where that has room for dim */
} koksma_warp;

/* Member i of the table, NULL past the end; by name, NULL if unknown. */
KOKSMA_API const koksma_warp *koksma_warp_at(size_t i);
KOKSMA_API const koksma_warp *koksma_warp_find(const char *name);

/* Evaluates a measure of the mapped points of the plane against the measure of the warp's domain:
     edge          half-planes (disk and triangle)
     l2-edge       half-planes; on the uniform hemisphere, half-spaces through its centre (law=isotropic)
     l2-disk       disk: disks of fixed radius that meet it, their centres uniform within 1 + r. On the hemispheres
                   with law=area: spherical caps of any size, their area uniform up to the whole sphere (r is idle)
     disk-sampled  disk: the same disks sampled, by any law, not on a torus
   Errors: ARGUMENT (no warp, no spec of a measure, a parameter that it does not take, no points, a coordinate outside
   [0,1]), DIM, N (too many for the method), UNSUPPORTED (another measure, or law), MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_warp_evaluate(const koksma_warp *warp, const koksma_spec *measure,
                                              const koksma_points *points, const koksma_run *run, koksma_value *out);

#ifdef __cplusplus
}
#endif

#endif
