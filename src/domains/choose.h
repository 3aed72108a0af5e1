/* SPDX-License-Identifier: Apache-2.0 */
/* Domains of points other than the uniform unit cube: a square with a density, the surface of a model. A domain draws
   candidates; choose.c chooses points among them, by pattern. */
#ifndef KOKSMA_DOMAINS_CHOOSE_H
#define KOKSMA_DOMAINS_CHOOSE_H

#include <koksma/koksma.h>

typedef struct koksma__point_domain {
    const char *what;   /* for messages: "with a density" */
    int dim;            /* coordinates of a candidate, which are in [0,1) */
    bool torus, varies; /* varies: the density varies, and draw() sets the unit of distance */
    double area;        /* area of the domain in the candidates' coordinates */
    double unit;        /* the length, in candidates' coordinates, that d = 1 means */
    const void *data;   /* of draw */
    /* Makes candidate i: its position, and the unit of distance there, which is 1 where the density equals its
       mean. */
    void (*draw)(const void *data, uint64_t seed, uint64_t i, double *x, double *unit);
} koksma__point_domain;

/* Chooses n points of a domain by the method of the pattern: chosen[i] is the number of the candidate that is point
   i. Errors: ARGUMENT, UNSUPPORTED, N, IMPOSSIBLE, MEMORY, INTERRUPTED. */
koksma_status koksma__domain_choose(const koksma__point_domain *domain, const koksma_spec *spec, uint64_t seed,
                                    size_t n, const koksma_run *run, uint64_t *chosen);

/* The index of the first of `count` ascending sums that is above `at`. If none is, the last index whose sum is above
   the one before it. */
size_t koksma__domain_find(const double *sums, size_t count, double at);

#endif
