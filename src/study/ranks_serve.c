/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Rank 0 of an MPI run. A batch stays with a rank until its results are in. When nothing else is left, what is still
 * out is done again here: a rank that was lost costs its batch, where MPI lets the others live on; else the run ends,
 * and the same command goes on from the store.
 *
 * Long because what is dealt out and what comes back stand together here.
 */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "study/clocks.h"
#include "study/queue.h"
#include "study/ranks.h"

/* Ranks have a batch in hand while they ask for the next, so that the answer may take as long as this. */
static const double REST_S = 1e-3;
/* How long ranks that say nothing are waited for at the end. */
static const double GOODBYE_S = 30;

typedef struct server {
    koksma__pool *pool;
    const koksma__transport *mpi;
    int size, phase;
    pthread_mutex_t lock; /* guards what follows */
    koksma__parts parts;
    koksma__queue part_queue, jobs;
    koksma_status status;
    char text[KOKSMA__RANK_TEXT];
    bool *ready; /* references that have their pixels */
    /* For the serving thread alone: */
    koksma__ask *said; /* by each rank, last */
    bool *ended;       /* ranks that know that the phase is over */
} server;

static void stop(server *s, koksma_status status, const char *text)
{
    pthread_mutex_lock(&s->lock);
    if (!s->status) {
        s->status = status;
        snprintf(s->text, sizeof s->text, "%s", text);
    }
    pthread_mutex_unlock(&s->lock);
}

static bool is_over(server *s)
{
    pthread_mutex_lock(&s->lock);
    const bool over = s->status || (s->part_queue.left == 0 && s->jobs.left == 0);
    pthread_mutex_unlock(&s->lock);
    return over;
}

/* ---- What to do next ----------------------------------------------------------------------------------- */

static bool job_is_ready(const void *context, size_t job)
{
    const server *s = context;
    long long trial;
    const koksma__task *task = koksma__tasks_job(s->pool->tasks, job, &trial);
    bool ready = true;
    for (size_t r = 0; task->image && r < task->n_series; r++) {
        ready &= s->ready[task->references[r]];
    }
    return ready;
}

/* Parts before jobs: jobs wait for them. With `lost`, when nothing else is left, something that is still out. */
static bool take(server *s, bool lost, koksma__deal *deal)
{
    size_t i;
    bool found = false;
    *deal = (koksma__deal){0};
    pthread_mutex_lock(&s->lock);
    if (s->status) {
        found = false;
    } else if (koksma__queue_take(&s->part_queue, 1, NULL, NULL, &i) ||
               (lost && s->part_queue.left && koksma__queue_take_lost(&s->part_queue, &i))) {
        *deal = (koksma__deal){.kind = KOKSMA__DEAL_PART, .number = i, .part = s->parts.at[i]};
        found = true;
    } else if (koksma__queue_take(&s->jobs, s->pool->tasks->n, job_is_ready, s, &i) ||
               (lost && !s->part_queue.left && koksma__queue_take_lost(&s->jobs, &i))) {
        *deal = (koksma__deal){.kind = KOKSMA__DEAL_JOB, .number = i};
        found = true;
    }
    pthread_mutex_unlock(&s->lock);
    return found;
}

/* ---- What comes in ------------------------------------------------------------------------------------- */

static void put_job(server *s, size_t job, const koksma__task *task, const koksma__result *results)
{
    pthread_mutex_lock(&s->lock);
    const bool is_new = koksma__queue_put(&s->jobs, job);
    pthread_mutex_unlock(&s->lock);
    const koksma_status status = is_new ? koksma__task_put(s->pool->tasks->study->store, task, results) : KOKSMA_OK;
    if (status) {
        stop(s, status, koksma_error_text());
        return;
    }
    atomic_fetch_add(&s->pool->done, is_new);
}

/* The number of a part that a rank has sent back; parts.n: no such. */
static size_t number_of(const server *s, const koksma__part *part)
{
    size_t i = 0;
    while (i < s->parts.n && (s->parts.at[i].reference != part->reference ||
                              s->parts.at[i].first_row != part->first_row || s->parts.at[i].rows != part->rows)) {
        i++;
    }
    return i;
}

