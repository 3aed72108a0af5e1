/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Digital sequences in a prime base. Each point is computed from the previous one: for each digit of the index that
 * changes, a column of the matrix is added. On average base / (base - 1) digits change. The value is stored as a
 * whole number below base^digits <= 2^53 and divided once, which gives the nearest double.
 */
#include "patterns/nets/nets.h"

#include <stdlib.h>

#include "core/status.h"

enum { MAX_DIGITS = 53, FEW = 4096 };

typedef struct job {
    uint32_t base;
    int digits;
    double whole;
    uint32_t *matrices; /* digits^2 for each coordinate: entry [r][c] */
} job;

void koksma__pascal_matrix(uint32_t b, int k, int digits, uint32_t *matrix)
{
    for (int c = 0; c < digits; c++) {
        for (int r = 0; r < digits; r++) {
            /* C(c,r) k^(c-r) = C(c-1,r-1) k^(c-r) + k C(c-1,r) k^(c-1-r) */
            uint32_t value = r == 0 && c == 0;
            if (c > 0 && r <= c) {
                value = r > 0 ? matrix[(r - 1) * digits + c - 1] : 0;
                value += (uint32_t)k * matrix[r * digits + c - 1] % b;
            }
            matrix[r * digits + c] = value % b;
        }
    }
}

/* The digits a of an index, their product y with the matrix, and x = y_0 b^(digits-1) + y_1 b^(digits-2) + ... */
typedef struct walk {
    uint32_t a[MAX_DIGITS], y[MAX_DIGITS];
    double weight[MAX_DIGITS], x; /* whole numbers below 2^53 */
} walk;

/* Adds column c of the matrix to y, modulo b. */
static void add_column(const job *j, const uint32_t *matrix, int c, walk *w)
{
    for (int r = 0; r <= c; r++) {
        const uint32_t sum = w->y[r] + matrix[r * j->digits + c], y = sum < j->base ? sum : sum - j->base;
        w->x += ((double)y - w->y[r]) * w->weight[r];
        w->y[r] = y;
    }
}

static void begin(const job *j, const uint32_t *matrix, uint64_t index, walk *w)
{
    *w = (walk){.x = 0};
    double weight = j->whole;
    for (int r = 0; r < j->digits; r++) {
        w->weight[r] = weight /= j->base;
    }
    for (int c = 0; index; c++, index /= j->base) {
        for (w->a[c] = 0; w->a[c] < index % j->base; w->a[c]++) {
            add_column(j, matrix, c, w);
        }
    }
}

/* Advances to the next index. A digit that wraps from b - 1 to 0 also grows by 1 modulo b, so its column is added,
   too. */
static void step(const job *j, const uint32_t *matrix, walk *w)
{
    for (int c = 0; c < j->digits; c++) {
        add_column(j, matrix, c, w);
        if (++w->a[c] < j->base) {
            return;
        }
        w->a[c] = 0;
    }
}

static void column(const void *context, int k, uint64_t first, size_t count, double *xs)
{
    const job *j = context;
    const uint32_t *matrix = j->matrices + (size_t)k * (size_t)(j->digits * j->digits);
    walk w;
    begin(j, matrix, first, &w);
    for (size_t i = 0; i < count; i++) {
        xs[i] = w.x / j->whole;
        step(j, matrix, &w);
    }
}

int koksma__digits_of_double(uint32_t base)
{
    int digits = 0;
    for (uint64_t room = UINT64_C(1) << 53; room >= base; room /= base) {
        digits++;
    }
    return digits;
}

koksma_status koksma__digit_sequence(const char *name, uint32_t base, int most_digits, koksma__digit_matrix fill,
                                     const koksma_args *args, koksma_points *out)
{
    job j = {.base = base, .digits = 1, .whole = base};
    const double end = (double)(args->first + out->n);
    for (; j.whole < end && j.digits < most_digits; j.digits++) {
        j.whole *= base;
    }
    KOKSMA__FAIL_IF(
        j.whole < end, KOKSMA_N,
        "%s: point %.0f: the digits of coordinates in base %u fit into the 53 bits of a double up to point "
        "%.0f; fewer dimensions have smaller bases, and sobol has points up to 2^51 - 1",
        name, end - 1, base, j.whole - 1);
    uint32_t few[FEW];
    const size_t entries = (size_t)out->dim * (size_t)(j.digits * j.digits);
    j.matrices = entries <= FEW ? few : malloc(entries * sizeof *j.matrices);
    KOKSMA__REQUIRE_MEMORY(j.matrices, entries * sizeof *j.matrices);
    for (int k = 0; k < out->dim; k++) {
        fill(base, k, j.digits, j.matrices + (size_t)k * (size_t)(j.digits * j.digits));
    }
    const koksma_status status = koksma__range_columns(args, out, column, &j);
    if (j.matrices != few) {
        free(j.matrices);
    }
    return status;
}
