/* SPDX-License-Identifier: Apache-2.0 */
/* The progress of a report, and its end where the caller says so. */
#include <math.h>
#include <unistd.h>

#include <koksma/study.h>

#include "test.h"

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
static void reports_have_progress(void **state)
{
    (void)state;
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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(reports_have_progress)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
