/* SPDX-License-Identifier: Apache-2.0 */
/* Patterns whose coordinates are computed one column at a time, a block of points at a time: no allocation, and the
   same bits on any number of threads. */
#ifndef KOKSMA_PATTERNS_SHARED_COLUMNS_H
#define KOKSMA_PATTERNS_SHARED_COLUMNS_H

#include <koksma/koksma.h>

enum { KOKSMA__COLUMN_BLOCK = 512 };

/* xs[0] .. xs[count-1] = coordinate k of points first .. first + count-1. first is a multiple of the block and count
   at most the block; xs has room for a whole block. */
typedef void (*koksma__column)(const void *context, int k, uint64_t first, size_t count, double *xs);

/* Coordinates k .. k + some - 1 at once, some <= 8: xs[c][i] = coordinate k + c of point first + i. */
typedef double (*koksma__columns)[KOKSMA__COLUMN_BLOCK];
typedef void (*koksma__block)(const void *context, int k, int some, uint64_t first, size_t count, koksma__columns xs);

/* Point 0 of out is point args->first. */
koksma_status koksma__range_blocks(const koksma_args *args, koksma_points *out, koksma__block f, const void *context);
koksma_status koksma__range_columns(const koksma_args *args, koksma_points *out, koksma__column f,
                                    const void *context);

enum { KOKSMA__DIGITAL_DIM = 16 };

/* A range of a digital sequence in base 2, dim <= KOKSMA__DIGITAL_DIM, up to point 2^32 - 1: coordinate k of point i is
   2^-32 times starts[k] xor directions[k][b] for all bits b of i. */
koksma_status koksma__range_digital(const koksma_args *args, const uint32_t *const *directions,
                                    const uint32_t *starts, koksma_points *out);

/* What the bits of `first` make of directions. */
uint32_t koksma__digital_start(const uint32_t *directions, uint64_t first);

/* An error unless the points wanted are below 2^32, which the indices of some sequences are. */
koksma_status koksma__range_fits(const char *name, const koksma_args *args, const koksma_points *out);

/* All coordinates of points first .. first + count - 1 of out, first a multiple of 32768; stream: past the caches. */
typedef void (*koksma__rows)(const void *context, size_t first, size_t count, bool stream, koksma_points *out);

koksma_status koksma__fill_rows(const koksma_run *run, koksma_points *out, koksma__rows f, const void *context);

/* Whether points are better stored past the caches: they are larger than these. */
bool koksma__is_large(const koksma_points *out);

/* out[i*dim + k] = xs[i] for i < count. */
void koksma__store_column(size_t count, const double *xs, int dim, int k, double *out);

/* Coordinates k .. k + some - 1 of points first .. first + count-1, column c at columns[c KOKSMA__COLUMN_BLOCK]. */
void koksma__store_columns(size_t count, int some, const double *columns, size_t first, int k, koksma_points *out);

#endif
