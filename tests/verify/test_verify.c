/* SPDX-License-Identifier: Apache-2.0 */
/* Each defect that `koksma verify` is there for, planted in points that have none, is found; and only it. */
#include <koksma/verify.h>

#include <stdlib.h>
#include <string.h>

#include "patterns/spacing/spacing.h"
#include "test.h"

static const koksma_finding *find(const koksma_findings *all, const char *property, const char *subject)
{
    for (size_t i = 0; i < all->count; i++) {
        if (!strcmp(all->items[i].property, property) && !strcmp(all->items[i].subject, subject)) {
            return &all->items[i];
        }
    }
    fail_msg("no finding %s of %s", property, subject);
    return NULL;
}

static koksma_finding one(const koksma_points *points, const char *property, const char *subject)
{
    koksma_findings all;
    assert_ok(koksma_verify(points, NULL, &all));
    const koksma_finding f = *find(&all, property, subject);
    koksma_findings_fini(&all);
    return f;
}

TEST_CASE(healthy_points_pass)
{
    koksma_points p = test_points("sobol", 256, 2, 0);
    static const char *const properties[][2] = {
        {"net-base-2", "0,1"},       {"latin", "0"},      {"latin", "1"},         {"stratified", "16 x 16"},
        {"stratified", "4 x 64"},    {"distinct", "-"},   {"origin-unique", "-"}, {"origin-not-missing", "-"},
        {"below-one-as-float", "-"}, {"progressive", "-"}};
    for (size_t i = 0; i < sizeof properties / sizeof *properties; i++) {
        const koksma_finding f = one(&p, properties[i][0], properties[i][1]);
        assert_that(f.holds, "%s %s: %g %s", f.property, f.subject, f.value, f.detail);
    }
    koksma_points_fini(&p);
}

TEST_CASE(each_name_of_the_table_is_found)
{
    koksma_points p = test_points("sobol", 64, 2, 0);
    koksma_findings all;
    const koksma_property *property;
    size_t seen = 0;
    assert_ok(koksma_verify(&p, NULL, &all));
    for (size_t i = 0; (property = koksma_property_at(i)) && !property->of_sets; i++) {
        const size_t before = seen;
        for (size_t f = 0; f < all.count; f++) {
            seen += !strcmp(all.items[f].property, property->name);
        }
        assert_true(seen > before);
    }
    assert_int_equal(seen, all.count);
    koksma_findings_fini(&all);
    koksma_points_fini(&p);
}

/* Of any property: it is called as its line, looks whatever the number of threads, and finds nothing that is no
 * number. */
TEST_CASE(every_property_looks_alike_on_any_threads)
{
    static const int dims[] = {1, 2, 3, 9};
    const koksma_property *property;
    for (size_t i = 0; (property = koksma_property_at(i)); i++) {
        assert_true(*property->name && *property->meaning);
        assert_int_equal(strspn(property->name, "abcdefghijklmnopqrstuvwxyz0123456789-"), strlen(property->name));
        for (size_t k = 0; k < i; k++) {
            assert_string_not_equal(property->name, koksma_property_at(k)->name);
        }
    }
    for (size_t d = 0; d < sizeof dims / sizeof *dims; d++) {
        koksma_points p = test_points("random", 50, dims[d], 6);
        koksma_findings one, three;
        assert_ok(koksma_verify(&p, &(koksma_run){.threads = 1}, &one));
        assert_ok(koksma_verify(&p, &(koksma_run){.threads = 3}, &three));
        assert_int_equal(one.count, three.count);
        for (size_t f = 0; f < one.count; f++) {
            const koksma_finding *a = &one.items[f], *b = &three.items[f];
            assert_that(a->property == b->property && strcmp(a->subject, b->subject) == 0 && a->holds == b->holds &&
                            a->value == b->value && isfinite(a->value) && strcmp(a->detail, b->detail) == 0,
                        "%s, %s: %g on one thread, %g on three", a->property, a->subject, a->value, b->value);
        }
        koksma_findings_fini(&one);
        koksma_findings_fini(&three);
        koksma_points_fini(&p);
    }
}

