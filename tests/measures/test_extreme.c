/* SPDX-License-Identifier: Apache-2.0 */
/* Branch and bound for boxes in the plane against the plain search and a published value; its kernel against the
   twin; bounds when time is short; threads. */
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "kernels/kernels.h"
#include "measures/extreme/extreme.h"
#include "sets.h"

TEST_CASE(plane_equals_plain_search)
{
    for (int s = 0; s < test_repeats(36, 12); s++) {
        koksma_points p = sets_points(20 + 2 * (size_t)s, 2, s % SETS_KINDS, (uint64_t)s);
        koksma_value plain = {.value = NAN};
        assert_ok(koksma__extreme_small(&p, NULL, &plain));
        assert_near(test_measure("extreme", &p).value, plain.value, 1e-15);
        koksma_points_fini(&p);
    }
}

/* The sweep and the mixture of both ways, on sets with ties, repeats, points on a line and on the sides, against the
   plain search; what the witness holds is counted. */
TEST_CASE(sweep_equals_plain_search)
{
    for (int s = 0; s < test_repeats(600, 120); s++) {
        koksma_points p = sets_points(1 + (size_t)s % 37, 2, s % SETS_KINDS, (uint64_t)s);
        koksma_value plain = {.value = NAN}, swept = {.value = NAN}, either = {.value = NAN};
        assert_ok(koksma__extreme_small(&p, NULL, &plain));
        assert_ok(koksma__extreme_plane_by(KOKSMA__EXTREME_SWEEP, &p, NULL, &swept));
        assert_ok(koksma__extreme_plane_by(KOKSMA__EXTREME_EITHER, &p, NULL, &either));
        assert_near(swept.value, plain.value, 1e-15);
        assert_near(either.value, plain.value, 1e-15);
        assert_true(swept.exact && swept.lower == swept.value && swept.upper == swept.value);
        size_t count = 0;
        for (size_t i = 0; i < p.n; i++) {
            bool in = true;
            for (int k = 0; k < 2; k++) {
                const double x = p.xs[2 * i + (size_t)k], lo = swept.witness.lo[k], hi = swept.witness.hi[k];
                in = in && (swept.witness.closed ? x >= lo && x <= hi : x > lo && x < hi);
            }
            count += in;
        }
        assert_int_equal(count, swept.witness.count);
        koksma_points_fini(&p);
    }
}

/* Sets on which bounding is slowest, larger than the plain search can do. */
TEST_CASE(sweep_equals_bounding)
{
    static const char *const patterns[] = {"golden", "hammersley", "jittered", "regular", "random"};
    for (int i = 0; i < 5; i++) {
        koksma_points p = test_points(patterns[i], 256, 2, 5);
        koksma_value bound, swept, cut;
        assert_ok(koksma__extreme_plane_by(KOKSMA__EXTREME_BOUND, &p, NULL, &bound));
        assert_ok(koksma__extreme_plane_by(KOKSMA__EXTREME_SWEEP, &p, NULL, &swept));
        assert_near(swept.value, bound.value, 1e-15);
        assert_ok(koksma__extreme_plane_by(KOKSMA__EXTREME_SWEEP, &p, &(koksma_run){.time_limit_s = 1e-6}, &cut));
        assert_true(!cut.exact && cut.lower <= bound.value + 1e-15 && cut.upper >= bound.value);
        koksma_points_fini(&p);
    }
}

TEST_CASE(strips_equal_reference)
{
    double x[200], y[200], sides[6][16], a[2][16], b[2][16];
    for (size_t i = 0; i < 200; i++) {
        x[i] = floor(32 * sets_unit(1, i)) / 32; /* many are on sides */
        y[i] = ((double)i + sets_unit(2, i)) / 200;
    }
    for (size_t count = 0; count <= 200; count += 1 + count / 3) {
        for (size_t l = 0; l < 16; l++) {
            sides[0][l] = sides[3][l] = floor(16 * sets_unit(3, l + count)) / 32;
            sides[1][l] = sides[4][l] = 0.5 + floor(16 * sets_unit(4, l + count)) / 32;
            sides[2][l] = 190 * (sides[1][l] - sides[0][l]);
            sides[5][l] = 210 * (sides[1][l] - sides[0][l]);
        }
        koksma__kernels_find("ref")->extreme_strips(count, x, y, (const double(*)[16])sides, a[0], a[1]);
        static const char *const isas[] = {"baseline", "avx2", "avx512"};
        for (int isa = 0; isa < 3; isa++) {
            const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
            if (fast) {
                fast->extreme_strips(count, x, y, (const double(*)[16])sides, b[0], b[1]);
                assert_memory_equal(a, b, sizeof a);
            }
        }
    }
}

