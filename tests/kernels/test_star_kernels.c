/* SPDX-License-Identifier: Apache-2.0 */
/* The kernels of the star discrepancy against their twins: maxima of the same numbers, to the bit; lists longer than
   the fast form's chunks among them. */
#include "core/random.h"
#include "kernels/kernels.h"
#include "sets.h"

enum { MAX = 600 };

static const char *const isas[] = {"baseline", "avx2", "avx512"};

TEST_CASE(sweep_equals_reference)
{
    const koksma__kernel_table *ref = koksma__kernels_find("ref");
    double x[MAX], y[MAX + 8], count[MAX + 9];
    uint32_t rank[MAX];
    for (size_t n = 1; n <= 100; n++) {
        koksma__random_permutation(n, 0, (uint32_t)n, rank);
        for (size_t i = 0; i < n; i++) {
            x[i] = ((double)i + sets_unit(n, i)) / (double)n;
            y[i] = ((double)i + sets_unit(n, n + i)) / (double)n;
        }
        for (size_t j = n; j < n + 8; j++) {
            y[j] = 1;
        }
        double a[2], b[2];
        size_t at_a[2], at_b[2];
        ref->star_sweep(n, x, rank, y, count, a, at_a);
        for (size_t isa = 0; isa < 3; isa++) {
            const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
            if (fast) {
                fast->star_sweep(n, x, rank, y, count, b, at_b);
                assert_memory_equal(a, b, sizeof a);
                assert_memory_equal(at_a, at_b, sizeof at_a);
            }
        }
    }
}

TEST_CASE(partition_equals_reference)
{
    const koksma__kernel_table *ref = koksma__kernels_find("ref");
    double a[MAX], b[MAX], r[2 * MAX], f[2 * MAX + 8];
    for (size_t i = 0; i < 2 * MAX; i++) {
        (i % 2 ? a : b)[i / 2] = sets_unit(1, i);
    }
    for (size_t na = 1; na <= MAX; na += 1 + na / 4) {
        for (size_t nb = 1; nb <= MAX; nb += 1 + nb / 7) {
            for (int smallest = 0; smallest < 2; smallest++) {
                ref->star_extremes(na, a, nb, b, smallest, r);
                const double best = ref->star_pairs(na, a, nb, b, smallest, 300, 7);
                for (size_t isa = 0; isa < 3; isa++) {
                    const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
                    if (fast) {
                        fast->star_extremes(na, a, nb, b, smallest, f);
                        assert_memory_equal(r, f, (na + nb - 1) * sizeof(double));
                        assert_true(fast->star_pairs(na, a, nb, b, smallest, 300, 7) == best);
                    }
                }
            }
        }
    }
}

TEST_CASE(corners_equal_reference)
{
    enum { MOST = 300 };
    const koksma__kernel_table *ref = koksma__kernels_find("ref");
    int16_t counts[MOST];
    float xs[MOST];
    uint32_t a[MOST + 1], b[MOST + 1];
    for (size_t count = 1; count < MOST; count += 1 + count / 8) {
        for (size_t k = 0; k < count; k++) {
            counts[k] = (int16_t)(100 * sets_unit(count, k));
            xs[k] = (float)(100 * sets_unit(count + 1, k));
        }
        for (int way = 0; way < 4; way++) {
            const float sign = way % 2 ? 1 : -1, limit = way < 2 ? 80 : 20;
            const size_t found = ref->far_corners(count, counts, xs, sign, sign * 1.01F, limit, a);
            for (size_t isa = 0; isa < 3; isa++) {
                const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
                if (fast) {
                    assert_int_equal(fast->far_corners(count, counts, xs, sign, sign * 1.01F, limit, b), found);
                    assert_memory_equal(a, b, found * sizeof *a);
                }
            }
        }
    }
}
