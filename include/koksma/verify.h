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

/* What was found: whether the points have a property, each of which is desirable, and a number, of which detail says
   what it counts. The properties:

   net-base-2, -3, -5
       subject: two coordinates, or "all". value: the worst t of the (t,m,s)-nets that the prefixes of b^m points are;
       detail: t for each m. Holds when t = 0 for all
   stratified
       subject: m x k cells in coordinates 0 and 1, or m^dim: one point in each. value: empty cells
   latin
       subject: a coordinate: one point in each of n strata. value: empty strata
   distance-square, distance-torus
       value: the smallest distance; detail: as a fraction of the densest packing's (exact for squares of 30 points
       or fewer, else of an upper bound, which many points on the torus in 2D come near). Holds when above 0
   distinct
       value: points that repeat another. Holds when 0
   origin-unique
       value: points at the origin. Holds when at most 1
   origin-present
       value: points at the origin. Holds when there is one, and also when none is expected: it fails where each
       coordinate has different multiples of 2^-m, 2^m > n, none of them 0 nor all odd, as an unscrambled sequence has
       after its first point
   below-one-as-float
       value: coordinates that become 1 as a float. Holds when 0
   progressive
       value: the largest L2 star discrepancy of a prefix of 2^j >= 16 points over that of as many random points (root
       mean square). Holds when at most 2. The longest prefix is of 2^22 points, in three dimensions 2^18, in four to
       twelve 4,096 */
typedef struct koksma_finding {
    const char *property;
    char subject[48];
    bool holds;
    double value;
    char detail[200];
} koksma_finding;

typedef struct koksma_findings {
    size_t count, room;
    koksma_finding *items;
} koksma_findings;

enum { KOKSMA_VERIFY_NET_DIM = 32 }; /* nets are of pairs of the first so many coordinates */

/* The name of property i, NULL past the end. */
KOKSMA_API const char *koksma_property_name_at(size_t i);

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
