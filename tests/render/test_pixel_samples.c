/* SPDX-License-Identifier: Apache-2.0 */
/* The samples of pixels: random orders are like those of Fisher and Yates, sets made in floats keep what their patterns
   claim and have the law of koksma_generate's, uses, pixels and seeds are independent, and every instruction set gives
   the same bits. Seeds are fixed; bounds are 5 standard deviations of a normal variable or more. */
#include "core/random.h"
#include "core/spec.h"
#include "drawing.h"
#include "test.h"
#include <koksma/render.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 256, TRIALS = test_repeats(20000, 2000) };

static void draw_words(uint64_t index, uint32_t lane, size_t count, uint32_t *out)
{
    koksma__kernels()->draws(11, KOKSMA__PURPOSE_TEST, index * ((count + 3) / 4), lane, (count + 3) / 4, out);
}

static void order_of(uint64_t index, size_t n, uint16_t *order)
{
    uint32_t words[64];
    draw_words(index, (uint32_t)n, koksma__order_words(n), words);
    koksma__batch()->order(words, n, order);
}

/* A chi-square of many degrees of freedom as a standard normal variable (Fisher 1922). */
static void assert_chi_square(const char *what, size_t n, double chi_square, double freedom)
{
    const double z = sqrt(2 * chi_square) - sqrt(2 * freedom - 1);
    assert_that(fabs(z) < 5, "%s, n = %zu: chi-square %g with %g degrees of freedom, %g deviations", what, n,
                chi_square, freedom, z);
}

/* ---- Orders --------------------------------------------------------------------------------------------------- */

TEST_CASE(orders_are_permutations)
{
    static uint16_t order[KOKSMA__ORDERED + 64];
    static bool seen[KOKSMA__ORDERED];
    for (size_t n = 1; n <= KOKSMA__ORDERED; n = n < 300 ? n + 1 : n < 60000 ? n * 3 / 2 : n + 1500) {
        order_of(n, n, order);
        memset(seen, 0, sizeof seen);
        for (size_t i = 0; i < n; i++) {
            assert_true(order[i] < n && !seen[order[i]]);
            seen[order[i]] = true;
        }
    }
    order_of(1, KOKSMA__ORDERED, order);
}

/* Each of the n! orders of few is as likely. */
TEST_CASE(few_are_in_every_order)
{
    for (size_t n = 2; n <= 5; n++) {
        double counts[3125] = {0}, chi_square = 0, orders = 1;
        for (uint64_t trial = 0; trial < 5 * TRIALS; trial++) {
            uint16_t order[5 + 64];
            size_t code = 0;
            order_of(trial, n, order);
            for (size_t i = 0; i < n; i++) {
                code = code * n + order[i];
            }
            counts[code]++;
        }
        for (size_t i = 2; i <= n; i++) {
            orders *= (double)i;
        }
        const double expected = 5 * TRIALS / orders;
        size_t there = 0;
        for (size_t code = 0; code < 3125; code++) {
            there += counts[code] > 0;
            chi_square += counts[code] > 0 ? (counts[code] - expected) * (counts[code] - expected) / expected : 0;
        }
        assert_int_equal(there, orders);
        assert_chi_square("orders", n, chi_square, orders - 1);
    }
}

/* Each position has each value as often; two positions i - j apart have values that are k apart as often for each k,
   on the ring and, for powers of two, by exclusive or, which is what linear maps would keep. */
TEST_CASE(orders_have_no_structure)
{
    static const size_t sizes[] = {16, 25, 33, 36, 49, 64, 81, 100, 128};
    static double values[128][128], rings[128][128], xors[128][128];
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const size_t n = sizes[s];
        const bool power = (n & (n - 1)) == 0;
        memset(values, 0, sizeof values);
        memset(rings, 0, sizeof rings);
        memset(xors, 0, sizeof xors);
        for (uint64_t trial = 0; trial < TRIALS; trial++) {
            uint16_t order[128 + 64];
            order_of(trial, n, order);
            for (size_t i = 0; i < n; i++) {
                values[i][order[i]]++;
                for (size_t d = 1; d < n; d++) {
                    rings[d][(order[(i + d) % n] + n - order[i]) % n]++;
                    xors[d][power ? order[i] ^ order[i ^ d] : 0]++;
                }
            }
        }
        double of_values = 0, of_rings = 0, of_xors = 0;
        const double m = (double)(n - 1), each = TRIALS / (double)n, pairs = TRIALS * (double)n / m;
        for (size_t i = 0; i < n; i++) {
            for (size_t k = 0; k < n; k++) {
                of_values += (values[i][k] - each) * (values[i][k] - each) / each;
                of_rings += i && k && 2 * i < n ? (rings[i][k] - pairs) * (rings[i][k] - pairs) / pairs : 0;
                of_xors += i && k ? (xors[i][k] - pairs) * (xors[i][k] - pairs) / (2 * pairs) : 0;
            }
        }
        assert_chi_square("positions and values", n, of_values, m * m);
        assert_chi_square("differences", n, of_rings, (double)((n - 1) / 2) * (m - 1));
        if (power) {
            assert_chi_square("exclusive ors", n, of_xors, m * (m - 1));
        }
    }
}

