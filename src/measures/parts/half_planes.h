/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The largest difference, over half-planes, between the share of points and the share of a convex domain's area.
 *
 * It is reached at a line through points. While a line turns about one of them and passes no other, the area on its
 * left changes by half the difference of the squared distances to the domain's boundary on its two sides: it is
 * extreme where the point bisects its chord. So the critical lines are those through two points and the bisected
 * chords of each. A point closer to a line than about 4e-15 counts as on it, so that points that were collinear
 * before they were mapped count together.
 */
#ifndef KOKSMA_MEASURES_PARTS_HALF_PLANES_H
#define KOKSMA_MEASURES_PARTS_HALF_PLANES_H

#include "measures/parts/warped.h"

enum { KOKSMA__MAX_CHORDS = 3 };

typedef struct koksma__convex {
    /* The share of the area on the left of the line through p with unit direction u. */
    double (*share)(const double *p, const double *u);
    /* Fills the unit directions of the chords that p bisects, and returns how many there are. */
    int (*chords)(const double *p, double directions[KOKSMA__MAX_CHORDS][2]);
} koksma__convex;

/* Value and witness. n^2 log n. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__half_planes(const koksma__warped *points, const koksma__convex *domain, const koksma_run *run,
                                  koksma_value *out);

#endif
