/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Lists the jobs that failed alone. The store has a text "failed" with one line for each task that has failed jobs:
 * label, n, number of failed trials, number of trials and reason, separated by tabs. For readers, lines of equal label
 * become one: "poisson-disk:d=0.3, N = 64 (100 of 100 trials), 256 (100 of 100 trials): reason". The text "left-out"
 * has these lines, behind those of the plan's blocks with `skip`.
 */
#include "study/run/failed_jobs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"
#include "study/plan/plan_owned.h"

static const char failed_key[] = "failed", left_out_key[] = "left-out";

void koksma__failures_fini(koksma__failures *failures)
{
    free(failures->tasks);
    koksma__texts_fini(&failures->lines);
}

static koksma_status add_text(koksma__texts *texts, const char *text)
{
    char **line = koksma__add_one(&texts->at, &texts->n, sizeof *line);
    KOKSMA__TRY(line ? KOKSMA_OK : KOKSMA_MEMORY);
    *line = strdup(text);
    texts->n -= !*line;
    return *line ? KOKSMA_OK : koksma__fail_memory(strlen(text));
}

/* ---- Counting ------------------------------------------------------------------------------------------ */

static bool may_skip(const koksma__task *t)
{
    return t->image ? t->image->left_out.skip : t->discrepancy->left_out.skip;
}

/* The reason in an error text that may begin with the job's name, and then with that of the pattern. */
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

/* What the jobs of a task are, but for n: "PATTERN", and the warp, or the scene and its options. */
static void put_label(FILE *f, const koksma__task *t)
{
    fputs(t->pattern, f);
    if (t->image) {
        fprintf(f, " in %s%s%s", t->scene->name, t->variant[0] ? ", " : "", t->variant);
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
    for (size_t i = 0; !status && i < size; i++) { /* a path may have any character; tabs and lines separate */
        const bool separates = text[i] == '\n' || text[i] == '\r' || (text[i] == '\t' && i < label);
        text[i] = separates ? ' ' : text[i];
    }
    status = status ? status : add_text(lines, text);
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
    return status;
}

/* ---- The list for readers ------------------------------------------------------------------------------ */

/* The fields of a line; false if it is not one. */
typedef struct fields {
    const char *label, *reason;
    int label_length;
    long long n, failed, trials;
} fields;

static bool read_line(const char *line, fields *out)
{
    int at = 0;
    out->label = line;
    out->label_length = (int)strcspn(line, "\t");
    const char *numbers = line + out->label_length;
    if (sscanf(numbers, "\t%lld\t%lld\t%lld%n", &out->n, &out->failed, &out->trials, &at) != 3 ||
        numbers[at] != '\t') {
        return false;
    }
    out->reason = numbers + at + 1;
    return true;
}

static bool same_label(const fields *a, const fields *b)
{
    return a->label_length == b->label_length && !strncmp(a->label, b->label, (size_t)a->label_length);
}

/* Appends to `lines` one line for all tasks with the label of task `first`, and marks them as shown. */
static koksma_status show(const fields *tasks, size_t n, size_t first, bool *shown, koksma__texts *lines)
{
    char *text = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&text, &size);
    KOKSMA__REQUIRE_MEMORY(f, 1);
    fprintf(f, "%.*s, N =", tasks[first].label_length, tasks[first].label);
    for (size_t i = first; i < n; i++) {
        if (!shown[i] && same_label(&tasks[first], &tasks[i])) {
            fprintf(f, "%s %lld (%lld of %lld trial%s)", i == first ? "" : ",", tasks[i].n, tasks[i].failed,
                    tasks[i].trials, tasks[i].trials == 1 ? "" : "s");
            shown[i] = true;
        }
    }
    fprintf(f, ": %s", tasks[first].reason);
    koksma_status status = fclose(f) ? koksma__fail_memory(size) : KOKSMA_OK;
    status = status ? status : add_text(lines, text);
    free(text);
    return status;
}

/* Makes the readers' lines of the store's lines. */
static koksma_status show_all(const koksma__texts *stored, koksma__texts *lines)
{
    fields *tasks = calloc(stored->n + 1, sizeof *tasks);
    bool *shown = calloc(stored->n + 1, sizeof *shown);
    koksma_status status = tasks && shown ? KOKSMA_OK : koksma__fail_memory(stored->n * sizeof *tasks);
    size_t n = 0;
    koksma__texts_fini(lines);
    for (size_t i = 0; !status && i < stored->n; i++) {
        n += read_line(stored->at[i], &tasks[n]);
    }
    for (size_t i = 0; !status && i < n; i++) {
        status = shown[i] ? KOKSMA_OK : show(tasks, n, i, shown, lines);
    }
    KOKSMA__FREE(tasks, shown);
    return status;
}

