/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Masks optimised for a filter, against the definition: the error is the variance over the pixels of the filtered
 * indicators, which is computed here by direct sums. The search never makes a mask worse, rearranges the given values
 * only, and its masks are better than void-and-cluster ones (Ulichney 1993) under a filter that those are good for.
 */
#include <koksma/mask.h>

#include <stdlib.h>
#include <string.h>

#include "test.h"

#define assert_close(a, b, share) assert_near(a, b, (share)*fabs(b))

enum { MOST = 64 * 64 * 4 };

static const double uneven[] = {1, 4, 2, 0, 3, -1}; /* 3 x 2 pixels, neither symmetric nor positive */

static koksma_mask_options options_of(int width, int height, const char *space)
{
    koksma_mask_options o = {.width = width, .height = height, .space = koksma_mask_space_find(space), .swaps = 40};
    assert_non_null(o.space);
    o.filter.width = 3;
    o.filter.height = 2;
    memcpy(o.filter.weights, uneven, sizeof uneven);
    return o;
}

/* exp(-(x^2 + y^2) / 2) in 7 x 7 pixels. */
static void use_gaussian(koksma_mask_options *o)
{
    o->filter.width = o->filter.height = 7;
    for (int i = 0; i < 49; i++) {
        const int x = i % 7 - 3, y = i / 7 - 3;
        o->filter.weights[i] = exp(-0.5 * (x * x + y * y));
    }
}

/* The filtered image of (v < t) - t at (x, y), the corner of the filter; pixels beyond the border count 0 if `open`. */
static double filtered(const koksma_mask_options *o, const float *v, double t, int x, int y)
{
    double sum = 0, weights = 0;
    for (int j = 0; j < o->filter.height; j++) {
        for (int i = 0; i < o->filter.width; i++) {
            const double w = o->filter.weights[j * o->filter.width + i];
            const bool inside = x + i >= 0 && x + i < o->width && y + j >= 0 && y + j < o->height;
            const int a = (x + i + 5 * o->width) % o->width, b = (y + j + 5 * o->height) % o->height;
            weights += w;
            sum += o->open && !inside ? 0 : w * (((double)v[b * o->width + a] < t ? 1 : 0) - t);
        }
    }
    return sum / weights;
}

TEST_CASE(error_is_that_of_the_definition)
{
    enum { W = 13, H = 10, TESTS = 17 };
    float v[W * H];
    koksma_mask_options o = options_of(W, H, "scalar");
    assert_ok(koksma_mask_optimise(&o, NULL, v, NULL));
    double all = 0, inside = 0, seam = 0;
    for (int k = 0; k < TESTS; k++) {
        const double t = (k + 0.5) / TESTS;
        double mean = 0;
        for (int p = 0; p < W * H; p++) {
            mean += filtered(&o, v, t, p % W, p / W) / (W * H);
        }
        for (int p = 0; p < W * H; p++) {
            const double d = filtered(&o, v, t, p % W, p / W) - mean;
            const bool wraps = p % W > W - 3 || p / W > H - 2;
            all += d * d / (W * H * TESTS);
            inside += wraps ? 0 : d * d / ((W - 2) * (H - 1) * TESTS);
            seam += wraps ? d * d / ((W * H - (W - 2) * (H - 1)) * TESTS) : 0;
        }
    }
    koksma_mask_quality one, two;
    const koksma_run run_one = {.threads = 1}, run_two = {.threads = 2};
    assert_ok(koksma_mask_measure(W, H, NULL, v, &o.filter, TESTS, &run_one, &one));
    assert_ok(koksma_mask_measure(W, H, NULL, v, &o.filter, TESTS, &run_two, &two));
    assert_memory_equal(&one, &two, sizeof one);
    assert_close(one.error, sqrt(all), 1e-12);
    assert_close(one.inside, sqrt(inside), 1e-12);
    assert_close(one.seam, sqrt(seam), 1e-12);
}

/* The error that the search minimises is the mean over all thresholds; of an open mask the pixels beyond have no error, and
   the filter is applied wherever it meets the mask. */
