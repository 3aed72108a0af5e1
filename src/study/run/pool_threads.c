/* SPDX-License-Identifier: Apache-2.0 */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/processor_clock.h"
#include "core/status.h"
#include "study/run/pool.h"
#include "study/run/reference_tiles.h"

typedef struct making {
    koksma__pool *pool;
    koksma__parts parts;
    pthread_mutex_t lock; /* guards the sums */
} making;

void koksma__pool_was_busy(koksma__pool *pool, double start_s)
{
    atomic_fetch_add(&pool->busy_ns, (unsigned long long)(1e9 * (koksma__now_s() - start_s)));
}

void koksma__pool_refuse(koksma__pool *pool, size_t job, const char *text)
{
    koksma__refused *r = &pool->refused;
    pthread_mutex_lock(&r->lock);
    if (!r->n++ || job < r->first) {
        r->first = job;
        snprintf(r->text, sizeof r->text, "%s", text);
    }
    pthread_mutex_unlock(&r->lock);
}

static koksma_status do_part(void *context, size_t i)
{
    making *m = context;
    const koksma__part *part = &m->parts.at[i];
    const double start_s = koksma__now_s();
    koksma__replicates sums;
    bool complete = false;
    koksma_status status = koksma__part_do(m->parts.study, part, &m->pool->watch->job, &sums);
    if (!status) {
        pthread_mutex_lock(&m->lock);
        status = koksma__parts_put(&m->parts, part, &sums, &complete);
        pthread_mutex_unlock(&m->lock);
        free(sums.sum);
    }
    if (!status && complete) {
        status = koksma__parts_finish(&m->parts, part->reference);
    }
    koksma__pool_was_busy(m->pool, start_s);
    return status;
}

static koksma_status do_job(void *context, size_t i)
{
    koksma__pool *pool = context;
    long long trial;
    const koksma__task *task = koksma__tasks_job(pool->tasks, i, &trial);
    if (koksma__task_is_done(task, trial)) {
        return KOKSMA_OK;
    }
    const double start_s = koksma__now_s();
    koksma__result *results = calloc(task->n_series, sizeof *results);
    if (!results) {
        return koksma__fail_memory(task->n_series * sizeof *results);
    }
    koksma_status status = koksma__task_do(pool->tasks->study, task, trial, &pool->watch->job, results);
    status = status ? status : koksma__task_put(pool->tasks->study->store, task, results);
    free(results);
    atomic_fetch_add(&pool->done, !status);
    koksma__pool_was_busy(pool, start_s);
    if (status == KOKSMA_IMPOSSIBLE) {
        koksma__pool_refuse(pool, i, koksma_error_text());
        status = KOKSMA_OK;
    }
    return status;
}

koksma_status koksma__pool_threads(koksma__pool *pool)
{
    making m = {.pool = pool, .lock = PTHREAD_MUTEX_INITIALIZER};
    koksma_status status = koksma__parts_open(pool->tasks, &m.parts);
    if (!status) {
        status = koksma__parallel(&pool->watch->run, m.parts.n, do_part, &m);
        koksma__parts_close(&m.parts);
    }
    pthread_mutex_destroy(&m.lock);
    return status ? status : koksma__parallel(&pool->watch->run, pool->tasks->n_jobs, do_job, pool);
}
