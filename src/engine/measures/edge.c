/* SPDX-License-Identifier: Apache-2.0 */
/*
 * edge: the largest absolute difference, over all half-planes, between the share of points in the half-plane and the
 * area of the unit square in it. The value is the largest error when the points estimate how much of a pixel an edge
 * covers. Mitchell 1992 announces this measure as work of David Dobkin.
 *
 * Formula: sup over half-planes H of |#{x_i in H}/n - area of H in the square|. Turning a line about a point changes
 * the area on one side of the line by (r1^2 - r2^2)/2 per radian, where r1 and r2 are the lengths of the line from
 * the point to the border of the square. So the supremum is reached on a line through two points, on a line whose
 * chord a point bisects (for a point at distances u and v from two sides the chord cuts off a triangle of area 2uv),
 * or on a side of the square. An excess is reached by a closed half-plane, a deficit by an open one.
 * Source: Mitchell 1992, section 5; Dobkin and Eppstein 1993; Dobkin, Eppstein and Mitchell 1996. Here a line turns
 * about one point (the pivot) past all others in order of angle, for each point in turn: O(n^2 log n).
 * Known exactly: the single point (1/2,1/2) has the value 1/2, (1/4,1/4) has 7/8, (0,0) has 1; m x m cell centres
 * have 1/(2m).
 * Limits: the order of angles, with their ties, is exact even in clusters as small as the smallest doubles; areas are
 * rounded, with errors of a few 1e-16. Under a time limit, half of the time is spent on the pivots and the rest on
 * bounds for intervals of directions (shared/edge_cover.c). If the time is too short, the result has a lower and an
 * upper bound. In 3 dimensions half-spaces and the unit cube replace half-planes and the square: the planes go
 * through up to three points (shared/edge_space.c), in O(n^4) and for up to 1024 points. Known exactly for one point
 * (u,v,w): 1 - 9uvw/2 if u, v and w are at most 1/3; 1 - 2uv/(1 + 12h^2) with h = 1/2 - w if u, v and w are at most
 * 1/2, w is at least 1/3, 2u(1 + 6h) <= 1 + 12h^2 and 2v(1 + 6h) <= 1 + 12h^2.
 */
#include <math.h>

#include "measures/edge/edge.h"
#include "measures/measures.h"

/* Computes the chord with midpoint p = (x, y), which goes from (2x - ex, ey) to (ex, 2y - ey), where e is the corner
   of the square nearest to p. */
static void chords_of_square(const double p[2], koksma__chord chords[KOKSMA__MAX_CHORDS])
{
    chords[0] = (koksma__chord){{p[0] < 0.5 ? 0 : 1, p[0]}, {p[1], p[1] < 0.5 ? 0 : 1}};
}

/* Tries the lines along the sides of the square. The half-plane beyond a side contains the points on this side but no
   area. */
static void try_sides(const koksma_points *points, koksma_value *out)
{
    static const double sides[4][3] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, -1}, {0, -1, -1}};
    for (int s = 0; s < 4; s++) {
        size_t count = 0;
        for (size_t i = 0; i < points->n; i++) {
            count += points->xs[2 * i + (size_t)(s % 2)] == (s < 2 ? 0 : 1);
        }
        const double value = (double)count / (double)points->n;
        if (count > 0 && value > out->value) {
            out->value = value;
            out->witness = (koksma_witness){.kind = KOKSMA_WITNESS_HALF_PLANE,
                                            .dim = 2,
                                            .closed = true,
                                            .count = count,
                                            .lo = {sides[s][0], sides[s][1]},
                                            .hi = {sides[s][2]}};
        }
    }
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    static const koksma__domain square = {koksma__area_below_through, chords_of_square, M_SQRT1_2};
    if (points->dim == 3) {
        return koksma__edge_space(points, args->run, out);
    }
    const koksma_status status = koksma__edge_sweep(&square, points->n, points->xs, args->run, out);
    if (!status) {
        try_sides(points, out);
        out->lower = out->value;
        out->exact = out->exact || out->upper <= out->lower;
    }
    return status;
}

const koksma_measure koksma__measure_edge = {
    .name = "edge",
    .title = "L-infinity discrepancy of half-planes or half-spaces",
    .cite = "mitchell1992 dobkin1993 dobkin1996 meyer1991",
    .revision = 1, /* own elementary functions */
    .cost = "n^2 log n; n^4 in 3D, up to 1024 points",
    .family = KOKSMA_FAMILY_EDGES,
    .min_dim = 2,
    .max_dim = 3,
    .eval = eval,
};