/* A reference is ready when its file is there, not with its last part; jobs are left as long as one is in the making.
 */
static void put_part(server *s, size_t i, const koksma__replicates *sums)
{
    const koksma__part part = s->parts.at[i];
    bool complete = false;
    koksma_status status = KOKSMA_OK;
    pthread_mutex_lock(&s->lock);
    if (koksma__queue_put(&s->part_queue, i)) {
        status = koksma__parts_put(&s->parts, &part, sums, &complete);
    }
    pthread_mutex_unlock(&s->lock);
    status = !status && complete ? koksma__parts_finish(&s->parts, part.reference) : status;
    if (status) {
        stop(s, status, koksma_error_text());
        return;
    }
    pthread_mutex_lock(&s->lock);
    s->ready[part.reference] |= complete;
    pthread_mutex_unlock(&s->lock);
}

/* ---- Work on this rank --------------------------------------------------------------------------------- */

static void do_job_here(server *s, size_t job)
{
    long long trial;
    const koksma__task *task = koksma__tasks_job(s->pool->tasks, job, &trial);
    koksma__result *results = calloc(task->n_series, sizeof *results);
    const koksma_status status =
        results ? koksma__task_do(s->pool->tasks->study, task, trial, &s->pool->watch->job, results)
                : koksma__fail_memory(task->n_series * sizeof *results);
    if (status) {
        stop(s, status, koksma_error_text());
    } else {
        put_job(s, job, task, results);
    }
    free(results);
}

static void do_part_here(server *s, size_t i)
{
    koksma__replicates sums = {0};
    const koksma_status status = koksma__part_do(s->pool->tasks->study, &s->parts.at[i], &s->pool->watch->job, &sums);
    if (status) {
        stop(s, status, koksma_error_text());
    } else {
        put_part(s, i, &sums);
    }
    free(sums.sum);
}

/* Until all results are in. */
static void *work_here(void *context)
{
    server *s = context;
    koksma__deal deal;
    double waiting_s = koksma__now_s(), took_s = 0;
    while (!is_over(s)) {
        /* A batch is late when it takes much longer than a job here; then it may be lost. */
        const bool late = koksma__now_s() - waiting_s > 1 + 20 * took_s;
        if (!take(s, late, &deal)) {
            koksma__ranks_rest(REST_S / 4);
            continue;
        }
        const double start_s = koksma__now_s();
        if (deal.kind == KOKSMA__DEAL_JOB) {
            do_job_here(s, deal.number);
        } else {
            do_part_here(s, deal.number);
        }
        koksma__pool_was_busy(s->pool, start_s);
        waiting_s = koksma__now_s();
        took_s = waiting_s - start_s;
    }
    return NULL;
}

/* ---- Messages ------------------------------------------------------------------------------------------ */

static void send_pixels(server *s, int to)
{
    unsigned long long index;
    if (!s->mpi->receive(to, KOKSMA__TAG_NEED, &index, sizeof index, NULL) ||
        index >= s->pool->tasks->study->n_references) {
        return;
    }
    const koksma_image *image = &s->pool->tasks->study->references[index].image;
    const int shape[3] = {image->width, image->height, image->channels};
    const size_t pixels = (size_t)shape[0] * (size_t)shape[1] * (size_t)shape[2];
    s->mpi->send(to, KOKSMA__TAG_PIXELS, shape, sizeof shape);
    s->mpi->send(to, KOKSMA__TAG_PIXELS, image->pixels, pixels * sizeof *image->pixels);
}

static void receive_results(server *s, unsigned char *message, size_t bytes)
{
    unsigned long long job;
    for (size_t at = 0; at + sizeof job < bytes;) {
        long long trial;
        memcpy(&job, message + at, sizeof job);
        at += sizeof job;
        const koksma__task *task = koksma__tasks_job(s->pool->tasks, job, &trial);
        const size_t size = task->n_series * sizeof(koksma__result);
        koksma__result *results = malloc(size);
        if (!results || at + size > bytes) {
            stop(s, KOKSMA_MEMORY, "out of memory for results");
            free(results);
            return;
        }
        memcpy(results, message + at, size);
        put_job(s, job, task, results);
        free(results);
        at += size;
    }
}

