/* SPDX-License-Identifier: Apache-2.0 */
/* Ranking and scrambling keys: the header has the pattern's points, pixels have nets, the table has every key equally
   often, and on integrands that the keys were not made with errors are blue and no larger than those of independent
   pixels. */
#include <koksma/keys.h>

#include <stdlib.h>

#include "claims/claims.h"
#include "test.h"

enum { WIDTH = 64, PIXELS = WIDTH * WIDTH, INTEGRANDS = 6 };

#define MOST_PLAIN 1.15

static void the_header_has_the_patterns_points(void **state)
{
    (void)state;
    static const struct {
        const char *spec;
        int width, dim;
        uint32_t spp;
    } cases[] = {{"ranking-keys", 4, 2, 1},           {"ranking-keys:width=5", 5, 5, 3},
                 {"ranking-keys:width=7", 7, 4, 16},  {"ranking-keys:width=3", 3, 1, 40},
                 {"ranking-keys:width=2", 2, 6, 700}, {"ranking-keys:width=70", 70, 8, 4}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        const int width = cases[c].width, dim = cases[c].dim;
        const uint32_t spp = cases[c].spp;
        koksma_points points = test_points(cases[c].spec, (size_t)(width * width) * spp, dim, 3 + c);
        for (size_t i = 0; i < points.n; i++) {
            const uint32_t pixel = (uint32_t)i / spp, w = (uint32_t)width;
            for (int k = 0; k < dim; k++) {
                const koksma_keys keys = koksma_keys_of(3 + c, pixel % w, pixel / w, (uint32_t)k / 2, spp);
                double xy[2];
                float rounded[2];
                koksma_keys_2d(&keys, (uint32_t)i % spp, xy);
                koksma_keys_2f(&keys, (uint32_t)i % spp, rounded);
                assert_true(xy[k % 2] == points.xs[i * (size_t)dim + (size_t)k]);
                assert_true(rounded[k % 2] == koksma_to_float(xy[k % 2]));
            }
        }
        koksma_points_fini(&points);
    }
}