/* ---- The store ----------------------------------------------------------------------------------------- */

static koksma_status recall(koksma_study *study, koksma__texts *stored)
{
    char *text = NULL;
    koksma_status status = koksma__store_get_text(study->store, failed_key, &text);
    for (char *line = text; !status && line && *line;) {
        const size_t length = strcspn(line, "\n");
        const bool last = !line[length];
        line[length] = '\0';
        status = add_text(stored, line);
        line += length + !last;
    }
    free(text);
    return status;
}

koksma_status koksma__failures_recall(koksma_study *study)
{
    koksma__texts stored = {0};
    koksma_status status = recall(study, &stored);
    status = status ? status : show_all(&stored, &study->failed);
    koksma__texts_fini(&stored);
    return status;
}

/* Writes a text unless the store has it; a store without the text is as one with an empty text. */
static koksma_status set_text(koksma_study *study, const char *key, const char *value)
{
    char *before = NULL;
    KOKSMA__TRY(koksma__store_get_text(study->store, key, &before));
    const bool same = !strcmp(before ? before : "", value);
    free(before);
    return same ? KOKSMA_OK : koksma__store_set_text(study->store, key, value);
}

/* Writes the lines that line_at(context, 0 ..) returns as one text. */
static koksma_status set_lines(koksma_study *study, const char *key, const char *(*line_at)(const void *, size_t),
                               const void *context)
{
    char *text = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&text, &size);
    const char *line;
    KOKSMA__REQUIRE_MEMORY(f, 1);
    for (size_t i = 0; (line = line_at(context, i)); i++) {
        fprintf(f, "%s\n", line);
    }
    koksma_status status = fclose(f) ? koksma__fail_memory(size) : KOKSMA_OK;
    status = status ? status : set_text(study, key, text);
    free(text);
    return status;
}

static const char *text_at(const void *context, size_t i)
{
    const koksma__texts *texts = context;
    return i < texts->n ? texts->at[i] : NULL;
}

static const char *left_out_at(const void *context, size_t i)
{
    return koksma_study_left_out_at(context, i);
}

/* Whether the lines have one of the same task with at least as many failed trials. A trial that failed fails again, so that
   of two runs the one that tried more of them knows more. */
static bool have_more(const koksma__texts *lines, const char *line)
{
    fields a, b;
    bool more = !read_line(line, &a);
    for (size_t i = 0; !more && i < lines->n; i++) {
        more = read_line(lines->at[i], &b) && same_label(&a, &b) && a.n == b.n && b.failed >= a.failed;
    }
    return more;
}

koksma_status koksma__failures_record(koksma_study *study, const koksma__failures *run, bool all)
{
    koksma__texts before = {0}, lines = {0};
    koksma_status status = all ? KOKSMA_OK : recall(study, &before);
    for (size_t i = 0; !status && i < before.n; i++) {
        status = have_more(&run->lines, before.at[i]) ? KOKSMA_OK : add_text(&lines, before.at[i]);
    }
    for (size_t i = 0; !status && i < run->lines.n; i++) {
        status = have_more(&lines, run->lines.at[i]) ? KOKSMA_OK : add_text(&lines, run->lines.at[i]);
    }
    status = status ? status : show_all(&lines, &study->failed);
    status = status ? status : set_lines(study, failed_key, text_at, &lines);
    status = status ? status : set_lines(study, left_out_key, left_out_at, study);
    koksma__texts_fini(&before);
    koksma__texts_fini(&lines);
    return status ? status : koksma__store_commit(study->store);
}

koksma_status koksma_study_left_out(const char *folder, char **lines)
{
    KOKSMA__REQUIRE(folder, lines);
    char path[KOKSMA__PATH];
    koksma__store *store;
    *lines = NULL;
    snprintf(path, sizeof path, "%s/results.sqlite", folder);
    KOKSMA__TRY(koksma__store_open(path, KOKSMA__STORE_READ, NULL, &store));
    koksma_status status = koksma__store_get_text(store, left_out_key, lines);
    koksma__store_close(store);
    if (!status && !*lines) {
        *lines = strdup("");
        status = *lines ? KOKSMA_OK : koksma__fail_memory(1);
    }
    return status;
}
