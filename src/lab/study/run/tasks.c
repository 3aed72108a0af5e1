/* SPDX-License-Identifier: Apache-2.0 */
/* Tasks and jobs. The blocks of a plan become tasks (a pattern at one size, with all its measures or references),
   sorted by descending number of trials. Rounds of trials in which the same tasks have trials left form a group, and
   job i is found by binary search among these groups. jobs.c does a job. */
#include "study/run/tasks.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/integrate.h>
#include <koksma/warp.h>

#include "core/c_locale.h"
#include "core/capacity.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "core/status.h"
#include "image/coherence.h"
#include "image/metrics/metrics.h"
#include "patterns/files/files.h"
#include "study/run/references.h"

/* A plan of kilobytes may list thousands of patterns and of sizes, each pair of which is a task. The limits are far above
   what studies need that end: an image of each of 2^18 tasks that takes a second takes three days of one processor. */

/* The maximum sums over all blocks of a plan. A task takes some hundred bytes, a series as many and a row of the store,
   a reference over a kilobyte. */
static const long long MOST_TASKS = 1 << 18, MOST_SERIES = 1 << 21, MOST_REFERENCES = 1 << 16;

/* Checks the sums over all blocks from the lengths of their lists: of tasks, of series, and of references. The sums have
   what a block leaves out, and what blocks share once for each. */
static koksma_status check_limits(const koksma_study *study)
{
    const koksma__plan *plan = &study->plan;
    double tasks = 0, series = 0, references = 0;
    for (size_t i = 0; i < plan->n_discrepancies; i++) {
        const koksma__discrepancy_block *b = &plan->discrepancies[i];
        const double sets = (double)(b->warps.n ? b->warps.n : 1) * (double)b->patterns.n * (double)b->n.n;
        tasks += sets;
        series += sets * (double)b->measures.n;
    }
    for (size_t i = 0; i < plan->n_images; i++) {
        const koksma__image_block *b = &plan->images[i];
        const double views = (double)b->scenes.n * (double)b->variants.n, n = (double)b->n_references;
        const double images = views * (double)b->patterns.n * (double)b->spp.n;
        tasks += images;
        series += images * (n + 1 + (double)b->metrics.n);
        references += views * n;
    }
    KOKSMA__FAIL_IF(tasks > (double)MOST_TASKS, KOKSMA_ARGUMENT,
                    "plan '%s': more than %lld combinations of patterns, sizes, warps, scenes and options",
                    plan->name, MOST_TASKS);
    KOKSMA__FAIL_IF(series > (double)MOST_SERIES, KOKSMA_ARGUMENT,
                    "plan '%s': more than %lld combinations of these with measures, references and metrics",
                    plan->name, MOST_SERIES);
    KOKSMA__FAIL_IF(references > (double)MOST_REFERENCES, KOKSMA_ARGUMENT,
                    "plan '%s': more than %lld images for reference", plan->name, MOST_REFERENCES);
    return KOKSMA_OK;
}

/* ---- The list ------------------------------------------------------------------------------------------ */

/* The maximum number of jobs in a plan. For so many jobs, two bits for each (done; in the store) take 256 MiB. */
static const long long MOST_JOBS = 1 << 30;

/* A job's seed is the hash of the task's key and the trial. The options are not part of the seed, so that different
   options use the same points. */
static uint64_t key_of(const koksma__task *t)
{
    char text[8192]; /* a path, a pattern and numbers */
    if (t->image) {
        snprintf(text, sizeof text, "image|%s|%s|%s|%lld|%dx%d|", t->scene->name, t->scene->hash, t->pattern, t->n,
                 t->width, t->height);
    } else {
        snprintf(text, sizeof text, "discrepancy|%s|%lld|%d|", t->pattern, t->n, t->discrepancy->dim);
    }
    return koksma__hash_more(KOKSMA__HASH_START, text, strlen(text));
}

uint64_t koksma__task_seed(const koksma__task *t, long long trial)
{
    char digits[KOKSMA__CSV_NUMBER];
    if (t->seeds && trial < t->trials) {
        return t->seeds[trial];
    }
    return koksma__hash_end(koksma__hash_more(t->key, digits, koksma__csv_whole((uint64_t)trial, digits)));
}

koksma__task koksma__task_with(const koksma__task *task, const char *pattern)
{
    koksma__task other = *task;
    other.pattern = pattern;
    other.key = key_of(&other);
    return other;
}

