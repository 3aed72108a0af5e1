/* SPDX-License-Identifier: Apache-2.0 */
/* Which measure predicts the error: Holm's correction, rankings of measures, and what of them holds without any one
   scene. */
#include <stdlib.h>
#include <string.h>

#include "core/random.h"
#include "stats/stats.h"
#include "study/report/rho.h"
#include "study/report/said.h"
#include "test.h"

static double uniform(uint64_t seed, uint64_t i)
{
    double u[2];
    koksma__random_pair(seed, KOKSMA__PURPOSE_SEARCH, i, 0, u);
    return u[0];
}

static double normal(uint64_t seed, uint64_t i)
{
    double u[2];
    koksma__random_pair(seed, KOKSMA__PURPOSE_SEARCH, i, 0, u);
    return sqrt(-2 * log1p(-u[0])) * cos(2 * M_PI * u[1]);
}

/* ---- Holm ---------------------------------------------------------------------------------------------- */

/* p.adjust(c(.01, .04, .03, .005), "holm") in R: .03 .06 .06 .02. The four tests of the example in Wikipedia's
   "Holm-Bonferroni method" (2024): at 5 % the first and the fourth are rejected. */
TEST_CASE(holm_by_hand)
{
    double p[] = {0.01, 0.04, 0.03, 0.005};
    const double adjusted[] = {0.03, 0.06, 0.06, 0.02};
    assert_ok(koksma__holm(p, 4));
    for (size_t i = 0; i < 4; i++) {
        assert_near(p[i], adjusted[i], 1e-15);
    }
    double one[] = {0.04}, large[] = {0.9, 0.6};
    assert_ok(koksma__holm(one, 1));
    assert_ok(koksma__holm(large, 2));
    assert_ok(koksma__holm(NULL, 0));
    assert_true(one[0] == 0.04 && large[0] == 1 && large[1] == 1);
}

/* Holm's procedure is the closed test of Bonferroni's: a test's adjusted p is the largest, over all sets of tests
   that have it, of the set's size times its smallest p. */
TEST_CASE(holm_is_the_closed_test)
{
    for (uint64_t t = 0; t < 100; t++) {
        double p[7], adjusted[7];
        for (uint64_t i = 0; i < 7; i++) {
            p[i] = adjusted[i] = t % 2 ? pow(uniform(t, i), 4) : floor(8 * uniform(t, i)) / 40; /* with ties */
        }
        assert_ok(koksma__holm(adjusted, 7));
        for (unsigned i = 0; i < 7; i++) {
            double most = 0;
            for (unsigned set = 1; set < 128; set++) {
                double least = 1, size = 0;
                for (unsigned j = 0; j < 7; j++) {
                    if (set >> j & 1) {
                        least = fmin(least, p[j]);
                        size++;
                    }
                }
                most = set >> i & 1 ? fmax(most, fmin(1, size * least)) : most;
            }
            assert_near(adjusted[i], most, 1e-15);
        }
    }
}

TEST_CASE(p_of_resamples)
{
    const double values[] = {1, 2, -1, 3, NAN, 4, 5, 6, 7, 8}, same[] = {1, 2, -1, 3, 0, 4, 5, 6, 7, 8};
    assert_near(koksma__resampled_p(values, 1, NULL, 0, 10), 2 * (1 + 1) / 10.0, 1e-15); /* 1 of 9 below 0 */
    assert_near(koksma__resampled_p(values, -1, NULL, 0, 10), 2 * (1 + 1) / 10.0, 1e-15);
    assert_near(koksma__resampled_p(values, 1, same, 1, 10), 1, 0); /* all differences are 0 */
    assert_near(koksma__resampled_p(values, 1, same, -1, 2), 2 / 3.0, 1e-15);
    assert_near(koksma__resampled_p(values + 4, 1, NULL, 0, 1), 1, 0); /* there is none */
}

/* ---- Rankings ------------------------------------------------------------------------------------------ */

enum { SCENES = 4, MEASURES = 5 };

