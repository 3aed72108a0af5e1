/* SPDX-License-Identifier: Apache-2.0 */
/* Points of the 2D torus in a grid of cells, for questions about neighbours. */
#ifndef KOKSMA_PATTERNS_SHARED_TORUS_GRID_H
#define KOKSMA_PATTERNS_SHARED_TORUS_GRID_H

#include <koksma/koksma.h>

#include "core/torus.h"

typedef struct koksma__torus_grid {
    uint32_t cells;   /* a side */
    uint32_t *head;   /* of each cell: the point put in last, or KOKSMA__NO_POINT */
    uint32_t *next;   /* of each point: the next older point in its cell, or KOKSMA__NO_POINT */
    const double *xs; /* pairs; borrowed */
} koksma__torus_grid;

#define KOKSMA__NO_POINT UINT32_MAX

/* A grid for up to n points of xs with about one point a cell; empty at first. */
koksma_status koksma__torus_grid_init(koksma__torus_grid *grid, size_t n, const double *xs);
void koksma__torus_grid_fini(koksma__torus_grid *grid);

void koksma__torus_grid_clear(koksma__torus_grid *grid);
void koksma__torus_grid_add(koksma__torus_grid *grid, uint32_t point);

/* The square of the distance from (x, y) to the nearest point in the grid; stops with any value at most `enough` when
   that is certain. 1 with no point. */
double koksma__torus_grid_nearest(const koksma__torus_grid *grid, double x, double y, double enough);

/* Whether a point in the grid is closer than d to (x, y): on the torus, or in the square alone. */
bool koksma__torus_grid_near(const koksma__torus_grid *grid, double x, double y, double d, bool torus);

#endif