TEST_CASE(a_broken_net)
{
    koksma_points p = test_points("sobol:scramble=owen", 64, 2, 4);
    assert_true(one(&p, "net-base-2", "0,1").holds);
    const double y = p.xs[2 * 9 + 1]; /* swapping two y's keeps both coordinates Latin */
    p.xs[2 * 9 + 1] = p.xs[2 * 50 + 1];
    p.xs[2 * 50 + 1] = y;
    const koksma_finding f = one(&p, "net-base-2", "0,1");
    assert_false(f.holds);
    assert_true(f.value >= 1);
    assert_true(one(&p, "latin", "1").holds);
    koksma_points_fini(&p);
}

TEST_CASE(quality_in_other_bases_and_dimensions)
{
    koksma_points p = test_points("faure", 125, 3, 0);
    assert_true(one(&p, "net-base-3", "all").holds);
    assert_false(one(&p, "net-base-5", "all").holds);
    koksma_points_fini(&p);
    p = test_points("faure", 125, 5, 0);
    assert_true(one(&p, "net-base-5", "all").holds);
    assert_true(one(&p, "net-base-5", "2,4").holds);
    koksma_points_fini(&p);
    p = test_points("sobol", 64, 3, 0); /* t = 1 in three dimensions, 0 in two */
    assert_near(one(&p, "net-base-2", "all").value, 1, 0);
    assert_true(one(&p, "net-base-2", "0,1").holds);
    koksma_points_fini(&p);
}

TEST_CASE(a_missing_stratum)
{
    koksma_points p = test_points("jittered", 64, 2, 4);
    assert_true(one(&p, "stratified", "8 x 8").holds);
    p.xs[2 * 5] = p.xs[2 * 60];
    p.xs[2 * 5 + 1] = p.xs[2 * 60 + 1] * 0.999;
    const koksma_finding f = one(&p, "stratified", "8 x 8");
    assert_false(f.holds);
    assert_near(f.value, 1, 0);
    koksma_points_fini(&p);
}

TEST_CASE(two_rooks_in_a_row)
{
    koksma_points p = test_points("n-rooks", 50, 2, 4);
    assert_true(one(&p, "latin", "0").holds && one(&p, "latin", "1").holds);
    p.xs[2 * 7 + 1] = p.xs[2 * 8 + 1];
    assert_true(one(&p, "latin", "0").holds);
    assert_near(one(&p, "latin", "1").value, 1, 0);
    koksma_points_fini(&p);
}

TEST_CASE(the_last_of_many_coordinates)
{
    koksma_points p = test_points("n-rooks", 16, 40, 3);
    assert_true(one(&p, "latin", "39").holds);
    for (size_t i = 0; i < p.n; i++) {
        p.xs[40 * i + 39] = 0.5;
    }
    assert_near(one(&p, "latin", "39").value, 15, 0);
    koksma_points_fini(&p);
}

TEST_CASE(two_close_points_and_only_across_the_side)
{
    koksma_points p = test_points("dart-throwing", 200, 2, 4);
    const double densest = koksma__packing_distance(200, 2, true);
    assert_true(one(&p, "distance-torus", "-").value >= 0.75 * densest * (1 - 1e-12));
    const double square = one(&p, "distance-square", "-").value;
    p.xs[0] = 0.0005;
    p.xs[1] = 0.5;
    p.xs[2] = 0.9995;
    p.xs[3] = 0.5;
    assert_near(one(&p, "distance-torus", "-").value, 0.001, 1e-12);
    assert_true(one(&p, "distance-square", "-").value > 0.001);
    assert_true(square > 0.001);
    koksma_points_fini(&p);
}

