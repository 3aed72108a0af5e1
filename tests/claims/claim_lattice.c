/* SPDX-License-Identifier: Apache-2.0 */
/* lattice: the points are a lattice: their differences form a group on the torus. */
#include "claims/claims.h"

void claim_LATTICE(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const size_t n = points->n, dim = (size_t)points->dim;
    for (size_t i = 0; i < n && n <= 64; i++) {
        for (size_t j = 0; j < n; j++) {
            bool found = false;
            for (size_t l = 0; l < n && !found; l++) {
                found = true;
                for (size_t k = 0; k < dim && found; k++) {
                    const double t =
                        points->xs[i * dim + k] + points->xs[j * dim + k] - points->xs[k] - points->xs[l * dim + k];
                    found = fabs(t - floor(t + 0.5)) < 1e-9;
                }
            }
            if (!found) {
                fail_claim(spec, points, "points %zu and %zu do not add up to a point", i, j);
            }
        }
    }
}
