/* SPDX-License-Identifier: Apache-2.0 */
/* Exact spectra whose points and frequencies don't fit into the memory of one step, against the definition. */
#include <koksma/spectrum.h>

#include "sets.h"

/* More points than a chunk has room for, and more rows than a band. */
TEST_CASE(exact_spectra_of_many_chunks_and_bands)
{
    static const struct {
        size_t n;
        int half;
    } sizes[] = {{270000, 7}, {129, 1100}};
    for (int t = 0; t < 2; t++) {
        koksma_points p = test_points("random", sizes[t].n, 2, 1);
        const int half = sizes[t].half;
        koksma_spectrum exact;
        assert_ok(koksma_spectrum_init(&exact, half));
        assert_ok(koksma_spectrum_add(&exact, &p, KOKSMA_SPECTRUM_EXACT, &(koksma_run){.threads = 2}));
        for (int i = 0; i <= 2; i++) {
            const int kx = half * (i - 1), ky = half - half * i / 3;
            assert_near(koksma_spectrum_power(&exact, kx, ky), sets_power(&p, kx, ky), 1e-11 * (double)p.n);
        }
        koksma_spectrum_fini(&exact);
        koksma_points_fini(&p);
    }
}
