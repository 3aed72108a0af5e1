/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Warps: maps of the unit square to the disk of a lens, a triangle light, a hemisphere or a sphere. Part of libkoksma.
 * Every warp preserves ratios of areas (where the domain has a density: probabilities), so a measure can compare the
 * mapped points with the distribution on the warp's domain.
 */
#ifndef KOKSMA_WARP_H
#define KOKSMA_WARP_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The set in which mapped points lie, and their density on it. */
typedef enum koksma_warp_domain {
    KOKSMA_DOMAIN_DISK,              /* x^2 + y^2 <= 1, uniform area */
    KOKSMA_DOMAIN_TRIANGLE,          /* x >= 0, y >= 0, x + y <= 1, uniform area: x, y and 1-x-y are the barycentric
                                       coordinates in a triangle of any shape */
    KOKSMA_DOMAIN_HEMISPHERE,        /* x^2 + y^2 + z^2 = 1, z >= 0, uniform solid angle */
    KOKSMA_DOMAIN_HEMISPHERE_COSINE, /* x^2 + y^2 + z^2 = 1, z >= 0, with density z/pi */
    KOKSMA_DOMAIN_SPHERE,            /* x^2 + y^2 + z^2 = 1, uniform solid angle */
    KOKSMA_DOMAIN_GGX_VISIBLE        /* x^2 + y^2 + z^2 = 1, z >= 0, with the density of the GGX normals of alpha
                                        = 1/2 that are visible from (sqrt(3)/2, 0, 1/2); no measure accepts it */
} koksma_warp_domain;

/* A map of the unit square. */
typedef struct koksma_warp {
    const char *name, *title, *cite;
    koksma_warp_domain domain;
    int dim; /* coordinates of a mapped point: 2 or 3 */
    /* maps the point `in` to `out`; out may equal in if it has room for dim numbers */
    void (*map)(const double in[2], double *out);
    int revision; /* as koksma_pattern.revision (koksma.h) */
} koksma_warp;

/* Returns warp i of the table, or the warp with this name, or NULL if there is none. */
KOKSMA_API const koksma_warp *koksma_warp_at(size_t i);
KOKSMA_API const koksma_warp *koksma_warp_find(const char *name);

/* Maps 2D points by a warp. Allocates out: as many points, of warp->dim coordinates, which koksma_points_fini frees.
   Errors: ARGUMENT (no points, a coordinate outside [0,1]), DIM, MEMORY. */
KOKSMA_API koksma_status koksma_warp_points(const koksma_warp *warp, const koksma_points *points, koksma_points *out);

/* Maps 2D points by a warp and evaluates a measure of the mapped points on the warp's domain. Accepted measures:
     edge          half-planes (disk and triangle)
     l2-edge       half-planes; on the uniform hemisphere and the sphere, half-spaces through the centre
                   (law=isotropic)
     l2-disk       disk: test disks of fixed radius r that meet the unit disk, with centres uniform within distance
                   1 + r. On the hemispheres and the sphere with law=area: spherical caps whose area is uniform up to
                   the whole sphere (r has no effect)
     disk-sampled  disk: random test disks, with centres as for l2-disk and radii by any law, not on a torus
   Errors: ARGUMENT (no warp, no measure, a parameter that the measure does not accept here, no points, a coordinate
   outside [0,1]), DIM, N (too many points for the method), UNSUPPORTED (a measure or law not listed above), MEMORY,
   INTERRUPTED. */
KOKSMA_API koksma_status koksma_warp_evaluate(const koksma_warp *warp, const koksma_spec *measure,
                                              const koksma_points *points, const koksma_run *run, koksma_value *out);

#ifdef __cplusplus
}
#endif

#endif