static koksma_status add_task(koksma__tasks *tasks, const koksma__task *task)
{
    tasks->wanted += task->trials;
    KOKSMA__FAIL_IF(tasks->wanted > MOST_JOBS, KOKSMA_ARGUMENT, "plan '%s': more than %lld jobs",
                    tasks->study->plan.name, MOST_JOBS);
    koksma__task *t = koksma__add_one(&tasks->at, &tasks->n, sizeof *t);
    KOKSMA__TRY(t ? KOKSMA_OK : KOKSMA_MEMORY);
    *t = *task;
    t->place = tasks->n - 1;
    t->key = key_of(t);
    t->series = calloc(t->n_series, sizeof *t->series);
    t->references = calloc(t->n_series, sizeof *t->references);
    t->done = calloc((size_t)t->trials / 8 + 1, 1);
    return t->series && t->references && t->done ? KOKSMA_OK : koksma__fail_memory((size_t)t->trials / 8);
}

bool koksma__has_one_set(const char *pattern)
{
    koksma_spec spec;
    return !koksma_pattern_spec(pattern, &spec) && koksma_has_one_set(&spec);
}

/* The files of the pattern that was looked at last, so that each family is listed once, not for each size. */
typedef struct family {
    const char *pattern;
    size_t n;
    koksma__file_set *sets; /* NULL: the pattern is no family with {seed} */
} family;

static koksma_status list_family(const char *pattern, family *f)
{
    koksma_spec spec;
    if (f->pattern == pattern) {
        return KOKSMA_OK;
    }
    free(f->sets);
    *f = (family){.pattern = pattern};
    const bool has_seeds = !koksma_pattern_spec(pattern, &spec) && koksma__reads_points(spec.pattern) &&
                           koksma__file_has(spec.path, "{seed}");
    return has_seeds ? koksma__file_sets(spec.path, &f->sets, &f->n) : KOKSMA_OK;
}

/* A family of files, such as file:my_{n}_{seed}.npy, has one set for each file: trial t has the file with the t-th smallest
   seed, and there are as many trials as files, at most those of the block. */
static koksma_status find_seeds(koksma__task *t, const family *f)
{
    const size_t most = (size_t)t->trials < f->n ? (size_t)t->trials : f->n;
    size_t n = 0;
    if (!f->sets) {
        return KOKSMA_OK;
    }
    t->seeds = calloc(most + 1, sizeof *t->seeds);
    KOKSMA__REQUIRE_MEMORY(t->seeds, (most + 1) * sizeof *t->seeds);
    for (size_t i = 0; i < f->n && n < most; i++) {
        if (!f->sets[i].n || f->sets[i].n == (size_t)t->n) {
            t->seeds[n++] = f->sets[i].seed;
        }
    }
    if (!n) { /* the error of the first trial names the file that is missing */
        free(t->seeds);
        t->seeds = NULL;
    }
    t->trials = n ? (long long)n : 1;
    return KOKSMA_OK;
}

/* Lists what a task measures: not what the block leaves out at its size, which is number k of the block. */
static koksma_status list_measures(koksma__task *t, size_t k)
{
    const koksma__discrepancy_block *b = t->discrepancy;
    t->measures = malloc(b->measures.n * sizeof *t->measures);
    KOKSMA__REQUIRE_MEMORY(t->measures, b->measures.n * sizeof *t->measures);
    for (size_t m = 0; m < b->measures.n; m++) {
        if (!koksma__is_unmeasured(&b->left_out, m, b->n.n, k)) {
            t->measures[t->n_series++] = b->measures.at[m];
        }
    }
    return KOKSMA_OK;
}

static koksma_status add_discrepancies(koksma__tasks *tasks, const koksma__discrepancy_block *b)
{
    const size_t warps = b->warps.n ? b->warps.n : 1;
    koksma_status status = KOKSMA_OK;
    family files = {.n = 0};
    for (size_t i = 0; !status && i < b->patterns.n * b->n.n * warps; i++) {
        if (koksma__is_left_out(&b->left_out, i / (b->n.n * warps), b->n.n, i / warps % b->n.n)) {
            continue;
        }
        koksma__task task = {.discrepancy = b,
                             .pattern = b->patterns.at[i / (b->n.n * warps)],
                             .n = b->n.at[i / warps % b->n.n],
                             .variant = b->warps.n ? b->warps.at[i % warps] : "",
                             .trials = koksma__has_one_set(b->patterns.at[i / (b->n.n * warps)]) ? 1 : b->trials};
        const size_t before = tasks->n;
        status = list_family(task.pattern, &files);
        status = status ? status : find_seeds(&task, &files);
        status = status ? status : list_measures(&task, i / warps % b->n.n);
        status = status || !task.n_series ? status : add_task(tasks, &task);
        if (tasks->n == before) { /* the list does not own the seeds and measures */
            KOKSMA__FREE(task.seeds, (void *)task.measures);
        }
    }
    free(files.sets);
    return status;
}

