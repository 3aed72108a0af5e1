/* SPDX-License-Identifier: Apache-2.0 */
/* Ranking keys: the header has the pattern's points, pixels and cells have nets, a pixel's error has the distribution of
   that of independent pixels, and on integrands that the keys were not made with errors are blue. */
#include <koksma/keys.h>

#include <stdlib.h>

#include "pattern_sets.h"

enum { WIDTH = 64, PIXELS = WIDTH * WIDTH };

/* koksma_keys_2d and, with dims=4, koksma_keys_4d. */
TEST_CASE(the_header_has_the_patterns_points)
{
    static const struct {
        const char *spec;
        int width, dim, dims;
        uint32_t spp;
    } cases[] = {{"ranking-keys", 4, 2, 2, 1},
                 {"ranking-keys:width=5", 5, 5, 2, 3},
                 {"ranking-keys:width=7", 7, 4, 2, 16},
                 {"ranking-keys:width=3", 3, 1, 2, 40},
                 {"ranking-keys:width=2", 2, 6, 2, 700},
                 {"ranking-keys:width=70", 70, 8, 2, 4},
                 {"ranking-keys:dims=4", 4, 4, 4, 1},
                 {"ranking-keys:width=5,dims=4", 5, 9, 4, 3},
                 {"ranking-keys:width=3,dims=4", 3, 2, 4, 700},
                 {"ranking-keys:width=70,dims=4", 70, 6, 4, 4}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        const uint32_t w = (uint32_t)cases[c].width, spp = cases[c].spp;
        const int dim = cases[c].dim, dims = cases[c].dims;
        koksma_points points = test_points(cases[c].spec, (size_t)w * w * spp, dim, 3 + c);
        for (size_t i = 0; i < points.n; i++) {
            const uint32_t pixel = (uint32_t)i / spp, s = (uint32_t)i % spp;
            for (int k = 0; k < dim; k++) {
                const koksma_keys keys = (dims == 2 ? koksma_keys_of : koksma_keys_of_4d)(3 + c, pixel % w, pixel / w,
                                                                                          (uint32_t)(k / dims), spp);
                double xs[4];
                float rounded[4];
                (dims == 2 ? koksma_keys_2d : koksma_keys_4d)(&keys, s, xs);
                (dims == 2 ? koksma_keys_2f : koksma_keys_4f)(&keys, s, rounded);
                assert_true(xs[k % dims] == points.xs[i * (size_t)dim + (size_t)k]);
                assert_true(rounded[k % dims] == koksma_to_float(xs[k % dims]));
            }
        }
        koksma_points_fini(&points);
    }
}

TEST_CASE(pixels_have_nets)
{
    for (size_t spp = 1; spp <= 512; spp *= 2) {
        koksma_points tile = test_points("ranking-keys:width=5", 25 * spp, 6, spp);
        for (int k = 0; k < 6; k += 2) {
            koksma_points pair = projection_of(&tile, k, 2);
            for (size_t pixel = 0; pixel < 25; pixel++) {
                const koksma_points own = {spp, 2, pair.xs + 2 * spp * pixel};
                for (size_t n = 1; n <= spp; n *= 2) {
                    for (size_t first = 0; first < spp; first += n) {
                        assert_true(is_net2_block(&own, first, n));
                    }
                }
            }
            koksma_points_fini(&pair);
        }
        koksma_points_fini(&tile);
    }
}

/* The pixels of a cell are those with equal seeds. There are 1,024, and all their points are a net. */
TEST_CASE(cells_have_nets)
{
    enum { AROUND = 3 * KOKSMA_KEYS_SIZE, CELL = KOKSMA_KEYS_SIZE * KOKSMA_KEYS_SIZE };
    static double xs[2 * CELL * 64];
    for (uint32_t spp = 1; spp <= 64; spp *= 2) {
        const koksma_keys middle = koksma_keys_of(spp, AROUND / 2, AROUND / 2, spp % 3, spp);
        koksma_points all = {0, 2, xs};
        for (uint32_t p = 0; p < AROUND * AROUND; p++) {
            const koksma_keys keys = koksma_keys_of(spp, p % AROUND, p / AROUND, spp % 3, spp);
            if (keys.seeds[0] == middle.seeds[0] && keys.seeds[1] == middle.seeds[1]) {
                assert_true(all.n < (size_t)CELL * spp);
                for (uint32_t s = 0; s < spp; s++) {
                    koksma_keys_2d(&keys, s, xs + 2 * all.n++);
                }
            }
        }
        assert_int_equal(all.n, (size_t)CELL * spp);
        assert_true(is_net2_block(&all, 0, all.n));
    }
}

static double errors[INTEGRANDS][PIXELS];

