/* SPDX-License-Identifier: Apache-2.0 */
/* Statistics by hand, plans that are wrong, and a store that is opened again. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/series.h>
#include <koksma/study.h>

#include "stats/stats.h"
#include "study/plan/plan.h"
#include "study/plan/plan_read.h"
#include "study/report/rho.h"
#include "study/report/said.h"
#include "study/run/references.h"
#include "study/run/study.h"
#include "study/store/store.h"
#include "texts.h"

TEST_CASE(summary_by_hand)
{
    const double values[] = {1, 9, 2, 9, 3, 9, 6, 9};
    const koksma__summary s = koksma__summarize(values, 4, 2);
    assert_near(s.mean, 3, 0);
    assert_near(s.sd, sqrt(14.0 / 3), 1e-15);
    assert_near(s.max, 6, 0);
    assert_near(s.high - s.mean, 3.182446 * s.sd / 2, 0.02 * s.sd);
}

TEST_CASE(student_table)
{
    assert_near(koksma_student_975(1), 12.7062, 1e-3);
    assert_near(koksma_student_975(5), 2.5706, 0.005);
    assert_near(koksma_student_975(30), 2.0423, 1e-4);
    assert_near(koksma_student_975(99), 1.9842, 1e-4);
}

TEST_CASE(largest_of_blocks)
{
    const double values[] = {1, 5, 2, 3, 9, 4, 100};
    double mean, sd;
    koksma__largest_of(values, 7, 1, 3, &mean, &sd);
    assert_near(mean, 7, 0);
    assert_near(sd, sqrt(8), 1e-14);
    koksma__largest_of(values, 2, 1, 3, &mean, &sd);
    assert_true(isnan(mean));
    const double close[] = {1e9 + 1, 1e9 + 2, 1e9 + 3}; /* a difference of squares keeps no digit of this SD */
    koksma__largest_of(close, 3, 1, 1, &mean, &sd);
    assert_near(mean, 1e9 + 2, 0);
    assert_near(sd, 1, 1e-14);
}

/* A printed number of JSON is as precise as the same number as text. */
TEST_CASE(printed_digits)
{
    static const char text[] = "{\"name\": \"a\", \"title\": \"b\", \"discrepancies\": [{\"patterns\": [\"random\"], "
                               "\"measures\": [\"star\"], "
                               "\"n\": [4], \"trials\": 1}], \"tables\": [{\"id\": \"t\", \"title\": \"t\", "
                               "\"measure\": \"star\", \"n\": 4, \"rows\": "
                               "[{\"pattern\": \"random\", \"label\": \"r\", \"published\": [%s]}]}]}";
    static const char *const numbers[] = {"0.00001, 0.000055, 0.25", "\"0.00001\", \"0.000055\", \"0.25\""};
    for (size_t i = 0; i < 2; i++) {
        char plan_text[1024];
        koksma__plan plan;
        snprintf(plan_text, sizeof plan_text, text, numbers[i]);
        assert_int_equal(koksma__plan_parse("p", plan_text, strlen(plan_text), NULL, &plan), KOKSMA_OK);
        const koksma__printed *published = plan.tables[0].rows[0].published;
        assert_near(published[0].half_digit, 0.5e-5, 1e-20);
        assert_near(published[1].half_digit, 0.5e-6, 1e-21);
        assert_near(published[2].half_digit, 0.5e-2, 1e-17);
        koksma__plan_fini(&plan);
    }
}

static void wrong_plan(const char *reason, const char *text)
{
    koksma__plan plan;
    assert_int_equal(koksma__plan_parse("p", text, strlen(text), NULL, &plan), KOKSMA_MALFORMED);
    assert_that(strncmp(koksma_error_text(), "plan 'p': ", 10) == 0 && strcmp(koksma_error_text() + 10, reason) == 0,
                "%s: the error is \"%s\" and should be \"%s\"", text, koksma_error_text(), reason);
}

