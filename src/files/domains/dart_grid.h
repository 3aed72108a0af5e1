/* SPDX-License-Identifier: Apache-2.0 */
/* A grid of cells that finds the points of a domain near a position. Two points conflict if they are closer than d
   times the smaller of their two units of distance (unit_of in domain.h). */
#ifndef KOKSMA_DOMAINS_DART_GRID_H
#define KOKSMA_DOMAINS_DART_GRID_H

#include "domains/domain.h"

typedef struct koksma__dart_grid {
    int dim;
    bool torus;
    double d;           /* smallest distance allowed where the unit is 1 */
    size_t n, capacity; /* number of points; capacity for points */
    double *xs, *units; /* positions and units of distance of the points */
    double lengths[3];  /* as in domain.h */
    uint32_t *next, *head;
    uint32_t side; /* number of cells along an axis; about one cell for each point */
    size_t work;   /* since the last question whether to go on: cells that were visited and distances computed */
} koksma__dart_grid;

/* A position, or a convex region about it of `corners` corners. */
typedef struct koksma__dart_query {
    const double *x;
    double unit; /* unit of distance of the position or of the whole region */
    size_t corners;
    double offsets[4][3]; /* each corner minus x */
} koksma__dart_query;

koksma_status koksma__dart_grid_init(koksma__dart_grid *grid, const koksma__point_domain *domain, bool torus,
                                     size_t capacity, double d);
void koksma__dart_grid_fini(koksma__dart_grid *grid);

/* Removes all but the first n points, n <= grid->n, and sets the smallest distance to d. */
void koksma__dart_grid_reset(koksma__dart_grid *grid, size_t n, double d);

/* Adds a point; there must be capacity for it. */
void koksma__dart_grid_add(koksma__dart_grid *grid, const double *x, double unit);

/* Returns whether a point of the grid conflicts with the position, or with every position of the region. */
bool koksma__dart_grid_meets(koksma__dart_grid *grid, const koksma__dart_query *query);

/* To be called after each query of a set of n points: asks the caller whether to go on once grid->work takes some
   milliseconds, as a query may visit a few cells or nearly all. Returns INTERRUPTED if the caller wants to stop. */
koksma_status koksma__dart_grid_look(koksma__dart_grid *grid, size_t n, const koksma_run *run);

#endif