static void expect_plain_value(const char *name, koksma_points *p)
{
    koksma_value plain = {.value = NAN}, v;
    size_t count = 0;
    assert_ok(koksma__extreme_small(p, NULL, &plain));
    assert_ok(koksma__extreme_plane_by(KOKSMA__EXTREME_BOUND, p, NULL, &v));
    for (size_t i = 0; i < p->n; i++) {
        const double *x = p->xs + 2 * i, *lo = v.witness.lo, *hi = v.witness.hi;
        count += v.witness.closed ? x[0] >= lo[0] && x[0] <= hi[0] && x[1] >= lo[1] && x[1] <= hi[1]
                                  : x[0] > lo[0] && x[0] < hi[0] && x[1] > lo[1] && x[1] < hi[1];
    }
    assert_that(fabs(v.value - plain.value) <= 1e-15 && count == v.witness.count,
                "%s: %.17g, by the plain search %.17g", name, v.value, plain.value);
    koksma_points_fini(p);
}

/* Points that are in all strips of a tile are bounded as runs only in sets larger than those above: all patterns of the
   table that make a plane set, and sets with repeats and with points on the sides, against the plain search. */
TEST_CASE(runs_equal_plain_search)
{
    static const size_t sizes[] = {256, 289, 233, 343};
    const koksma_pattern *pattern;
    size_t made = 0;
    for (size_t i = 0; (pattern = koksma_pattern_at(i)); i++) {
        for (size_t s = 0; s < 4; s++) {
            koksma_spec spec;
            koksma_points p;
            if (i % test_repeats(1, 4) > 0) { /* patterns only give sets of all kinds here */
                break;
            }
            assert_ok(koksma_points_init(&p, sizes[s], 2));
            if (!koksma_pattern_spec(pattern->name, &spec) && !koksma_generate(&spec, 3, NULL, &p)) {
                expect_plain_value(pattern->name, &p);
                made++;
                break;
            }
            koksma_points_fini(&p);
        }
    }
    assert_true(made >= test_repeats(30, 8));
    for (int s = 0; s < 2 * SETS_KINDS; s++) {
        koksma_points p = sets_points(200 + 10 * (size_t)s, 2, s % SETS_KINDS, (uint64_t)s);
        expect_plain_value("a set of sets.h", &p);
    }
    for (int s = 0; s < 3; s++) { /* widths that hardly differ, or are below the normal numbers */
        koksma_points p = sets_points(300, 2, 0, 99);
        for (size_t i = 0; i < p.n; i++) {
            p.xs[2 * i] = s == 2 ? 0.5 + 1e-15 * p.xs[2 * i] : p.xs[2 * i] * (s ? 1e-310 : 1e-14);
        }
        expect_plain_value("a set in a thin strip", &p);
    }
}

static void expect_bounds(const koksma__run_list *all, const koksma__run_list *list, const koksma__strip_set *set,
                          double n, bool exactly)
{
    double sides[6][16], exact[2][16], bound[2][16], other[2][16];
    for (size_t l = 0; l < 16; l++) {
        sides[0][l] = sides[3][l] = set->a1 + (set->a2 - set->a1) * (double)(l % 4) / 3;
        sides[1][l] = sides[4][l] = set->b1 + (set->b2 - set->b1) * (double)(l / 4) / 3;
        sides[2][l] = sides[5][l] = n * (sides[1][l] - sides[0][l]);
    }
    const double(*const lanes)[16] = (const double(*)[16])sides;
    const double(*const lines)[KOKSMA__RUN_NUMBERS] = (const double(*)[KOKSMA__RUN_NUMBERS])list->runs;
    const koksma__kernel_table *ref = koksma__kernels_find("ref");
    ref->extreme_strips(all->count - 1, all->x, all->y, lanes, exact[0], exact[1]);
    ref->extreme_runs(list->count, list->x, list->y, lines, lanes, bound[0], bound[1]);
    for (int k = 0; k < 2; k++) {
        for (size_t l = 0; l < 16; l++) {
            assert_true(bound[k][l] >= exact[k][l] - 1e-9 && bound[k][l] <= exact[k][l] + (exactly ? 1e-9 : 2));
        }
    }
    static const char *const isas[] = {"baseline", "avx2", "avx512"};
    for (int isa = 0; isa < 3; isa++) {
        const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
        if (fast) {
            fast->extreme_runs(list->count, list->x, list->y, lines, lanes, other[0], other[1]);
            assert_memory_equal(bound, other, sizeof bound);
        }
    }
}

/* Lists of narrower and narrower sets bound all their strips from above, and equal them where there is one width; the
   kernel equals its twin. */
