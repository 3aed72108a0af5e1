/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Rank 0 of an MPI run: messages, and work of its own. A batch stays with a rank until its results are in. When
 * nothing else is left, what is still out is done again here: a rank that was lost costs its batch, where MPI lets
 * the others live on; else the run ends, and the same command goes on from the store.
 */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/processor_clock.h"
#include "core/status.h"
#include "study/run/mpi_ranks.h"
#include "study/run/run_state.h"

/* Ranks have a batch in hand while they ask for the next, so that the answer may take as long as this. */
static const double REST_S = 1e-3;
/* How long ranks that say nothing are waited for at the end. */
static const double GOODBYE_S = 30;

typedef struct server {
    koksma__pool *pool;
    const koksma__transport *mpi;
    int size, phase;
    koksma__ledger ledger;
    /* For the serving thread alone: */
    koksma__ask *said; /* by each rank, last */
    bool *ended;       /* ranks that know that the phase is over */
} server;

/* ---- Work on this rank --------------------------------------------------------------------------------- */

static void do_job_here(server *s, size_t job)
{
    long long trial;
    const koksma__task *task = koksma__tasks_job(s->pool->tasks, job, &trial);
    koksma__result *results = calloc(task->n_series, sizeof *results);
    const koksma_status status =
        results ? koksma__task_do(s->pool->tasks->study, task, trial, &s->pool->watch->job, results)
                : koksma__fail_memory(task->n_series * sizeof *results);
    if (status == KOKSMA_IMPOSSIBLE) {
        koksma__ledger_refuse_job(&s->ledger, job, koksma_error_text());
    } else if (status) {
        koksma__ledger_stop(&s->ledger, status, koksma_error_text());
    } else {
        koksma__ledger_put_job(&s->ledger, job, task, results);
    }
    free(results);
}

static void do_part_here(server *s, size_t i)
{
    koksma__replicates sums = {0};
    const koksma_status status =
        koksma__part_do(s->pool->tasks->study, &s->ledger.parts.at[i], &s->pool->watch->job, &sums);
    if (status) {
        koksma__ledger_stop(&s->ledger, status, koksma_error_text());
    } else {
        koksma__ledger_put_part(&s->ledger, i, &sums);
    }
    free(sums.sum);
}

/* Until all results are in. */
static void *work_here(void *context)
{
    server *s = context;
    koksma__deal deal;
    double waiting_s = koksma__now_s(), took_s = 0;
    while (!koksma__ledger_is_over(&s->ledger)) {
        /* A batch is late when it takes much longer than a job here; then it may be lost. */
        const bool late = koksma__now_s() - waiting_s > 1 + 20 * took_s;
        if (!koksma__ledger_take(&s->ledger, late, &deal)) {
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
            koksma__ledger_stop(&s->ledger, KOKSMA_MEMORY, "out of memory for results");
            free(results);
            return;
        }
        memcpy(results, message + at, size);
        koksma__ledger_put_job(&s->ledger, job, task, results);
        free(results);
        at += size;
    }
}

static void receive_refusal(server *s, int from)
{
    koksma__refusal refusal;
    if (s->mpi->receive(from, KOKSMA__TAG_REFUSAL, &refusal, sizeof refusal, NULL) &&
        refusal.job < s->pool->tasks->n_jobs) {
        koksma__ledger_refuse_job(&s->ledger, refusal.job, refusal.text);
    }
}

static void receive_part(server *s, unsigned char *message, size_t bytes)
{
    koksma__part part;
    if (bytes < sizeof part) {
        return;
    }
    memcpy(&part, message, sizeof part);
    const size_t i = koksma__ledger_part(&s->ledger, &part);
    double *numbers = malloc(bytes - sizeof part);
    if (!numbers) {
        koksma__ledger_stop(&s->ledger, KOKSMA_MEMORY, "out of memory for a part of a reference");
    } else if (i < s->ledger.parts.n) {
        const int width = s->pool->tasks->study->references[part.reference].width;
        memcpy(numbers, message + sizeof part, bytes - sizeof part);
        const koksma__replicates sums = koksma__replicates_over(numbers, (bytes - sizeof part) / sizeof *numbers,
                                                                (size_t)width * (size_t)part.rows);
        koksma__ledger_put_part(&s->ledger, i, &sums);
    }
    free(numbers);
}