static void receive_part(server *s, unsigned char *message, size_t bytes)
{
    koksma__part part;
    if (bytes < sizeof part) {
        return;
    }
    memcpy(&part, message, sizeof part);
    const size_t i = number_of(s, &part), count = (bytes - sizeof part) / (2 * sizeof(double));
    double *sum = malloc(bytes - sizeof part);
    if (!sum) {
        stop(s, KOKSMA_MEMORY, "out of memory for a part of a reference");
    } else if (i < s->parts.n) {
        memcpy(sum, message + sizeof part, bytes - sizeof part);
        put_part(s, i, &(koksma__replicates){.sum = sum, .squares = sum + count, .count = count});
    }
    free(sum);
}

static void receive_work(server *s, int from, int tag, size_t bytes)
{
    unsigned char *message = malloc(bytes ? bytes : 1);
    if (!message) {
        stop(s, KOKSMA_MEMORY, "out of memory for a message");
    } else if (s->mpi->receive(from, tag, message, bytes, NULL)) {
        (tag == KOKSMA__TAG_PART ? receive_part : receive_results)(s, message, bytes);
    }
    free(message);
}

/* Jobs of about BATCH_S together, or a few parts; fewer towards the end, so that nobody is left with many. */
static size_t fill(server *s, double job_s, koksma__deal deals[KOKSMA__MAX_BATCH])
{
    pthread_mutex_lock(&s->lock);
    const koksma__queue *queue = s->part_queue.next < s->part_queue.n ? &s->part_queue : &s->jobs;
    const size_t share = (queue->n - queue->next) / (size_t)(4 * s->size) + 1;
    const double fit = queue == &s->part_queue ? 6 : job_s > 0 ? KOKSMA__BATCH_S / job_s : 1;
    pthread_mutex_unlock(&s->lock);
    size_t batch = fit < 1 ? 1 : fit > KOKSMA__MAX_BATCH ? KOKSMA__MAX_BATCH : (size_t)fit, n = 0;
    batch = batch < share ? batch : share;
    while (n < batch && take(s, false, &deals[n])) {
        n++;
    }
    return n;
}

/* Answers a request; with nothing when there is nothing now. */
static void deal(server *s, int to)
{
    koksma__ask ask;
    koksma__deal deals[KOKSMA__MAX_BATCH];
    size_t n = 0;
    s->mpi->receive(to, KOKSMA__TAG_ASK, &ask, sizeof ask, NULL);
    const bool now = (int)ask.phase == s->phase;
    if (now) {
        s->said[to] = ask;
        n = fill(s, ask.job_s, deals);
    }
    if (n == 0 && (is_over(s) ? (int)ask.phase <= s->phase || s->status : (int)ask.phase < s->phase)) {
        deals[n++] = (koksma__deal){.kind = s->status ? KOKSMA__DEAL_RUN_OVER : KOKSMA__DEAL_PHASE_OVER};
        s->ended[to] = s->ended[to] || now || s->status;
    }
    s->mpi->send(to, KOKSMA__TAG_DEAL, deals, n * sizeof *deals);
}

/* One message, if there is one. */
static bool serve_one(server *s)
{
    int from, tag;
    size_t bytes;
    if (!s->mpi->probe(&from, &tag, &bytes)) {
        return false;
    }
    char text[KOKSMA__RANK_TEXT] = "";
    switch (tag) {
    case KOKSMA__TAG_ASK:
        deal(s, from);
        break;
    case KOKSMA__TAG_NEED:
        send_pixels(s, from);
        break;
    case KOKSMA__TAG_RESULTS:
    case KOKSMA__TAG_PART:
        receive_work(s, from, tag, bytes);
        break;
    case KOKSMA__TAG_ERROR:
        s->mpi->receive(from, KOKSMA__TAG_ERROR, text, sizeof text, NULL);
        stop(s, (koksma_status)text[0], text + 1);
        break;
    default:
        break;
    }
    return true;
}