static void pixels_have_nets(void **state)
{
    (void)state;
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

/* Each value of a key comes as often as the others, and ranks are below the number of samples. */
static void keys_are_uniform(void **state)
{
    (void)state;
    for (int table = 0; table < 3; table++) {
        int count[3][256] = {{0}};
        for (uint32_t p = 0; p < PIXELS; p++) {
            const uint32_t word = koksma__keys_word(table, 1 + p);
            for (int k = 0; k < 3; k++) {
                count[k][word >> 8 * k & 255]++;
            }
            assert_true(word >> 24 < 1u << 2 * table);
        }
        for (int k = 0; k < (table ? 3 : 2); k++) {
            for (int v = 0; v < 256; v++) {
                assert_int_equal(count[k][v], PIXELS / 256);
            }
        }
    }
}

static const struct {
    const char *name;
    double mean;
} integrands[INTEGRANDS] = {{"x", 0.5},
                            {"xy", 0.25},
                            {"gaussian", 0.55774628535103},
                            {"quarter disk", 0.5},
                            {"step in x", 0.31830988618379},
                            {"step in y", 0.31830988618379}};

static void evaluate(const double *xy, double *f)
{
    const double square = xy[0] * xy[0] + xy[1] * xy[1];
    f[0] += xy[0];
    f[1] += xy[0] * xy[1];
    f[2] += exp(-square);
    f[3] += square < 0.63661977236758;
    f[4] += xy[0] < 0.31830988618379;
    f[5] += xy[1] < 0.31830988618379;
}

static double errors[INTEGRANDS][PIXELS];

static void errors_of(uint64_t seed, uint32_t spp, bool independent)
{
    for (uint32_t p = 0; p < PIXELS; p++) {
        const koksma_keys keys = koksma_keys_of(seed, p % WIDTH, p / WIDTH, 0, spp);
        const koksma_domain pixel = koksma_domain_of_pixel(seed, p % WIDTH, p / WIDTH);
        double f[INTEGRANDS] = {0};
        for (uint32_t s = 0; s < spp; s++) {
            double xy[2];
            if (independent) {
                koksma_sobol_2d(pixel, s, xy);
            } else {
                koksma_keys_2d(&keys, s, xy);
            }
            evaluate(xy, f);
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

/* RATIOS=1 in the environment prints the table of docs/findings/blue-noise.md. */
static void errors_are_blue_and_small(void **state)
{
    (void)state;
    enum { TILES = 6, N_SPP = 15 };
    static const uint32_t spps[N_SPP] = {1, 2, 3, 4, 5, 6, 8, 12, 16, 24, 32, 40, 48, 64, 100};
    for (size_t t = 0; t < N_SPP; t++) {
        double sums[2][2][INTEGRANDS] = {{{0}}}, squares[2][2][INTEGRANDS] = {{{0}}};
        for (uint64_t tile = 0; tile < TILES; tile++) {
            for (int kind = 0; kind < 2; kind++) {
                errors_of(tile, spps[t], kind);
                for (int k = 0; k < INTEGRANDS; k++) {
                    double both[2];
                    mean_squares(errors[k], &both[0], &both[1]);
                    for (int b = 0; b < 2; b++) {
                        sums[kind][b][k] += both[b] / TILES;
                        squares[kind][b][k] += both[b] * both[b] / TILES;
                    }
                }
            }
        }
        if (getenv("RATIOS")) {
            printf("%u", spps[t]);
        }
        for (int k = 0; k < INTEGRANDS; k++) {
            double ratio[2], deviation[2];
            for (int b = 0; b < 2; b++) {
                double variance = 0;
                for (int kind = 0; kind < 2; kind++) {
                    variance += squares[kind][b][k] - sums[kind][b][k] * sums[kind][b][k];
                }
                ratio[b] = sums[0][b][k] / sums[1][b][k];
                deviation[b] = sqrt(fmax(variance, 0) / (TILES - 1)) / sums[1][b][k];
            }
            if (getenv("RATIOS")) {
                printf(" | %.2f, %.2f", sqrt(ratio[0]), sqrt(ratio[1]));
            }
            if (!(ratio[0] < MOST_PLAIN + 2 * deviation[0] && ratio[1] < 1 + 2 * deviation[1])) {
                fail_msg(
                    "%u samples, %s: mean squares are %.3f (plain), %.3f (blurred) of those of independent pixels",
                    spps[t], integrands[k].name, ratio[0], ratio[1]);
            }
        }
        if (getenv("RATIOS")) {
            printf("\n");
        }
    }
}

/* u of one pair and v of another: the RMS error of the mean of (u - 1/2)(v - 1/2) beside that of random numbers,
   1 / (12 sqrt(N)). Padding by nested shuffles has 1.26 times as much. */
static void pairs_are_independent(void **state)
{
    (void)state;
    for (uint32_t spp = 4; spp <= 256; spp *= 4) {
        for (uint32_t other = 1; other < 4; other++) {
            double square = 0;
            for (uint32_t p = 0; p < PIXELS; p++) {
                const koksma_keys a = koksma_keys_of(1, p % WIDTH, p / WIDTH, other - 1, spp);
                const koksma_keys b = koksma_keys_of(1, p % WIDTH, p / WIDTH, other, spp);
                double mean = 0;
                for (uint32_t s = 0; s < spp; s++) {
                    double u[2], v[2];
                    koksma_keys_2d(&a, s, u);
                    koksma_keys_2d(&b, s, v);
                    mean += (u[0] - 0.5) * (v[0] - 0.5) / spp;
                }
                square += mean * mean / PIXELS;
            }
            const double relative = 12 * sqrt(spp * square);
            if (getenv("RATIOS")) {
                printf("%u samples, pairs %u and %u: %.3f\n", spp, other - 1, other, relative);
            }
            if (!(relative < 1.4)) {
                fail_msg("%u samples, pairs %u and %u: %.3f", spp, other - 1, other, relative);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_header_has_the_patterns_points),
        cmocka_unit_test(pixels_have_nets),
        cmocka_unit_test(keys_are_uniform),
        cmocka_unit_test(errors_are_blue_and_small),
        cmocka_unit_test(pairs_are_independent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
