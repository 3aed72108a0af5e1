/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Dart throwing on the 2D torus without wasted darts. The points have the distribution of simple dart throwing: darts
 * are uniform, and a dart is kept if it is at least d from all darts kept before. Darts are thrown only at a cover of
 * the free area, made of squares of equal size, so that a dart that lands in the free area is uniform there. The
 * cover is the flat quadtree of Ebeida, Mitchell, Patney, Davidson & Owens (2012): after each round of darts each
 * square is cut into four, and squares without free area are dropped.
 *
 * A grid that fits into the cache is one tile. A larger grid is cut into tiles that fit. In each tile the darts of a
 * round arrive as a Poisson process in time; all tiles together are one Poisson process over the cover. Whether a
 * dart is kept depends only on earlier darts near it. Each tile thus decides its darts in order of time. Darts near
 * its border may depend on another tile; these darts, and later darts near them, wait until the end of the round and
 * are then decided in order of time. The points therefore have the same distribution as with a single tile, and most
 * darts access only memory in the cache.
 *
 * Positions are also stored as fixed-point numbers in units of 2^-12 of a cell (kernels/dart_cells.h), which decide
 * almost all cases; only the closest ones are decided with doubles. Darts are drawn in batches of some hundreds.
 * The darts of a batch that are too near to points of earlier batches are dropped in one pass; the others are decided
 * one by one. The cover may contain squares without free area, because all darts in them are dropped anyway.
 * Therefore only the nearest cells are examined for large squares.
 */
#ifndef KOKSMA_PATTERNS_SHARED_DART_COVER_H
#define KOKSMA_PATTERNS_SHARED_DART_COVER_H

#include "patterns/shared/dart_tiles.h"

/* Throws darts until there are n points or no free area is left; with n = SIZE_MAX until no free area is left. When
   it stops at n points, the grid may be incomplete and must not be used. */
koksma_status koksma__disks_fill(koksma__disks *disks, size_t n, const koksma_run *run);

/* Keeps the first n points and makes the cover of the free area for the smaller distance d. */
koksma_status koksma__disks_shrink(koksma__disks *disks, size_t n, double d);

/* Cuts each square into four and keeps the quarters with free area. */
koksma_status koksma__disks_refine(koksma__disks *disks);

#endif