TEST_CASE(energy_is_that_of_the_definition)
{
    enum { TESTS = 2000 };
    float v[16 * 12];
    for (int open = 0; open < 2; open++) {
        koksma_mask_options o = options_of(16, 12, "scalar");
        koksma_mask_result r;
        o.open = open;
        assert_ok(koksma_mask_optimise(&o, NULL, v, &r));
        double sum = 0;
        for (int k = 0; k < TESTS; k++) {
            for (int y = open ? -1 : 0; y < 12; y++) {
                for (int x = open ? -2 : 0; x < 16; x++) {
                    const double f = filtered(&o, v, (k + 0.5) / TESTS, x, y);
                    sum += f * f / (16 * 12) / TESTS;
                }
            }
        }
        assert_close(r.error, sqrt(sum), 2e-3);
    }
}

TEST_CASE(errors_never_rise)
{
    static const char *const names[] = {"scalar", "vector2", "sphere"};
    static float v[MOST], next[MOST];
    for (size_t s = 0; s < 3; s++) {
        koksma_mask_options o = options_of(16, 11, names[s]);
        koksma_mask_result r;
        o.swaps = 0;
        assert_ok(koksma_mask_optimise(&o, NULL, v, &r));
        assert_true(r.error == r.first && r.done == 0 && r.finished);
        double error = r.error;
        for (int round = 0; round < 6; round++) {
            o.from = v;
            o.swaps = round;
            o.seed = (uint64_t)round;
            assert_ok(koksma_mask_optimise(&o, NULL, next, &r));
            assert_close(r.first, error, 1e-9);
            assert_true(r.error <= r.first);
            error = r.error;
            memcpy(v, next, sizeof v);
        }
    }
}

static int ascending(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return x < y ? -1 : x > y;
}

TEST_CASE(each_value_occurs_once_or_equally_often)
{
    float v[24 * 10], mask[24 * 10];
    koksma_mask_options o = options_of(24, 10, "scalar");
    for (int levels = 0; levels <= 8; levels += 8) {
        o.levels = levels;
        assert_ok(koksma_mask_optimise(&o, NULL, v, NULL));
        memcpy(mask, v, sizeof v);
        qsort(v, 240, sizeof *v, ascending);
        for (int i = 0; i < 240; i++) {
            assert_close((double)v[i], levels ? (i / 30 + 0.5) / 8 : (i + 0.5) / 240, 1e-6);
        }
    }
    o.levels = 0;
    o.from = mask; /* rearranges what it gets */
    float again[24 * 10];
    assert_ok(koksma_mask_optimise(&o, NULL, again, NULL));
    qsort(again, 240, sizeof *again, ascending);
    assert_memory_equal(again, v, sizeof v);
}

TEST_CASE(a_search_continues_where_it_ended)
{
    static const struct {
        const char *space;
        int levels;
        bool tied, state; /* tied: of a mask of few different numbers */
    } cases[] = {{"scalar", 0, false, false}, {"tent", 0, false, false},  {"vector3", 0, false, false},
                 {"circle", 0, false, false}, {"scalar", 9, false, true}, {"scalar", 0, true, true},
                 {"gaussian", 0, true, true}, {"vector2", 0, true, true}};
    static float whole[MOST], part[MOST], rest[MOST], given[MOST];
    static uint32_t stands[16 * 16];
    for (size_t s = 0; s < sizeof cases / sizeof *cases; s++) {
        koksma_mask_options o = options_of(16, 16, cases[s].space);
        koksma_mask_result r, all;
        koksma_run soon = {.threads = 1, .time_limit_s = 1e-9}; /* ends after the first block */
        o.seed = 5;
        o.levels = cases[s].levels;
        o.state = cases[s].state ? stands : NULL;
        for (int i = 0; i < 512; i++) {
            given[i] = (float)(i * 5 % 7) / 7;
        }
        o.from = cases[s].tied ? given : NULL;
        assert_ok(koksma_mask_optimise(&o, NULL, whole, &all));
        assert_int_equal(all.done, 40 * 256);
        assert_ok(koksma_mask_optimise(&o, &soon, part, &r));
        for (int calls = 0; calls < 3; calls++) {
            assert_true(r.done == 1024 * (calls + 1U) && !r.finished && r.first == all.first);
            o.from = part;
            o.done = r.done;
            o.first = r.first;
            assert_ok(koksma_mask_optimise(&o, calls < 2 ? &soon : NULL, rest, &r));
            memcpy(part, rest, sizeof part);
        }
        assert_true(r.finished && r.done == 40 * 256 && r.first == all.first);
        assert_memory_equal(rest, whole, 256 * (size_t)o.space->dim * sizeof *whole);
    }
}

