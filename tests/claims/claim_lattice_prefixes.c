/* SPDX-License-Identifier: Apache-2.0 */
/* lattice-prefixes: for every m, the first 2^m points are a lattice, perhaps shifted: there are whole numbers z, the
   first odd, for which they are {i z / 2^m + shift}, i = 0 .. 2^m - 1, in any order. */
#include "claims/claims.h"

/* How far point p is from the first along an axis, on the torus, in units of 1/n; fails unless it is a whole number. */
static size_t steps_of(const koksma_spec *spec, const koksma_points *points, size_t n, size_t p, size_t k)
{
    const double steps = (points->xs[p * (size_t)points->dim + k] - points->xs[k]) * (double)n, whole = round(steps);
    if (!(fabs(steps - whole) < 1e-9 * (double)n)) {
        fail_claim(spec, points, "of the first %zu points, 0 and %zu are %.9g/%zu apart on axis %zu", n, p, steps, n,
                   k);
    }
    return (size_t)(whole < 0 ? whole + (double)n : whole) % n;
}

/* The point that is i steps from the first along axis 0 is i times as far from it as that of one step, along each axis. */
static void check_prefix(const koksma_spec *spec, const koksma_points *points, size_t n)
{
    const size_t dim = (size_t)points->dim;
    size_t *at = malloc(n * sizeof *at); /* [i]: the point that is i steps from the first */
    assert_non_null(at);
    memset(at, 0xff, n * sizeof *at);
    for (size_t p = 0; p < n; p++) {
        const size_t i = steps_of(spec, points, n, p, 0);
        if (at[i] != SIZE_MAX) {
            fail_claim(spec, points, "two of the first %zu points are %zu/%zu from the first on axis 0", n, i, n);
        }
        at[i] = p;
    }
    for (size_t i = 1; i < n; i++) {
        for (size_t k = 0; k < dim; k++) {
            if (steps_of(spec, points, n, at[i], k) != i * steps_of(spec, points, n, at[1], k) % n) {
                fail_claim(spec, points, "the first %zu points are not a lattice on axis %zu", n, k);
            }
        }
    }
    free(at);
}

void claim_LATTICE_PREFIXES(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    for (size_t n = 2; n <= points->n; n *= 2) {
        check_prefix(spec, points, n);
    }
}
