/* SPDX-License-Identifier: Apache-2.0 */
/* The ways to the star discrepancy against each other, against brute force in one and four dimensions and against
   closed forms; bounds when time is short; threads. */
#include <string.h>

#include <koksma/series.h>

#include "measures/star/star.h"
#include "sets.h"

TEST_CASE(sweep_equals_kinetic_tree)
{
    for (int s = 0; s < test_repeats(3000, 300); s++) {
        const size_t n = 1 + (size_t)(s / SETS_KINDS) % 60;
        koksma_points p = sets_points(n, 2, s % SETS_KINDS, (uint64_t)s);
        koksma_value sweep = {.value = NAN}, tree = {.value = NAN};
        assert_ok(koksma__star_2d_by(false, &p, NULL, &sweep));
        assert_ok(koksma__star_2d_by(true, &p, NULL, &tree));
        assert_near(sweep.value, tree.value, 1e-15);
        koksma_points_fini(&p);
    }
    for (int kind = 0; kind < SETS_KINDS; kind++) {
        koksma_points p = sets_points(5000, 2, kind, 5);
        koksma_value sweep = {.value = NAN}, tree = {.value = NAN};
        assert_ok(koksma__star_2d_by(false, &p, NULL, &sweep));
        assert_ok(koksma__star_2d_by(true, &p, NULL, &tree));
        assert_near(sweep.value, tree.value, 1e-15);
        koksma_points_fini(&p);
    }
}

/* Every interval [0,y) and [0,y] that ends at a point, at 0 or at 1. */
static double brute_1d(const koksma_points *p)
{
    double best = 0;
    for (size_t at = 0; at < p->n + 2; at++) {
        const double y = at < p->n ? p->xs[at] : (double)(at - p->n);
        size_t open = 0, closed = 0;
        for (size_t i = 0; i < p->n; i++) {
            open += p->xs[i] < y;
            closed += p->xs[i] <= y;
        }
        best = fmax(best, fmax((double)closed / (double)p->n - y, y - (double)open / (double)p->n));
    }
    return best;
}

TEST_CASE(line_equals_brute_force)
{
    int reached = 0;
    for (int s = 0; s < test_repeats(1200, 150); s++) {
        koksma_points p = sets_points(1 + (size_t)(s / SETS_KINDS) % 40, 1, s % SETS_KINDS, (uint64_t)s);
        for (size_t i = 0; i < p.n && s % 7 == 0; i += 3) {
            p.xs[i] = i % 2 ? 0x1p-1074 : 0x1p-1060 * p.xs[i];
        }
        const koksma_value star = test_measure("star", &p);
        const koksma_value found = test_measure("star-lower:steps=100,restarts=2", &p);
        const double y = star.witness.hi[0], share = (double)star.witness.count / (double)p.n;
        assert_near(star.value, brute_1d(&p), 1e-15);
        assert_true(star.exact && star.value == (star.witness.closed ? share - y : y - share));
        assert_true(found.value <= star.value);
        reached += found.value >= star.value - 1e-15;
        koksma_points_fini(&p);
    }
    assert_true(reached > test_repeats(1000, 100));
    koksma_points many = test_points("random", 50000, 1, 3);
    koksma_value cut = {0};
    const size_t sizes[] = {1, 300, 2500};
    koksma_value values[3];
    koksma_spec spec;
    assert_ok(koksma_measure_spec("star", &spec));
    assert_ok(koksma_evaluate_prefixes(&spec, &many, sizes, 3, NULL, values));
    for (int i = 0; i < 3; i++) {
        assert_near(values[i].value, brute_1d(&(koksma_points){sizes[i], 1, many.xs}), 1e-15);
    }
    assert_ok(koksma_evaluate(&spec, &many, &(koksma_run){.threads = 2, .time_limit_s = 1e6}, &cut));
    assert_true(cut.exact && cut.value > 1e-3 && cut.value < 1e-2);
    koksma_points_fini(&many);
}

static double brute_4d(const koksma_points *p)
{
    double best = 0, n = (double)p->n;
    const size_t m = p->n + 1;
    for (size_t code = 0; code < m * m * m * m; code++) {
        const size_t at[4] = {code % m, code / m % m, code / m / m % m, code / m / m / m};
        double corner[4], volume = 1;
        for (size_t k = 0; k < 4; k++) {
            corner[k] = at[k] < p->n ? p->xs[4 * at[k] + k] : 1;
            volume *= corner[k];
        }
        size_t open = 0, closed = 0;
        for (size_t i = 0; i < p->n; i++) {
            bool in_open = true, in_closed = true;
            for (size_t k = 0; k < 4; k++) {
                in_open = in_open && p->xs[4 * i + k] < corner[k];
                in_closed = in_closed && p->xs[4 * i + k] <= corner[k];
            }
            open += in_open;
            closed += in_closed;
        }
        best = fmax(best, fmax((double)closed / n - volume, volume - (double)open / n));
    }
    return best;
}

