/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Test which properties a given point set has: nets, strata, distances, repeated points, a missing origin,
 * coordinates that rounding to float makes 1, and whether the order is progressive; and, from one set for each of many
 * seeds, whether a random pattern is unbiased. Part of libkoksma.
 */
#ifndef KOKSMA_VERIFY_H
#define KOKSMA_VERIFY_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A desirable property that koksma_verify tests or, with of_sets, koksma_verify_sets. */
typedef struct koksma_property {
    const char *name;    /* "net-base-2" */
    const char *meaning; /* the condition that is tested, and the meaning of koksma_finding.value */
    int coordinates;     /* number of leading coordinates that are tested; 0: all */
    bool of_sets;        /* a property of how the points of many sets are distributed */
} koksma_property;

/* One result of koksma_verify: whether the points have a property, and a number that the property's meaning
   explains. `subject` names the coordinates ("0,1" or "all") or the cells ("4 x 8") that were tested, or is "-";
   `detail` explains how the value was found. */
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

enum { KOKSMA_VERIFY_NET_DIM = 32 }; /* nets are tested for pairs of the first KOKSMA_VERIFY_NET_DIM coordinates */

/* Returns property i of the table, or NULL past the last one. */
KOKSMA_API const koksma_property *koksma_property_at(size_t i);

/* Tests a point set for all properties; allocates findings. The function skips tests that would take too long for
   the number of points or dimensions. Errors: ARGUMENT (no points, a coordinate outside [0,1]), DIM, MEMORY,
   INTERRUPTED. */
KOKSMA_API koksma_status koksma_verify(const koksma_points *points, const koksma_run *run, koksma_findings *findings);

enum { KOKSMA_VERIFY_SETS = 32 }; /* fewer sets show no distribution */

/* Tests the distribution of the points of a random pattern, of which `sets` has n_sets >= KOKSMA_VERIFY_SETS independent
   sets: one for each seed, with equal numbers of points and dimensions. Allocates two findings:
     unbiased         the mean share of all points in every box is the box's volume
     uniform-samples  the first, second, fourth, ... and last point are each uniform
   A pattern that has a property fails it with a probability of at most .001. The detail names the box where the evidence is
   strongest, what was expected there and seen, and z, the difference in standard errors; the value is the difference of
   the shares. The points of one set may depend on each other, those of different sets may not. Boxes are those of single
   coordinates and of pairs of the first 8; of up to 64 coordinates. Errors: N (too few sets, or sets of different sizes),
   ARGUMENT (no points, a coordinate outside [0,1]), DIM, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_verify_sets(const koksma_points *sets, size_t n_sets, const koksma_run *run,
                                            koksma_findings *findings);

/* Frees the findings and zeroes the struct. findings may be NULL, or zeroed. */
KOKSMA_API void koksma_findings_fini(koksma_findings *findings);

/* Computes the smallest distance between any two points of a set.
     torus  true: distances on the unit torus; false: distances in the cube
   O(n log n) for few dimensions. A distance below 1e-154, whose square is no normal number, has fewer digits or is 0.
   Errors: ARGUMENT (no points, a coordinate outside
   [0,1]), N (one point, which has no distance), DIM, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_smallest_distance(const koksma_points *points, bool torus, const koksma_run *run,
                                                  double *distance);

#ifdef __cplusplus
}
#endif

#endif
