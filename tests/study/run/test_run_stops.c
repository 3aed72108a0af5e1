/* SPDX-License-Identifier: Apache-2.0 */
/* Runs that stop while they create the series of their tasks: nothing is lost, what was done before is counted, no job
   runs without its series, and the same call continues. */
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include <koksma/study.h>

#include "study/run/run.h"
#include "study/run/study.h"
#include "test.h"

enum { JOBS = 3 * 3 * 2, SERIES = 3 * 3 * 2, DONE = 3 * 1 * 2 };

/* The plan with all numbers of points, or with the first alone. */
static koksma_study *open_study(const char *folder, bool all)
{
    char plan[512];
    const char *text = plan;
    koksma_study *study;
    snprintf(plan, sizeof plan,
             "{\"name\": \"p\", \"title\": \"p\", \"discrepancies\": [{\"patterns\": [\"random\", \"jittered\", "
             "\"n-rooks\"], \"measures\": [\"star\", \"l2-star\"], \"n\": [4%s], \"trials\": 2}]}",
             all ? ", 9, 16" : "");
    assert_ok(koksma_study_open(&(koksma_study_options){.plans = &text, .n_plans = 1, .folder = folder}, &study));
    return study;
}

static void close_study(koksma_study *study, const char *folder)
{
    char path[64];
    snprintf(path, sizeof path, "%s/results.sqlite", folder);
    assert_ok(koksma_study_close(study));
    assert_int_equal(remove(path) | rmdir(folder), 0);
}

static bool until(void *context, double fraction)
{
    int *left = context;
    (void)fraction;
    return (*left)-- > 0;
}

static int count_series(koksma_study *study)
{
    koksma__tasks tasks;
    int n = 0;
    assert_ok(koksma__tasks_open(study, false, &tasks));
    assert_ok(koksma__tasks_look_up(&tasks, false, NULL));
    for (size_t i = 0; i < tasks.n; i++) {
        for (size_t k = 0; k < tasks.at[i].n_series; k++) {
            n += tasks.at[i].series[k] != 0;
        }
    }
    koksma__tasks_close(&tasks);
    return n;
}

/* Runs the study until keep_going was called so many times; returns the number of its series. */
static int run_until(const char *folder, int calls, koksma_study_summary *summary)
{
    const koksma_run run = {.threads = 2, .keep_going = until, .context = &calls};
    koksma_study *study = open_study(folder, true);
    assert_int_equal(koksma_study_run(study, &run, summary), KOKSMA_INTERRUPTED);
    const int series = count_series(study);
    assert_ok(koksma_study_close(study));
    return series;
}

static void finish(const char *folder, size_t done)
{
    koksma_study_summary summary;
    size_t jobs, undone;
    koksma_study *study = open_study(folder, true);
    assert_ok(koksma_study_run(study, NULL, &summary));
    assert_true(summary.complete);
    assert_int_equal(summary.done_before, done);
    assert_int_equal(summary.done_now, JOBS - done);
    assert_ok(koksma_study_undone(study, &jobs, &undone));
    assert_int_equal(jobs, JOBS);
    assert_int_equal(undone, 0);
    close_study(study, folder);
}

static void stops_among_series(void **state)
{
    (void)state;
    koksma_study_summary summary;
    for (int calls = 0; calls < SERIES; calls++) {
        char folder[32];
        snprintf(folder, sizeof folder, "new-%d", calls);
        assert_int_equal(run_until(folder, calls, &summary), calls);
        assert_int_equal(summary.jobs, JOBS);
        assert_int_equal(summary.done_before + summary.done_now, 0);
        finish(folder, 0);
    }
}

static void counts_what_was_done(void **state)
{
    (void)state;
    for (int calls = 0; calls < SERIES; calls++) {
        char folder[32];
        koksma_study_summary summary;
        snprintf(folder, sizeof folder, "old-%d", calls);
        koksma_study *study = open_study(folder, false);
        assert_ok(koksma_study_run(study, NULL, NULL));
        assert_ok(koksma_study_close(study));
        const int series = run_until(folder, calls, &summary);
        assert_in_range(series, DONE, SERIES - 1);
        assert_int_equal(summary.done_before, DONE);
        assert_int_equal(summary.done_now, 0);
        finish(folder, DONE);
    }
}

/* Workers that ask for a job before the caller's thread has seen the stop get none. */
static void stopped_phases_give_no_job(void **state)
{
    (void)state;
    koksma__tasks tasks;
    koksma__run_control control;
    koksma__assignment assignment;
    koksma_study *study = open_study("given", true);
    assert_ok(koksma__tasks_open(study, false, &tasks));
    for (int stop = 0; stop < 2; stop++) {
        koksma__phase phase = {.tasks = &tasks, .control = &control};
        koksma__run_state of_run;
        koksma__run_control_begin(NULL, 0, &control);
        atomic_store(&control.stop, stop);
        assert_ok(koksma__run_state_open(&phase, &of_run));
        assert_int_equal(koksma__run_state_take(&of_run, &assignment), !stop);
        assert_int_equal(koksma__run_state_status(&of_run), stop ? KOKSMA_INTERRUPTED : KOKSMA_OK);
        koksma__run_state_close(&of_run);
    }
    koksma__tasks_close(&tasks);
    close_study(study, "given");
}

/* In whatever order jobs fail, the lowest one is told. */
static void tells_the_lowest_failed_job(void **state)
{
    static const char *const jobs[] = {"05", "07", "02", "09"};
    koksma__tasks tasks;
    koksma__failures failures = {.n = 0}, run = {.n = 0};
    koksma_study *study = open_study(NULL, true);
    (void)state;
    assert_ok(koksma__tasks_open(study, false, &tasks));
    for (size_t i = 0; i < 4; i++) {
        assert_ok(koksma__failures_count(&tasks, strtoul(jobs[i], NULL, 10), jobs[i], &failures));
    }
    assert_ok(koksma__failures_add(&run, &failures, &tasks));
    assert_string_equal(run.text, "02");
    koksma__failures_fini(&failures);
    koksma__failures_fini(&run);
    koksma__tasks_close(&tasks);
    assert_ok(koksma_study_close(study));
}

int main(void)
{
    char folder[] = "/tmp/koksma-stops-XXXXXX";
    const struct CMUnitTest tests[] = {cmocka_unit_test(stops_among_series), cmocka_unit_test(counts_what_was_done),
                                       cmocka_unit_test(stopped_phases_give_no_job),
                                       cmocka_unit_test(tells_the_lowest_failed_job)};
    if (!mkdtemp(folder) || chdir(folder)) {
        return 1;
    }
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return chdir("/") || rmdir(folder) || failed;
}