static const char *const scene_names[SCENES] = {"s0", "s1", "s2", "s3"};
static const char *const measure_names[MEASURES] = {"A", "B", "C", "D", "E"};

/* Correlations of measures by scene, with resamples of this standard deviation; without a scene (SCENES: all). */
static void add_means(koksma__report *r, koksma__rho_means *s, const double rho[MEASURES][SCENES], size_t measures,
                      double sd, size_t without)
{
    double draws[KOKSMA__RHO_SAMPLES];
    *s = (koksma__rho_means){0};
    for (size_t m = 0; m < measures; m++) {
        for (size_t k = 0; k < SCENES; k++) {
            if (k != without) {
                const koksma__estimate e = {rho[m][k], rho[m][k] - 2 * sd, rho[m][k] + 2 * sd};
                for (uint64_t i = 0; i < KOKSMA__RHO_SAMPLES; i++) {
                    draws[i] = rho[m][k] + sd * normal(10 * m + k, i);
                }
                koksma__rho_add(r, s, measure_names[m], scene_names[k], 16, &e, draws);
            }
        }
    }
    koksma__rho_order(r, s);
}

static size_t number_of(const koksma__rho_means *s, const char *measure)
{
    size_t m = 0;
    while (strcmp(s->of[m].measure, measure) != 0) {
        m++;
    }
    return m;
}

static bool better(const koksma__rho_means *s, const koksma__rho_jackknife *j, const char *a, const char *b)
{
    return koksma__rho_always(j, KOKSMA__RHO_BETTER, number_of(s, a), number_of(s, b));
}

/* C is surely worse than A over all scenes and surely better than B, but only because of s3 and of the others. */
TEST_CASE(headline_without_one_scene)
{
    const double rho[MEASURES][SCENES] = {
        {.92, .92, .92, .92}, {.5, .5, .5, .5}, {.9, .9, .9, -.4}, {.05, -.05, .05, -.05}};
    koksma__report report = {0};
    koksma__rho_means s;
    koksma__document words = {0};
    char text[4096];
    add_means(&report, &s, rho, 4, 0.03, SCENES);
    const koksma__rho_jackknife j = koksma__rho_leave_out(&report, &s);
    assert_int_equal(j.n, 1 + SCENES);
    assert_true(j.of[0].n_pairs == 6 && j.of[0].n == 4);
    const size_t a = number_of(&s, "A"), b = number_of(&s, "B"), c = number_of(&s, "C"), d = number_of(&s, "D");
    assert_true(koksma__rho_is_better(&j.of[0], a, c) && koksma__rho_is_better(&j.of[0], c, b));
    assert_true(better(&s, &j, "A", "B") && better(&s, &j, "B", "D") && better(&s, &j, "A", "D"));
    assert_true(!better(&s, &j, "A", "C") && !better(&s, &j, "C", "B") && !better(&s, &j, "B", "A"));
    assert_true(koksma__rho_always(&j, KOKSMA__RHO_PREDICTS, b, 0) &&
                !koksma__rho_always(&j, KOKSMA__RHO_PREDICTS, d, 0));
    assert_near(koksma__rho_range(&j, c).low, (0.9 + 0.9 - 0.4) / 3, 1e-15);
    assert_near(koksma__rho_range(&j, c).high, 0.9, 1e-15);
    koksma__rho_say(&words, &s, &j);
    koksma__doc_close(&words);
    said(&words, text, sizeof text);
    assert_non_null(strstr(text, "Best predictor: A (mean Spearman +0.92 over 4 cases"));
    assert_non_null(strstr(text, "It comes first whichever one of the 4 scenes is left out (+0.92 to +0.92)"));
    assert_non_null(strstr(text, "A than B and D;"));
    assert_null(strstr(text, "A than C"));
    koksma__report_release(&report);
    koksma__json_writer_fini(&words.json);
}

