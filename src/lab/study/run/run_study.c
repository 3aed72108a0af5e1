/* SPDX-License-Identifier: Apache-2.0 */
/* Runs the jobs of a study whose results the store lacks. The results do not depend on threads, order or
   interruptions, because a job's seed is a hash of its key. */
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>

#include "core/clock.h"
#include "core/parallel.h"
#include "core/status.h"
#include "study/run/run.h"

/* ---- The record of a run ------------------------------------------------------------------------------- */

static void name_machine(char *text, size_t size)
{
    struct utsname system = {0};
    char line[256], model[160] = "";
    FILE *f = fopen("/proc/cpuinfo", "r");
    while (f && fgets(line, sizeof line, f)) {
        if (!strncmp(line, "model name", 10) && strchr(line, ':')) {
            snprintf(model, sizeof model, "%.*s, ", (int)strcspn(strchr(line, ':') + 2, "\n"), strchr(line, ':') + 2);
            break;
        }
    }
    if (f) {
        fclose(f);
    }
    uname(&system);
    snprintf(text, size, "%s%.30s %.30s", model, system.sysname, system.machine);
}

static koksma_status record_run(koksma_study *study, const char *started, const koksma_study_summary *summary)
{
    koksma__run_record record = {.workers = summary->workers,
                                 .jobs = (long long)summary->done_now,
                                 .seconds = summary->seconds,
                                 .idle_seconds = summary->idle_seconds,
                                 .processor_seconds = summary->processor_seconds,
                                 .store_seconds = summary->store_seconds};
    if (summary->done_now == 0) {
        return KOKSMA_OK;
    }
    snprintf(record.started, sizeof record.started, "%s", started);
    snprintf(record.version, sizeof record.version, "%s", koksma_version());
    name_machine(record.machine, sizeof record.machine);
    const koksma_status status = koksma__store_put_run(study->store, &record);
    return status ? status : koksma__store_commit(study->store);
}

/* ---- The whole run ------------------------------------------------------------------------------------- */

/* If `before`, the status of an earlier kind of jobs, is not OK, the jobs are only counted. */
koksma_status koksma__run_kind(koksma_study *study, bool images, koksma__run_control *control, koksma_status before,
                               koksma_study_summary *summary, koksma__failures *failures)
{
    koksma__tasks tasks;
    char reason[KOKSMA__FAILURE_TEXT]; /* counting fails, too, if the store can't be written, with another reason */
    snprintf(reason, sizeof reason, "%s", before ? koksma_error_text() : "");
    KOKSMA__TRY(koksma__tasks_open(study, images, &tasks));
    koksma__phase phase = {.tasks = &tasks, .control = control, .last = images || !study->plan.n_images};
    koksma_status status = study->sink ? study->sink->look_up(study->sink->context, &tasks)
                                       : koksma__tasks_look_up(&tasks, !before, &control->run);
    summary->jobs += tasks.n_jobs;
    size_t done_before = 0;
    for (size_t i = 0; i < tasks.n; i++) {
        done_before += (size_t)tasks.at[i].done_before;
    }
    summary->done_before += done_before;
    /* An audit renders the references even if none of the drawn rows needs them. */
    const bool mpi = koksma__mpi_size() > 1 && koksma__tasks_have_work(&tasks, images);
    if (!status && !before && (done_before < tasks.n_jobs || mpi || study->sink)) {
        status = mpi ? koksma__mpi_serve(&phase) : koksma__work_threads(&phase);
    }
    summary->done_now += atomic_load(&phase.done);
    summary->idle_seconds -= 1e-9 * (double)atomic_load(&phase.busy_ns);
    summary->processor_seconds += phase.others_s;
    const koksma_status added = koksma__failures_add(failures, &phase.failures, &tasks);
    koksma__failures_fini(&phase.failures);
    koksma__tasks_close(&tasks);
    return before ? koksma__fail(before, "%s", reason) : status ? status : added;
}

double koksma__run_work(koksma_study *study, bool images)
{
    koksma__tasks tasks;
    double sum = 0;
    if (koksma__tasks_open(study, images, &tasks)) {
        return 0;
    }
    for (size_t i = 0; i < tasks.n; i++) {
        const koksma__task *t = &tasks.at[i];
        sum += (double)t->trials * (double)t->n * (images ? (double)t->width * t->height : (double)t->n_series);
    }
    koksma__tasks_close(&tasks);
    return sum;
}

