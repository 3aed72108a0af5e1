/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Estimates the cost of a study. Some jobs are timed until the time for the estimate is used up. Every other task is
 * assumed to cost what the nearest timed task of its block and scene costs, scaled by a power of n: the power that
 * the pattern showed between two timed values of n or, before two are timed, 1 for renders and 2 for point sets.
 * distance() defines the nearest task by n, pattern and variant. First the smallest n of every block and scene is
 * timed; then, repeatedly, of the tasks whose timing fits into the remaining time, the one whose cost is most
 * uncertain.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "study/run/references.h"
#include "study/run/run.h"
#include "study/run/run_control.h"
#include "study/run/tasks.h"

/* Bytes on disk: ROW for each row of table `result`, with its share of the B-tree; VALUE for each value in a row, which
   has up to VALUES of them (both measured on 1e5 rows of each kind); REFERENCE_PIXEL for each channel of each pixel of
   a reference. */
static const double ROW = 34, VALUE = 8, REFERENCE_PIXEL = 4;
enum { VALUES = KOKSMA__RESULT_VALUES };

typedef struct guess {
    koksma__task *task;
    size_t nearest; /* index of the timed task that the estimate is based on (a timed task's own index), or NONE */
    double seconds; /* the time of one job of the task */
} guess;

enum { NONE = -1 };

typedef struct guesses {
    guess *at; /* sorted by n, ascending */
    size_t n;
} guesses;

static int by_n(const void *a, const void *b)
{
    const koksma__task *s = ((const guess *)a)->task, *t = ((const guess *)b)->task;
    return s->n != t->n ? (s->n > t->n) - (s->n < t->n) : (s->place > t->place) - (s->place < t->place);
}

/* Whether the time of one task may be used to estimate the time of the other. */
static bool same_block(const koksma__task *s, const koksma__task *t)
{
    return s->image == t->image && s->discrepancy == t->discrepancy && s->scene == t->scene;
}

static bool same_kind(const koksma__task *s, const koksma__task *t)
{
    return same_block(s, t) && !strcmp(s->pattern, t->pattern) && !strcmp(s->variant, t->variant);
}

static bool is_timed(const guesses *g, size_t i)
{
    return g->at[i].nearest == i;
}

/* The distance of two tasks of one block: |log2| of the ratio of their n, plus 1/2 for different variants (like 1.4
   times the points), plus 1 for different patterns (like twice the points). */
static double distance(const koksma__task *s, const koksma__task *t)
{
    return fabs(koksma__log2((double)s->n / (double)t->n)) + (strcmp(s->pattern, t->pattern) ? 1 : 0) +
           (strcmp(s->variant, t->variant) ? 0.5 : 0);
}

/* Times are extrapolated from the size of timed task i to n by a power of the size. Returns its exponent, which follows
   from task i and the nearest timed task of the same pattern and variant, preferably one that is on the same side of
   task i as n. If no such task has been timed yet, returns the default exponent. */
static double power_at(const guesses *g, size_t i, long long n)
{
    const koksma__task *t = g->at[i].task;
    const bool up = n > t->n;
    double best = INFINITY, power = t->image ? 1 : 2;
    for (size_t j = 0; j < g->n; j++) {
        const koksma__task *other = g->at[j].task;
        if (is_timed(g, j) && other->n != t->n && same_kind(other, t)) {
            const double ratio = koksma__log((double)other->n / (double)t->n);
            /* a task on the other side of task i is used only if there is none on the side of n */
            const double far = fabs(ratio) + ((ratio > 0) == up ? 0 : 100);
            if (far < best) {
                best = far;
                power = koksma__log(g->at[j].seconds / g->at[i].seconds) / ratio;
            }
        }
    }
    return fmin(fmax(power, 0), 3);
}

/* Updates the estimates of all tasks in the block of task `timed`, which has just been timed. */
static void learn(guesses *g, size_t timed)
{
    g->at[timed].nearest = timed;
    for (size_t i = 0; i < g->n; i++) {
        guess *to = &g->at[i];
        if (is_timed(g, i) || !same_block(to->task, g->at[timed].task)) {
            continue;
        }
        if (to->nearest == (size_t)NONE ||
            distance(to->task, g->at[timed].task) < distance(to->task, g->at[to->nearest].task)) {
            to->nearest = timed;
        }
        const guess *from = &g->at[to->nearest];
        const double ratio = (double)to->task->n / (double)from->task->n;
        to->seconds = from->seconds *
                      (to->task->n == from->task->n ? 1 : koksma__pow(ratio, power_at(g, to->nearest, to->task->n)));
    }
}

