/* SPDX-License-Identifier: Apache-2.0 */
/* Counts the jobs of each task that failed without ending the run, and makes the lines of the list in the store
   (store_failed.c). */
#include "study/run/run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/plan/plan.h"

void koksma__failures_fini(koksma__failures *failures)
{
    free(failures->tasks);
    koksma__texts_fini(&failures->lines);
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
   pattern, scene, size and options. Lines of equal label, n and reason may be of several blocks, and a list has one of
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

static koksma_status add_line(koksma__texts *lines, const koksma__task *t, const koksma__failed_task *failed)
{
    char *text = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&text, &size);
    KOKSMA__REQUIRE_MEMORY(f, 1);
    put_label(f, t);
    fflush(f);
    const size_t label = size;
    fprintf(f, "\t%lld\t%zu\t%lld\t%s", t->n, failed->n, t->trials, failed->reason);
    koksma_status status = fclose(f) ? koksma__fail_memory(size) : KOKSMA_OK;
    for (size_t i = 0; !status && i < size; i++) { /* blanks replace tabs and ends of lines, which separate fields */
        const bool separates = text[i] == '\n' || text[i] == '\r' || (text[i] == '\t' && i < label);
        text[i] = separates ? ' ' : text[i];
    }
    status = status ? status : koksma__texts_add(lines, text);
    free(text);
    return status;
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
            status = add_line(&run->lines, &tasks->at[i], &phase->tasks[i]);
        }
        free(phase->tasks[i].reason);
    }
    return status ? status : koksma__left_out_thin(&run->lines);
}

koksma_status koksma__failures_record(koksma_study *study, const koksma__failures *run, bool all)
{
    koksma__texts before = {0}, stored = {0}, lines = {0};
    const char *line;
    koksma_status status = all ? KOKSMA_OK : koksma__left_out_recall(study->store, &before);
    status = status ? status : koksma__left_out_add(&before, &run->lines, &stored);
    const koksma__texts kept = stored;
    status = status ? status : koksma__left_out_add(&run->lines, &kept, &stored);
    status = status ? status : koksma__left_out_show(&stored, &study->failed);
    for (size_t i = 0; !status && (line = koksma_study_left_out_at(study, i)); i++) {
        status = koksma__texts_add(&lines, line);
    }
    status = status ? status : koksma__left_out_record(study->store, &stored, &lines);
    koksma__texts_fini(&before);
    koksma__texts_fini(&stored);
    koksma__texts_fini(&lines);
    return status ? status : koksma__store_commit(study->store);
}
