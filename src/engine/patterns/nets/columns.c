/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Fills sets of points in blocks of rows on several threads. Coordinates are computed in columns of 512 points, which
 * stay in the cache, and kernels transpose the columns into rows. Streaming stores write sets that are larger than
 * the caches.
 */
#include "patterns/nets/nets.h"

#include "core/parallel.h"
#include "core/status.h"
#include "kernels/kernels.h"

enum { GROUP = 1 << 15, COLUMNS = 8, STREAM_BYTES = 1 << 23 };

typedef struct job {
    koksma__block f;
    const void *context;
    uint64_t first; /* the index that point 0 of `out` has in the sequence */
    koksma_points *out;
} job;

bool koksma__is_large(const koksma_points *out)
{
    return out->n * (size_t)out->dim * sizeof *out->xs >= STREAM_BYTES;
}

void koksma__store_column(size_t count, const double *xs, int dim, int k, double *out)
{
    out += k;
    for (size_t i = 0; i < count; i++, out += dim) {
        *out = xs[i];
    }
}

void koksma__store_columns(size_t count, int some, const double *columns, size_t first, int k, koksma_points *out)
{
    const size_t dim = (size_t)out->dim;
    double *to = out->xs + first * dim + k;
    if (some == out->dim && (some == 2 || some == 4)) {
        koksma__kernels()->rows_of_columns(count, some, columns, KOKSMA__COLUMN_BLOCK, koksma__is_large(out), to);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        for (size_t c = 0; c < (size_t)some; c++) {
            to[i * dim + c] = columns[c * KOKSMA__COLUMN_BLOCK + i];
        }
    }
}

/* Computes points at .. at + count - 1, which all belong to one aligned block of KOKSMA__COLUMN_BLOCK indices. */
static void block(const job *j, uint64_t at, size_t count)
{
    double columns[COLUMNS][KOKSMA__COLUMN_BLOCK];
    const int dim = j->out->dim;
    const size_t skip = (size_t)(at % KOKSMA__COLUMN_BLOCK);
    for (int k = 0; k < dim; k += COLUMNS) {
        const int some = dim - k < COLUMNS ? dim - k : COLUMNS;
        j->f(j->context, k, some, at - skip, skip + count, columns);
        koksma__store_columns(count, some, columns[0] + skip, (size_t)(at - j->first), k, j->out);
    }
}

/* Returns the number of groups that contain points first .. first + n - 1. Groups are aligned ranges of GROUP indices
   and do not depend on `first`. */
static size_t groups_of(uint64_t first, size_t n)
{
    return (size_t)((first + n - 1) / GROUP - first / GROUP + 1);
}

/* Computes the range at .. end - 1 of those points among first .. first + n - 1 that are in their group number g. */
static void group_of(uint64_t first, size_t n, size_t g, uint64_t *at, uint64_t *end)
{
    const uint64_t start = (first / GROUP + g) * GROUP;
    *at = start < first ? first : start;
    *end = start + GROUP < first + n ? start + GROUP : first + n;
}

static koksma_status group(void *context, size_t g)
{
    const job *j = context;
    uint64_t at, end;
    group_of(j->first, j->out->n, g, &at, &end);
    while (at < end) {
        const size_t left = (size_t)(end - at), some = KOKSMA__COLUMN_BLOCK - (size_t)(at % KOKSMA__COLUMN_BLOCK);
        const size_t count = left < some ? left : some;
        block(j, at, count);
        at += count;
    }
    return KOKSMA_OK;
}

koksma_status koksma__range_blocks(const koksma_args *args, koksma_points *out, koksma__block f, const void *context)
{
    job j = {f, context, args->first, out};
    const size_t n_groups = groups_of(j.first, out->n);
    return n_groups == 1 ? group(&j, 0) : koksma__parallel(args->run, n_groups, group, &j);
}

typedef struct single {
    koksma__column f;
    const void *context;
} single;

static void one_by_one(const void *context, int k, int some, uint64_t first, size_t count, koksma__columns xs)
{
    const single *s = context;
    for (int c = 0; c < some; c++) {
        s->f(s->context, k + c, first, count, xs[c]);
    }
}

koksma_status koksma__range_columns(const koksma_args *args, koksma_points *out, koksma__column f,
                                    const void *context)
{
    const single s = {f, context};
    return koksma__range_blocks(args, out, one_by_one, &s);
}

typedef struct digital_job {
    const uint32_t *const *directions;
    const uint32_t *starts;
    uint64_t first;
    koksma_points *out;
} digital_job;

uint32_t koksma__digital_start(const uint32_t *directions, uint64_t first)
{
    uint32_t start = 0;
    for (int b = 0; first; b++, first >>= 1) {
        start ^= first & 1 ? directions[b] : 0;
    }
    return start;
}

void koksma__digital_column(const void *context, int k, uint64_t first, size_t count, double *xs)
{
    const koksma__digital_columns *j = context;
    const uint32_t *directions = j->directions[k];
    const uint32_t start = koksma__digital_start(directions, first);
    uint32_t v[KOKSMA__COLUMN_BLOCK];
    koksma__kernels()->digital(count, directions, j->starts ? start ^ j->starts[k] : start, v);
    koksma__kernels()->fractions(count, v, xs);
}

/* Makes the points of group g of a digital sequence. The kernel handles aligned runs of 2^k points. A group that
   begins at an unaligned index is therefore cut into aligned runs of increasing length. */
static koksma_status group_of_digits(void *context, size_t g)
{
    const digital_job *j = context;
    const int dim = j->out->dim;
    uint64_t at, end;
    group_of(j->first, j->out->n, g, &at, &end);
    while (at < end) {
        const uint64_t run = at % GROUP ? at & -at : GROUP, left = end - at;
        const size_t count = (size_t)(left < run ? left : run);
        uint32_t starts[KOKSMA__DIGITAL_DIM];
        for (int k = 0; k < dim; k++) {
            starts[k] = j->starts[k] ^ koksma__digital_start(j->directions[k], at);
        }
        koksma__kernels()->digital_rows(count, dim, j->directions, starts, koksma__is_large(j->out),
                                        j->out->xs + (size_t)(at - j->first) * (size_t)dim);
        at += count;
    }
    return KOKSMA_OK;
}

koksma_status koksma__range_digital(const koksma_args *args, const uint32_t *const *directions,
                                    const uint32_t *starts, koksma_points *out)
{
    digital_job j = {directions, starts, args->first, out};
    const size_t n_groups = groups_of(j.first, out->n);
    return n_groups == 1 ? group_of_digits(&j, 0) : koksma__parallel(args->run, n_groups, group_of_digits, &j);
}

typedef struct whole {
    koksma__rows f;
    const void *context;
    koksma_points *out;
} whole;

static koksma_status group_of_rows(void *context, size_t g)
{
    const whole *w = context;
    const size_t first = g * GROUP, left = w->out->n - first;
    w->f(w->context, first, left < GROUP ? left : GROUP, koksma__is_large(w->out), w->out);
    return KOKSMA_OK;
}

koksma_status koksma__fill_rows(const koksma_run *run, koksma_points *out, koksma__rows f, const void *context)
{
    whole w = {f, context, out};
    const size_t n_groups = (out->n + GROUP - 1) / GROUP;
    return n_groups == 1 ? group_of_rows(&w, 0) : koksma__parallel(run, n_groups, group_of_rows, &w);
}
