/* SPDX-License-Identifier: Apache-2.0 */
/* The progress of a report, and its end where the caller says so. */
#include <math.h>
#include <unistd.h>

#include <koksma/study.h>

#include "test.h"

#define PATTERNS "\"random\", \"sobol\", \"jittered\", \"n-rooks\", \"hammersley\", \"halton\", \"korobov:a=3\""

/* Calls of a report: their number, the largest fraction, whether one was below an earlier one, the call that says no. */
typedef struct calls {
    size_t n, last;
    double reached;
    bool fell;
} calls;

static bool count_call(void *context, double fraction)
{
    calls *c = context;
    c->fell |= fraction < c->reached || fraction > 1;
    c->reached = fmax(c->reached, fraction);
    return ++c->n != c->last;
}

/* A report tells its progress, which never falls, and ends where the callback says so, without a file. */
TEST_CASE(reports_have_progress)
{
    const char *plans[] = {"{\"name\": \"p\", \"title\": \"P\", \"discrepancies\": [{\"patterns\": [\"random\"], "
                           "\"measures\": [\"star\"], \"n\": [4], \"trials\": 3}]}"};
    const koksma_study_options options = {.plans = plans, .n_plans = 1, .folder = "progress"};
    koksma_study *study;
    unlink("progress/report.json"); /* of an earlier run of this test */
    assert_ok(koksma_study_open(&options, &study));
    assert_ok(koksma_study_run(study, NULL, NULL));
    calls all = {0}, one = {.last = 3};
    koksma_run run = {.keep_going = count_call, .context = &one};
    assert_int_equal(koksma_study_report(study, &run), KOKSMA_INTERRUPTED);
    assert_int_equal(access("progress/report.json", F_OK), -1);
    run.context = &all;
    assert_ok(koksma_study_report(study, &run));
    assert_true(all.n > 3 && !all.fell && all.reached > 0.8);
    assert_int_equal(access("progress/report.json", F_OK), 0);
    assert_ok(koksma_study_close(study));
}

/* A report also asks while it hashes the rows, which it does first: here at the first row, after 4,096 and after 8,192. */
TEST_CASE(hashing_rows_can_end)
{
    const char *plans[] = {"{\"name\": \"p\", \"title\": \"P\", \"discrepancies\": [{\"patterns\": [\"random\"], "
                           "\"measures\": [\"star\"], \"n\": [1], \"trials\": 10000}]}"};
    const koksma_study_options options = {.plans = plans, .n_plans = 1, .folder = "hashing"};
    koksma_study *study;
    assert_ok(koksma_study_open(&options, &study));
    assert_ok(koksma_study_run(study, NULL, NULL));
    calls some = {.last = 4};
    const koksma_run run = {.keep_going = count_call, .context = &some};
    assert_int_equal(koksma_study_report(study, &run), KOKSMA_INTERRUPTED);
    assert_true(some.reached == 0); /* no section had begun */
    assert_ok(koksma_study_close(study));
}

/* A question asks the callback at a grain of little work: once for every 64 of 120,000 resamples here, then in the
   rankings, and for every number that it reads. A no at any of these calls is the last call and leaves no file. */
TEST_CASE(questions_end_where_the_callback_says)
{
    const char *plans[] = {
        "{\"name\": \"p\", \"title\": \"P\", \"discrepancies\": [{\"id\": \"d\", \"patterns\": [" PATTERNS "], "
        "\"measures\": [\"star\", \"diaphony\"], \"n\": [4, 9], \"trials\": 2}], "
        "\"images\": [{\"id\": \"i\", \"patterns\": [" PATTERNS "], "
        "\"scenes\": [\"ball\", \"checker\", \"balls\"], \"size\": [8, 8], \"spp\": [4], \"trials\": 2, "
        "\"references\": [{\"name\": \"r\", \"pattern\": \"random\", \"spp\": 4}]}], \"questions\": ["
        "{\"id\": \"c\", \"title\": \"C\", \"kind\": \"correlation\", \"discrepancies\": \"d\", \"images\": \"i\"}, "
        "{\"id\": \"s\", \"title\": \"S\", \"kind\": \"slopes\", \"discrepancies\": \"d\"}]}"};
    const koksma_study_options options = {.plans = plans, .n_plans = 1, .folder = "asking"};
    koksma_study *study;
    unlink("asking/report.json"); /* of an earlier run of this test */
    assert_ok(koksma_study_open(&options, &study));
    assert_ok(koksma_study_run(study, NULL, NULL));
    calls all = {0};
    koksma_run run = {.threads = 1, .keep_going = count_call, .context = &all};
    assert_ok(koksma_study_report(study, &run));
    assert_true(all.n > 120000 / 64 && !all.fell);
    unlink("asking/report.json");
    for (size_t part = 1; part < 8; part++) {
        calls some = {.last = part < 4 ? all.n * part / 4 : all.n - 64 * (part - 4) - 1};
        run.context = &some;
        assert_int_equal(koksma_study_report(study, &run), KOKSMA_INTERRUPTED);
        assert_int_equal(some.n, some.last);
        assert_int_equal(access("asking/report.json", F_OK), -1);
    }
    assert_ok(koksma_study_close(study));
}
