/* SPDX-License-Identifier: Apache-2.0 */
#include "study/run/run_state.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"

void koksma__ledger_stop(koksma__ledger *ledger, koksma_status status, const char *text)
{
    pthread_mutex_lock(&ledger->lock);
    if (!ledger->status) {
        ledger->status = status;
        snprintf(ledger->text, sizeof ledger->text, "%s", text);
    }
    pthread_mutex_unlock(&ledger->lock);
}

bool koksma__ledger_is_over(koksma__ledger *ledger)
{
    pthread_mutex_lock(&ledger->lock);
    const bool over = ledger->status || (ledger->part_queue.left == 0 && ledger->jobs.left == 0);
    pthread_mutex_unlock(&ledger->lock);
    return over;
}

double koksma__ledger_fraction(koksma__ledger *ledger)
{
    const size_t n = ledger->jobs.n;
    pthread_mutex_lock(&ledger->lock);
    const double fraction = n ? 1 - (double)ledger->jobs.left / (double)n : 1;
    pthread_mutex_unlock(&ledger->lock);
    return fraction;
}

/* ---- What to do next ----------------------------------------------------------------------------------- */

static bool job_is_ready(const void *context, size_t job)
{
    const koksma__ledger *ledger = context;
    long long trial;
    const koksma__task *task = koksma__tasks_job(ledger->pool->tasks, job, &trial);
    bool ready = true;
    for (size_t r = 0; task->image && r < task->n_series; r++) {
        ready &= ledger->ready[task->references[r]];
    }
    return ready;
}

bool koksma__ledger_take(koksma__ledger *ledger, bool lost, koksma__deal *deal)
{
    size_t i;
    bool found = false;
    *deal = (koksma__deal){0};
    pthread_mutex_lock(&ledger->lock);
    const bool failed = ledger->status != KOKSMA_OK;
    if (!failed && (koksma__queue_take(&ledger->part_queue, 1, NULL, NULL, &i) ||
                    (lost && ledger->part_queue.left && koksma__queue_take_lost(&ledger->part_queue, &i)))) {
        *deal = (koksma__deal){.kind = KOKSMA__DEAL_PART, .number = i, .part = ledger->parts.at[i]};
        found = true;
    } else if (!failed && (koksma__queue_take(&ledger->jobs, ledger->pool->tasks->n, job_is_ready, ledger, &i) ||
                           (lost && !ledger->part_queue.left && koksma__queue_take_lost(&ledger->jobs, &i)))) {
        *deal = (koksma__deal){.kind = KOKSMA__DEAL_JOB, .number = i};
        found = true;
    }
    pthread_mutex_unlock(&ledger->lock);
    return found;
}

size_t koksma__ledger_take_batch(koksma__ledger *ledger, double job_s, int ranks,
                                 koksma__deal deals[KOKSMA__MAX_BATCH])
{
    pthread_mutex_lock(&ledger->lock);
    const koksma__queue *queue = ledger->part_queue.next < ledger->part_queue.n ? &ledger->part_queue : &ledger->jobs;
    const size_t share = (queue->n - queue->next) / (size_t)(4 * ranks) + 1;
    const double fit = queue == &ledger->part_queue ? 6 : job_s > 0 ? KOKSMA__BATCH_S / job_s : 1;
    pthread_mutex_unlock(&ledger->lock);
    size_t batch = fit < 1 ? 1 : fit > KOKSMA__MAX_BATCH ? KOKSMA__MAX_BATCH : (size_t)fit, n = 0;
    batch = batch < share ? batch : share;
    while (n < batch && koksma__ledger_take(ledger, false, &deals[n])) {
        n++;
    }
    return n;
}

/* ---- What comes in ------------------------------------------------------------------------------------- */

void koksma__ledger_put_job(koksma__ledger *ledger, size_t job, const koksma__task *task,
                            const koksma__result *results)
{
    pthread_mutex_lock(&ledger->lock);
    const bool is_new = koksma__queue_put(&ledger->jobs, job);
    pthread_mutex_unlock(&ledger->lock);
    const koksma_status status =
        is_new ? koksma__task_put(ledger->pool->tasks->study->store, task, results) : KOKSMA_OK;
    if (status) {
        koksma__ledger_stop(ledger, status, koksma_error_text());
        return;
    }
    atomic_fetch_add(&ledger->pool->done, is_new);
}

void koksma__ledger_refuse_job(koksma__ledger *ledger, size_t job, const char *text)
{
    pthread_mutex_lock(&ledger->lock);
    const bool is_new = koksma__queue_put(&ledger->jobs, job);
    pthread_mutex_unlock(&ledger->lock);
    if (is_new) {
        koksma__pool_refuse(ledger->pool, job, text);
    }
}

size_t koksma__ledger_part(const koksma__ledger *ledger, const koksma__part *part)
{
    size_t i = 0;
    while (i < ledger->parts.n &&
           (ledger->parts.at[i].reference != part->reference || ledger->parts.at[i].first_row != part->first_row ||
            ledger->parts.at[i].rows != part->rows)) {
        i++;
    }
    return i;
}

/* A reference is ready when its file is there, not with its last part; jobs are left as long as one is in the making.
 */
void koksma__ledger_put_part(koksma__ledger *ledger, size_t i, const koksma__replicates *sums)
{
    const koksma__part part = ledger->parts.at[i];
    bool complete = false;
    koksma_status status = KOKSMA_OK;
    pthread_mutex_lock(&ledger->lock);
    if (koksma__queue_put(&ledger->part_queue, i)) {
        status = koksma__parts_put(&ledger->parts, &part, sums, &complete);
    }
    pthread_mutex_unlock(&ledger->lock);
    status = !status && complete ? koksma__parts_finish(&ledger->parts, part.reference) : status;
    if (status) {
        koksma__ledger_stop(ledger, status, koksma_error_text());
        return;
    }
    pthread_mutex_lock(&ledger->lock);
    ledger->ready[part.reference] |= complete;
    pthread_mutex_unlock(&ledger->lock);
}

/* ---- The whole ----------------------------------------------------------------------------------------- */

koksma_status koksma__ledger_open(koksma__pool *pool, koksma__ledger *ledger)
{
    const koksma__tasks *tasks = pool->tasks;
    const size_t n_references = tasks->study->n_references;
    *ledger = (koksma__ledger){.pool = pool};
    pthread_mutex_init(&ledger->lock, NULL);
    ledger->ready = calloc(n_references + 1, sizeof *ledger->ready);
    koksma_status status = ledger->ready ? KOKSMA_OK : koksma__fail_memory(n_references + 1);
    status = status ? status : koksma__parts_open(tasks, &ledger->parts);
    status = status ? status : koksma__queue_open(ledger->parts.n, &ledger->part_queue);
    status = status ? status : koksma__queue_open(tasks->n_jobs, &ledger->jobs);
    for (size_t i = 0; i < n_references && !status; i++) {
        ledger->ready[i] = tasks->study->references[i].image.pixels != NULL;
    }
    for (size_t i = 0; i < tasks->n_jobs && !status; i++) {
        long long trial;
        const koksma__task *task = koksma__tasks_job(tasks, i, &trial);
        if (koksma__task_is_done(task, trial)) {
            koksma__queue_put(&ledger->jobs, i);
        }
    }
    return status;
}

void koksma__ledger_close(koksma__ledger *ledger)
{
    koksma__queue_close(&ledger->part_queue);
    koksma__queue_close(&ledger->jobs);
    if (ledger->parts.sums) {
        koksma__parts_close(&ledger->parts);
    }
    free(ledger->ready);
    pthread_mutex_destroy(&ledger->lock);
}