static koksma_status add_images(koksma__tasks *tasks, const koksma__image_block *b, const koksma__study_scene *scene)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < b->patterns.n * b->spp.n * b->variants.n; i++) {
        if (koksma__is_left_out(&b->left_out, i / (b->spp.n * b->variants.n), b->spp.n,
                                i / b->variants.n % b->spp.n)) {
            continue;
        }
        koksma__task task = {.image = b,
                             .scene = scene,
                             .pattern = b->patterns.at[i / (b->spp.n * b->variants.n)],
                             .n = b->spp.at[i / b->variants.n % b->spp.n],
                             .variant = b->variants.at[i % b->variants.n],
                             .trials = b->trials,
                             .n_series = b->n_references + 1 + b->metrics.n};
        koksma__block_size(b, scene, &task.width, &task.height);
        status = add_task(tasks, &task);
        for (size_t r = 0; !status && r < b->n_references; r++) {
            status = koksma__reference_index(tasks->study, b, scene, task.variant, r,
                                             &tasks->at[tasks->n - 1].references[r]);
        }
        /* the coherence and the metrics use the last reference */
        for (size_t k = b->n_references; !status && k < task.n_series; k++) {
            koksma__task *added = &tasks->at[tasks->n - 1];
            added->references[k] = added->references[b->n_references - 1];
        }
    }
    return status;
}

static int compare_tasks(const void *a, const void *b)
{
    const koksma__task *s = a, *t = b;
    return s->trials != t->trials ? (s->trials > t->trials ? -1 : 1) : s->place < t->place ? -1 : 1;
}

/* Sorts the tasks by descending number of trials (equal numbers keep the plan's order), so that every round of
   trials consists of the first tasks->rounds[s].tasks tasks for some s, and numbers the jobs. */
