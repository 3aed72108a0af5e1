/* SPDX-License-Identifier: Apache-2.0 */
/* The pair sums of the L2 discrepancies against their twin; the fast forms agree with each other bit for bit. */
#include "kernels/kernels.h"
#include "sets.h"

enum { MAX = 300, DIM = 5 };

TEST_CASE(pairs_equal_reference)
{
    double u[MAX * DIM], g[MAX * DIM], expected[2], got[2], first[2];
    for (size_t i = 0; i < MAX * DIM; i++) {
        u[i] = sets_unit(1, i);
        g[i] = sets_unit(2, i) - 0.3;
    }
    for (size_t n = 1; n <= MAX; n += 1 + n / 6) {
        const int dim = 1 + (int)(n % DIM);
        koksma__kernels_find("ref")->l2_pairs(n / 3, n, n, dim, u, g, -0.75, 0.5, expected);
        koksma__kernels_find("baseline")->l2_pairs(n / 3, n, n, dim, u, g, -0.75, 0.5, first);
        assert_near(expected[0] + expected[1], first[0] + first[1], 1e-15 * (double)(n * n));
        for (int isa = 0; isa < 2; isa++) {
            const koksma__kernel_table *fast = koksma__kernels_find(isa ? "avx2" : "avx512");
            if (fast) {
                fast->l2_pairs(n / 3, n, n, dim, u, g, -0.75, 0.5, got);
                assert_memory_equal(first, got, sizeof got);
            }
        }
    }
}

/* The rows of all L2 discrepancies have such factors; the products are double-doubles to the last bit. */
TEST_CASE(products_equal_reference)
{
    static const double rows[][4] = {{9, -12, -12, 0}, {25, 0, -12, 12}, {40, 0, 0, 0}, {37, 0, 6, -6}, {1, 0, 0, 3}};
    double u[MAX * DIM];
    for (size_t i = 0; i < MAX * DIM; i++) {
        u[i] = i % 11 == 3 ? 0.5 : i % 13 == 5 ? 1 : sets_unit(3, i);
    }
    for (size_t n = 0; n <= MAX; n += 1 + n / 6) {
        for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
            double a[2][MAX], b[2][MAX];
            koksma__kernels_find("ref")->l2_linear(n, 1 + (int)(n % DIM), u, MAX, rows[r], a[0], a[1]);
            for (int isa = 0; isa < 3; isa++) {
                const char *const names[] = {"baseline", "avx2", "avx512"};
                const koksma__kernel_table *fast = koksma__kernels_find(names[isa]);
                if (fast) {
                    fast->l2_linear(n, 1 + (int)(n % DIM), u, MAX, rows[r], b[0], b[1]);
                    assert_memory_equal(a[0], b[0], n * sizeof(double));
                    assert_memory_equal(a[1], b[1], n * sizeof(double));
                }
            }
        }
    }
}