/* Uniform points, and in the plane such that lie on one line, in one corner, in opposite corners, on a lattice. */
static koksma_points places(int kind, size_t n, int dim, uint64_t seed)
{
    koksma_points p = test_points("random", n, dim, seed);
    for (size_t i = 0; i < n && dim == 2; i++) {
        double *x = p.xs + 2 * i;
        x[0] = kind == 1 ? 0.5 : kind == 2 ? 1e-5 * x[0] : kind == 3 ? (double)(i % 2) : x[0];
        x[1] = kind == 2 ? 1e-5 * x[1] : kind == 3 ? fabs((double)(i / 2 % 2) - 1e-9 * x[1]) : x[1];
        if (kind == 4) {
            x[0] = floor(16 * x[0]) / 16;
            x[1] = (double)i / (double)n;
        }
    }
    return p;
}

TEST_CASE(distances_by_brute_force)
{
    for (int dim = 1; dim <= 4; dim++) {
        for (uint64_t seed = 0; seed < 40; seed++) {
            koksma_points p = places((int)seed % 5, 2 + 3 * seed, dim, seed);
            double best[2] = {10, 10}, found;
            for (size_t i = 0; i < p.n; i++) {
                for (size_t j = 0; j < i; j++) {
                    double plain = 0, around = 0;
                    for (int k = 0; k < dim; k++) {
                        const double t = fabs(p.xs[i * (size_t)dim + (size_t)k] - p.xs[j * (size_t)dim + (size_t)k]);
                        plain += t * t;
                        around += fmin(t, 1 - t) * fmin(t, 1 - t);
                    }
                    best[0] = fmin(best[0], sqrt(plain));
                    best[1] = fmin(best[1], sqrt(around));
                }
            }
            for (int torus = 0; torus < 2; torus++) {
                assert_ok(koksma_smallest_distance(&p, torus, NULL, &found));
                assert_near(found, best[torus], 1e-15);
            }
            koksma_points_fini(&p);
        }
    }
}

/* All pairs would be 8e10. */
TEST_CASE(distances_in_a_corner)
{
    koksma_points p = places(2, 400000, 2, 1);
    double square, torus;
    assert_ok(koksma_smallest_distance(&p, false, NULL, &square));
    assert_ok(koksma_smallest_distance(&p, true, NULL, &torus));
    assert_true(square > 0 && square < 1e-9 && torus == square);
    koksma_points_fini(&p);
}

static bool count_questions(void *context, double fraction)
{
    assert_true(fraction >= 0 && fraction <= 1);
    ++*(int *)context;
    return true;
}

/* The measure goes by cells where points are spread and by halving where they crowd: to the bit the same. All pairs
   of the corner would be 2e10, a question whether to go on each 65,536. */
TEST_CASE(the_measure_is_the_same)
{
    for (uint64_t seed = 0; seed < 60; seed++) {
        koksma_points p = places((int)seed % 5, 2 + 9 * seed, 2, seed);
        double square, torus;
        assert_ok(koksma_smallest_distance(&p, false, NULL, &square));
        assert_ok(koksma_smallest_distance(&p, true, NULL, &torus));
        assert_true(test_measure("min-distance", &p).value == torus);
        assert_true(test_measure("min-distance:torus=0", &p).value == square);
        koksma_points_fini(&p);
    }
    koksma_points p = places(2, 200000, 2, 1);
    for (int on_torus = 0; on_torus < 2; on_torus++) {
        int asked = 0;
        double distance;
        koksma_spec spec;
        koksma_value value;
        const koksma_run run = {.threads = 1, .keep_going = count_questions, .context = &asked};
        assert_ok(koksma_smallest_distance(&p, on_torus, NULL, &distance));
        assert_ok(koksma_measure_spec(on_torus ? "min-distance" : "min-distance:torus=0", &spec));
        assert_ok(koksma_evaluate(&spec, &p, &run, &value));
        assert_true(value.value == distance && asked < 100);
    }
    koksma_points_fini(&p);
}