/* ---- Sets ------------------------------------------------------------------------------------------------------- */

/* The spec of the float form of a pattern. */
static koksma_spec spec_of(const char *pattern)
{
    koksma_spec spec;
    assert_ok(koksma_pattern_spec(strcmp(pattern, "sobol") ? pattern : "sobol:scramble=owen", &spec));
    return spec;
}

static void open_set(const koksma_spec *spec, size_t n, uint64_t seed, drawing *d)
{
    const koksma_render_options options = {.spp = (int)n,
                                           .width = 4,
                                           .height = 4,
                                           .seed = seed,
                                           .pattern = *spec,
                                           .integrator = koksma_integrator_find("path")};
    open_drawing(&options, d);
}

/* One point in each of the boxes of columns x rows of the first n. */
static void assert_boxes(const char *name, const float *pairs, size_t n, size_t columns, size_t rows)
{
    bool seen[MOST] = {false};
    for (size_t i = 0; i < n; i++) {
        const double x = (double)pairs[2 * i], y = (double)pairs[2 * i + 1];
        const size_t box = (size_t)floor(x * (double)columns) * rows + (size_t)floor(y * (double)rows);
        assert_that(x >= 0 && x < 1 && y >= 0 && y < 1 && !seen[box],
                    "%s, %zu points: (%.9g, %.9g) is a second one in its box of %zu x %zu", name, n, x, y, columns,
                    rows);
        seen[box] = true;
    }
}

/* As floats, with no tolerance, in every use: a group's sets lose nothing by their order. */
TEST_CASE(sets_keep_their_strata)
{
    static const size_t sizes[] = {1, 4, 9, 16, 36, 49, 64, 100, 225, 256};
    static const uint32_t uses[] = {KOKSMA__USE_PIXEL, KOKSMA__USE_LENS, KOKSMA__USE_LIGHT + 1};
    size_t forms = 0;
    for (const char *name; (name = koksma__float_set_name(forms)) != NULL; forms++) {
        const koksma_spec spec = spec_of(name);
        for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
            const size_t n = sizes[s], m = (size_t)sqrt((double)n);
            const unsigned claims = koksma__claims_left(&spec, n);
            const bool net = claims & KOKSMA_CLAIM_NET2 && (n & (n - 1)) == 0;
            const bool latin = claims & KOKSMA_CLAIM_LATIN,
                       grid = claims & (KOKSMA_CLAIM_GRID | KOKSMA_CLAIM_STRATIFIED);
            drawing d;
            open_set(&spec, n, 5, &d);
            for (uint64_t pixel = 0; pixel < 60; pixel++) {
                float pairs[2 * MOST];
                const uint32_t use = uses[pixel % 3];
                draw(&d, pixel, use, pairs);
                for (size_t columns = 1; columns <= n; columns++) {
                    const bool box = net ? (columns & (columns - 1)) == 0
                                         : (latin && (columns == 1 || columns == n)) || (grid && columns == m);
                    if (box && n % columns == 0) {
                        assert_boxes(name, pairs, n, columns, n / columns);
                    }
                }
                for (size_t prefix = 1; net && use == KOKSMA__USE_PIXEL && prefix <= n; prefix *= 2) {
                    assert_boxes(name, pairs, prefix, 1, prefix);
                    assert_boxes(name, pairs, prefix, prefix, 1);
                }
            }
            close_drawing(&d);
        }
    }
    assert_true(forms >= 6);
}

/* Powers of a set: what a change of its law would change. */
static void powers_of(const double *xs, size_t n, double out[4])
{
    double mean = 0, product = 0, corner = 0, wave = 0;
    for (size_t i = 0; i < n; i++) {
        mean += xs[2 * i] / (double)n;
        product += xs[2 * i] * xs[2 * i + 1] / (double)n;
        corner += xs[2 * i] + xs[2 * i + 1] < 0.7 ? 1 / (double)n : 0;
        wave += sin(7 * xs[2 * i] + 11 * xs[2 * i + 1]) / (double)n;
    }
    out[0] = mean;
    out[1] = product;
    out[2] = corner;
    out[3] = wave;
}

