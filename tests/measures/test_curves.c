/* SPDX-License-Identifier: Apache-2.0 */
/* Spectra against the definition and each other, pair correlation and distances against all pairs, diaphony and t
   against what is known; kernels against twins. */
#include <stdlib.h>
#include <string.h>

#include <koksma/spectrum.h>

#include "kernels/kernels.h"
#include "sets.h"

static koksma_spectrum spectrum_of(const koksma_points *p, int half, koksma_spectrum_method method, int threads)
{
    koksma_spectrum s;
    assert_ok(koksma_spectrum_init(&s, half));
    assert_ok(koksma_spectrum_add(&s, p, method, &(koksma_run){.threads = threads}));
    return s;
}

TEST_CASE(spectra_equal_the_definition)
{
    static const int halves[] = {1, 5, 16, 37};
    for (int t = 0; t < 24; t++) {
        koksma_points p = sets_points(1 + 13 * (size_t)t, 2, t % SETS_KINDS, (uint64_t)t);
        const int half = halves[t % 4];
        koksma_spectrum exact = spectrum_of(&p, half, KOKSMA_SPECTRUM_EXACT, 1);
        koksma_spectrum fast = spectrum_of(&p, half, KOKSMA_SPECTRUM_FAST, 1);
        for (int kx = -half; kx <= half; kx += 1 + half / 4) {
            for (int ky = -half; ky <= half; ky += 1 + half / 5) {
                const double power = sets_power(&p, kx, ky), n = (double)p.n;
                assert_near(koksma_spectrum_power(&exact, kx, ky), power, 1e-12 * n);
                assert_near(koksma_spectrum_power(&fast, kx, ky), power, 2e-10 * n);
            }
        }
        koksma_spectrum_fini(&exact);
        koksma_spectrum_fini(&fast);
        koksma_points_fini(&p);
    }
}

/* Random points have power 1 at every frequency; a jittered set of m x m cells 1 - sinc^2 sinc^2. */
TEST_CASE(radial_means_have_known_values)
{
    enum { HALF = 12, SETS = 400 };
    for (int jittered = 0; jittered < 2; jittered++) {
        koksma_spectrum s;
        koksma_ring rings[HALF];
        assert_ok(koksma_spectrum_init(&s, HALF));
        for (uint64_t seed = 0; seed < SETS; seed++) {
            koksma_points p = test_points(jittered ? "jittered" : "random", 64, 2, seed);
            assert_ok(koksma_spectrum_add(&s, &p, KOKSMA_SPECTRUM_FAST, NULL));
            koksma_points_fini(&p);
        }
        koksma_spectrum_rings(&s, rings);
        for (int r = 1; r <= HALF; r++) {
            double expected = 0, count = 0;
            for (int kx = -r - 1; kx <= r + 1; kx++) {
                for (int ky = -r - 1; ky <= r + 1; ky++) {
                    if ((int)floor(hypot(kx, ky) + 0.5) == r && abs(kx) <= HALF && abs(ky) <= HALF) {
                        const double a = M_PI * kx / 8, b = M_PI * ky / 8;
                        const double x = kx ? sin(a) / a : 1, y = ky ? sin(b) / b : 1;
                        const double grid = kx % 8 || ky % 8 ? 0 : 64 * x * x * y * y; /* of the cells' means */
                        expected += jittered ? 1 - x * x * y * y + grid : 1;
                        count++;
                    }
                }
            }
            assert_near(rings[r - 1].power, expected / count, 5 * rings[r - 1].standard_error + 1e-12);
            assert_true(rings[r - 1].standard_error < 0.05 && rings[r - 1].frequency == r);
        }
        koksma_spectrum_quality_values quality;
        koksma_spectrum_quality(&s, &quality);
        assert_true(jittered ? quality.effective_nyquist >= 0.5 && quality.effective_nyquist <= 2
                             : quality.effective_nyquist == 0);
        assert_near(quality.relative_nyquist, quality.effective_nyquist / 4, 1e-15);
        assert_true(isnan(quality.oscillation)); /* the spectrum ends too early */
        koksma_spectrum_fini(&s);
    }
}