/* With keys for `of` samples a pixel; of = 0: independent pixels. */
static void errors_of(uint64_t seed, uint32_t spp, uint32_t of)
{
    for (uint32_t p = 0; p < PIXELS; p++) {
        const koksma_keys keys = koksma_keys_of(seed, p % WIDTH, p / WIDTH, 0, of ? of : spp);
        const koksma_domain pixel = koksma_domain_of_pixel(seed, p % WIDTH, p / WIDTH);
        double f[INTEGRANDS] = {0};
        for (uint32_t s = 0; s < spp; s++) {
            double xy[2];
            if (of) {
                koksma_keys_2d(&keys, s, xy);
            } else {
                koksma_sobol_2d(pixel, s, xy);
            }
            add_integrands(xy, f);
        }
        for (int k = 0; k < INTEGRANDS; k++) {
            errors[k][p] = f[k] / spp - integrands[k].mean;
        }
    }
}

/* The mean square of a tile's errors, plain, and blurred by a Gaussian of standard deviation 1.5 pixels on the torus. */
static void mean_squares(const double *e, double *plain, double *blurred)
{
    static double rows[PIXELS];
    double weights[13], sum = 0;
    for (int i = 0; i < 13; i++) {
        sum += weights[i] = exp(-(i - 6) * (i - 6) / 4.5);
    }
    *plain = *blurred = 0;
    for (int p = 0; p < PIXELS; p++) {
        *plain += e[p] * e[p] / PIXELS;
        rows[p] = 0;
        for (int i = 0; i < 13; i++) {
            rows[p] += weights[i] / sum * e[p / WIDTH * WIDTH + (p + i + WIDTH - 6) % WIDTH];
        }
    }
    for (int p = 0; p < PIXELS; p++) {
        double mean = 0;
        for (int i = 0; i < 13; i++) {
            mean += weights[i] / sum * rows[(p + (i + WIDTH - 6) * WIDTH) % PIXELS];
        }
        *blurred += mean * mean / PIXELS;
    }
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The largest difference of the empirical distribution functions of two samples of n numbers, which it sorts; sums of
   equal numbers in different orders count as equal. */
static double kolmogorov_smirnov(double *a, double *b, size_t n)
{
    size_t i = 0, j = 0, largest = 0;
    qsort(a, n, sizeof *a, ascending);
    qsort(b, n, sizeof *b, ascending);
    while (i < n && j < n) {
        const double x = fmin(a[i], b[j]) + 1e-12;
        while (i < n && a[i] <= x) {
            i++;
        }
        while (j < n && b[j] <= x) {
            j++;
        }
        const size_t difference = i > j ? i - j : j - i;
        largest = difference > largest ? difference : largest;
    }
    return (double)largest / (double)n;
}

/* Owen scrambling that the seed draws makes a pixel's points those of an independently scrambled pixel: over the seeds
   the error has mean 0, and the distribution of koksma_sobol_2d's. Two samples of SEEDS errors differ by more than 2.2
   sqrt(2 / SEEDS) with probability 1.3e-4 (Smirnov). */
TEST_CASE(a_pixel_has_the_distribution_of_independent_pixels)
{
    enum { SEEDS = 3000, N_SPP = 13 };
    static const uint32_t spps[N_SPP] = {1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 32, 64, 100};
    static double own[INTEGRANDS][SEEDS], others[INTEGRANDS][SEEDS];
    for (uint32_t t = 0; t < N_SPP; t++) {
        const uint32_t spp = spps[t], pair = t % 3, of = spp == 3 ? 64 : spp;
        for (uint64_t seed = 0; seed < SEEDS; seed++) {
            const koksma_keys keys = koksma_keys_of(seed, 5 + t, 9, pair, of);
            const koksma_domain domain = koksma_domain_of_pixel(seed, 5 + t, 9);
            double f[2][INTEGRANDS] = {{0}};
            for (uint32_t s = 0; s < spp; s++) {
                double xy[2];
                koksma_keys_2d(&keys, s, xy);
                add_integrands(xy, f[0]);
                koksma_sobol_2d(domain, s, xy);
                add_integrands(xy, f[1]);
            }
            for (int k = 0; k < INTEGRANDS; k++) {
                own[k][seed] = f[0][k] / spp - integrands[k].mean;
                others[k][seed] = f[1][k] / spp - integrands[k].mean;
            }
        }
        for (int k = 0; k < INTEGRANDS; k++) {
            double mean = 0, square = 0;
            for (int i = 0; i < SEEDS; i++) {
                mean += own[k][i] / SEEDS;
                square += own[k][i] * own[k][i] / SEEDS;
            }
            const double error = sqrt(square / SEEDS);
            const double difference = kolmogorov_smirnov(own[k], others[k], SEEDS);
            assert_that(fabs(mean) < 4 * error && difference < 2.2 * sqrt(2.0 / SEEDS),
                        "%u samples, %s: mean error %g, standard error %g; distributions differ by %g", spp,
                        integrands[k].name, mean, error, difference);
        }
    }
}

/* Mean squares over the tiles, plain and blurred, and the standard errors of the means. */
static void mean_squares_of_tiles(uint32_t spp, bool independent, double mean[2][INTEGRANDS],
                                  double error[2][INTEGRANDS])
{
    enum { TILES = 6 };
    double squares[2][INTEGRANDS] = {{0}};
    memset(mean, 0, 2 * sizeof *mean);
    for (uint64_t tile = 0; tile < TILES; tile++) {
        errors_of(tile, spp, independent ? 0 : spp);
        for (int k = 0; k < INTEGRANDS; k++) {
            double both[2];
            mean_squares(errors[k], &both[0], &both[1]);
            for (int b = 0; b < 2; b++) {
                mean[b][k] += both[b] / TILES;
                squares[b][k] += both[b] * both[b] / TILES;
            }
        }
    }
    for (int b = 0; b < 2; b++) {
        for (int k = 0; k < INTEGRANDS; k++) {
            error[b][k] = sqrt(fmax(squares[b][k] - mean[b][k] * mean[b][k], 0) / (TILES - 1));
        }
    }
}

/* Plain errors are no larger than those of independent pixels, within four standard errors; blurred ones are smaller. */
TEST_CASE(errors_are_blue_and_small)
{
    static const uint32_t spps[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 64, 100};
    for (size_t t = 0; t < sizeof spps / sizeof *spps; t++) {
        double mean[2][2][INTEGRANDS], error[2][2][INTEGRANDS];
        for (int kind = 0; kind < 2; kind++) {
            mean_squares_of_tiles(spps[t], kind, mean[kind], error[kind]);
        }
        for (int k = 0; k < INTEGRANDS; k++) {
            double ratio[2], deviation[2];
            for (int b = 0; b < 2; b++) {
                ratio[b] = mean[0][b][k] / mean[1][b][k];
                deviation[b] = hypot(error[0][b][k], error[1][b][k]) / mean[1][b][k];
            }
            assert_that(
                ratio[0] < 1 + 4 * deviation[0] && ratio[1] < 0.8,
                "%u samples, %s: mean squares are %.3f (plain), %.3f (blurred) of those of independent pixels",
                spps[t], integrands[k].name, ratio[0], ratio[1]);
        }
    }
}

/* Heitz & others 2019: a ranking key permutes the samples of its pixel. With 2^m samples its lower m bits change their
   order alone: the set of all is the same for any of them, and the first sample is another one. */
TEST_CASE(ranking_permutes_samples)
{
    for (uint32_t m = 0; m <= 6; m++) {
        for (uint32_t p = 0; p < PIXELS; p += 61) {
            const koksma_keys keys = koksma_keys_of(3, p % WIDTH, p / WIDTH, 0, 1u << m);
            for (uint32_t rank = 1; rank < 1u << m; rank++) {
                koksma_keys other = keys;
                other.key ^= rank;
                for (uint32_t s = 0; s < 1u << m; s++) {
                    double a[2], b[2];
                    koksma_keys_2d(&keys, s, a);
                    koksma_keys_2d(&other, s ^ rank, b);
                    assert_true(a[0] == b[0] && a[1] == b[1]);
                    koksma_keys_2d(&other, s, b);
                    assert_true(a[0] != b[0] && a[1] != b[1]);
                }
            }
        }
    }
}

/* They rank for all powers of two at once: the first 1, 2, 4, ... of 64 samples have blue errors, too. Blurred mean squares
   over those of independent pixels; docs/findings/screen-noise.md has the low frequencies. */
TEST_CASE(prefixes_are_blue)
{
    enum { TILES = test_repeats(4, 1) };
    for (uint32_t spp = 1; spp <= 64; spp *= 2) {
        double sums[2][INTEGRANDS] = {{0}};
        for (uint64_t tile = 0; tile < 2 * TILES; tile++) {
            errors_of(tile / 2, spp, tile % 2 ? 0 : 64);
            for (int k = 0; k < INTEGRANDS; k++) {
                double plain, blurred;
                mean_squares(errors[k], &plain, &blurred);
                sums[tile % 2][k] += blurred;
            }
        }
        for (int k = 0; k < INTEGRANDS; k++) {
            assert_that(sums[0][k] < 0.8 * sums[1][k],
                        "%u of 64 samples, %s: blurred mean squares are %.2f of those of independent pixels", spp,
                        integrands[k].name, sums[0][k] / sums[1][k]);
        }
    }
}