/* Adds the jobs of one kind, and those of them that the store has. */
static koksma_status count_jobs(koksma_study *study, bool images, size_t *jobs, size_t *done)
{
    koksma__tasks tasks;
    KOKSMA__TRY(koksma__tasks_open(study, images, &tasks));
    const koksma_status status = tasks.n ? koksma__tasks_look_up(&tasks, false, NULL) : KOKSMA_OK;
    *jobs += tasks.n_jobs;
    for (size_t i = 0; i < tasks.n; i++) {
        *done += (size_t)tasks.at[i].done_before;
    }
    koksma__tasks_close(&tasks);
    return status;
}

koksma_status koksma__count_undone(koksma_study *study, size_t *jobs, size_t *undone)
{
    size_t done = 0, failed = 0;
    *jobs = *undone = 0;
    KOKSMA__TRY(count_jobs(study, false, jobs, &done));
    KOKSMA__TRY(count_jobs(study, true, jobs, &done));
    KOKSMA__TRY(koksma__store_count_failed(study->store, &failed));
    *undone = *jobs - done > failed ? *jobs - done - failed : 0;
    return KOKSMA_OK;
}

koksma_status koksma_study_undone(koksma_study *study, size_t *jobs, size_t *undone)
{
    KOKSMA__REQUIRE(study, jobs, undone);
    KOKSMA__FAIL_IF(!study->store, KOKSMA_ARGUMENT, "a study without a folder has no rows");
    koksma__study_forget_files(study);
    return koksma__count_undone(study, jobs, undone);
}

koksma_status koksma_study_run(koksma_study *study, const koksma_run *run, koksma_study_summary *summary)
{
    KOKSMA__REQUIRE(study);
    KOKSMA__REQUIRE_RUN(run);
    koksma_study_summary unused;
    char started[24];
    const time_t now = time(NULL);
    struct tm utc;
    strftime(started, sizeof started, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &utc));
    summary = summary ? summary : &unused;
    *summary = (koksma_study_summary){0};
    koksma__run_control control;
    koksma__study_forget_files(study);
    /* Only rank 0 enforces the time limit, for all ranks. */
    koksma__run_control_begin(run, run && study->store ? run->time_limit_s : 0, &control);
    if (!study->store) {
        return koksma__mpi_work(study, &control.job);
    }
    KOKSMA__TRY(koksma__study_open_to_write(study));
    const double start_s = koksma__now_s(), processor_s = koksma__processor_s();
    const double store_s = koksma__store_seconds(study->store);
    koksma__failures failures = {.n = 0};
    const double sets = koksma__run_work(study, false), pictures = koksma__run_work(study, true);
    control.share = sets > 0 ? sets / (sets + pictures) : 0;
    koksma_status status = koksma__run_kind(study, false, &control, KOKSMA_OK, summary, &failures);
    control.begin = control.share;
    control.share = 1 - control.begin;
    status = koksma__run_kind(study, true, &control, status, summary, &failures);
    summary->workers = koksma__mpi_size() > 1 ? koksma__mpi_size() : control.run.threads;
    summary->seconds = koksma__now_s() - start_s;
    summary->idle_seconds += summary->workers * summary->seconds;
    summary->processor_seconds += koksma__processor_s() - processor_s;
    summary->store_seconds = koksma__store_seconds(study->store) - store_s;
    const bool all = !status;
    summary->complete = all && !failures.n_refused;
    if (!status || status == KOKSMA_INTERRUPTED || koksma__is_impossible(status)) {
        koksma_status recorded = koksma__failures_record(study, &failures, all);
        recorded = recorded ? recorded : record_run(study, started, summary);
        status = status == KOKSMA_OK || koksma__run_control_time_is_up(&control) ? recorded : status;
    }
    if (all && !status && failures.n_refused) {
        status = koksma__fail(KOKSMA_IMPOSSIBLE, "%zu of %zu jobs failed; the others completed. First: %s",
                              failures.n_refused, summary->jobs, failures.text);
    }
    koksma__failures_fini(&failures);
    return status;
}
