/* SPDX-License-Identifier: Apache-2.0 */
/* A grid of cells for points of the 2D torus, which finds the points near a position. */
#ifndef KOKSMA_PATTERNS_SHARED_TORUS_GRID_H
#define KOKSMA_PATTERNS_SHARED_TORUS_GRID_H

#include <koksma/koksma.h>

#include "core/torus.h"

typedef struct koksma__torus_grid {
    uint32_t cells;   /* cells on a side */
    uint32_t *head;   /* for each cell the point added last, or KOKSMA__NO_POINT */
    uint32_t *next;   /* for each point the one added to its cell before, or KOKSMA__NO_POINT */
    const double *xs; /* x and y of each point in turn; not owned */
} koksma__torus_grid;

#define KOKSMA__NO_POINT UINT32_MAX

/* Makes an empty grid for up to n points of xs, with about n cells. */
koksma_status koksma__torus_grid_init(koksma__torus_grid *grid, size_t n, const double *xs);
void koksma__torus_grid_fini(koksma__torus_grid *grid);

void koksma__torus_grid_clear(koksma__torus_grid *grid);
void koksma__torus_grid_add(koksma__torus_grid *grid, uint32_t point);

/* The squared distance from (x, y) to the nearest point in the grid, or 1 if there is none; once it is at most
   `enough`, any value at most `enough` may be returned. */
double koksma__torus_grid_nearest(const koksma__torus_grid *grid, double x, double y, double enough);

/* Whether a point in the grid is closer than d to (x, y), on the torus or, with torus = false, in the square. */
bool koksma__torus_grid_near(const koksma__torus_grid *grid, double x, double y, double d, bool torus);

#endif