/* Means and variances of four estimates over many sets are those of koksma_generate's sets. */
TEST_CASE(sets_have_the_law_of_their_pattern)
{
    static const size_t sizes[] = {9, 16, 64, 100};
    for (size_t form = 0; koksma__float_set_name(form); form++) {
        const char *name = koksma__float_set_name(form);
        const koksma_spec spec = spec_of(name);
        for (size_t s = 0; s < 4; s++) {
            const size_t n = sizes[s];
            double sums[2][4][4] = {{{0}}}; /* of powers 1 to 4 about a common origin */
            double origin[4] = {0};
            koksma_points points;
            drawing d;
            assert_ok(koksma_points_init(&points, n, 2));
            open_set(&spec, n, 6, &d);
            for (uint64_t trial = 0; trial < TRIALS / 4; trial++) {
                for (int kind = 0; kind < 2; kind++) {
                    float pairs[2 * MOST];
                    double values[4];
                    if (kind) {
                        assert_ok(koksma_generate(&spec, trial, NULL, &points));
                    } else {
                        draw(&d, trial, trial % 2 ? KOKSMA__USE_PIXEL : KOKSMA__USE_LIGHT, pairs);
                    }
                    for (size_t i = 0; !kind && i < 2 * n; i++) {
                        points.xs[i] = (double)pairs[i];
                    }
                    powers_of(points.xs, n, values);
                    if (!trial && !kind) {
                        memcpy(origin, values, sizeof origin);
                    }
                    for (int v = 0; v < 4; v++) {
                        double power = 1;
                        for (int p = 0; p < 4; p++) {
                            sums[kind][v][p] += power *= values[v] - origin[v];
                        }
                    }
                }
            }
            for (int v = 0; v < 4; v++) {
                double mean[2], variance[2], error[2], spread[2];
                for (int kind = 0; kind < 2; kind++) {
                    const double t = TRIALS / 4, a = sums[kind][v][0] / t, b = sums[kind][v][1] / t,
                                 c = sums[kind][v][2] / t, e = sums[kind][v][3] / t;
                    mean[kind] = a;
                    variance[kind] = b - a * a;
                    error[kind] = variance[kind] / t;
                    spread[kind] =
                        (e - 4 * a * c + 6 * a * a * b - 3 * a * a * a * a - variance[kind] * variance[kind]) / t;
                }
                assert_that(fabs(mean[0] - mean[1]) < 5 * sqrt(error[0] + error[1]) + 1e-7 &&
                                fabs(variance[0] - variance[1]) < 5 * sqrt(spread[0] + spread[1]) + 1e-14,
                            "%s, n = %zu, estimate %d: mean %g, expected %g; variance %g, expected %g", name, n, v,
                            mean[0], mean[1], variance[0], variance[1]);
            }
            close_drawing(&d);
            koksma_points_fini(&points);
        }
    }
}

/* ---- Independence ------------------------------------------------------------------------------------------------ */

/* The mean over the samples of (u - 1/2)(v - 1/2) of two draws has mean 0, and the variance of independent numbers, 1/144n,
   where one of them is in random order; all patterns are stratified to some degree, so theirs may be smaller by 1/n. */
static void assert_independent(const char *what, const char *name, size_t n, double sum, double squares,
                               double trials)
{
    const double scale = 144 * (double)n, variance = squares / trials * scale, z = sum * sqrt(scale / trials);
    assert_that(fabs(z) < 5 && variance > 0.7 && variance < 1.3,
                "%s, %s, n = %zu: products are off by %g deviations, their variance is %g times that of random ones",
                name, what, n, z, variance);
}

TEST_CASE(uses_pixels_and_seeds_are_independent)
{
    static const size_t sizes[] = {16, 64};
    static const struct {
        const char *what;
        uint64_t pixel, seed;
        uint32_t use;
    } others[] = {{"the other light", 0, 0, KOKSMA__USE_LIGHT + 1},
                  {"the pixel", 0, 0, KOKSMA__USE_PIXEL},
                  {"the next bounce", 0, 0, KOKSMA__USES_A_BOUNCE + KOKSMA__USE_LIGHT},
                  {"the next pixel", 1, 0, KOKSMA__USE_LIGHT},
                  {"a pixel 2^32 further", (uint64_t)1 << 32, 0, KOKSMA__USE_LIGHT},
                  {"the next seed", 0, 1, KOKSMA__USE_LIGHT}};
    for (size_t form = 0; koksma__float_set_name(form); form++) {
        const char *name = koksma__float_set_name(form);
        const koksma_spec spec = spec_of(name);
        for (size_t s = 0; s < 2; s++) {
            const size_t n = sizes[s];
            for (size_t o = 0; o < sizeof others / sizeof *others; o++) {
                double sum = 0, squares = 0;
                drawing d, e;
                open_set(&spec, n, 100, &d);
                open_set(&spec, n, 100 + others[o].seed, &e);
                for (uint64_t trial = 0; trial < TRIALS / 4; trial++) {
                    float a[2 * MOST], b[2 * MOST];
                    double product[4] = {0};
                    draw(&d, 2 * trial, KOKSMA__USE_LIGHT, a);
                    draw(&e, 2 * trial + others[o].pixel, others[o].use, b);
                    for (size_t i = 0; i < n; i++) {
                        for (size_t k = 0; k < 4; k++) {
                            product[k] +=
                                ((double)a[2 * i + k / 2] - 0.5) * ((double)b[2 * i + k % 2] - 0.5) / (double)n;
                        }
                    }
                    for (size_t k = 0; k < 4; k++) {
                        sum += product[k];
                        squares += product[k] * product[k];
                    }
                }
                assert_independent(others[o].what, name, n, sum, squares, TRIALS);
                close_drawing(&d);
                close_drawing(&e);
            }
        }
    }
}

