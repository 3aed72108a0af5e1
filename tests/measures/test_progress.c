/* SPDX-License-Identifier: Apache-2.0 */
/* The fractions that measures and spectra report: they never fall, and those with several phases do not reach 1 in the
   first one. Counted are calls, which are as many as pieces of work, not seconds: with one thread the fraction after
   half of the calls of evenly long pieces is about 1/2. */
#include <stdlib.h>

#include <koksma/spectrum.h>

#include "test.h"

enum { MOST = 1 << 16 };

typedef struct calls {
    size_t n;
    double fractions[MOST];
} calls;

static bool keep_going(void *context, double fraction)
{
    calls *c = context;
    assert_true(fraction >= 0 && fraction <= 1 && c->n < MOST);
    assert_true(!c->n || fraction >= c->fractions[c->n - 1]);
    c->fractions[c->n++] = fraction;
    return true;
}

/* Fails unless the fraction after half of the calls is from low to high, and that after 9 of 10 is below 1. Calls of
   short phases at the start, such as sorting, report 0 and do not count. */
static void assert_half(const char *what, const calls *c, double low, double high)
{
    size_t first = 0;
    while (first + 1 < c->n && c->fractions[first] == 0) {
        first++;
    }
    const size_t count = c->n - first;
    const double half = c->fractions[first + count / 2], most = c->fractions[first + count * 9 / 10];
    if (count < 8 || half < low || half > high || most >= 1) {
        fail_msg("%s: %zu calls, after half %g, after 9 of 10 %g", what, c->n, half, most);
    }
}

TEST_CASE(test_measures)
{
    static const struct {
        const char *measure;
        int dim;
        size_t n;
        double low, high;
    } cases[] = {
        {"star-lower", 3, 200, 0.48, 0.52}, /* walks, all of equally many steps */
        {"star", 2, 40000, 0.45, 0.55},     /* points of the sweep */
        {"star", 3, 600, 0.001, 0.6}, /* a short search, then slabs: the first are longer, and pruning makes them shorter */
        {"star", 5, 60, 0.001, 0.6},
        {"l2-star", 5, 3000, 0.3, 0.8}, /* levels of the recursion, or rows of pairs */
        {"extreme", 2, 1000, 0.1, 0.9}};
    calls *c = malloc(sizeof *c);
    assert_non_null(c);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        koksma_points points;
        koksma_spec pattern, measure;
        koksma_value value;
        const koksma_run run = {.threads = 1, .keep_going = keep_going, .context = c};
        c->n = 0;
        assert_ok(koksma_pattern_spec("random", &pattern));
        assert_ok(koksma_measure_spec(cases[i].measure, &measure));
        assert_ok(koksma_points_init(&points, cases[i].n, cases[i].dim));
        assert_ok(koksma_generate(&pattern, 0, NULL, &points));
        assert_ok(koksma_evaluate(&measure, &points, &run, &value));
        assert_half(cases[i].measure, c, cases[i].low, cases[i].high);
        koksma_points_fini(&points);
    }
    free(c);
}

/* A fast spectrum transforms columns, then rows. */
TEST_CASE(test_spectrum)
{
    koksma_points points;
    koksma_spec pattern;
    koksma_spectrum spectrum;
    calls *c = malloc(sizeof *c);
    assert_non_null(c);
    const koksma_run run = {.threads = 1, .keep_going = keep_going, .context = c};
    c->n = 0;
    assert_ok(koksma_pattern_spec("random", &pattern));
    assert_ok(koksma_points_init(&points, 1000, 2));
    assert_ok(koksma_generate(&pattern, 0, NULL, &points));
    assert_ok(koksma_spectrum_init(&spectrum, 100));
    assert_ok(koksma_spectrum_add(&spectrum, &points, KOKSMA_SPECTRUM_FAST, &run));
    assert_half("spectrum", c, 0.3, 0.7);
    koksma_spectrum_fini(&spectrum);
    koksma_points_fini(&points);
    free(c);
}