TEST_CASE(wrong_plans)
{
#define NAMES "\"name\": \"a\", \"title\": \"b\""
#define REFERENCES "\"references\": [{\"name\": \"r\", \"pattern\": \"random\", \"spp\": 4}]"
#define IMAGES(id, scene)                                                                                            \
    "{\"id\": \"" id "\", \"scenes\": [\"" scene                                                                     \
    "\"], \"patterns\": [\"random\"], \"spp\": [4], \"trials\": 1, " REFERENCES "}"
#define POINTS                                                                                                       \
    NAMES ", \"discrepancies\": [{\"id\": \"d\", \"patterns\": [\"random\"], \"measures\": [\"star\"], \"n\": [4], " \
          "\"trials\": 1}]"
    static const shared_text shared[] = {{"{N}", NAMES},
                                         {"{D}", POINTS},
                                         {"{R}", REFERENCES},
                                         {"{I}", NAMES ", \"images\": [" IMAGES("i", "ball") "]"},
                                         {"{Q}", POINTS ", \"images\": [" IMAGES("i", "ball") ", " IMAGES(
                                                     "j", "checker") "], \"questions\": [{\"id\": "
                                                                     "\"q\", \"title\": \"Q\", \"images\": \"i\""},
                                         {NULL, NULL}};
    assert_true(each_text("study/plans.txt", shared, wrong_plan) > 28);
}

static const koksma__figure *figure_of(const koksma__plan *plan, const char *id)
{
    size_t i = 0;
    while (i < plan->n_figures && strcmp(plan->figures[i].id, id) != 0) {
        i++;
    }
    assert_true(i < plan->n_figures);
    return &plan->figures[i];
}

/* A detail is cut from the very picture that the figure shows: all that makes the picture, and its seed, is equal. */
static void detail_is_of_the_figure(const koksma__plan *plan, const char *id, const char *detail)
{
    const koksma__figure *whole = figure_of(plan, id), *part = figure_of(plan, detail);
    assert_true(part->detail[2] > 0 && !whole->detail[2]);
    assert_string_equal(whole->scene, part->scene);
    assert_string_equal(whole->pattern, part->pattern);
    assert_string_equal(whole->variant, part->variant);
    assert_int_equal(whole->n, part->n);
    assert_null(whole->adaptive);
    assert_null(part->adaptive);
}

TEST_CASE(shipped_plans_parse)
{
    size_t size;
    koksma__plan plan;
    const koksma__plan_trials seven = {.trials = 7};
    assert_null(koksma__plan_shipped("nothing", &size));
    const char *text = koksma__plan_shipped("shirley1991", &size);
    assert_non_null(text);
    assert_ok(koksma__plan_parse("shirley1991", text, size, &seven, &plan));
    assert_int_equal(plan.n_tables, 7);
    assert_int_equal(plan.images[0].trials, 7);
    detail_is_of_the_figure(&plan, "5.37", "5.38");
    koksma__plan_fini(&plan);
    for (size_t i = 0; koksma_plan_name_at(i); i++) {
        text = koksma__plan_shipped(koksma_plan_name_at(i), &size);
        assert_ok(koksma__plan_parse(koksma_plan_name_at(i), text, size, NULL, &plan));
        assert_string_equal(plan.name, koksma_plan_name_at(i));
        koksma__plan_fini(&plan);
    }
}

static void see_bit(void *context, long long series, long long trial)
{
    assert_int_equal(series, 1);
    *(unsigned char *)context |= (unsigned char)(1u << trial);
}

#define STORE_FOLDER "/tmp/koksma-store-XXXXXX"

static const koksma__series one_series = {.kind = "discrepancy",
                                          .scene = "",
                                          .scene_hash = "",
                                          .options = "",
                                          .pattern = "random",
                                          .what = "l2-star",
                                          .n = 1,
                                          .dim = 2};

/* Makes a store in a new folder, whose name is written over STORE_FOLDER in `folder`. */
static koksma__store *new_store(char folder[sizeof STORE_FOLDER], char path[64])
{
    koksma__store *store;
    assert_non_null(mkdtemp(folder));
    snprintf(path, 64, "%s/r.sqlite", folder);
    assert_ok(koksma__store_open(path, KOKSMA__STORE_WRITE, "plan", &store));
    return store;
}