/* Y comes first over all scenes, and X without s3. */
TEST_CASE(headline_that_depends_on_a_scene)
{
    const double rho[MEASURES][SCENES] = {{.95, .95, .95, -.5}, {.6, .6, .6, .6}};
    koksma__report report = {0};
    koksma__rho_means s;
    koksma__document words = {0};
    char text[4096];
    add_means(&report, &s, rho, 2, 0.03, SCENES);
    const koksma__rho_jackknife j = koksma__rho_leave_out(&report, &s);
    koksma__rho_say(&words, &s, &j);
    koksma__doc_close(&words);
    said(&words, text, sizeof text);
    assert_non_null(strstr(text, "The best predictor depends on the scenes. Over all of them it is B (mean Spearman "
                                 "+0.60 over 4 cases"));
    assert_non_null(strstr(text, "No measure is surely better than another, whichever one scene is left out."));
    koksma__report_release(&report);
    koksma__json_writer_fini(&words.json);
}

/* Each statement over all scenes is one again of means that never had a scene, whichever it is. */
TEST_CASE(statements_survive_any_scene)
{
    static const bool every[SCENES] = {true, true, true, true}; /* of those that the means have */
    int stated = 0, dropped = 0;
    for (uint64_t t = 0; t < 8; t++) {
        double rho[MEASURES][SCENES];
        for (uint64_t i = 0; i < (uint64_t)MEASURES * SCENES; i++) {
            rho[i / SCENES][i % SCENES] = 0.8 - 0.2 * (double)(i / SCENES) + 0.3 * (uniform(t, i) - 0.5);
        }
        koksma__report report = {0};
        koksma__rho_means all, less;
        add_means(&report, &all, rho, MEASURES, 0.05, SCENES);
        const koksma__rho_jackknife j = koksma__rho_leave_out(&report, &all);
        for (size_t k = 0; k < SCENES; k++) {
            add_means(&report, &less, rho, MEASURES, 0.05, k);
            const koksma__rho_ranking r = koksma__rho_rank(&report, &less, every);
            for (size_t a = 0; a < MEASURES; a++) {
                for (size_t b = 0; b < MEASURES; b++) {
                    const size_t x = number_of(&less, measure_names[a]), y = number_of(&less, measure_names[b]);
                    const bool always = better(&all, &j, measure_names[a], measure_names[b]);
                    assert_true(!always || koksma__rho_is_better(&r, x, y));
                    stated += always;
                    dropped += !always && koksma__rho_is_better(&j.of[0], number_of(&all, measure_names[a]),
                                                                number_of(&all, measure_names[b]));
                }
            }
            if (koksma__rho_always(&j, KOKSMA__RHO_FIRST, number_of(&all, "A"), 0)) {
                assert_int_equal(r.order[0], number_of(&less, "A"));
            }
        }
        koksma__report_release(&report);
    }
    assert_true(stated > 0 && dropped > 0);
}

/* A group's mean is over its scenes' cases. */
TEST_CASE(means_of_parts)
{
    const double rho[MEASURES][SCENES] = {{.9, .5, .3, .1}, {.2, .4, .6, .8}};
    const bool first_two[SCENES] = {true, true, false, false}, last_two[SCENES] = {false, false, true, true};
    koksma__report report = {0};
    koksma__rho_means s;
    koksma__rho_ranking r;
    add_means(&report, &s, rho, 2, 0.02, SCENES);
    r = koksma__rho_rank(&report, &s, first_two);
    assert_string_equal(s.of[r.order[0]].measure, "A");
    assert_near(r.of[r.order[0]].mean.value, 0.7, 1e-15);
    assert_near(r.of[r.order[1]].less.value, 0.3 - 0.7, 1e-15);
    assert_in_range(1000 * (r.of[r.order[0]].mean.high - r.of[r.order[0]].mean.low), 50,
                    61); /* 2 x 1.96 x 0.02 / sqrt(2) = 0.0554 */
    r = koksma__rho_rank(&report, &s, last_two);
    assert_string_equal(s.of[r.order[0]].measure, "B");
    assert_near(r.of[r.order[0]].mean.value, 0.7, 1e-15);
    koksma__report_release(&report);
}
