/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Warps: maps of the unit square onto the domains that a renderer samples. Each carries the uniform measure of the
 * square to the measure of its domain, so that mapped points are to be judged against that.
 */
#ifndef KOKSMA_WARP_H
#define KOKSMA_WARP_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum koksma_domain {
    KOKSMA_DOMAIN_DISK,             /* x^2 + y^2 <= 1, uniform area */
    KOKSMA_DOMAIN_TRIANGLE,         /* x >= 0, y >= 0, x + y <= 1, uniform area: x, y and 1-x-y are the barycentric
                                       coordinates in a triangle of any shape */
    KOKSMA_DOMAIN_HEMISPHERE,       /* x^2 + y^2 + z^2 = 1, z >= 0, uniform solid angle */
    KOKSMA_DOMAIN_HEMISPHERE_COSINE /* the same, with density z / pi */
} koksma_domain;

typedef struct koksma_warp {
    const char *name, *title, *cite; /* cite: keys of docs/references.bib */
    koksma_domain domain;
    int dim;                                 /* coordinates of a mapped point: 2 or 3 */
    void (*map)(const double *u, double *x); /* u in [0,1]^2; x has room for dim numbers */
} koksma_warp;

/* Member i of the table, NULL past the end; by name, NULL if unknown. */
KOKSMA_API const koksma_warp *koksma_warp_at(size_t i);
KOKSMA_API const koksma_warp *koksma_warp_find(const char *name);

#ifdef __cplusplus
}
#endif

#endif