TEST_CASE(store_keeps_rows)
{
    char folder[] = STORE_FOLDER, path[64];
    const koksma__series series = one_series;
    koksma__store *store = new_store(folder, path), *second;
    const koksma__result first = {3, UINT64_MAX, {0.1, NAN, NAN, NAN}}, again = {3, UINT64_MAX, {0.7, NAN, NAN, NAN}};
    koksma__result *results;
    long long id, same;
    unsigned char bits = 0;
    size_t n;
    assert_ok(koksma__store_series(store, &series, false, &id));
    assert_int_equal(id, 0);
    assert_ok(koksma__store_series(store, &series, true, &id));
    assert_ok(koksma__store_put(store, &id, &first, 1));
    assert_ok(koksma__store_put(store, &id, &again, 1)); /* a row that exists stays */
    assert_int_equal(koksma__store_open(path, KOKSMA__STORE_WRITE, "plan", &second), KOKSMA_IO);
    assert_non_null(strstr(koksma_error_text(), "another run"));
    assert_ok(koksma__store_close(store));
    assert_int_equal(koksma__store_open(path, KOKSMA__STORE_WRITE, "other", &store), KOKSMA_MALFORMED);
    assert_ok(koksma__store_open(path, KOKSMA__STORE_READ, NULL, &store));
    assert_ok(koksma__store_series(store, &series, true, &same));
    assert_int_equal(same, id);
    assert_ok(koksma__store_scan(store, false, see_bit, &bits));
    assert_int_equal(bits, 1 << 3);
    assert_ok(koksma__store_results(store, id, 5, &results, &n));
    assert_int_equal(n, 1);
    assert_true(results[0].seed == UINT64_MAX && results[0].trial == 3);
    assert_near(results[0].values[0], 0.1, 0);
    assert_true(isnan(results[0].values[1]));
    free(results);
    assert_ok(koksma__store_close(store));
    FILE *f = fopen(path, "wb");
    fputs("this is not a database, and long enough to be read as one would be", f);
    fclose(f);
    assert_int_equal(koksma__store_open(path, KOKSMA__STORE_WRITE, "plan", &store), KOKSMA_MALFORMED);
    unlink(path);
    rmdir(folder);
}

static koksma_status count_row(void *context, const koksma__series *series, const koksma__result *result)
{
    long long *seen = context; /* how many, and the trial that comes */
    const bool second = !strcmp(series->what, "star");
    assert_int_equal(result->trial, second ? seen[0] - 40001 : seen[0] * 2);
    assert_near(result->values[0], (double)result->trial + (second ? 0.5 : 0), 0);
    seen[0]++;
    return KOKSMA_OK;
}

/* More rows than are gathered at a time, of two series, the first with every second trial and out of order. */
TEST_CASE(store_keeps_many_rows)
{
    char folder[] = STORE_FOLDER, path[64];
    koksma__series series = one_series;
    koksma__store *store = new_store(folder, path);
    koksma__result *results;
    long long ids[2], seen = 0;
    size_t n;
    assert_ok(koksma__store_series(store, &series, true, &ids[0]));
    series.what = "star";
    assert_ok(koksma__store_series(store, &series, true, &ids[1]));
    for (long long i = 0; i < 40000; i++) {
        const long long trial = i ^ 1;
        const koksma__result both[2] = {{2 * trial, 1, {2 * (double)trial, NAN, NAN, NAN}},
                                        {trial, 1, {(double)trial + 0.5, NAN, NAN, NAN}}};
        assert_ok(koksma__store_put(store, ids, both, 2));
    }
    assert_ok(koksma__store_results(store, ids[0], 40001, &results, &n));
    assert_int_equal(n, 20001);
    free(results);
    const koksma__result late = {80000, 1, {80000, NAN, NAN, NAN}};
    assert_ok(koksma__store_put(store, ids, &late, 1));
    assert_ok(koksma__store_results(store, ids[0], 100000, &results, &n)); /* also what has come since */
    assert_int_equal(n, 40001);
    free(results);
    assert_ok(koksma__store_close(store));
    assert_ok(koksma__store_open(path, KOKSMA__STORE_READ, NULL, &store));
    seen = 0;
    assert_ok(koksma__store_visit(store, count_row, &seen));
    assert_int_equal(seen, 80001);
    assert_ok(koksma__store_close(store));
    unlink(path);
    rmdir(folder);
}

/* Errors of images are of luminance, and so is a reference's own: of one channel its weight, of equal replicates 0.
 */
TEST_CASE(own_error_of_a_reference)
{
    static const double weights[] = {0.2126, 0.7152, 0.0722};
    for (size_t c = 0; c < 4; c++) { /* 3: grey */
        koksma__replicates s = {0};
        koksma_image image, mean;
        double error;
        const size_t at = c % 3;
        assert_ok(koksma_image_init(&image, 2, 1, c < 3 ? 3 : 1));
        for (int k = 0; k < 4; k++) { /* pixel 0: 0.1 every time; pixel 1: 1, 2, 3, 4 */
            image.pixels[at] = 0.1F;
            image.pixels[(size_t)image.channels + at] = (float)(k + 1);
            assert_ok(koksma__replicates_add(&s, &image));
        }
        assert_ok(koksma__replicates_mean(&s, 2, 1, &mean, &error));
        assert_near(error, (c < 3 ? weights[c] : 1) * sqrt(2 / M_PI * (5.0 / 3) / 4) / 2, 1e-15);
        assert_near((double)mean.pixels[(size_t)image.channels + at], 2.5, 0);
        const size_t n = koksma__replicates_numbers(&s);
        const koksma__replicates same = koksma__replicates_over(s.sum, n, 2);
        assert_true(n == 2 * (s.channels + 2) && same.channels == s.channels && same.luminance == s.luminance);
        assert_true(same.squares == s.squares && s.squares[0] == 0);
        koksma_image_fini(&mean);
        koksma_image_fini(&image);
        free(s.sum);
    }
}

