/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Which points are these? Compares a set of points with the sequences, lattices and patterns that this library knows,
 * and says by which map of which of them the points arise: none, another order, a shift, a scrambling. Part of
 * libkoksma.
 */
#ifndef KOKSMA_IDENTIFY_H
#define KOKSMA_IDENTIFY_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One statement about a set of points. Each was tested for every point; a linear scramble may miss up to n / 64 of them,
   whose number `detail` then has. `relation` is one of
     equal               the points are those of `what`, in its order
     reordered           they are those of `what`, in another order
     part                they are some of the points of `what`
     shifted             `what` plus one vector modulo 1 (a Cranley-Patterson rotation)
     digital-shift       `what` with one number added to each digit, in base 2 by exclusive or
     digit-permutation   `what` with one permutation for each digit of a coordinate
     linear-scramble     `what` with a linear map of its digits and a digital shift
     nested-scramble     `what` with a nested permutation of digits that is not linear (Owen 1995)
     lattice, recurrence, grid    points of that form, whose numbers `detail` has
     sequence            each aligned block of 2^k points has one in each of 2^k intervals of every coordinate: a
                         sequence in base 2 of other matrices, or behind nested scrambling and perhaps a shuffle
     stratified          a Latin hypercube, or one point in each cell of a grid, and nothing above
     scaled, rounded     how the coordinates were mapped to [0,1), or rounded; the other statements are about the mapped
     unknown             no other statement holds */
typedef struct koksma_identity {
    const char *relation;
    char what[160];             /* the points of which this is a map, such as "Sobol' (Joe & Kuo 2008), Gray order" */
    char spec[KOKSMA_MAX_SPEC]; /* the spec whose points `what` is, "" if there is none; for `equal`, `reordered` and
                                   `part` it makes the points themselves */
    uint64_t first;             /* index of the first point in `what` */
    uint64_t seed;              /* seed of `spec`; 0 where it needs none */
    char detail[400];           /* the evidence: numbers that were recovered, the largest difference */
} koksma_identity;

typedef struct koksma_identities {
    size_t count, capacity;
    koksma_identity *items;
} koksma_identities;

/* Returns whether a statement says where points come from: its relation is none of scaled, rounded, unknown. */
KOKSMA_API bool koksma_identity_names(const koksma_identity *identity);

/* Tests where points come from; allocates identities, the strongest statement first. The coordinates may be any
   finite numbers: those outside [0,1) are mapped first, from [-1,1], from whole numbers or from a box with round
   bounds. Coordinates that were rounded, to float, to multiples of 2^-k or to decimals, are compared within that
   rounding. Takes seconds for 2^16 points in 8 dimensions, on one thread. What it doesn't know it calls unknown.
   Errors: ARGUMENT (no points, a coordinate that is not finite), DIM, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_identify(const koksma_points *points, const koksma_run *run,
                                         koksma_identities *identities);

/* Frees the statements and zeroes the struct. identities may be NULL, or zeroed. */
KOKSMA_API void koksma_identities_fini(koksma_identities *identities);

#ifdef __cplusplus
}
#endif

#endif
