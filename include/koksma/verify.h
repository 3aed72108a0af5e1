/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Which properties do these points really have? Findings about a set, whoever made it: nets, strata, distances,
 * repeated points, a lost origin, coordinates that a float rounds to 1, and whether the order is progressive.
 */
#ifndef KOKSMA_VERIFY_H
#define KOKSMA_VERIFY_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A property that koksma_verify looks for; each is desirable. */
typedef struct koksma_property {
    const char *name;    /* "net-base-2" */
    const char *meaning; /* what holds, and what a finding's value counts */
    int coordinates;     /* only the first so many coordinates are looked at; 0: all */
} koksma_property;

/* What was found: whether the points have a property, and a number that the property's meaning explains. subject: the
   coordinates ("0,1" or "all") or the cells ("4 x 8") in question, or "-"; detail: what the value is made of. */
typedef struct koksma_finding {
    const char *property;
    char subject[48];
    bool holds;
    double value;
    char detail[200];
} koksma_finding;

typedef struct koksma_findings {
    size_t count, capacity;
    koksma_finding *items;
} koksma_findings;

enum { KOKSMA_VERIFY_NET_DIM = 32 }; /* nets are of pairs of the first so many coordinates */

/* Property i, NULL past the end. */
KOKSMA_API const koksma_property *koksma_property_at(size_t i);

/* Looks for all properties in a point set; allocates findings. Properties that would take too long for so many
   points or dimensions are left out. Errors: ARGUMENT (no points, a coordinate outside [0,1]), DIM, MEMORY,
   INTERRUPTED. */
KOKSMA_API koksma_status koksma_verify(const koksma_points *points, const koksma_run *run, koksma_findings *findings);

/* Frees the findings and zeroes the struct. findings may be NULL, or zeroed. */
KOKSMA_API void koksma_findings_fini(koksma_findings *findings);

/* Computes the smallest distance of two points.
     torus  true: distances on the unit torus; false: in the cube
   O(n log n) for few dimensions. Errors: ARGUMENT (no points, a coordinate outside
   [0,1]), N (one point, which has no distance), DIM, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_smallest_distance(const koksma_points *points, bool torus, const koksma_run *run,
                                                  double *distance);

#ifdef __cplusplus
}
#endif

#endif
