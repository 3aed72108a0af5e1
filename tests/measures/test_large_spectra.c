/* SPDX-License-Identifier: Apache-2.0 */
/* Exact spectra whose points and frequencies don't fit into the memory of one step, against the definition; rings
   that hold nothing. */
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

/* Rings without power have no anisotropy, and rings of equal powers have none in dB; by both methods, whose rounding
   makes numbers of either. */
TEST_CASE(anisotropy_of_nothing)
{
    enum { HALF = 12 };
    for (int method = 0; method < 4; method++) {
        koksma_points p = test_points("regular", 36, 2, 0);
        koksma_spectrum s;
        koksma_ring rings[HALF];
        for (size_t c = 0; method / 2 && c < 2 * p.n; c++) {
            p.xs[c] = c % 2 ? 0.3 : 0.7; /* one place */
        }
        assert_ok(koksma_spectrum_init(&s, HALF));
        assert_ok(koksma_spectrum_add(&s, &p, method % 2 ? KOKSMA_SPECTRUM_FAST : KOKSMA_SPECTRUM_EXACT, NULL));
        assert_ok(koksma_spectrum_rings(&s, rings));
        for (int r = 1; r <= HALF; r++) {
            const double db = rings[r - 1].anisotropy_db;
            const bool has_power = r == 6 || r == 8 || r == 12; /* 6, 6 sqrt(2) and 12 */
            assert_true(method / 2 ? db == -(double)INFINITY : has_power ? db > 0 : isnan(db));
        }
        koksma_spectrum_fini(&s);
        koksma_points_fini(&p);
    }
}