TEST_CASE(a_repeated_point)
{
    koksma_points p = test_points("random", 100, 3, 4);
    assert_true(one(&p, "distinct", "-").holds);
    memcpy(p.xs + 3 * 10, p.xs + 3 * 90, 3 * sizeof *p.xs);
    assert_near(one(&p, "distinct", "-").value, 1, 0);
    assert_false(one(&p, "distance-square", "-").holds);
    koksma_points_fini(&p);
}

TEST_CASE(the_origin)
{
    koksma_points p = test_points("sobol", 65, 2, 0);
    koksma_points skipped = {64, 2, p.xs + 2}; /* the first point dropped */
    const koksma_finding f = one(&skipped, "origin-not-missing", "-");
    assert_false(f.holds);
    assert_false(one(&skipped, "net-base-2", "0,1").holds);
    p.xs[2 * 3] = p.xs[2 * 3 + 1] = 0;
    assert_near(one(&p, "origin-unique", "-").value, 2, 0);
    assert_false(one(&p, "origin-unique", "-").holds);
    koksma_points_fini(&p);
    static const struct {
        const char *pattern;
        size_t n;
        int dim;
    } whole[] = {{"random", 64, 2},
                 {"regular", 1, 2},
                 {"regular", 16, 2},
                 {"regular", 64, 3},
                 {"regular", 64, 1},
                 {"hammersley:offset=0.5", 16, 2},
                 {"void-and-cluster", 256, 2},
                 {"hammersley", 64, 3},
                 {"void-and-cluster:size=4", 4, 2}};
    for (size_t i = 0; i < sizeof whole / sizeof *whole; i++) {
        p = test_points(whole[i].pattern, whole[i].n, whole[i].dim, 0);
        assert_true(one(&p, "origin-not-missing", "-").holds);
        koksma_points_fini(&p);
    }
    static const size_t sizes[] = {2, 3, 63, 100};
    for (size_t i = 0; i < 4; i++) {
        p = test_points("sobol", sizes[i] + 1, 4, 0);
        skipped = (koksma_points){sizes[i], 4, p.xs + 4};
        assert_false(one(&skipped, "origin-not-missing", "-").holds);
        koksma_points_fini(&p);
    }
}

TEST_CASE(a_coordinate_that_rounds_to_one)
{
    koksma_points p = test_points("regular", 64, 2, 0);
    assert_true(one(&p, "below-one-as-float", "-").holds);
    p.xs[101] = 1 - 0x1p-26;
    assert_near(one(&p, "below-one-as-float", "-").value, 1, 0);
    koksma_points_fini(&p);
}

TEST_CASE(an_order_that_is_not_progressive)
{
    koksma_points p = test_points("jittered", 256, 2, 0); /* in order of the cells */
    const koksma_finding f = one(&p, "progressive", "-");
    assert_false(f.holds);
    koksma_points_fini(&p);
    p = test_points("pmj02", 256, 2, 0);
    assert_true(one(&p, "progressive", "-").holds);
    koksma_points_fini(&p);
    p = test_points("sobol:scramble=owen", 16384, 2, 0);
    assert_true(one(&p, "progressive", "-").holds);
    for (size_t c = 2 * 8192; c < 2 * 16384; c++) { /* the last doubling is bad */
        p.xs[c] /= 2;
    }
    assert_false(one(&p, "progressive", "-").holds);
    koksma_points_fini(&p);
}

TEST_CASE(zero_and_minus_zero_are_one_place)
{
    double xs[] = {0, 0.5, 0.25, 0.75, -0.0, 0.5, 1, 0.5};
    koksma_points p = {4, 2, xs};
    const koksma_finding f = one(&p, "distinct", "-");
    assert_false(f.holds);
    assert_true(f.value == 1);
}

TEST_CASE(points_outside_are_refused)
{
    double xs[] = {0.5, 1.5};
    const koksma_points p = {1, 2, xs};
    koksma_findings all;
    assert_int_equal(koksma_verify(&p, NULL, &all), KOKSMA_ARGUMENT);
    xs[1] = 1;
    assert_ok(koksma_verify(&p, NULL, &all));
    koksma_findings_fini(&all);
}

