/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Fills points by blocks of rows on several threads. Coordinates are made in columns of 512, which stay in the
 * cache, and kernels transpose columns into rows. Sets larger than the caches are written by streaming stores.
 */
#include "patterns/shared/columns.h"

#include "core/parallel.h"
#include "kernels/kernels.h"

enum { GROUP = 1 << 15, COLUMNS = 8, STREAM_BYTES = 1 << 23 };

typedef struct job {
    koksma__block f;
    const void *context;
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

static void block(const job *j, size_t first, size_t count)
{
    double columns[COLUMNS][KOKSMA__COLUMN_BLOCK];
    const int dim = j->out->dim;
    for (int k = 0; k < dim; k += COLUMNS) {
        const int some = dim - k < COLUMNS ? dim - k : COLUMNS;
        j->f(j->context, k, some, first, count, columns);
        koksma__store_columns(count, some, columns[0], first, k, j->out);
    }
}

static koksma_status group(void *context, size_t g)
{
    const job *j = context;
    const size_t end = (g + 1) * GROUP < j->out->n ? (g + 1) * GROUP : j->out->n;
    for (size_t first = g * GROUP; first < end; first += KOKSMA__COLUMN_BLOCK) {
        block(j, first, end - first < KOKSMA__COLUMN_BLOCK ? end - first : KOKSMA__COLUMN_BLOCK);
    }
    return KOKSMA_OK;
}

koksma_status koksma__fill_blocks(const koksma_run *run, koksma_points *out, koksma__block f, const void *context)
{
    job j = {f, context, out};
    const size_t n_groups = (out->n + GROUP - 1) / GROUP;
    return n_groups == 1 ? group(&j, 0) : koksma__parallel(run, n_groups, group, &j);
}

typedef struct single {
    koksma__column f;
    const void *context;
} single;

static void one_by_one(const void *context, int k, int some, size_t first, size_t count, koksma__columns xs)
{
    const single *s = context;
    for (int c = 0; c < some; c++) {
        s->f(s->context, k + c, first, count, xs[c]);
    }
}

koksma_status koksma__fill_columns(const koksma_run *run, koksma_points *out, koksma__column f, const void *context)
{
    const single s = {f, context};
    return koksma__fill_blocks(run, out, one_by_one, &s);
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