/* A search that is ended while it is hot stands at a worse mask than the one that it was given: it returns the latter, and
   continues from where it stands, to the mask of a search that is not ended. */
TEST_CASE(a_search_that_is_ended_keeps_the_better_mask)
{
    enum { N = 16 * 16 };
    static float given[N], whole[N], part[N], rest[N];
    static uint32_t stands[N];
    koksma_mask_options o = options_of(16, 16, "scalar");
    koksma_mask_result r;
    const koksma_run soon = {.threads = 1, .time_limit_s = 1e-9};
    o.swaps = 200;
    assert_ok(koksma_mask_optimise(&o, NULL, given, &r));
    const double error = r.error;
    o.from = given;
    o.seed = 3;
    o.swaps = 1000;
    assert_ok(koksma_mask_optimise(&o, NULL, whole, &r));
    assert_true(r.error < error); /* five times as many swaps */
    assert_ok(koksma_mask_optimise(&o, &soon, part, &r));
    assert_memory_equal(part, given, sizeof part);
    assert_true(!r.finished && r.done == 0 && r.error == r.first); /* nothing to continue without the state */
    o.state = stands;
    assert_ok(koksma_mask_optimise(&o, &soon, part, &r));
    assert_memory_equal(part, given, sizeof part);
    assert_true(!r.finished && r.done == 1024 && r.error == r.first);
    o.from = part;
    o.done = r.done;
    o.first = r.first;
    assert_ok(koksma_mask_optimise(&o, NULL, rest, &r));
    assert_memory_equal(rest, whole, sizeof rest);
    stands[7] = stands[8];
    assert_int_equal(koksma_mask_optimise(&o, NULL, rest, &r), KOKSMA_ARGUMENT);
}

TEST_CASE(target_ends_the_search)
{
    float v[32 * 32];
    koksma_mask_options o = options_of(32, 32, "scalar");
    koksma_mask_result all, some;
    assert_ok(koksma_mask_optimise(&o, NULL, v, &all));
    o.target = (all.first + all.error) / 2;
    assert_ok(koksma_mask_optimise(&o, NULL, v, &some));
    assert_true(some.done < all.done && some.error <= o.target * (1 + 1e-4));
}

/* The moments of each space: the mean, and the mean of the square of each number. */
TEST_CASE(values_have_the_distribution_of_their_space)
{
    static const struct {
        const char *name;
        double mean[4], square[4];
    } known[] = {{"scalar", {0.5}, {1.0 / 3}},
                 {"tent", {0}, {1.0 / 6}},
                 {"gaussian", {0}, {1}},
                 {"vector2", {0.5, 0.5}, {1.0 / 3, 1.0 / 3}},
                 {"vector3", {0.5, 0.5, 0.5}, {1.0 / 3, 1.0 / 3, 1.0 / 3}},
                 {"vector4", {0.5, 0.5, 0.5, 0.5}, {1.0 / 3, 1.0 / 3, 1.0 / 3, 1.0 / 3}},
                 {"disk", {0, 0}, {0.25, 0.25}},
                 {"circle", {0, 0}, {0.5, 0.5}},
                 {"sphere", {0, 0, 0}, {1.0 / 3, 1.0 / 3, 1.0 / 3}},
                 {"hemisphere", {0, 0, 2.0 / 3}, {0.25, 0.25, 0.5}}};
    static float v[MOST];
    for (size_t s = 0; koksma_mask_space_at(s); s++) {
        assert_string_equal(koksma_mask_space_at(s)->name, known[s].name);
        koksma_mask_options o = options_of(64, 48, known[s].name);
        o.swaps = 1;
        const int dim = o.space->dim, n = 64 * 48;
        assert_ok(koksma_mask_optimise(&o, NULL, v, NULL));
        for (int k = 0; k < dim; k++) {
            double mean = 0, square = 0;
            for (int p = 0; p < n; p++) {
                const double x = (double)v[p * dim + k];
                assert_true(x >= o.space->low && x <= o.space->high);
                mean += x / n;
                square += x * x / n;
            }
            assert_close(mean + 1, known[s].mean[k] + 1, 2e-3);
            assert_close(square, known[s].square[k], 5e-3);
        }
    }
}