/* Radial mean, error and anisotropy by the definitions, over all frequencies of both halves of the plane. */
TEST_CASE(rings_equal_the_definition)
{
    enum { HALF = 9, SETS = 3 };
    for (int kind = 0; kind < SETS_KINDS; kind++) {
        koksma_points p[SETS];
        koksma_spectrum s;
        koksma_ring rings[HALF];
        assert_ok(koksma_spectrum_init(&s, HALF));
        for (uint64_t t = 0; t < SETS; t++) {
            p[t] = sets_points(23, 2, kind, 50 + t);
            assert_ok(koksma_spectrum_add(&s, &p[t], KOKSMA_SPECTRUM_EXACT, NULL));
        }
        assert_ok(koksma_spectrum_rings(&s, rings));
        for (int r = 1; r <= HALF; r++) {
            double powers[SETS][200], means[SETS] = {0}, mean = 0, spread = 0, along = 0;
            int count = 0;
            for (int kx = -HALF; kx <= HALF; kx++) {
                for (int ky = -HALF; ky <= HALF; ky++) {
                    const int norm = kx * kx + ky * ky; /* r - 1/2 <= |k| < r + 1/2 in whole numbers */
                    if (4 * norm >= (2 * r - 1) * (2 * r - 1) && 4 * norm < (2 * r + 1) * (2 * r + 1)) {
                        for (int t = 0; t < SETS; t++) {
                            powers[t][count] = sets_power(&p[t], kx, ky);
                        }
                        count++;
                    }
                }
            }
            for (int i = 0; i < SETS * count; i++) {
                means[i / count] += powers[i / count][i % count] / count;
                mean += powers[i / count][i % count] / count / SETS;
            }
            for (int t = 0; t < SETS; t++) {
                spread += (means[t] - mean) * (means[t] - mean) / (SETS - 1);
            }
            for (int i = 0; i < count; i++) {
                const double off = (powers[0][i] + powers[1][i] + powers[2][i]) / SETS - mean;
                along += off * off / (count / 2.0 - 1) / 2; /* each frequency stands beside its mirror */
            }
            assert_near(rings[r - 1].power, mean, 1e-11);
            assert_near(rings[r - 1].standard_error, sqrt(spread / SETS), 1e-11);
            assert_near(rings[r - 1].anisotropy_db, 10 * log10(along / mean / mean), 1e-8);
        }
        koksma_spectrum_fini(&s);
        for (int t = 0; t < SETS; t++) {
            koksma_points_fini(&p[t]);
        }
    }
}

TEST_CASE(equal_sets_have_no_error)
{
    koksma_points p = test_points("jittered", 100, 2, 3);
    koksma_spectrum s;
    koksma_ring rings[20];
    assert_ok(koksma_spectrum_init(&s, 20));
    for (int t = 0; t < 7; t++) {
        assert_ok(koksma_spectrum_add(&s, &p, KOKSMA_SPECTRUM_FAST, NULL));
    }
    assert_ok(koksma_spectrum_rings(&s, rings));
    for (int r = 0; r < 20; r++) {
        assert_true(rings[r].standard_error == 0);
    }
    koksma_spectrum_fini(&s);
    koksma_points_fini(&p);
}

/* A spectrum that ends early has the same effective Nyquist frequency as a large one, or none. That of the square
   lattice is half of the last frequency before its first peak, which is at sqrt(n). */
TEST_CASE(nyquist_is_that_of_large_spectra)
{
    static const char *const patterns[] = {"regular", "random", "jittered", "poisson-disk-maximal"};
    for (int i = 0; i < 4; i++) {
        double expected = i ? 0 : 15 / 2.0;
        koksma_points p = test_points(patterns[i], 256, 2, 7);
        for (int half = 60; half > 0; half--) {
            koksma_spectrum_quality_values quality;
            koksma_spectrum s;
            assert_ok(koksma_spectrum_init(&s, half));
            assert_ok(koksma_spectrum_add(&s, &p, KOKSMA_SPECTRUM_EXACT, NULL));
            koksma_spectrum_quality(&s, &quality);
            koksma_spectrum_fini(&s);
            expected = i && half == 60 ? quality.effective_nyquist : expected;
            assert_true(quality.effective_nyquist == expected || (half < 24 && isnan(quality.effective_nyquist)));
            assert_true(half >= 8 || isnan(quality.effective_nyquist)); /* the search goes on at least to sqrt(n)/2 */
            assert_true(isnan(quality.effective_nyquist) ? isnan(quality.relative_nyquist)
                                                         : quality.relative_nyquist == quality.effective_nyquist / 8);
        }
        koksma_points_fini(&p);
    }
}