static koksma_status order(koksma__tasks *tasks)
{
    if (tasks->n) {
        qsort(tasks->at, tasks->n, sizeof *tasks->at, compare_tasks);
    }
    tasks->rounds = calloc(tasks->n + 1, sizeof *tasks->rounds);
    KOKSMA__REQUIRE_MEMORY(tasks->rounds, (tasks->n + 1) * sizeof *tasks->rounds);
    long long trial = 0;
    for (size_t left = tasks->n; left > 0;) {
        const long long end = tasks->at[left - 1].trials;
        if (end > trial) {
            tasks->rounds[tasks->n_rounds++] = (koksma__rounds){tasks->n_jobs, trial, left};
            tasks->n_jobs += (size_t)(end - trial) * left;
            trial = end;
        }
        while (left > 0 && tasks->at[left - 1].trials == trial) {
            left--;
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__tasks_open(koksma_study *study, bool images, koksma__tasks *tasks)
{
    const koksma__plan *plan = &study->plan;
    *tasks = (koksma__tasks){.study = study};
    koksma_status status = check_limits(study);
    for (size_t b = 0; !images && !status && b < plan->n_discrepancies; b++) {
        status = add_discrepancies(tasks, &plan->discrepancies[b]);
    }
    for (size_t b = 0; images && !status && b < plan->n_images; b++) {
        for (size_t s = 0; !status && s < plan->images[b].scenes.n; s++) {
            status = add_images(tasks, &plan->images[b], koksma__study_scene_of(study, plan->images[b].scenes.at[s]));
        }
    }
    status = status ? status : order(tasks);
    if (status) {
        koksma__tasks_close(tasks);
    }
    return status;
}

void koksma__tasks_close(koksma__tasks *tasks)
{
    for (size_t i = 0; i < tasks->n; i++) {
        KOKSMA__FREE(tasks->at[i].series, tasks->at[i].references, tasks->at[i].done, tasks->at[i].seeds,
                     (void *)tasks->at[i].measures);
    }
    free(tasks->at);
    free(tasks->rounds);
    *tasks = (koksma__tasks){0};
}

bool koksma__tasks_have_work(const koksma__tasks *tasks, bool images)
{
    return tasks->n_jobs || (images && tasks->study->n_references);
}

const koksma__task *koksma__tasks_job(const koksma__tasks *tasks, size_t i, long long *trial)
{
    size_t low = 0, high = tasks->n_rounds;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        *(tasks->rounds[middle].first_job <= i ? &low : &high) = middle;
    }
    const koksma__rounds *r = &tasks->rounds[low];
    const size_t within = i - r->first_job;
    *trial = r->first_trial + (long long)(within / r->tasks);
    return &tasks->at[within % r->tasks];
}

bool koksma__task_is_done(const koksma__task *task, long long trial)
{
    return task->done[trial / 8] >> trial % 8 & 1;
}

/* ---- The store ----------------------------------------------------------------------------------------- */

koksma__series koksma__task_series(const koksma__task *t, size_t k, char name[KOKSMA__REFERENCE_NAME])
{
    const size_t references = t->image ? t->image->n_references : 0;
    koksma__series s = {.kind = !t->image         ? "discrepancy"
                                : k < references  ? "image"
                                : k == references ? "coherence"
                                                  : "metric",
                        .metric = t->image && k > references ? t->image->metrics.at[k - references - 1] : "",
                        .scene = t->image ? t->scene->name : "",
                        .scene_hash = t->image ? t->scene->hash : "",
                        .options = t->variant,
                        .pattern = t->pattern,
                        .n = t->n,
                        .dim = t->image ? 0 : t->discrepancy->dim,
                        .width = t->width,
                        .height = t->height};
    if (t->image) {
        koksma__reference_name(&t->image->references[k < references ? k : references - 1], name);
        s.what = name;
    } else {
        s.what = t->measures[k];
    }
    return s;
}

/* The task that owns a series, and the trials of the series in the store. */
typedef struct owner {
    koksma__task *task;
    unsigned char *bits; /* one bit per trial, which tells whether the store has the trial */
} owner;

typedef struct owners {
    size_t n;
    owner *at; /* indexed by the id of the series */
} owners;

static void see_row(void *context, long long series, long long trial)
{
    const owners *o = context;
    if ((size_t)series < o->n && o->at[series].task && trial < o->at[series].task->trials) {
        o->at[series].bits[trial / 8] |= (unsigned char)(1u << trial % 8);
    }
}

/* Once `run` stops, creates no more series, but finds those that there are, so that done trials are known. No
   trial is done of a task that lacks a series, so its others need not be found. */
static koksma_status find_series(koksma__tasks *tasks, bool add, const koksma_run *run, owners *o)
{
    koksma_status status = KOKSMA_OK;
    long long most = 0;
    for (size_t i = 0; i < tasks->n; i++) {
        koksma__task *t = &tasks->at[i];
        for (size_t k = 0; !status && k < t->n_series && (add || !k || t->series[k - 1]); k++) {
            char name[KOKSMA__REFERENCE_NAME];
            const koksma__series series = koksma__task_series(t, k, name);
            add = add && koksma__keep_going(run, 0);
            status = koksma__store_series(tasks->study->store, &series, add, &t->series[k]);
            most = t->series[k] > most ? t->series[k] : most;
        }
    }
    KOKSMA__TRY(status);
    o->n = (size_t)most + 1;
    o->at = calloc(o->n, sizeof *o->at);
    status = o->at ? KOKSMA_OK : koksma__fail_memory(o->n * sizeof *o->at);
    for (size_t i = 0; !status && i < tasks->n; i++) {
        koksma__task *t = &tasks->at[i];
        for (size_t k = 0; !status && k < t->n_series; k++) {
            owner *own = &o->at[t->series[k]];
            if (t->series[k] && !own->task) { /* the first of those that share it has the most trials and owns it */
                own->bits = calloc(((size_t)t->trials + 7) / 8, 1);
                status = own->bits ? KOKSMA_OK : koksma__fail_memory((size_t)t->trials / 8);
                own->task = t;
            }
        }
    }
    return status;
}

/* Marks the trials of a task that are done: those that the store has in every series of the task. */
static void mark_done(koksma__task *t, const owners *o)
{
    const size_t bytes = ((size_t)t->trials + 7) / 8;
    memset(t->done, 0xff, bytes);
    for (size_t k = 0; k < t->n_series; k++) {
        for (size_t i = 0; i < bytes; i++) {
            t->done[i] &= t->series[k] ? o->at[t->series[k]].bits[i] : 0;
        }
    }
    t->done_before = 0;
    for (long long trial = 0; trial < t->trials; trial++) {
        t->done_before += koksma__task_is_done(t, trial);
    }
}

koksma_status koksma__tasks_look_up(koksma__tasks *tasks, bool add, const koksma_run *run)
{
    owners o = {0};
    koksma_status status = find_series(tasks, add, run, &o);
    status = status ? status : koksma__store_scan(tasks->study->store, false, see_row, &o);
    for (size_t i = 0; !status && i < tasks->n; i++) {
        mark_done(&tasks->at[i], &o);
    }
    for (size_t i = 0; o.at && i < o.n; i++) {
        free(o.at[i].bits);
    }
    free(o.at);
    return status;
}

koksma_status koksma__task_put(const koksma_study *study, const koksma__task *task, const koksma__result *results)
{
    return study->sink ? study->sink->put_job(study->sink->context, task, results)
                       : koksma__store_put(study->store, task->series, results, task->n_series);
}

bool koksma__ends_all(koksma_status status)
{
    return status == KOKSMA_INTERRUPTED || status == KOKSMA_MEMORY || status == KOKSMA_IO || status == KOKSMA_SYSTEM;
}

bool koksma__is_impossible(koksma_status status)
{
    return status == KOKSMA_IMPOSSIBLE || status == KOKSMA_N;
}

bool koksma__task_failed_alone(const koksma_study *study, koksma_status status)
{
    return koksma__is_impossible(status) || (study->sink && status && !koksma__ends_all(status));
}
