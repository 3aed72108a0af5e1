/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Radical inverses of consecutive indices: a table holds the mirrored low digits; the higher digits add a number that
 * changes only once per length of the table. Only the final division rounds, so each value is the double nearest to
 * its exact fraction.
 */
#include "patterns/nets/nets.h"

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/status.h"
#include "kernels/kernels.h"

static uint32_t digit_of(const koksma__radical *r, int j, uint32_t a)
{
    return r->digit ? r->digit(r->context, r->base, j, a) : a;
}

/* If digits are mapped, the digits of indices below MAPPED form the exact numerator, and the higher digits form the
   tail. */
#define MAPPED 0x1p28

/* Chooses the numbers of digits and the size of the table for indices below n. With mapped digits, the position at
   which the tail begins does not depend on n, so that values do not depend on n. */
static void measure(koksma__radical *r, uint32_t base, uint64_t n, bool mapped)
{
    const double most = mapped ? MAPPED : (double)n;
    r->base = base;
    r->whole = base;
    r->digits = 1;
    while (r->whole < most) {
        r->whole *= base;
        r->digits++;
    }
    size_t size = base;
    r->low_digits = 1;
    while (size < n && size * base <= KOKSMA__RADICAL_TABLE) {
        size *= base;
        r->low_digits++;
    }
    r->size = (uint32_t)(size < n ? size : n);
    r->high_scale = 1;
    for (int j = r->low_digits; j < r->digits; j++) {
        r->high_scale *= base;
    }
}

/* Returns the tail if digits are mapped: the fraction in [0,1) that the digits of `rest` (those above the numerator)
   and the infinitely many leading zeros add to the numerator. */
static double tail_of(const koksma__radical *r, uint64_t rest)
{
    double place = 1, tail = 0;
    for (int j = r->digits; r->digit && place > 0x1p-60; j++, rest /= r->base) {
        place /= r->base;
        tail += place * digit_of(r, j, (uint32_t)(rest % r->base));
    }
    /* The tail is rounded to a grid on which the sum of numerator and tail is exact, and it is kept below 1, so that
       values are below 1. */
    const double grid = koksma__exp2(floor(52 - koksma__log2(r->whole)));
    return fmin(floor(tail * grid + 0.5), grid - 1) / grid;
}

/* Computes table[a]: the mirrored low digits of a, as a whole number, times high_scale. */
static void fill_table(koksma__radical *r)
{
    double top = r->high_scale; /* the place value of digit 0 */
    for (int j = 1; j < r->low_digits; j++) {
        top *= r->base;
    }
    double scale = top;
    r->table[0] = 0;
    for (int j = 0; j < r->low_digits; j++, scale /= r->base) {
        r->table[0] += scale * digit_of(r, j, 0);
    }
    size_t done = 1;
    scale = top;
    for (int j = 0; done < r->size; j++, scale /= r->base) {
        const size_t step = done;
        for (uint32_t a = 1; a < r->base && done < r->size; a++) {
            const double add = scale * ((double)digit_of(r, j, a) - digit_of(r, j, 0));
            const size_t end = done + step < r->size ? done + step : r->size;
            for (size_t i = 0; done + i < end; i++) {
                r->table[done + i] = r->table[i] + add;
            }
            done = end;
        }
    }
    r->tail = tail_of(r, 0);
}

koksma_status koksma__radicals_init(koksma__radicals *r, int count, uint64_t n, koksma__digit digit,
                                    const void *context)
{
    size_t entries = 0;
    r->memory = NULL;
    r->columns = r->few;
    koksma__radical one;
    for (int k = 0; k < count; k++) {
        measure(&one, koksma__prime(k), n, digit != NULL);
        const double last = digit ? 0x1p53 / one.base : one.whole <= 0x1p53 ? one.whole : one.whole / one.base;
        KOKSMA__FAIL_IF(
            (double)n > last, KOKSMA_N,
            "point %llu: the digits of radical inverses in base %u fit into the 53 bits of a double up to "
            "point %.0f; fewer dimensions have smaller bases, and sobol has points up to 2^51 - 1",
            (unsigned long long)(n - 1), one.base, floor(last) - 1);
        entries += one.size;
    }
    double *table = r->room;
    if (count > 8 || entries > sizeof r->room / sizeof *r->room) {
        const size_t bytes = (size_t)count * sizeof *r->columns + entries * sizeof *table;
        r->memory = malloc(bytes);
        KOKSMA__REQUIRE_MEMORY(r->memory, bytes);
        r->columns = r->memory;
        table = (double *)(r->columns + count);
    }
    for (int k = 0; k < count; k++) {
        koksma__radical *c = &r->columns[k];
        measure(c, koksma__prime(k), n, digit != NULL);
        c->digit = digit;
        c->context = context;
        c->table = table;
        fill_table(c);
        table += c->size;
    }
    return KOKSMA_OK;
}

void koksma__radicals_fini(koksma__radicals *r)
{
    free(r->memory);
}

void koksma__radical_column(const koksma__radical *r, uint64_t first, size_t count, double *out)
{
    const koksma__kernel_table *kernels = koksma__kernels();
    while (count) {
        const size_t low = (size_t)(first % r->size);
        uint64_t rest = first / r->size;
        double high = 0, scale = r->high_scale;
        for (int j = r->low_digits; j < r->digits; j++) {
            scale /= r->base;
            high += scale * digit_of(r, j, (uint32_t)(rest % r->base));
            rest /= r->base;
        }
        const size_t some = count < r->size - low ? count : r->size - low;
        high += rest ? tail_of(r, rest) : r->tail;
        kernels->quotients(some, r->table + low, high, r->whole, out);
        out += some;
        first += some;
        count -= some;
    }
}

typedef struct job {
    const double *offset;
    double n;
    koksma__radicals radicals;
} job;

static void column(const void *context, int k, uint64_t first, size_t count, double *xs)
{
    const job *j = context;
    if (k == 0 && j->offset) {
        koksma__kernels()->steps(count, (double)first, *j->offset, j->n, xs);
    } else {
        koksma__radical_column(&j->radicals.columns[j->offset ? k - 1 : k], first, count, xs);
    }
}

koksma_status koksma__range_radicals(const koksma_args *args, uint64_t n, const double *offset, koksma__digit digit,
                                     const void *context, koksma_points *out)
{
    job j;
    j.offset = offset;
    j.n = (double)n;
    koksma_status status = koksma__radicals_init(&j.radicals, offset ? out->dim - 1 : out->dim, n, digit, context);
    if (!status) {
        status = koksma__range_columns(args, out, column, &j);
        koksma__radicals_fini(&j.radicals);
    }
    return status;
}