/* ---- Properties of sets ------------------------------------------------------------------------------------ */

static koksma_findings of_sets(const koksma_spec *spec, size_t n, int dim, size_t n_sets)
{
    koksma_points *sets = calloc(n_sets, sizeof *sets);
    koksma_findings all;
    assert_non_null(sets);
    for (size_t s = 0; s < n_sets; s++) {
        assert_ok(koksma_points_init(&sets[s], n, dim));
        assert_ok(koksma_generate(spec, s, NULL, &sets[s]));
    }
    assert_ok(koksma_verify_sets(sets, n_sets, NULL, &all));
    for (size_t s = 0; s < n_sets; s++) {
        koksma_points_fini(&sets[s]);
    }
    free(sets);
    assert_int_equal(all.count, 2);
    return all;
}

/* With their boxes: the middle halves of cells; sides, where darts have fewer neighbours; a first cell that comes first;
   one set for all seeds. Darts on the torus are the same wherever it is cut, so each is uniform. */
TEST_CASE(biases_are_found)
{
    static const struct {
        const char *spec;
        size_t n_sets;
        bool unbiased, uniform_samples;
        double bias; /* of the share, at least */
    } rows[] = {
        {"half-jittered", 200, false, false, 0.125},
        {"jittered", 200, true, false, 0},
        {"sobol", 200, false, false, 0},
        {"poisson-disk:d=0.15", 4000, false, false, 0.02},
        {"poisson-disk:d=0.15,torus=1", 4000, true, true, 0},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        if (TEST_FEW && rows[r].n_sets > 200) {
            continue;
        }
        koksma_spec spec;
        assert_ok(koksma_pattern_spec(rows[r].spec, &spec));
        koksma_findings all = of_sets(&spec, 16, 2, rows[r].n_sets);
        assert_int_equal(koksma_is_unbiased(&spec), rows[r].unbiased);
        assert_that(all.items[0].holds == rows[r].unbiased && all.items[1].holds == rows[r].uniform_samples &&
                        fabs(all.items[0].value) >= rows[r].bias,
                    "%s: %g, %s; %s", rows[r].spec, all.items[0].value, all.items[0].detail, all.items[1].detail);
        koksma_findings_fini(&all);
    }
}

/* A sampler whose first coordinate is never in [1/4,3/4): 0 of 400 samples where half are expected is 20 standard errors,
   sqrt(400 / (1/2 1/2)) / 2. */
TEST_CASE(a_gap_is_named)
{
    enum { N_SETS = 400 };
    koksma_points sets[N_SETS];
    koksma_findings all;
    for (uint64_t s = 0; s < N_SETS; s++) {
        sets[s] = test_points("random", 8, 2, s);
        for (size_t i = 0; i < 8; i++) {
            double *x = &sets[s].xs[2 * i];
            *x = *x / 2 < 0.25 ? *x / 2 : *x / 2 + 0.5;
        }
    }
    assert_ok(koksma_verify_sets(sets, N_SETS, NULL, &all));
    for (size_t f = 0; f < 2; f++) {
        assert_false(all.items[f].holds);
        assert_near(all.items[f].value, -0.5, 0);
        assert_non_null(strstr(all.items[f].detail, "[1/4,3/4) of coordinate 0: expected 0.5, "));
        assert_non_null(strstr(all.items[f].detail, "z = -20.0"));
    }
    koksma_findings_fini(&all);
    assert_int_equal(koksma_verify_sets(sets, KOKSMA_VERIFY_SETS - 1, NULL, &all), KOKSMA_N);
    sets[5].n = 7;
    assert_int_equal(koksma_verify_sets(sets, N_SETS, NULL, &all), KOKSMA_N);
    for (size_t s = 0; s < N_SETS; s++) {
        koksma_points_fini(&sets[s]);
    }
}