static void receive_work(server *s, int from, int tag, size_t bytes)
{
    unsigned char *message = malloc(bytes ? bytes : 1);
    if (!message) {
        koksma__ledger_stop(&s->ledger, KOKSMA_MEMORY, "out of memory for a message");
    } else if (s->mpi->receive(from, tag, message, bytes, NULL)) {
        (tag == KOKSMA__TAG_PART ? receive_part : receive_results)(s, message, bytes);
    }
    free(message);
}

/* Answers a rank's request for jobs; the answer is empty when no job is ready. */
static void deal(server *s, int to)
{
    koksma__ask ask;
    koksma__deal deals[KOKSMA__MAX_BATCH];
    size_t n = 0;
    s->mpi->receive(to, KOKSMA__TAG_ASK, &ask, sizeof ask, NULL);
    const bool now = (int)ask.phase == s->phase;
    if (now) {
        s->said[to] = ask;
        n = koksma__ledger_take_batch(&s->ledger, ask.job_s, s->size, deals);
    }
    if (n == 0 && (koksma__ledger_is_over(&s->ledger) ? (int)ask.phase <= s->phase || s->ledger.status
                                                      : (int)ask.phase < s->phase)) {
        deals[n++] = (koksma__deal){.kind = s->ledger.status ? KOKSMA__DEAL_RUN_OVER : KOKSMA__DEAL_PHASE_OVER};
        s->ended[to] = s->ended[to] || now || s->ledger.status;
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
    case KOKSMA__TAG_REFUSAL:
        receive_refusal(s, from);
        break;
    case KOKSMA__TAG_RESULTS:
    case KOKSMA__TAG_PART:
        receive_work(s, from, tag, bytes);
        break;
    case KOKSMA__TAG_ERROR:
        s->mpi->receive(from, KOKSMA__TAG_ERROR, text, sizeof text, NULL);
        koksma__ledger_stop(&s->ledger, (koksma_status)text[0], text + 1);
        s->ended[from] = true;
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
    double over_s = 0;
    for (;;) {
        const bool served = serve_one(s), over = koksma__ledger_is_over(&s->ledger);
        over_s = !over ? 0 : over_s > 0 ? over_s : koksma__now_s();
        if (over && (all_ended(s) || koksma__now_s() - over_s > GOODBYE_S)) {
            return;
        }
        if (!over && !koksma__keep_going(&s->pool->watch->run, koksma__ledger_fraction(&s->ledger))) {
            koksma__ledger_stop(&s->ledger, KOKSMA_INTERRUPTED, "interrupted");
        }
        if (!served) {
            koksma__ranks_rest(REST_S);
        }
    }
}

/* ---- The whole ----------------------------------------------------------------------------------------- */

static koksma_status open_server(server *s)
{
    s->said = calloc((size_t)s->size, sizeof *s->said);
    s->ended = calloc((size_t)s->size, sizeof *s->ended);
    const koksma_status status = koksma__ledger_open(s->pool, &s->ledger);
    return s->said && s->ended ? status : koksma__fail_memory((size_t)s->size);
}

static void close_server(server *s)
{
    koksma__ledger_close(&s->ledger);
    free(s->said);
    free(s->ended);
}

koksma_status koksma__pool_serve(koksma__pool *pool)
{
    koksma__ranks *ranks = koksma__ranks_get();
    server s = {
        .pool = pool, .mpi = ranks->mpi, .size = ranks->size, .phase = pool->tasks->n && pool->tasks->at[0].image};
    pthread_t helper;
    koksma_status status = open_server(&s);
    if (status && !(s.said && s.ended)) {
        close_server(&s);
        return status;
    }
    if (status) {
        koksma__ledger_stop(&s.ledger, status, koksma_error_text());
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
    ranks->released = s.ledger.status || pool->last;
    status = s.ledger.status ? koksma__fail(s.ledger.status, "%s", s.ledger.text) : KOKSMA_OK;
    close_server(&s);
    return status;
}