TEST_CASE(runs_bound_their_strips)
{
    enum { N = 3000 };
    static double x[N + 1], y[N + 1];
    koksma__run_place *places = malloc(3 * KOKSMA__RUN_CAPACITY * sizeof *places);
    koksma__run_list all = {.count = N + 1, .x = x, .y = y}, lists[3];
    for (size_t i = 0; i < N; i++) { /* every fifth height is repeated */
        x[i] = sets_unit(5, i);
        y[i] = i % 5 == 4 ? y[i - 1] : ((double)i + sets_unit(6, i)) / N;
    }
    x[N] = HUGE_VAL;
    y[N] = 1;
    assert_non_null(places);
    for (size_t i = 0; i < 3; i++) {
        koksma__run_list_init(&lists[i], places + i * KOKSMA__RUN_CAPACITY);
    }
    for (uint64_t seed = 0; seed < test_repeats(60, 6); seed++) {
        koksma__strip_set set = {.a1 = 0.4 * sets_unit(7, seed), .b1 = 0.4 + 0.5 * sets_unit(8, seed)};
        const koksma__run_list *from = &all;
        for (size_t i = 0; i < 3; i++) {
            const double size = 0.08 * pow(0.2, (double)i);
            set.a1 += i * size * sets_unit(9 + i, seed);
            set.b1 += i * size * sets_unit(12 + i, seed);
            set.a2 = set.a1 + size;
            set.b2 = set.b1 + size;
            set.narrow = N * fmax(0, set.b1 - set.a2);
            set.wide = N * (set.b2 - set.a1);
            assert_true(koksma__run_list_narrow(from, &set, &lists[i]));
            expect_bounds(&all, &lists[i], &set, N, false);
            from = &lists[i];
        }
        set.a1 = set.a2 = fmin(x[seed], x[N - 1 - seed]); /* both are points' */
        set.b1 = set.b2 = fmax(x[seed], x[N - 1 - seed]);
        set.narrow = set.wide = N * (set.b1 - set.a1);
        assert_true(koksma__run_list_narrow(&all, &set, &lists[0]));
        expect_bounds(&all, &lists[0], &set, N, true);
    }
    assert_false(koksma__run_list_narrow(&all, &(koksma__strip_set){0, 0.5, 0.5, 1, 0, N}, &lists[0]));
    free(places);
}

/* What the witness of a grid holds, counted in doubles as everywhere. */
TEST_CASE(witness_of_a_grid)
{
    for (int s = 0; s < test_repeats(200, 60); s++) {
        koksma_points p = sets_points(1 + (size_t)s % 37, 2, s % SETS_KINDS, (uint64_t)s);
        char text[32];
        koksma_spec spec;
        koksma_value v;
        size_t count = 0;
        snprintf(text, sizeof text, "extreme:grid=%d", 2 + s % 19);
        assert_ok(koksma_measure_spec(text, &spec));
        assert_ok(koksma_evaluate(&spec, &p, NULL, &v));
        assert_true(v.witness.closed);
        for (size_t i = 0; i < p.n; i++) {
            const double *x = p.xs + 2 * i, *lo = v.witness.lo, *hi = v.witness.hi;
            count += x[0] >= lo[0] && x[0] <= hi[0] && x[1] >= lo[1] && x[1] <= hi[1];
        }
        assert_int_equal(count, v.witness.count);
        assert_near(fabs((double)count / (double)p.n - v.witness.volume), v.value, 1e-15);
        koksma_points_fini(&p);
    }
}

/* Time that passes by a second whenever somebody asks: what a limit allows does not depend on the machine. */
static double seconds_asked;

static double ticking(void)
{
    return seconds_asked++;
}

/* Sets that take minutes end in time, with bounds that say something. */
TEST_CASE(large_sets_obey_the_time_limit)
{
    static const struct {
        const char *measure, *pattern;
        size_t n;
        int dim;
        double upper;
    } cases[] = {
        {"extreme", "hammersley", 16384, 2, 0.1},
        {"extreme", "random", 200000, 2, 0.2},
        {"star", "random", 50000, 6, 1},
        {"star-lower:steps=1000000000", "random", 50000, 6, 1},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        koksma_points p = test_points(cases[c].pattern, cases[c].n, cases[c].dim, 0);
        koksma_spec spec;
        koksma_value v;
        assert_ok(koksma_measure_spec(cases[c].measure, &spec));
        koksma__set_clock(ticking);
        assert_ok(koksma_evaluate(&spec, &p, &(koksma_run){.threads = 1, .time_limit_s = test_repeats(100, 20)}, &v));
        koksma__set_clock(NULL);
        assert_true(!v.exact && v.value == v.lower && v.lower > 0 && v.lower < v.upper);
        assert_true(v.upper <= cases[c].upper);
        koksma_points_fini(&p);
    }
}
