/* SPDX-License-Identifier: Apache-2.0 */
/* Fills the points of patterns that compute one coordinate (a column) of a block of points at a time. The functions
   allocate no memory, and results are bitwise equal for any number of threads. */
#ifndef KOKSMA_PATTERNS_SHARED_COLUMNS_H
#define KOKSMA_PATTERNS_SHARED_COLUMNS_H

#include <koksma/koksma.h>

enum { KOKSMA__COLUMN_BLOCK = 512 };

/* Computes coordinate k of points first .. first + count - 1 into xs[0] .. xs[count - 1]. `first` is a multiple of
   KOKSMA__COLUMN_BLOCK and count is at most that; xs has capacity for a whole block. */
typedef void (*koksma__column)(const void *context, int k, uint64_t first, size_t count, double *xs);

/* Computes the coordinates k .. k + some - 1 at once, some <= 8: xs[c][i] is coordinate k + c of point first + i. */
typedef double (*koksma__columns)[KOKSMA__COLUMN_BLOCK];
typedef void (*koksma__block)(const void *context, int k, int some, uint64_t first, size_t count, koksma__columns xs);

/* Fill `out` with points args->first, args->first + 1, ... by calling f for each block of points. */
koksma_status koksma__range_blocks(const koksma_args *args, koksma_points *out, koksma__block f, const void *context);
koksma_status koksma__range_columns(const koksma_args *args, koksma_points *out, koksma__column f,
                                    const void *context);

enum { KOKSMA__DIGITAL_DIM = 16 };

/* Fills `out` with a range of a digital sequence in base 2, dim <= KOKSMA__DIGITAL_DIM, up to point 2^32 - 1:
   coordinate k of point i is 2^-32 times the exclusive or of starts[k] and directions[k][b] for all bits b set in i. */
koksma_status koksma__range_digital(const koksma_args *args, const uint32_t *const *directions,
                                    const uint32_t *starts, koksma_points *out);

/* Returns the exclusive or of directions[b] over all bits b that are set in `first`. */
uint32_t koksma__digital_start(const uint32_t *directions, uint64_t first);

/* The context of koksma__digital_column: the directions of each coordinate, and the word to which the directions are
   added; NULL: 0. */
typedef struct koksma__digital_columns {
    const uint32_t (*directions)[32];
    const uint32_t *starts;
} koksma__digital_columns;

/* A koksma__column of a digital sequence in base 2 of any number of dimensions. */
void koksma__digital_column(const void *context, int k, uint64_t first, size_t count, double *xs);

/* Computes all coordinates of points first .. first + count - 1 of `out`, with `first` a multiple of 32768; `stream`:
   whether to bypass the caches with streaming stores. */
typedef void (*koksma__rows)(const void *context, size_t first, size_t count, bool stream, koksma_points *out);

koksma_status koksma__fill_rows(const koksma_run *run, koksma_points *out, koksma__rows f, const void *context);

/* Returns whether the set is larger than the caches, so that streaming stores should write it. */
bool koksma__is_large(const koksma_points *out);

/* Stores a column as coordinate k of `count` points: out[i*dim + k] = xs[i] for i < count. */
void koksma__store_column(size_t count, const double *xs, int dim, int k, double *out);

/* Stores coordinates k .. k + some - 1 of points first .. first + count - 1; the numbers of coordinate k + c begin at
   columns[c * KOKSMA__COLUMN_BLOCK]. */
void koksma__store_columns(size_t count, int some, const double *columns, size_t first, int k, koksma_points *out);

#endif