/* What is counted as sure is what is shown with an interval that excludes 0. */
TEST_CASE(correlations_as_shown)
{
    static const struct {
        koksma__estimate rho;
        size_t n_patterns;
    } cases[] = {{{1, -1, 1}, 6}, {{1, 1, 1}, 6}, {{1, 1, 1}, 8}, {{0.9, 0.5, 1}, 8}, {{0.2, -0.3, 0.6}, 8}};
    const double draws[KOKSMA__RHO_SAMPLES] = {0};
    koksma__rho_means means = {0};
    koksma__report report = {0};
    koksma__document words = {0};
    char text[4096];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const koksma__estimate shown = koksma__rho_shown(&cases[i].rho, cases[i].n_patterns);
        assert_near(shown.value, cases[i].rho.value, 0);
        assert_int_equal(isnan(shown.low) && isnan(shown.high), i < 3);
        koksma__rho_add(&report, &means, "star", "ball", cases[i].n_patterns, &shown, draws);
    }
    assert_int_equal(means.of[0].sure, 1);
    koksma__rho_order(&report, &means);
    const koksma__rho_jackknife jackknife = koksma__rho_leave_out(&report, &means);
    koksma__rho_say(&words, &means, &jackknife);
    koksma__doc_close(&words);
    assert_non_null(strstr(said(&words, text, sizeof text), "over 5 cases; the interval excludes 0 in 1 of them)"));
    koksma__report_release(&report);
    koksma__json_writer_fini(&words.json);
}

TEST_CASE(study_without_folder)
{
    const char *plans[] = {"shirley1991"};
    const koksma_study_options options = {.plans = plans, .n_plans = 1};
    koksma_study *study;
    koksma_study_row row;
    bool found;
    assert_ok(koksma_study_open(&options, &study));
    assert_int_equal(koksma_study_report(study, NULL), KOKSMA_ARGUMENT);
    assert_string_equal(koksma_error_text(), "a study without a folder has no report");
    assert_int_equal(koksma_study_table_row(study, koksma_study_table_at(study, 0), 0, &row, &found),
                     KOKSMA_ARGUMENT);
    assert_int_equal(koksma_study_run(study, NULL, NULL), KOKSMA_ARGUMENT);
    assert_ok(koksma_study_close(study));
}

/* Room for the trials is taken at once. */
TEST_CASE(rankings_have_eight_trials_or_more)
{
    const char *patterns[] = {"random", "n-rooks"};
    const long long refused[] = {-1, 1, 7, KOKSMA_MAX_RANK_TRIALS + 1, 1LL << 62};
    koksma_rank_row rows[2];
    koksma_ranking ranking;
    koksma_rank_options options = {
        .scene = "checker", .patterns = patterns, .n_patterns = 2, .spp = 4, .width = 8, .height = 6};
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        options.max_trials = refused[i];
        assert_int_equal(koksma_rank_patterns(&options, NULL, rows, &ranking), KOKSMA_ARGUMENT);
    }
    options.max_trials = 8;
    assert_ok(koksma_rank_patterns(&options, NULL, rows, &ranking));
    assert_int_equal(ranking.trials, 8);
}

static void count_difference(void *context, const char *text)
{
    assert_true(strlen(text) > 0);
    ++*(size_t *)context;
}

/* 18 rows: three patterns, two measures, three trials. The limit of Clopper & Pearson by hand: with none of 10 wrong it
   is 1 - 0.05^(1/10), and of all rows the part itself. */
