/* SPDX-License-Identifier: Apache-2.0 */
/* Distances and forces between points: what blue noise of several kinds is made with. Each section is the interface of
   the file of its name. */
#ifndef KOKSMA_PATTERNS_SPACING_SPACING_H
#define KOKSMA_PATTERNS_SPACING_SPACING_H

#include <koksma/koksma.h>

#include <stdbool.h>
#include <stddef.h>

#include "core/vector.h"
#include "core/visibility.h"

/* ---- Packing --------------------------------------------------------------------------------------------- */

/* Returns the largest d such that n points of [0,1]^dim can all be at least d apart, in the cube or on the torus. The
   result is exact for up to 30 points in the square and an upper bound in all other cases: in 2D within 10 % for many
   points and 20 % too large for 3 points on the torus; in more dimensions it is further from the optimum. */
KOKSMA__LAB double koksma__packing_distance(size_t n, int dim, bool torus);

/* ---- Torus grid ------------------------------------------------------------------------------------------ */

/* A grid of cells for points of the 2D torus, which finds the points near a position. */

typedef struct koksma__torus_grid {
    uint32_t cells;   /* cells on a side */
    uint32_t *head;   /* the point that was added last to each cell, or KOKSMA__NO_POINT */
    uint32_t *next;   /* for each point, the point that was added before it to the same cell, or KOKSMA__NO_POINT */
    const double *xs; /* x and y of each point; the caller owns this array */
} koksma__torus_grid;

#define KOKSMA__NO_POINT UINT32_MAX

/* Makes an empty grid for up to n points of xs, with about n cells. */
koksma_status koksma__torus_grid_init(koksma__torus_grid *grid, size_t n, const double *xs);
void koksma__torus_grid_fini(koksma__torus_grid *grid);

void koksma__torus_grid_clear(koksma__torus_grid *grid);
void koksma__torus_grid_add(koksma__torus_grid *grid, uint32_t point);

/* Returns the squared distance from (x, y) to the nearest point in the grid, or 1 if the grid is empty. If the
   distance is at most `enough`, the function may return any value up to `enough`. */
double koksma__torus_grid_nearest(const koksma__torus_grid *grid, double x, double y, double enough);

/* Returns whether a point in the grid is closer than d to (x, y), on the torus or, with torus = false, in the square.
   */
bool koksma__torus_grid_near(const koksma__torus_grid *grid, double x, double y, double d, bool torus);

/* ---- Space forces ---------------------------------------------------------------------------------------- */

/* Forces between points of the torus in 3 to 6 dimensions that repel each other with Gaussians, for
   gaussian-blue-noise. */

enum { KOKSMA__FORCE_DIMS = 6 };

typedef struct koksma__space_forces {
    int dim;
    size_t n;
    uint32_t side;           /* number of cells along an axis */
    double s;                /* standard deviation of the Gaussian */
    double *sorted;          /* the points, cell by cell */
    double *table;           /* if s > 1/10: four coefficients of each piece of the periodic Gaussian; else NULL */
    uint32_t *start, *order; /* index of the first sorted point of each cell; original number of each sorted point */
} koksma__space_forces;

koksma_status koksma__space_forces_init(koksma__space_forces *f, size_t n, int dim, double s);
void koksma__space_forces_fini(koksma__space_forces *f);

/* Copies the points into f->sorted, cell by cell; the functions below read these copies. */
void koksma__space_forces_sort(koksma__space_forces *f, const double *xs);

/* Computes the force on sorted point number `at`: with w(t) = exp(-|t|^2 / (2 s^2)), the sum of t w(t) over the other
   points and their periodic images, t the difference to an image. For s <= 1/10 points further away than 5 s are left
   out. */
void koksma__space_force(const koksma__space_forces *f, size_t at, double *force);

/* ---- Elimination ----------------------------------------------------------------------------------------- */

/* Weighted sample elimination on the torus (Yuksel 2015), for the patterns sample-elimination and
   progressive-elimination. */

/* Returns the radius of the weight function, which is twice the largest Poisson disk radius of n points in [0,1)^dim.
   In 1 to 3 dimensions it follows from the densest packing; in more, from balls that fill the whole volume, as in the
   paper. */
double koksma__elimination_radius(size_t n, int dim);

/* Returns the weight limit d_min / d_max if n of m points remain in `dim` dimensions: distances below d_min have the same
   weight as d_min. It is 0 above 3 dimensions. */
double koksma__elimination_limit(size_t n, size_t m, int dim);

/* Removes the heaviest of `count` points, one after the other, until `keep` are left. The weight of a point is the
   sum over the other points with d < d_max of (1 - max(d, d_min) / d_max)^8, where d is the distance on the torus;
   in 4 to 8 dimensions with d_max > 1/2 the sum is over all periodic images of the other points. Of points with
   equal weights the one with the lowest number is removed first.
       order[0] .. order[keep - 1]       the points left, in the order in which they are given
       order[keep] .. order[count - 1]   the points removed, the last one first */
koksma_status koksma__eliminate(size_t count, int dim, const double *points, size_t keep, double d_max, double d_min,
                                const koksma_run *run, uint32_t *order);

/* Puts a finished set on the torus into progressive order. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__order_progressively(const koksma_run *run, koksma_points *points);

/* Makes n points by elimination from factor * n uniform random points. The points are in the order in which they were
   drawn or, with `progressive`, in Yuksel's progressive order, whose prefixes are blue noise, too. `name` is the name
   of the pattern in error messages. */
koksma_status koksma__eliminated_set(const char *name, uint64_t seed, size_t n, int dim, size_t factor,
                                     bool progressive, const koksma_run *run, double *xs);

#endif