static double distance_on_torus(const double *a, const double *b, bool torus)
{
    double dx = fabs(a[0] - b[0]), dy = fabs(a[1] - b[1]);
    dx = torus ? fmin(dx, 1 - dx) : dx;
    dy = torus ? fmin(dy, 1 - dy) : dy;
    return hypot(dx, dy);
}

TEST_CASE(distances_equal_all_pairs)
{
    enum { BINS = 20 };
    for (int t = 0; t < test_repeats(300, 60); t++) {
        koksma_points p = sets_points(1 + (size_t)t, 2, t % SETS_KINDS, (uint64_t)t);
        const double r_max = 0.05 + 0.45 * sets_unit(77, (uint64_t)t), n = (double)p.n;
        double least[2] = {HUGE_VAL, HUGE_VAL}, counts[BINS] = {0}, values[BINS];
        for (size_t i = 0; i < p.n; i++) {
            for (size_t j = 0; j < i; j++) {
                const double on = distance_on_torus(p.xs + 2 * i, p.xs + 2 * j, true);
                least[0] = fmin(least[0], on);
                least[1] = fmin(least[1], distance_on_torus(p.xs + 2 * i, p.xs + 2 * j, false));
                if (on < r_max) {
                    counts[(int)fmin(on * BINS / r_max, BINS - 1)] += 1;
                }
            }
        }
        assert_ok(koksma_pair_correlation(&p, r_max, BINS, NULL, values));
        double total = 0, expected = 0;
        for (int b = 0; b < BINS; b++) {
            if (p.n == 1) { /* there are no pairs */
                assert_true(isnan(values[b]));
                values[b] = 0;
            }
            total += values[b] * M_PI * r_max * r_max / BINS / BINS * (2 * b + 1) * n * (n - 1) / 2;
            expected += counts[b];
            assert_near(values[b] * M_PI * r_max * r_max / BINS / BINS * (2 * b + 1) * n * (n - 1) / 2, counts[b],
                        t % SETS_KINDS == 0 ? 1e-9 : HUGE_VAL); /* on lattices a distance may be a bin's end */
        }
        assert_near(total, expected, 1e-9 * (1 + expected));
        if (p.n > 1) {
            assert_near(test_measure("min-distance", &p).value, least[0], 1e-15);
            assert_near(test_measure("min-distance:torus=0", &p).value, least[1], 1e-15);
        }
        koksma_points_fini(&p);
    }
}

/* The sum over frequencies in closed form: n^2 (diaphony^2 + 1) = sum over pairs of prod (1 + 2 pi^2 B2({x - y})). */
TEST_CASE(diaphony_equals_all_pairs)
{
    for (int t = 0; t < test_repeats(120, 24); t++) {
        koksma_points p = sets_points(1 + (size_t)t / 2, 1 + t % 4, t % SETS_KINDS, (uint64_t)t);
        const size_t dim = (size_t)p.dim;
        const long double pi = acosl(-1);
        long double sum = 0;
        for (size_t i = 0; i < p.n * p.n; i++) {
            long double product = 1;
            for (size_t k = 0; k < dim; k++) {
                const long double d = fabsl((long double)p.xs[i / p.n * dim + k] - p.xs[i % p.n * dim + k]);
                product *= 1 + 2 * pi * pi * (d * d - d + 1.0L / 6);
            }
            sum += product;
        }
        const double square = (double)(sum / ((long double)p.n * (long double)p.n) - 1);
        assert_near(test_measure("diaphony", &p).square, square, 1e-12 * (1 + square));
        koksma_points_fini(&p);
    }
}

