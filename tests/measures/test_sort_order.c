/* SPDX-License-Identifier: Apache-2.0 */
/* The stable order of numbers against the library's sort: ties, numbers that differ only behind the 32nd bit, ends.
 */
#include <stdlib.h>

#include "measures/shared/shared.h"
#include "sets.h"

typedef struct entry {
    double x;
    uint32_t index;
} entry;

static int compare(const void *a, const void *b)
{
    const entry *x = a, *y = b;
    return x->x != y->x ? (x->x > y->x) - (x->x < y->x) : (x->index > y->index) - (x->index < y->index);
}

/* 0: uniform. 1: multiples of 1/16, ends included. 2: all within 2^-32 of 1/3. 3: powers of 1/2 down to denormals.
   4: 0, -0 and 1. 5: few places, with differences in the last bits. */
static double number(int kind, uint64_t seed, size_t i)
{
    const double u = sets_unit(seed, i), v = sets_unit(seed, i + 1000000);
    const double numbers[] = {
        u,
        floor(17 * u) / 16,
        1.0 / 3 + u * 0x1p-34,
        exp2(-1100 * u),
        u < 0.3   ? 0.0
        : u < 0.6 ? -0.0
                  : 1,
        floor(64 * u) / 64 + floor(8 * v) * 0x1p-50,
    };
    return numbers[kind];
}

TEST_CASE(orders_as_qsort)
{
    static const size_t sizes[] = {1, 2, 31, 32, 33, 100, 4095, 4096, 40000, 70001};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        for (int kind = 0; kind < 6; kind++) {
            const size_t n = sizes[s], stride = 1 + s % 3;
            entry *entries = malloc(n * sizeof *entries);
            double *xs = malloc(n * stride * sizeof *xs);
            uint32_t *order = malloc(n * sizeof *order);
            assert_true(entries && xs && order);
            for (size_t i = 0; i < n; i++) {
                xs[i * stride] = number(kind, s, i);
                entries[i] = (entry){xs[i * stride], (uint32_t)i};
            }
            qsort(entries, n, sizeof *entries, compare);
            for (int threads = 1; threads <= 3; threads += 2) {
                const koksma_run run = {.threads = threads};
                assert_ok(koksma__order(&run, n, xs, stride, order));
                for (size_t r = 0; r < n; r++) {
                    if (order[r] != entries[r].index) {
                        fail_msg("n = %zu, kind %d, rank %zu: %u, not %u", n, kind, r, order[r], entries[r].index);
                    }
                }
            }
            free(entries);
            free(xs);
            free(order);
        }
    }
}