/* Under a Gaussian of sigma = 1, the filter for which void-and-cluster is best, and also beside its ranks. */
TEST_CASE(masks_are_better_than_void_and_cluster)
{
    enum { SIZE = test_repeats(48, 16), N = SIZE * SIZE };
    static float v[N], ulichney[N];
    static uint32_t ranks[N];
    koksma_mask_options o = options_of(SIZE, SIZE, "scalar");
    use_gaussian(&o);
    o.swaps = test_repeats(2000, 500);
    koksma_mask_result r;
    assert_ok(koksma_mask_optimise(&o, NULL, v, &r));
    assert_ok(koksma_mask_void_and_cluster(SIZE, 1, NULL, ranks));
    for (int p = 0; p < N; p++) {
        ulichney[p] = (float)((ranks[p] + 0.5) / N);
    }
    koksma_mask_quality ours, other;
    assert_ok(koksma_mask_measure(SIZE, SIZE, NULL, v, &o.filter, 64, NULL, &ours));
    assert_ok(koksma_mask_measure(SIZE, SIZE, NULL, ulichney, &o.filter, 64, NULL, &other));
    assert_that(ours.error < other.error, "error %.5f, void-and-cluster %.5f", ours.error, other.error);
}

/* A random arrangement has the error `white`; also one whose tile is smaller than the filter, of 7 x 7 pixels. */
TEST_CASE(white_is_the_error_of_random_arrangements)
{
    static const struct {
        const char *name;
        int width, height;
        unsigned masks;
        double apart; /* some three standard deviations */
    } cases[] = {{"scalar", 32, 32, 20, 0.06}, {"vector2", 32, 32, 20, 0.06}, {"scalar", 4, 6, 2000, 0.03}};
    float v[32 * 32 * 2];
    for (size_t s = 0; s < sizeof cases / sizeof *cases; s++) {
        const int width = cases[s].width, height = cases[s].height;
        koksma_mask_options o = options_of(width, height, cases[s].name);
        use_gaussian(&o);
        double squares = 0, expected = 0;
        o.swaps = 0;
        for (o.seed = 0; o.seed < cases[s].masks; o.seed++) {
            koksma_mask_quality q;
            assert_ok(koksma_mask_optimise(&o, NULL, v, NULL));
            assert_ok(koksma_mask_measure(width, height, o.space, v, &o.filter, 32, NULL, &q));
            squares += q.error * q.error / cases[s].masks;
            expected = q.white * q.white;
        }
        assert_close(squares, expected, cases[s].apart);
    }
}

/* Equal weights over the whole tile leave nothing of a mask; a box of 65 pixels over 24 x 20 is 2 or 3 of them along the
   width, 3 or 4 along the height. */
TEST_CASE(white_wraps_filters_that_are_larger_than_the_mask)
{
    float v[24 * 20];
    koksma_mask_options o = options_of(24, 20, "scalar");
    koksma_mask_quality q;
    o.swaps = 0;
    o.filter.width = o.filter.height = 65;
    for (int i = 0; i < 65 * 65; i++) {
        o.filter.weights[i] = 1;
    }
    double squares = 0, shares = 0;
    for (int i = 0; i < 24 * 20; i++) {
        squares += pow((i % 24 < 17 ? 3 : 2) * (i / 24 < 5 ? 4 : 3) / (65 * 65.0), 2);
    }
    for (int t = 0; t < 16; t++) {
        shares += (t + 0.5) / 16 * (1 - (t + 0.5) / 16) / 16;
    }
    assert_ok(koksma_mask_optimise(&o, NULL, v, NULL));
    assert_ok(koksma_mask_measure(24, 20, NULL, v, &o.filter, 16, NULL, &q));
    assert_close(q.white, sqrt(shares * (480 * squares - 1) / 479), 1e-9);
}
