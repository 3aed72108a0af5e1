/* SPDX-License-Identifier: Apache-2.0 */
/* What callers can get wrong: points that are none, and specs of something else. Every public function says so. */
#include <string.h>

#include <koksma/series.h>
#include <koksma/spectrum.h>
#include <koksma/verify.h>
#include <koksma/warp.h>

#include "test.h"

/* Calls all that take a set of points in the plane; each must refuse it for this reason. */
static void all_refuse(const koksma_points *p, const char *reason)
{
    koksma_spec star, edge, disk;
    koksma_value value;
    koksma_findings findings;
    koksma_spectrum spectrum;
    double bins[3], distance;
    const size_t size = p->n;
    assert_ok(koksma_measure_spec("star", &star));
    assert_ok(koksma_measure_spec("edge", &edge));
    assert_ok(koksma_measure_spec("l2-disk", &disk));
    assert_ok(koksma_spectrum_init(&spectrum, 4));
    const koksma_warp *lens = koksma_warp_find("concentric-disk");
    for (int call = 0; call < 10; call++) {
        const koksma_status status = call == 0   ? koksma_evaluate(&star, p, NULL, &value)
                                     : call == 1 ? koksma_warp_evaluate(lens, &edge, p, NULL, &value)
                                     : call == 2 ? koksma_warp_evaluate(lens, &disk, p, NULL, &value)
                                     : call == 3 ? koksma_verify(p, NULL, &findings)
                                     : call == 4 ? koksma_spectrum_add(&spectrum, p, KOKSMA_SPECTRUM_FAST, NULL)
                                     : call == 5 ? koksma_spectrum_add(&spectrum, p, KOKSMA_SPECTRUM_EXACT, NULL)
                                     : call == 6 ? koksma_pair_correlation(p, 0.25, 3, NULL, bins)
                                     : call == 7 ? koksma_smallest_distance(p, true, NULL, &distance)
                                     : call == 8 ? koksma_smallest_distance(p, false, NULL, &distance)
                                                 : koksma_points_write("test_arguments.txt", p, NULL, NULL);
        assert_that(status == KOKSMA_ARGUMENT && strstr(koksma_error_text(), reason),
                    "call %d: status %d, \"%s\", not %s", call, (int)status, koksma_error_text(), reason);
    }
    if (p->xs && p->n) {
        assert_int_equal(koksma_evaluate_prefixes(&star, p, &size, 1, NULL, &value), KOKSMA_ARGUMENT);
    }
    assert_true(spectrum.sets == 0);
    koksma_spectrum_fini(&spectrum);
}

TEST_CASE(coordinates_are_in_the_unit_square)
{
    static const double odd[] = {NAN, INFINITY, -INFINITY, 1.7, -7, 1e300};
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        for (size_t at = 0; at < 4; at++) {
            double xs[] = {0.5, 0.25, 0.75, 0.125};
            xs[at % 2 ? at : 0] = odd[i];
            all_refuse(&(koksma_points){2, 2, xs}, "is outside [0,1]");
        }
    }
}

TEST_CASE(sets_have_points)
{
    double xs[] = {0.5, 0.25};
    all_refuse(&(koksma_points){0, 2, xs}, "at least 1 point");
    all_refuse(&(koksma_points){1, 2, NULL}, "at least 1 point");
}

/* One point in the middle of a side, in a corner and in between is in order. */
TEST_CASE(closed_sides_are_taken)
{
    double xs[] = {0, 1, 1, 0.5, 1, 1}, distance;
    const koksma_points p = {3, 2, xs};
    assert_ok(koksma_smallest_distance(&p, false, NULL, &distance));
    assert_near(distance, 0.5, 1e-15);
    assert_int_equal(koksma_smallest_distance(&(koksma_points){1, 2, xs}, true, NULL, &distance), KOKSMA_N);
}

TEST_CASE(warps_ask_for_a_measure)
{
    double xs[] = {0.5, 0.25};
    const koksma_points p = {1, 2, xs};
    const koksma_warp *lens = koksma_warp_find("concentric-disk");
    koksma_spec spec;
    koksma_value value;
    assert_ok(koksma_pattern_spec("random", &spec));
    assert_int_equal(koksma_warp_evaluate(lens, &spec, &p, NULL, &value), KOKSMA_ARGUMENT);
    memset(&spec, 0, sizeof spec);
    assert_int_equal(koksma_warp_evaluate(lens, &spec, &p, NULL, &value), KOKSMA_ARGUMENT);
    assert_ok(koksma_measure_spec("l2-disk", &spec));
    assert_int_equal(koksma_warp_evaluate(NULL, &spec, &p, NULL, &value), KOKSMA_ARGUMENT);
    assert_ok(koksma_warp_evaluate(lens, &spec, &p, NULL, &value));
    static const double odd[] = {NAN, -1, 1e9, INFINITY};
    const double before = value.value;
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        spec.params[0] = odd[i];
        assert_int_equal(koksma_warp_evaluate(lens, &spec, &p, NULL, &value), KOKSMA_ARGUMENT);
        assert_true(value.value == before);
    }
}

TEST_CASE(specs_of_nothing)
{
    koksma_spec none = {0}, sobol;
    koksma_points p = {0};
    koksma_value value;
    char text[KOKSMA_MAX_SPEC] = "x";
    koksma_spec_text(&none, text);
    assert_string_equal(text, "");
    assert_ok(koksma_points_init(&p, 4, 2));
    assert_int_equal(koksma_generate(&none, 1, NULL, &p), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_evaluate(&none, &p, NULL, &value), KOKSMA_ARGUMENT);
    koksma_points_fini(&p);
    assert_int_equal(koksma_generate_whole(&none, 1, NULL, 2, &p), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_pattern_spec(NULL, &none), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_measure_spec(NULL, &none), KOKSMA_ARGUMENT);
    /* A choice that its table has not: the text is of the number. */
    assert_ok(koksma_pattern_spec("sobol:scramble=owen", &sobol));
    int choice = 0;
    while (!sobol.pattern->params[choice].choices) {
        choice++;
    }
    static const double odd[] = {99, -1, NAN};
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        sobol.params[choice] = odd[i];
        koksma_spec_text(&sobol, text);
        assert_memory_equal(text, "sobol:", 6);
    }
}

TEST_CASE(spectra_ask_for_init)
{
    double xs[] = {0.5, 0.25};
    koksma_spectrum none = {0};
    assert_int_equal(koksma_spectrum_add(&none, &(koksma_points){1, 2, xs}, KOKSMA_SPECTRUM_FAST, NULL),
                     KOKSMA_ARGUMENT);
    assert_int_equal(koksma_spectrum_write("test_arguments.txt", &none), KOKSMA_ARGUMENT);
}