TEST_CASE(diaphony_has_known_values)
{
    /* the sum over frequencies up to 400; what is left out is below 2 (1 + pi^2/3) 2/400 */
    koksma_points p = sets_points(7, 2, 0, 4);
    double sum = -1;
    enum { TOP = 400 };
    koksma_spectrum s = spectrum_of(&p, TOP, KOKSMA_SPECTRUM_FAST, 1);
    for (int kx = -TOP; kx <= TOP; kx++) {
        for (int ky = -TOP; ky <= TOP; ky++) {
            sum += koksma_spectrum_power(&s, kx, ky) / 7 / fmax(1, kx * kx) / fmax(1, ky * ky);
        }
    }
    assert_near(test_measure("diaphony", &p).square, sum, 0.05);
    koksma_spectrum_fini(&s);
    koksma_points_fini(&p);
}

TEST_CASE(t_has_known_values)
{
    koksma_points p;
    assert_ok(koksma_points_init(&p, 64, 2));
    for (size_t i = 0; i < p.n; i++) {
        p.xs[2 * i] = (double)i / 64;
        for (int bit = 0; bit < 6; bit++) {
            p.xs[2 * i + 1] += (double)(i >> bit & 1) * exp2(-1 - bit);
        }
    }
    assert_true(test_measure("t-value", &p).value == 0);
    assert_true(test_measure("t-value:base=8", &p).value == 0); /* all base-8 shapes are base-2 shapes */
    p.xs[0] = p.xs[2];
    assert_true(test_measure("t-value", &p).value > 0);
    memset(p.xs, 0, 128 * sizeof(double));
    assert_true(test_measure("t-value", &p).value == 6);
    koksma_points_fini(&p);
    p = test_points("jittered", 64, 2, 1); /* even on 8 x 8, and no better in other shapes than chance */
    const double t = test_measure("t-value", &p).value;
    assert_true(t >= 1 && t <= 6);
    koksma_points_fini(&p);
    p = test_points("random", 60, 2, 1);
    koksma_spec spec;
    koksma_value value;
    assert_ok(koksma_measure_spec("t-value", &spec));
    assert_int_equal(koksma_evaluate(&spec, &p, NULL, &value), KOKSMA_N);
    koksma_points_fini(&p);
}

TEST_CASE(kernels_equal_reference)
{
    enum { MAX = 128, LANES = 16 };
    static double re[2][LANES * MAX], im[2][LANES * MAX], spare[2][2][LANES * MAX], twiddles[2 * MAX];
    const koksma__kernel_table *ref = koksma__kernels_find("ref");
    static const char *const isas[] = {"baseline", "avx2", "avx512"};
    for (int isa = 0; isa < 3; isa++) {
        const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
        for (size_t n = 1; fast && n <= MAX; n *= 2) {
            for (size_t i = 0; i < LANES * n; i++) {
                re[0][i] = re[1][i] = sets_unit(1, i) - 0.5;
                im[0][i] = im[1][i] = sets_unit(2, i) - 0.5;
            }
            for (size_t p = 0; p < n; p++) {
                twiddles[2 * p] = cos(2 * M_PI * (double)p / (double)n);
                twiddles[2 * p + 1] = sin(2 * M_PI * (double)p / (double)n);
            }
            double sums[2][8][16] = {{{0}}};
            ref->outer_sums(n, re[0], im[0], sums[0]);
            fast->outer_sums(n, re[0], im[0], sums[1]);
            assert_memory_equal(sums[0], sums[1], sizeof sums[0]);
            ref->fourier16(n, twiddles, re[0], im[0], spare[0][0], spare[0][1]);
            const bool moved = fast->fourier16(n, twiddles, re[1], im[1], spare[1][0], spare[1][1]);
            for (size_t i = 0; i < LANES * n; i++) {
                assert_near((moved ? spare[1][0] : re[1])[i], spare[0][0][i], 1e-14);
                assert_near((moved ? spare[1][1] : im[1])[i], spare[0][1][i], 1e-14);
            }
        }
    }
}