/* Random words: each of 8 parts of a word as often, for all four words, and successive counters in all 64 pairs of
   parts. */
TEST_CASE(words_are_random)
{
    enum { COUNT = 1 << 16 };
    static uint32_t words[COUNT + 32];
    for (uint32_t lane = 0; lane < 6; lane++) {
        draw_words(lane, 1 << lane, COUNT, words);
        for (size_t step = 1; step <= 4; step += 3) { /* within a counter, and of the next */
            for (int shift = 0; shift < 30; shift += 3) {
                double counts[64] = {0}, chi_square = 0;
                for (size_t i = 0; i + step < COUNT; i++) {
                    counts[(words[i] >> shift & 7) << 3 | (words[i + step] >> shift & 7)]++;
                }
                for (int c = 0; c < 64; c++) {
                    const double expected = (double)(COUNT - step) / 64;
                    chi_square += (counts[c] - expected) * (counts[c] - expected) / expected;
                }
                assert_chi_square("pairs of words", step, chi_square, 63);
            }
        }
    }
}

/* ---- Bits -------------------------------------------------------------------------------------------------------- */

TEST_CASE(every_instruction_set_gives_the_same_bits)
{
    static const size_t sizes[] = {1, 2, 3, 7, 16, 31, 32, 33, 63, 64, 65, 100, 127, 128, 200, 255, 256};
    static const float scale[2] = {0x1p-27f, 0x1.8p-26f}, offset[2] = {3, 5};
    uint32_t partners[2][32];
    for (uint32_t level = 0; level < 32; level++) {
        partners[0][level] = ((uint32_t)1 << level) - 1;
        partners[1][level] = 0x5a5a5a5au & (((uint32_t)1 << level) - 1);
    }
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const size_t n = sizes[s];
        uint32_t words[2 * MOST + 32];
        uint16_t orders[4][MOST + 64];
        float placed[4][2 * MOST], gathered[4][2 * MOST], both[4][2 * MOST], nets[4][2][2 * MOST], moved[4][2 * MOST];
        draw_words(s, 99, 2 * MOST, words);
        for (size_t isa = 0; isa < 4; isa++) {
            const koksma__batch_table *batch = koksma__batch_find(isas[isa]);
            uint32_t fractions[2 * MOST];
            if (!batch) {
                continue;
            }
            for (size_t i = 0; i < 2 * n; i++) {
                placed[isa][i] = (float)(words[i] >> 8) * 0x1p-25f;
            }
            batch->order(words, n, orders[isa]);
            batch->jitter(placed[isa], words, scale, offset, n, placed[isa]);
            batch->gather(placed[isa], orders[isa], n, gathered[isa]);
            batch->gather_both(placed[isa], orders[isa], orders[0], n, both[isa]);
            batch->net(words, (const uint32_t(*)[32])partners, 2, offset, n, fractions, nets[isa][0]);
            batch->net(words, (const uint32_t(*)[32])partners, 1, offset, n, fractions, nets[isa][1]);
            batch->move(placed[isa], offset, n, moved[isa]);
            assert_memory_equal(orders[isa], orders[0], n * sizeof **orders);
            assert_memory_equal(placed[isa], placed[0], 2 * n * sizeof **placed);
            assert_memory_equal(gathered[isa], gathered[0], 2 * n * sizeof **gathered);
            assert_memory_equal(both[isa], both[0], 2 * n * sizeof **both);
            assert_memory_equal(moved[isa], moved[0], 2 * n * sizeof **moved);
            for (int dim = 0; dim < 2; dim++) {
                assert_memory_equal(nets[isa][dim], nets[0][dim], 2 * n * sizeof ***nets);
            }
        }
    }
}