/* Replaces each reference by a black picture of the same size, because timing needs only the size. */
static koksma_status stand_in(koksma_study *study, const koksma__task *task)
{
    for (size_t r = 0; task->image && r < task->n_series; r++) {
        koksma__reference_image *reference = &study->references[task->references[r]];
        if (!reference->image.pixels) {
            KOKSMA__TRY(koksma_image_init(&reference->image, reference->width, reference->height, 3));
        }
    }
    return KOKSMA_OK;
}

/* A single timing is unreliable on a busy machine: up to MOST_LOOKS trials are timed, until they took LONG_JOB
   seconds together. */
enum { MOST_LOOKS = 9 };
static const double LONG_JOB = 0.02;

static int compare_seconds(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The median processor time of several trials, which is the time of a job on an undisturbed thread. */
static koksma_status time_job(koksma_study *study, const koksma__task *task, const koksma_run *job, double *seconds)
{
    double looks[MOST_LOOKS], all = 0;
    int n = 0;
    koksma__result *results = calloc(task->n_series, sizeof *results);
    koksma_status status = results ? stand_in(study, task) : koksma__fail_memory(task->n_series * sizeof *results);
    for (; !status && n < MOST_LOOKS && (n == 0 || all < LONG_JOB); n++) {
        const double start = koksma__thread_s();
        status = koksma__task_do(study, task, n % task->trials, job, results);
        status = koksma__is_impossible(status) ? KOKSMA_OK : status; /* the time of a job that fails counts as well */
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
    const size_t rows = t->image ? t->n_series : (t->n_series + VALUES - 1) / VALUES;
    const size_t values = t->image ? VALUES * t->n_series - t->image->metrics.n : t->n_series;
    cost->bytes += trials * (ROW * (double)rows + VALUE * (double)values);
}

/* Lowers the time of a sample of each reference that a task is compared with to that of the task's samples: the task whose
   samples are cheapest is nearest to a reference, whose many samples are of a fast pattern. */
static void note_references(const koksma__task *t, double seconds, double *sample_s)
{
    for (size_t r = 0; t->image && r < t->n_series; r++) {
        sample_s[t->references[r]] = fmin(sample_s[t->references[r]], seconds / (double)t->n);
    }
}

/* Replaces *seconds, the time of a replicate as guessed from tasks, by that of three of its rows, times their share.
   Tasks of few samples spend more on metrics than on rendering. The guess stays where rows can't be rendered alone, or
   would take long. */
static koksma_status time_rows(const koksma__reference_image *reference, const koksma_run *job, double *seconds)
{
    enum { ROWS = 3 };
    const double most_s = 1;
    bool alone;
    KOKSMA__TRY(koksma__reference_rows_stand_alone(reference, &alone));
    if (!alone || *seconds / reference->height * ROWS > most_s) {
        return KOKSMA_OK;
    }
    koksma_status status = KOKSMA_OK;
    const double start = koksma__thread_s();
    for (int i = 0; i < ROWS && !status; i++) {
        koksma_image image = {0};
        status =
            koksma__reference_replicate(reference, 0, (2 * i + 1) * reference->height / (2 * ROWS), 1, job, &image);
        koksma_image_fini(&image);
    }
    if (!status) {
        *seconds = (koksma__thread_s() - start) * reference->height / ROWS;
    }
    return koksma__is_impossible(status) ? KOKSMA_OK : status;
}

/* Adds the references that tasks are compared with. */
static koksma_status add_references(koksma_study *study, const double *sample_s, const koksma_run *job,
                                    koksma_study_cost *cost)
{
    for (size_t r = 0; r < study->n_references; r++) {
        const koksma__reference_image *image = &study->references[r];
        double seconds = sample_s[r] * (double)image->reference->spp;
        if (isfinite(seconds)) {
            KOKSMA__TRY(time_rows(image, job, &seconds));
            cost->references++;
            cost->reference_seconds += seconds * (double)image->reference->replicates;
            cost->bytes += (double)image->width * image->height * 3 * REFERENCE_PIXEL;
        }
    }
    return KOKSMA_OK;
}

static koksma_status time_and_learn(koksma_study *study, guesses *g, size_t i, const koksma_run *job)
{
    KOKSMA__TRY(time_job(study, g->at[i].task, job, &g->at[i].seconds));
    learn(g, i);
    return KOKSMA_OK;
}

/* Chooses the task whose timing reduces the uncertainty most and fits into left_s seconds; g->n if there is none. */
static size_t choose(const guesses *g, double left_s)
{
    double most = 0;
    size_t best = g->n;
    for (size_t i = 0; i < g->n; i++) {
        const guess *from = &g->at[i];
        if (is_timed(g, i) || from->seconds > left_s) {
            continue;
        }
        const double gain =
            from->seconds * (double)from->task->trials * distance(from->task, g->at[from->nearest].task);
        best = gain > most ? i : best;
        most = fmax(gain, most);
    }
    return best;
}

static koksma_status time_tasks(koksma_study *study, guesses *g, const koksma_run *run, double budget_s)
{
    const double start_s = koksma__now_s();
    koksma__run_control w;
    koksma__run_control_begin(run, 0, &w);
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < g->n; i++) {
        if (g->at[i].nearest == (size_t)NONE) {
            status = koksma__keep_going(&w.run, 0) ? time_and_learn(study, g, i, &w.job) : koksma__fail_interrupted();
        }
    }
    for (;;) {
        const double passed_s = koksma__now_s() - start_s;
        const size_t i = status || passed_s > budget_s ? g->n : choose(g, budget_s - passed_s);
        if (i == g->n) {
            return status;
        }
        status = koksma__keep_going(&w.run, passed_s / budget_s) ? time_and_learn(study, g, i, &w.job)
                                                                 : koksma__fail_interrupted();
    }
}

static koksma_status estimate_kind(koksma_study *study, bool images, const koksma_run *run, double budget_s,
                                   koksma_study_cost *cost)
{
    koksma__tasks tasks;
    KOKSMA__TRY(koksma__tasks_open(study, images, &tasks));
    guesses g = {calloc(tasks.n + 1, sizeof *g.at), tasks.n};
    double *sample_s = calloc(study->n_references + 1, sizeof *sample_s);
    koksma_status status = g.at && sample_s ? KOKSMA_OK : koksma__fail_memory(tasks.n * sizeof *g.at);
    for (size_t i = 0; !status && i < g.n; i++) {
        g.at[i] = (guess){&tasks.at[i], (size_t)NONE, 0};
    }
    if (!status && tasks.n) {
        qsort(g.at, g.n, sizeof *g.at, by_n);
        status = time_tasks(study, &g, run, budget_s);
    }
    for (size_t r = 0; sample_s && r < study->n_references; r++) {
        sample_s[r] = (double)INFINITY;
    }
    for (size_t i = 0; !status && i < g.n; i++) {
        add_task(g.at[i].task, g.at[i].seconds, cost);
        note_references(g.at[i].task, g.at[i].seconds, sample_s);
    }
    if (!status) {
        const koksma_run job = {.threads = 1};
        status = add_references(study, sample_s, &job, cost);
    }
    cost->jobs += tasks.n_jobs;
    free(g.at);
    free(sample_s);
    koksma__tasks_close(&tasks);
    return status;
}

koksma_status koksma_study_estimate(koksma_study *study, const koksma_run *run, koksma_study_cost *out)
{
    KOKSMA__REQUIRE(study, out);
    KOKSMA__REQUIRE_RUN(run);
    const double start_s = koksma__now_s(), budget_s = run && run->time_limit_s > 0 ? run->time_limit_s : 5;
    const bool both = study->plan.n_discrepancies && study->plan.n_images;
    *out = (koksma_study_cost){0};
    koksma__mpi_release();
    koksma_status status = estimate_kind(study, false, run, both ? budget_s / 2 : budget_s, out);
    const double left_s = budget_s - (koksma__now_s() - start_s);
    status = status ? status : estimate_kind(study, true, run, fmax(left_s, budget_s / 4), out);
    out->seconds += out->reference_seconds;
    /* frees the black pictures, which must not be used as references */
    for (size_t i = 0; i < study->n_references; i++) {
        koksma_image_fini(&study->references[i].image);
    }
    return status;
}