TEST_CASE(four_dimensions_equal_brute_force)
{
    for (int s = 0; s < test_repeats(120, 24); s++) {
        koksma_points p = sets_points(1 + (size_t)(s / SETS_KINDS) % 9, 4, s % SETS_KINDS, (uint64_t)s);
        assert_near(test_measure("star", &p).value, brute_4d(&p), 1e-15);
        koksma_points_fini(&p);
    }
}

/* The partition in two dimensions, which `star` does not use there, against the sweep. */
TEST_CASE(partition_equals_sweep)
{
    for (int s = 0; s < test_repeats(1200, 150); s++) {
        koksma_points p = sets_points(1 + (size_t)(s / SETS_KINDS) % 50, 2, s % SETS_KINDS, (uint64_t)s);
        koksma_value v = {.value = -1};
        bool complete;
        assert_ok(koksma__star_partition(&p, NULL, INFINITY, &v, &complete));
        assert_true(complete);
        assert_near(v.value, test_measure("star", &p).value, 1e-15);
        koksma_points_fini(&p);
    }
}

TEST_CASE(short_time_gives_bounds)
{
    static const struct {
        const char *measure, *pattern;
        size_t n;
        int dim;
        double limit_s;
    } cases[] = {{"star", "random", 400, 4, 0.02}, {"extreme", "jittered", 256, 2, 1e-6}};
    for (size_t c = 0; c < 2; c++) {
        koksma_points p = test_points(cases[c].pattern, cases[c].n, cases[c].dim, 2);
        koksma_spec spec;
        koksma_value exact, cut;
        assert_ok(koksma_measure_spec(cases[c].measure, &spec));
        assert_ok(koksma_evaluate(&spec, &p, &(koksma_run){.threads = 1}, &exact));
        assert_true(exact.exact && exact.lower == exact.value && exact.upper == exact.value);
        assert_ok(koksma_evaluate(&spec, &p, &(koksma_run){.threads = 1, .time_limit_s = cases[c].limit_s}, &cut));
        assert_true(cut.lower <= exact.value + 1e-15 && cut.upper >= exact.value - 1e-15 && cut.value == cut.lower);
        koksma_points_fini(&p);
    }
}

/* Even when there is no time for a first look at anything, the bounds are those of some box. */
TEST_CASE(no_time_gives_bounds)
{
    static const char *const names[] = {"star", "star-lower", "extreme"};
    for (int m = 0; m < 3; m++) {
        for (int s = 0; s < 40; s++) {
            koksma_points p = sets_points(100, m == 2 ? 3 : 5, s % SETS_KINDS, (uint64_t)s);
            koksma_spec spec;
            koksma_value cut;
            assert_ok(koksma_measure_spec(names[m], &spec));
            assert_ok(koksma_evaluate(&spec, &p, &(koksma_run){.time_limit_s = 1e-9}, &cut));
            const double share = (double)cut.witness.count / (double)p.n, volume = cut.witness.volume;
            assert_true(cut.value >= 0 && cut.value == (cut.witness.closed ? share - volume : volume - share));
            assert_true(!cut.exact && cut.lower == cut.value && cut.upper > cut.value && cut.upper <= 1);
            koksma_points_fini(&p);
        }
    }
}

TEST_CASE(search_is_a_lower_bound)
{
    int reached = 0;
    for (int s = 0; s < test_repeats(60, 12); s++) {
        koksma_points p = sets_points(1 + (size_t)s / 2, 2 + s % 2, s % SETS_KINDS, (uint64_t)s);
        const double exact = test_measure("star", &p).value;
        const koksma_value lower = test_measure("star-lower:steps=200,restarts=2", &p);
        assert_true(lower.value <= exact && !lower.exact && lower.upper >= exact);
        reached += lower.value >= exact - 1e-15;
        koksma_points_fini(&p);
    }
    assert_true(reached >= test_repeats(55, 10));
}

/* The default search against the exact value, over patterns and dimensions. */
TEST_CASE(search_reaches_star)
{
    static const char *const patterns[] = {"random",  "n-rooks",    "sobol",      "sobol:scramble=owen",
                                           "halton",  "faure",      "r-sequence", "lattice-rank1",
                                           "korobov", "hammersley", "regular",    "jittered"};
    for (size_t s = 0; s < sizeof patterns / sizeof *patterns; s++) {
        for (int dim = 2; dim <= 5; dim++) {
            const size_t n = dim == 2 ? 144 : dim == 3 ? 125 : dim == 4 ? 81 : 32;
            koksma_points p = test_points(patterns[s], n, dim, 1);
            const double exact = test_measure("star", &p).value;
            const koksma_value lower = test_measure("star-lower:restarts=3", &p);
            assert_that(lower.value >= exact - 1e-15 && lower.value <= exact + 1e-15,
                        "%s, n = %zu, dim = %d: %.17g, exact %.17g", patterns[s], n, dim, lower.value, exact);
            koksma_points_fini(&p);
        }
    }
}