static bool all_ended(const server *s)
{
    bool all = true;
    for (int r = 1; r < s->size; r++) {
        all &= s->ended[r];
    }
    return all;
}

/* Until all results are in, and then for those who are still to be told; a rank that says nothing for long is lost.
 */
static void serve(server *s)
{
    const size_t n = s->jobs.n;
    double over_s = 0;
    for (;;) {
        const bool served = serve_one(s), over = is_over(s);
        pthread_mutex_lock(&s->lock);
        const double fraction = n ? 1 - (double)s->jobs.left / (double)n : 1;
        pthread_mutex_unlock(&s->lock);
        over_s = !over ? 0 : over_s > 0 ? over_s : koksma__now_s();
        if (over && (all_ended(s) || koksma__now_s() - over_s > GOODBYE_S)) {
            return;
        }
        if (!over && !koksma__keep_going(&s->pool->watch->run, fraction)) {
            stop(s, KOKSMA_INTERRUPTED, "interrupted");
        }
        if (!served) {
            koksma__ranks_rest(REST_S);
        }
    }
}

/* ---- The whole ----------------------------------------------------------------------------------------- */

static koksma_status open_server(server *s)
{
    const koksma__tasks *tasks = s->pool->tasks;
    const size_t n_references = tasks->study->n_references;
    s->said = calloc((size_t)s->size, sizeof *s->said);
    s->ended = calloc((size_t)s->size, sizeof *s->ended);
    s->ready = calloc(n_references + 1, sizeof *s->ready);
    koksma_status status = s->said && s->ended && s->ready ? KOKSMA_OK : koksma__fail_memory((size_t)s->size);
    status = status ? status : koksma__parts_open(tasks, &s->parts);
    status = status ? status : koksma__queue_open(s->parts.n, &s->part_queue);
    status = status ? status : koksma__queue_open(tasks->n_jobs, &s->jobs);
    for (size_t i = 0; i < n_references && !status; i++) {
        s->ready[i] = tasks->study->references[i].image.pixels != NULL;
    }
    for (size_t i = 0; i < tasks->n_jobs && !status; i++) {
        long long trial;
        const koksma__task *task = koksma__tasks_job(tasks, i, &trial);
        if (koksma__task_is_done(task, trial)) {
            koksma__queue_put(&s->jobs, i);
        }
    }
    return status;
}

static void close_server(server *s)
{
    koksma__queue_close(&s->part_queue);
    koksma__queue_close(&s->jobs);
    if (s->parts.sums) {
        koksma__parts_close(&s->parts);
    }
    free(s->said);
    free(s->ended);
    free(s->ready);
    pthread_mutex_destroy(&s->lock);
}

koksma_status koksma__pool_serve(koksma__pool *pool)
{
    koksma__ranks *ranks = koksma__ranks_get();
    server s = {.pool = pool,
                .mpi = ranks->mpi,
                .size = ranks->size,
                .phase = pool->tasks->n && pool->tasks->at[0].image,
                .lock = PTHREAD_MUTEX_INITIALIZER};
    pthread_t helper;
    koksma_status status = open_server(&s);
    if (status && !s.ended) {
        close_server(&s);
        return status;
    }
    if (status) {
        stop(&s, status, koksma_error_text());
    }
    const bool helped = !pthread_create(&helper, NULL, work_here, &s);
    serve(&s);
    if (helped) {
        pthread_join(helper, NULL);
    }
    for (int r = 1; r < s.size; r++) {
        atomic_fetch_add(&pool->busy_ns, (unsigned long long)(1e9 * s.said[r].busy_s));
        pool->others_s += s.said[r].processor_s;
    }
    ranks->released = s.status || pool->last;
    status = s.status ? koksma__fail(s.status, "%s", s.text) : KOKSMA_OK;
    close_server(&s);
    return status;
}
