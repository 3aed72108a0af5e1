/* SPDX-License-Identifier: Apache-2.0 */
/* The multipliers of lattices, read from their points. */
#ifndef KOKSMA_TESTS_LATTICES_H
#define KOKSMA_TESTS_LATTICES_H

#include "test.h"

/* The multipliers are in the second point of a lattice: x_k = z_k / n. */
static inline void lattices_multipliers(const char *pattern, size_t n, int dim, size_t *z)
{
    koksma_points points = test_points(pattern, n, dim, 0);
    for (int k = 0; k < dim; k++) {
        z[k] = (size_t)(points.xs[dim + k] * (double)n + 0.5);
    }
    koksma_points_fini(&points);
}

/* The multipliers of lattice-sequence modulo 2^20: phi(2^19) = 2^-20. */
static inline void lattices_sequence_multipliers(int dim, size_t *z)
{
    koksma_spec spec;
    koksma_points point;
    assert_ok(koksma_pattern_spec("lattice-sequence", &spec));
    assert_ok(koksma_points_init(&point, 1, dim));
    assert_ok(koksma_generate_range(&spec, 0, 0, 1 << 19, NULL, &point));
    for (int k = 0; k < dim; k++) {
        z[k] = (size_t)(point.xs[k] * 0x1p20);
        assert_true(z[k] % 2 == 1 && (double)z[k] == point.xs[k] * 0x1p20);
    }
    koksma_points_fini(&point);
}

static inline size_t lattices_common_divisor(size_t a, size_t b)
{
    return b ? lattices_common_divisor(b, a % b) : a;
}

#endif
