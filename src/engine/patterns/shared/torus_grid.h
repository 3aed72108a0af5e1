/* SPDX-License-Identifier: Apache-2.0 */
/* A grid of cells for points of the 2D torus, which finds the points near a position. */
#ifndef KOKSMA_PATTERNS_SHARED_TORUS_GRID_H
#define KOKSMA_PATTERNS_SHARED_TORUS_GRID_H

#include <koksma/koksma.h>

#include "core/torus.h"

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

#endif