TEST_CASE(folder_is_read_and_audited)
{
    char folder[] = "/tmp/koksma-audit-XXXXXX", path[64], command[256];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/p.json", folder);
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs("{\"name\": \"p\", \"title\": \"p\", \"discrepancies\": [{\"patterns\": [\"random\", \"jittered\", "
          "\"n-rooks\"], \"measures\": [\"star\", \"l2-star\"], \"n\": [4], \"trials\": 3}]}",
          f);
    fclose(f);
    const char *plans[] = {path};
    koksma_study_options options = {.plans = plans, .n_plans = 1, .folder = folder, .trials = 2};
    koksma_study_summary summary;
    koksma_study *study, *second;
    koksma_audit found;
    size_t differences = 0;
    koksma_audit_options audit = {.folder = folder, .differs = count_difference, .context = &differences};
    assert_ok(koksma_study_open(&options, &study));
    assert_ok(koksma_study_run(study, NULL, &summary));
    assert_int_equal(koksma_study_audit(&audit, NULL, &found), KOKSMA_IO); /* as long as it can be written */
    assert_ok(koksma_study_close(study));
    options.n_plans = 0; /* readers beside each other, then one that runs */
    assert_ok(koksma_study_open(&options, &study));
    assert_ok(koksma_study_open(&options, &second));
    assert_ok(koksma_study_audit(&audit, NULL, &found));
    assert_ok(koksma_study_close(second));
    assert_int_equal(found.rows, 12);
    assert_int_equal(found.agree, 12);
    assert_near(found.bound, 0, 0);
    assert_ok(koksma_study_run(study, NULL, &summary));
    assert_int_equal(summary.done_before, 6);
    assert_ok(koksma_study_close(study));
    options.n_plans = 1;
    options.trials = 3;
    assert_ok(koksma_study_open(&options, &study));
    assert_ok(koksma_study_run(study, NULL, &summary));
    assert_ok(koksma_study_close(study));
    for (uint64_t seed = 0; seed < 5; seed++) {
        audit.rows = 10;
        audit.seed = seed;
        assert_ok(koksma_study_audit(&audit, NULL, &found));
        assert_int_equal(found.rows, 18);
        assert_int_equal(found.drawn, 10);
        assert_int_equal(found.agree, 10);
        assert_near(found.bound, 0.25886555, 1e-8);
    }
    assert_int_equal(differences, 0);
    audit.rows = -1;
    assert_int_equal(koksma_study_audit(&audit, NULL, &found), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_study_audit(NULL, NULL, &found), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_study_audit(&audit, NULL, NULL), KOKSMA_ARGUMENT);
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
}

/* The fractions that an audit reports. */
typedef struct fractions {
    double first, last;
    size_t between; /* number of different fractions from 0.1 to 0.9 */
} fractions;

static bool see_fraction(void *context, double fraction)
{
    fractions *seen = context;
    assert_true(fraction >= 0 && fraction <= 1);
    seen->first = seen->first < 0 ? fraction : seen->first;
    assert_true(fraction >= seen->last);
    seen->between += fraction > seen->last && fraction > 0.1 && fraction < 0.9;
    seen->last = fraction;
    return true;
}

/* An audit of one row renders the reference again, in three tiles of 2^19 samples, which are nearly all of its work. */
TEST_CASE(audit_reports_progress)
{
    char folder[] = "/tmp/koksma-progress-XXXXXX", path[64], command[256];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/p.json", folder);
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs("{\"name\": \"p\", \"title\": \"p\", \"discrepancies\": [{\"patterns\": [\"random\"], \"measures\": "
          "[\"star\"], \"n\": [4], \"trials\": 100}], \"images\": [{\"scenes\": [\"checker\"], \"patterns\": "
          "[\"random\"], \"spp\": [1], \"size\": [32, 24], \"trials\": 1, \"references\": [{\"name\": \"r\", "
          "\"pattern\": \"jittered\", \"spp\": 1024, \"replicates\": 2}]}]}",
          f);
    fclose(f);
    const char *plans[] = {path};
    const koksma_study_options options = {.plans = plans, .n_plans = 1, .folder = folder};
    koksma_study *study;
    assert_ok(koksma_study_open(&options, &study));
    assert_ok(koksma_study_run(study, NULL, NULL));
    assert_ok(koksma_study_close(study));
    koksma_audit found;
    fractions seen = {.first = -1, .last = 0};
    const koksma_audit_options audit = {.folder = folder, .rows = 1, .seed = 1};
    const koksma_run run = {.threads = 1, .keep_going = see_fraction, .context = &seen};
    assert_ok(koksma_study_audit(&audit, &run, &found));
    assert_int_equal(found.drawn, 1);
    assert_int_equal(found.references_agree, 1);
    assert_int_equal(found.differences, 0);
    assert_near(seen.first, 0, 0);
    assert_true(seen.between >= 2);
    assert_true(seen.last > 0.9);
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
}
