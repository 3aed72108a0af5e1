/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Dart throwing on the torus in 3 to 6 dimensions without wasted darts: the method of dart_cover.h for more
 * dimensions than 2. The points have the distribution of simple dart throwing: darts are uniform, and a dart is kept
 * if it is at least d from all darts kept before. Darts are thrown only at a cover of the free volume, made of cubes
 * of equal size; after each round each cube is cut into 2^dim, and those inside one ball of radius d are dropped.
 * Source: Ebeida, Mitchell, Patney, Davidson & Owens 2012.
 *
 * The number of cubes first grows and then shrinks. At its maximum it is about 12 times the number of points in 3
 * dimensions, 65 times in 4, 600 times in 5 and 4,500 times in 6. If the cover needs more than KOKSMA__BALL_BYTES, the
 * call fails with KOKSMA_IMPOSSIBLE and the error text of koksma__balls_fill.
 */
#ifndef KOKSMA_PATTERNS_SHARED_BALL_COVER_H
#define KOKSMA_PATTERNS_SHARED_BALL_COVER_H

#include <koksma/koksma.h>

enum { KOKSMA__BALL_DIMS = 6 };

#define KOKSMA__BALL_BYTES ((size_t)1 << 30) /* limit of the memory of one list of cubes */

typedef struct koksma__balls {
    int dim;
    double d;
    size_t n, room; /* number of points, and capacity of xs and next */
    double *xs;
    uint32_t side;  /* number of cells along an axis, at least d wide; 1 if fewer than 3 would fit */
    uint32_t *head; /* the last point of each cell; UINT32_MAX: none */
    uint32_t *next; /* for each point: the point before it in the same cell, or UINT32_MAX */
    size_t head_room;
    uint32_t along;                        /* number of cubes along an axis of the torus */
    uint32_t *cubes;                       /* dim integer coordinates for each cube of the cover */
    size_t n_cubes, cube_room, most_cubes; /* most_cubes: the largest n_cubes so far */
    uint64_t seed, dart;                   /* the random stream of darts and the next dart's number in it */
} koksma__balls;

/* Prepares an empty set for distance d > 0 in 3 to KOKSMA__BALL_DIMS dimensions. */
koksma_status koksma__balls_init(koksma__balls *balls, uint64_t seed, int dim, double d);
void koksma__balls_fini(koksma__balls *balls);

/* Throws darts until there are n points or no free volume is left; n = SIZE_MAX: until none is left. */
koksma_status koksma__balls_fill(koksma__balls *balls, size_t n, const koksma_run *run);

/* Keeps the first n points and makes the cover of the free volume for the smaller distance d. */
koksma_status koksma__balls_shrink(koksma__balls *balls, size_t n, double d, const koksma_run *run);

/* Returns the mean of n d^dim over maximal sets in 2 and more dimensions, from saturated random sequential addition
   of balls of diameter d (Zhang & Torquato 2013). */
double koksma__balls_per_volume(int dim);

#endif
