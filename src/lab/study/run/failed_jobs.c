/* SPDX-License-Identifier: Apache-2.0 */
/* Counts the jobs of each task that failed without ending the run, and lists these in the store
   (store.c). */
#include "study/run/run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"
#include "study/plan/plan.h"

void koksma__failures_fini(koksma__failures *failures)
{
    free(failures->tasks);
    for (size_t i = 0; i < failures->n_list; i++) {
        KOKSMA__FREE(failures->list[i].label, failures->list[i].reason);
    }
    free(failures->list);
}

/* ---- Counting ------------------------------------------------------------------------------------------ */

static bool may_skip(const koksma__task *t)
{
    return t->image ? t->image->left_out.skip : t->discrepancy->left_out.skip;
}

/* Returns the reason in an error text: what follows the job's name and the pattern's name, if the text begins with
   them. */
static const char *reason_of(const koksma_study *study, const koksma__task *t, long long trial, const char *text)
{
    char name[KOKSMA__JOB_NAME];
    koksma__task_name(study, t, trial, name);
    const size_t length = strlen(name), pattern = strcspn(t->pattern, ":");
    text += strncmp(text, name, length) || strncmp(text + length, ": ", 2) ? 0 : length + 2;
    return text + (strncmp(text, t->pattern, pattern) || strncmp(text + pattern, ": ", 2) ? 0 : pattern + 2);
}

koksma_status koksma__failures_count(const koksma__tasks *tasks, size_t job, const char *text,
                                     koksma__failures *failures)
{
    long long trial;
    const koksma__task *t = koksma__tasks_job(tasks, job, &trial);
    const bool refused = !may_skip(t);
    if (!failures->n || refused > (failures->n_refused > 0) ||
        (refused == (failures->n_refused > 0) && job < failures->first)) {
        failures->first = job;
        snprintf(failures->text, sizeof failures->text, "%s", text);
    }
    failures->n++;
    failures->n_refused += refused;
    failures->tasks = failures->tasks ? failures->tasks : calloc(tasks->n, sizeof *failures->tasks);
    KOKSMA__REQUIRE_MEMORY(failures->tasks, tasks->n * sizeof *failures->tasks);
    koksma__failed_task *f = &failures->tasks[t - tasks->at];
    if (!f->n++ || trial < f->trial) {
        free(f->reason);
        f->trial = trial;
        f->reason = strdup(reason_of(tasks->study, t, trial, text));
        KOKSMA__REQUIRE_MEMORY(f->reason, strlen(text));
    }
    return KOKSMA_OK;
}

/* Writes the label of a task, which tells all but n: the pattern, the dimension unless it is 2, and the warp; or the
   pattern, scene, size and options. Tasks of equal label, n and reason may be of several blocks, and the store has one of
   them. */
static void put_label(FILE *f, const koksma__task *t)
{
    fputs(t->pattern, f);
    if (t->image) {
        fprintf(f, " in %s at %dx%d%s%s", t->scene->name, t->width, t->height, t->variant[0] ? ", " : "", t->variant);
    } else if (t->discrepancy->dim != 2) {
        fprintf(f, " (%dD)", t->discrepancy->dim);
    } else if (t->variant[0]) {
        fprintf(f, " through %s", t->variant);
    }
}

/* Adds a task to the list, which takes over the reason. */
static koksma_status list_task(koksma__failures *run, const koksma__task *t, const koksma__failed_task *failed)
{
    koksma__failed *at = koksma__add_one(&run->list, &run->n_list, sizeof *at);
    size_t size = 0;
    if (!at) {
        free(failed->reason);
        return KOKSMA_MEMORY;
    }
    *at = (koksma__failed){.reason = failed->reason, .n = t->n, .failed = (long long)failed->n, .trials = t->trials};
    FILE *f = open_memstream(&at->label, &size);
    KOKSMA__REQUIRE_MEMORY(f, 1);
    put_label(f, t);
    return fclose(f) ? koksma__fail_memory(size) : KOKSMA_OK;
}

koksma_status koksma__failures_add(koksma__failures *run, const koksma__failures *phase, const koksma__tasks *tasks)
{
    koksma_status status = KOKSMA_OK;
    if (phase->n && (!run->n || (phase->n_refused && !run->n_refused))) {
        memcpy(run->text, phase->text, sizeof run->text);
    }
    run->n += phase->n;
    run->n_refused += phase->n_refused;
    for (size_t i = 0; phase->tasks && i < tasks->n; i++) {
        if (!status && phase->tasks[i].n) {
            status = list_task(run, &tasks->at[i], &phase->tasks[i]);
        } else {
            free(phase->tasks[i].reason);
        }
    }
    return status;
}

koksma_status koksma__failures_record(koksma_study *study, const koksma__failures *run, bool all)
{
    koksma__texts lines = {0};
    const char *line;
    koksma__texts_fini(&study->failed);
    koksma_status status = koksma__store_put_failed(study->store, run->list, run->n_list, all);
    status = status ? status : koksma__store_failed(study->store, &study->failed);
    for (size_t i = 0; !status && (line = koksma_study_left_out_at(study, i)); i++) {
        status = koksma__texts_add(&lines, line);
    }
    status = status ? status : koksma__store_put_left_out(study->store, &lines);
    koksma__texts_fini(&lines);
    return status ? status : koksma__store_commit(study->store);
}
