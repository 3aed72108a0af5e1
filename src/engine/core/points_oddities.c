/* SPDX-License-Identifier: Apache-2.0 */
/* What in a set of points looks like a mistake of whoever made it, though it can be measured. */
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/hash.h"
#include "core/points.h"
#include "core/status.h"
#include "core/visibility.h"

enum {
    MOST_COMPARED = 1 << 16, /* rows that are looked at for equal ones, in 20 ms */
    FEW = 16,                /* points below which a narrow column may be chance */
};

typedef struct remarks {
    char *text;
    size_t room, used, n;
} remarks;

KOKSMA_PRINTF(2, 3) static void remark(remarks *r, const char *format, ...)
{
    char line[160];
    va_list arguments;
    va_start(arguments, format);
    const int length = koksma__vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    r->n++;
    if (r->used + (size_t)length + 2 <= r->room) {
        memcpy(r->text + r->used, line, (size_t)length);
        r->used += (size_t)length;
        r->text[r->used++] = '\n';
        r->text[r->used] = '\0';
    }
}

typedef struct column {
    double low, high, sum;
    bool counts, bits; /* every value is 1 more than that of the row before; is 0 or 1 */
} column;

static column look_at(const koksma_points *points, size_t k)
{
    const double *x = points->xs + k;
    column c = {.low = *x, .high = *x, .counts = true, .bits = true};
    for (size_t i = 0; i < points->n; i++, x += points->dim) {
        c.low = fmin(c.low, *x);
        c.high = fmax(c.high, *x);
        c.sum += *x;
        c.counts &= *x == points->xs[k] + (double)i;
        c.bits &= *x == 0 || *x == 1;
    }
    return c;
}

/* The least range that is no surprise: that of n random numbers is smaller in one column of 10^9. A regular grid of two
   columns has 1/2. */
static double least_range(size_t n)
{
    return n < 32 ? 0.2 : n < 40 ? 0.45 : 0.4999;
}

static void look_at_columns(remarks *r, const koksma_points *points)
{
    const size_t n = points->n, dim = (size_t)points->dim;
    column *columns = malloc(dim * sizeof *columns);
    size_t of_bits = 0, narrow = 0;
    double low = 1, high = 0;
    for (size_t k = 0; columns && k < dim; k++) {
        const column c = columns[k] = look_at(points, k);
        of_bits += c.bits;
        narrow += n >= FEW && c.high - c.low < least_range(n);
        low = fmin(low, c.low);
        high = fmax(high, c.high);
    }
    for (size_t k = 0; columns && k < dim; k++) {
        const column c = columns[k];
        if (c.low == c.high) {
            remark(r, "column %zu is %.9g in all rows; is it a coordinate?", k + 1, c.low);
        } else if (c.counts && k == 0) {
            remark(r, "the first column counts the rows; if it is an index, leave it out");
        } else if (c.bits && of_bits < dim && n > 4) {
            remark(r, "column %zu has only 0 and 1; is it a coordinate?", k + 1);
        } else if (n >= FEW && fabs(c.sum - 1) < 0.01) {
            remark(r, "column %zu sums to 1; if these are weights, leave them out", k + 1);
        } else if (n >= FEW && narrow < dim && c.high - c.low < least_range(n)) {
            remark(r, "column %zu lies in [%.3g,%.3g]; is its unit right?", k + 1, c.low, c.high);
        }
    }
    if (narrow == dim && low < high) {
        remark(r, "all coordinates lie in [%.3g,%.3g]; is their unit right?", low, high);
    }
    free(columns);
}

typedef struct row {
    uint64_t hash;
    size_t i;
} row;

static int by_hash(const void *a, const void *b)
{
    const row *p = a, *q = b;
    return p->hash == q->hash ? (p->i > q->i) - (p->i < q->i) : (p->hash > q->hash) - (p->hash < q->hash);
}

/* Rows of one hash are taken as equal. */
static void look_for_twins(remarks *r, const koksma_points *points)
{
    const size_t n = points->n, size = (size_t)points->dim * sizeof(double);
    row *rows = n <= MOST_COMPARED ? malloc(n * sizeof *rows) : NULL;
    size_t twins = 0, twin = n, first = n;
    if (!rows) {
        return;
    }
    for (size_t i = 0; i < n; i++) {
        rows[i] = (row){koksma__hash(points->xs + i * (size_t)points->dim, size), i};
    }
    qsort(rows, n, sizeof *rows, by_hash);
    for (size_t i = 1, of = 0; i < n; i++) {
        const bool equal = rows[i].hash == rows[i - 1].hash;
        of = equal ? of : i; /* the first row of this hash */
        twins += equal;
        if (equal && rows[i].i < twin) {
            twin = rows[i].i;
            first = rows[of].i;
        }
    }
    free(rows);
    if (twins) {
        remark(r, "%zu of %zu points equal earlier ones; the first is point %zu, like point %zu", twins, n, twin + 1,
               first + 1);
    }
}

size_t koksma_points_oddities(const koksma_points *points, char *text, size_t room)
{
    KOKSMA__REQUIRE_OR(0, points, text);
    remarks r = {.text = text, .room = room};
    if (room) {
        *text = '\0';
    }
    if (points->xs && points->n == 1 && points->dim > 3) {
        remark(&r, "one point in %d dimensions; a line is a point", points->dim);
    } else if (points->xs && points->n > 1 && points->dim > 1) {
        if (points->dim > 3 && 2 * points->n < (size_t)points->dim) {
            remark(&r, "%zu points in %d dimensions; are rows and columns swapped?", points->n, points->dim);
        }
        look_at_columns(&r, points);
        look_for_twins(&r, points);
    }
    return r.n;
}
