/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a study would cost. Some jobs of every task are timed, those of few points first, until the time for it is up.
 * A task that was not timed is taken to grow from the nearest smaller one of the same pattern, scene and variant:
 * renders with the samples, point sets with the power of n that the two largest timed ones show (2 when there is one
 * only).
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "study/clocks.h"
#include "study/tasks.h"

/* Of a row of table result, with its share of the tree (measured on 1e5 rows of each kind), and a reference's pixel.
 */
static const double DISCREPANCY_ROW = 38, IMAGE_ROW = 66, REFERENCE_PIXEL = 4;

static int by_n(const void *a, const void *b)
{
    const koksma__task *s = *(koksma__task *const *)a, *t = *(koksma__task *const *)b;
    return s->n != t->n ? (s->n > t->n) - (s->n < t->n) : (s->place > t->place) - (s->place < t->place);
}

static bool same_kind(const koksma__task *s, const koksma__task *t)
{
    return s->image == t->image && s->discrepancy == t->discrepancy && s->scene == t->scene &&
           !strcmp(s->pattern, t->pattern) && !strcmp(s->variant, t->variant);
}

/* From the timed tasks before `at` in the order of n. */
static double extrapolate(koksma__task *const *tasks, const double *seconds, size_t at)
{
    size_t last = at, before = at;
    for (size_t i = at; i-- > 0;) {
        if (same_kind(tasks[i], tasks[at])) {
            before = last < at && before == at && tasks[i]->n < tasks[last]->n ? i : before;
            last = last == at ? i : last;
        }
    }
    if (last == at) {
        return at ? seconds[at - 1] * (double)tasks[at]->n / (double)tasks[at - 1]->n : 0;
    }
    double power = tasks[at]->image ? 1 : 2;
    if (!tasks[at]->image && before < at && seconds[before] > 0) {
        power = log(seconds[last] / seconds[before]) / log((double)tasks[last]->n / (double)tasks[before]->n);
        power = fmin(fmax(power, 0), 3);
    }
    return seconds[last] * pow((double)tasks[at]->n / (double)tasks[last]->n, power);
}

/* A picture of zeros in place of a reference: it only has to have its size. */
static koksma_status stand_in(koksma_study *study, const koksma__task *task)
{
    koksma_status status = KOKSMA_OK;
    for (size_t r = 0; task->image && !status && r < task->n_series; r++) {
        koksma__reference_image *reference = &study->references[task->references[r]];
        if (!reference->image.pixels) {
            status = koksma_image_init(&reference->image, reference->width, reference->height, 3);
        }
    }
    return status;
}

/* One timing may be anything on a machine with other work: trials are timed until they took LONG_JOB together. */
enum { MOST_LOOKS = 9 };
static const double LONG_JOB = 0.05;

static int compare_seconds(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The median of several trials, in processor time: that is what a thread of its own would take. */
static koksma_status time_job(koksma_study *study, const koksma__task *task, double *seconds)
{
    double looks[MOST_LOOKS], all = 0;
    int n = 0;
    koksma__result *results = calloc(task->n_series, sizeof *results);
    koksma_status status = results ? stand_in(study, task) : koksma__fail_memory(task->n_series * sizeof *results);
    for (; !status && n < MOST_LOOKS && (n == 0 || all < LONG_JOB); n++) {
        const double start = koksma__thread_s();
        status = koksma__task_do(study, task, n % task->trials, results);
        looks[n] = koksma__thread_s() - start;
        all += looks[n];
    }
    if (!status) {
        qsort(looks, (size_t)n, sizeof *looks, compare_seconds);
        *seconds = looks[n / 2];
    }
    free(results);
    return status;
}

static void add_task(const koksma__task *t, double seconds, koksma_study_cost *cost)
{
    const double trials = (double)t->trials;
    cost->rows += (uint64_t)t->trials * t->n_series;
    cost->seconds += seconds * trials;
    cost->bytes += trials * (double)t->n_series * (t->image ? IMAGE_ROW : DISCREPANCY_ROW);
}

/* A reference takes the time of the tasks that are compared with it, sample for sample. */
static void add_references(koksma_study *study, const koksma__task *t, double seconds, bool *counted,
                           koksma_study_cost *cost)
{
    for (size_t r = 0; t->image && r < t->n_series; r++) {
        const koksma__reference_image *image = &study->references[t->references[r]];
        if (!counted[t->references[r]]) {
            counted[t->references[r]] = true;
            const double samples = (double)image->reference->spp * (double)image->reference->replicates;
            cost->references++;
            cost->reference_seconds += seconds * samples / (double)t->n;
            cost->bytes += (double)image->width * image->height * 3 * REFERENCE_PIXEL;
        }
    }
}

static koksma_status estimate_kind(koksma_study *study, bool images, const koksma_run *run, double budget_s,
                                   koksma_study_cost *cost)
{
    koksma__tasks tasks;
    koksma_status status = koksma__tasks_open(study, images, &tasks);
    if (status) {
        return status;
    }
    koksma__task **order = calloc(tasks.n + 1, sizeof *order);
    double *seconds = calloc(tasks.n + 1, sizeof *seconds);
    bool *counted = calloc(study->n_references + 1, sizeof *counted);
    status = order && seconds && counted ? KOKSMA_OK : koksma__fail_memory(tasks.n * sizeof *order);
    for (size_t i = 0; order && i < tasks.n; i++) {
        order[i] = &tasks.at[i];
    }
    if (!status && tasks.n) {
        qsort(order, tasks.n, sizeof *order, by_n);
    }
    const double end = koksma__now_s() + budget_s;
    for (size_t i = 0; !status && i < tasks.n; i++) {
        if (!koksma__keep_going(run, (double)i / (double)tasks.n)) {
            status = koksma__fail_interrupted();
        } else if (koksma__now_s() + extrapolate(order, seconds, i) < end) {
            status = time_job(study, order[i], &seconds[i]);
        } else {
            seconds[i] = extrapolate(order, seconds, i);
        }
        if (!status) {
            add_task(order[i], seconds[i], cost);
            add_references(study, order[i], seconds[i], counted, cost);
        }
    }
    cost->jobs += tasks.n_jobs;
    free(order);
    free(seconds);
    free(counted);
    koksma__tasks_close(&tasks);
    return status;
}

koksma_status koksma_study_estimate(koksma_study *study, const koksma_run *run, koksma_study_cost *out)
{
    const double budget_s = run && run->time_limit_s > 0 ? run->time_limit_s : 5;
    *out = (koksma_study_cost){0};
    koksma_status status = estimate_kind(study, false, run, budget_s / 2, out);
    status = status ? status : estimate_kind(study, true, run, budget_s / 2, out);
    out->seconds += out->reference_seconds;
    for (size_t i = 0; i < study->n_references; i++) { /* the stand-ins must not be taken for references */
        koksma_image_fini(&study->references[i].image);
    }
    return status;
}
