/* SPDX-License-Identifier: Apache-2.0 */
/* Domains of points other than the uniform unit cube: a rectangle, which may have a density, or the surface of a
   model. A domain consists of parts (the pixels of the density or the triangles of the model), each with its own
   coordinates. choose.c makes points on a domain with the methods of patterns. */
#ifndef KOKSMA_DOMAINS_DOMAIN_H
#define KOKSMA_DOMAINS_DOMAIN_H

#include <koksma/koksma.h>

/* A point of a domain: a part and a position in it. `at` is in [0,1)^2 for a pixel; for a triangle it has the weights
   of the second and the third corner. */
typedef struct koksma__domain_point {
    uint32_t part;
    double at[2];
} koksma__domain_point;

typedef struct koksma__point_domain {
    const char *what;   /* for messages: "with a density" */
    int dim;            /* number of coordinates of a position; they are in [0,1) */
    double lengths[3];  /* what a coordinate of 1 measures along each axis */
    bool torus, varies; /* varies: the density is not constant */
    double area;        /* area of the domain, in the measure of `lengths` */
    const void *data;   /* argument of the functions below */
    /* Makes candidate i. Candidates are independent and have the density of the domain. */
    void (*draw)(const void *data, uint64_t seed, uint64_t i, koksma__domain_point *point);
    void (*place)(const void *data, const koksma__domain_point *point, double *x);
    /* If `varies`: returns the unit of distance on a part, 1 / sqrt p where the density is p times its mean. */
    double (*unit_of)(const void *data, size_t part);
} koksma__point_domain;

/* The task of a method: make n points of the pattern, with its parameters and a seed, on the domain. */
typedef struct koksma__choice {
    const koksma__point_domain *domain;
    const koksma_pattern *pattern;
    const double *params;
    uint64_t seed;
    size_t n;
    const koksma_run *run;
    koksma__domain_point *points;
} koksma__choice;

/* Returns the index of the first of `count` ascending sums that is above `at`; if there is none, the last index whose
   sum is above the sum before it. */
size_t koksma__domain_find(const double *sums, size_t count, double at);

/* Makes n points of a domain by the method of the pattern that the spec names. The caller frees *points, also after an
   error; it is NULL on entry. Errors: ARGUMENT, UNSUPPORTED, N, MEMORY, INTERRUPTED. */
koksma_status koksma__domain_choose(const koksma__point_domain *domain, const koksma_spec *spec, uint64_t seed,
                                    const koksma_run *run, size_t n, koksma__domain_point **points);

#endif
