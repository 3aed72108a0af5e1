/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The ranks of an MPI run (the messages go by transport.h). Rank 0 holds the store: it deals jobs out in batches, a
 * request at a time, and does jobs itself on a second thread; only its first thread sends and receives. The other
 * ranks have the plan and so the same list of jobs; a job is its number. They get reference images from rank 0 when
 * they first need them, so that only the plan's own files must be readable everywhere.
 *
 * Long because both sides of every message stand together here.
 *
 * A batch stays on a rank's lease until its results are in. When no other jobs are left, leases that are still out
 * are done again here: a rank that was lost costs its batch, where MPI lets the others live on (MPICH's
 * -disable-auto-cleanup); else the run ends, and the same command goes on from the store.
 */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/parallel.h"
#include "core/status.h"
#include "study/pool.h"
#include "study/transport.h"

/* Messages. To rank 0: ASK (phase, seconds a job took), RESULT (job, results), NEED (reference). From it: JOBS (their
   numbers; none: wait; PHASE_END, RUN_END), PIXELS. A rank's error text ends all. */
enum { TAG_ASK = 1, TAG_RESULT, TAG_NEED, TAG_ERROR, TAG_JOBS, TAG_PIXELS };
static const unsigned long long PHASE_END = ~0ull, RUN_END = ~1ull;
enum { N_PHASES = 2, MAX_BATCH = 256, TEXT = 480 };

static const double BATCH_S = 0.02, IDLE_S = 2e-4;

static int size = 0, rank = 0;
static const koksma__transport *mpi; /* NULL: this process is alone */
static const char *problem;          /* why it is, when mpirun started more than one */
static bool released;                /* the other ranks know that there is no more to do */

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void finish(void)
{
    const bool others_wait = rank == 0 && size > 1 && !released; /* for what won't come */
    mpi->finish(others_wait ? koksma_status_exit_code(KOKSMA_IO) : 0);
}

/* Ranks that were started together, as the launcher's environment has it; 0: no launcher. */
static int launched(void)
{
    const char *ompi = getenv("OMPI_COMM_WORLD_SIZE"), *pmi = getenv("PMI_SIZE"), *slurm = getenv("SLURM_NTASKS");
    return ompi ? atoi(ompi) : pmi ? atoi(pmi) : getenv("PMIX_RANK") ? (slurm ? atoi(slurm) : 1) : 0;
}

/* A process that no mpirun started must not pay for MPI, nor depend on it. */
static void start(void)
{
    const int expected = launched();
    size = 1;
    if (expected) {
        mpi = koksma__transport_load(&problem);
        if (mpi && !mpi->start(&size, &rank)) {
            mpi = NULL;
            problem = "MPI can't be started";
        }
    }
    if (mpi) {
        atexit(finish);
    } else if (expected <= 1) {
        problem = NULL;
    }
}

int koksma__pool_size(void)
{
    if (size == 0) {
        start();
    }
    return size;
}

int koksma_study_rank(void)
{
    koksma__pool_size();
    return rank;
}

koksma_status koksma__pool_check(void)
{
    koksma__pool_size();
    return problem ? koksma__fail(KOKSMA_UNSUPPORTED, "%s", problem) : KOKSMA_OK;
}

static void rest(void)
{
    const struct timespec t = {0, (long)(1e9 * IDLE_S)};
    nanosleep(&t, NULL);
}

/* ---- Rank 0 -------------------------------------------------------------------------------------------- */

typedef struct server {
    koksma__pool *pool;
    const koksma_run *run;
    pthread_mutex_t lock; /* guards what follows */
    size_t next, left;    /* the next job to deal; jobs without results */
    unsigned char *in;    /* a bit a job: its results are in */
    size_t again;         /* where the search for lost jobs goes on */
    koksma_status status;
    char text[TEXT];
    int phase;
    bool *ended; /* ranks that know that the phase is over */
} server;

static bool is_in(const server *s, size_t job)
{
    return s->in[job / 8] >> job % 8 & 1;
}

/* The next job that nobody has; with `lost`, when there is none, one that somebody has not answered. */
static bool take(server *s, bool lost, size_t *job)
{
    bool found = false;
    pthread_mutex_lock(&s->lock);
    while (s->next < s->pool->tasks->n_jobs && is_in(s, s->next)) {
        s->next++;
    }
    if (!s->status && s->next < s->pool->tasks->n_jobs) {
        *job = s->next++;
        found = true;
    } else if (!s->status && lost && s->left) {
        while (is_in(s, s->again)) {
            s->again = (s->again + 1) % s->pool->tasks->n_jobs;
        }
        *job = s->again;
        s->again = (s->again + 1) % s->pool->tasks->n_jobs;
        found = true;
    }
    pthread_mutex_unlock(&s->lock);
    return found;
}

static void stop(server *s, koksma_status status, const char *text)
{
    pthread_mutex_lock(&s->lock);
    if (!s->status) {
        s->status = status;
        snprintf(s->text, sizeof s->text, "%s", text);
    }
    pthread_mutex_unlock(&s->lock);
}

static void put(server *s, size_t job, const koksma__task *task, const koksma__result *results)
{
    pthread_mutex_lock(&s->lock);
    const bool known = is_in(s, job);
    pthread_mutex_unlock(&s->lock);
    const koksma_status status = known ? KOKSMA_OK : koksma__task_put(s->pool->tasks->study->store, task, results);
    if (status) {
        stop(s, status, koksma_error_text());
        return;
    }
    pthread_mutex_lock(&s->lock);
    if (!is_in(s, job)) {
        s->in[job / 8] |= (unsigned char)(1u << job % 8);
        s->left--;
        atomic_fetch_add(&s->pool->done, 1);
    }
    pthread_mutex_unlock(&s->lock);
}

/* Jobs on this rank, until all results are in. */
static void *work_here(void *context)
{
    server *s = context;
    size_t job;
    double waiting = now_s(), took = 0;
    for (;;) {
        /* A batch is late when it takes much longer than a job here; then it may be lost. */
        const bool late = now_s() - waiting > 1 + 20 * took;
        pthread_mutex_lock(&s->lock);
        const bool over = s->left == 0 || s->status;
        pthread_mutex_unlock(&s->lock);
        if (over) {
            return NULL;
        }
        if (!take(s, late, &job)) {
            rest();
            continue;
        }
        long long trial;
        const koksma__task *task = koksma__tasks_job(s->pool->tasks, job, &trial);
        koksma__result *results = calloc(task->n_series, sizeof *results);
        const double start_s = now_s();
        const koksma_status status = results ? koksma__task_do(s->pool->tasks->study, task, trial, results)
                                             : koksma__fail_memory(task->n_series * sizeof *results);
        if (status) {
            stop(s, status, koksma_error_text());
        } else {
            put(s, job, task, results);
        }
        free(results);
        waiting = now_s();
        took = waiting - start_s;
    }
}

static void send_pixels(server *s, int to)
{
    unsigned long long index;
    if (!mpi->receive(to, TAG_NEED, &index, sizeof index, NULL) || index >= s->pool->tasks->study->n_references) {
        return;
    }
    const koksma_image *image = &s->pool->tasks->study->references[index].image;
    const int shape[3] = {image->width, image->height, image->channels};
    const size_t pixels = (size_t)shape[0] * (size_t)shape[1] * (size_t)shape[2];
    mpi->send(to, TAG_PIXELS, shape, sizeof shape);
    mpi->send(to, TAG_PIXELS, image->pixels, pixels * sizeof *image->pixels);
}

static void receive_result(server *s, int from, size_t bytes)
{
    unsigned char *message = malloc(bytes);
    if (!message) {
        stop(s, KOKSMA_MEMORY, "out of memory for a message");
        return;
    }
    unsigned long long job;
    long long trial;
    mpi->receive(from, TAG_RESULT, message, bytes, NULL);
    memcpy(&job, message, sizeof job);
    const koksma__task *task = koksma__tasks_job(s->pool->tasks, job, &trial);
    koksma__result *results = calloc(task->n_series, sizeof *results);
    if (results) {
        memcpy(results, message + sizeof job, task->n_series * sizeof *results);
        put(s, job, task, results);
    } else {
        stop(s, KOKSMA_MEMORY, "out of memory for results");
    }
    free(results);
    free(message);
}

/* Answers a request: a batch of about BATCH_S; nothing when there is nothing now; the number ~0 when the phase is
   over or is not this one. */
static void deal(server *s, int to)
{
    double ask[2];
    unsigned long long jobs[MAX_BATCH];
    int n = 0;
    mpi->receive(to, TAG_ASK, ask, sizeof ask, NULL);
    const bool now = (int)ask[0] == s->phase;
    const double fit = ask[1] > 0 ? BATCH_S / ask[1] : 1;
    const size_t share = (s->pool->tasks->n_jobs - s->next) / (size_t)(4 * size) + 1;
    size_t batch = fit < 1 ? 1 : fit > MAX_BATCH ? MAX_BATCH : (size_t)fit;
    batch = batch < share ? batch : share;
    size_t job;
    while (now && (size_t)n < batch && take(s, false, &job)) {
        jobs[n++] = job;
    }
    pthread_mutex_lock(&s->lock);
    const bool over = s->status || s->left == 0;
    pthread_mutex_unlock(&s->lock);
    if (n == 0 && (over ? (int)ask[0] <= s->phase || s->status : (int)ask[0] < s->phase)) {
        jobs[n++] = s->status ? RUN_END : PHASE_END;
        s->ended[to] = s->ended[to] || now || s->status;
    }
    mpi->send(to, TAG_JOBS, jobs, (size_t)n * sizeof *jobs);
}

/* One message, if there is one. */
static bool serve_one(server *s)
{
    int from, tag;
    size_t bytes;
    if (!mpi->probe(&from, &tag, &bytes)) {
        return false;
    }
    char text[TEXT] = "";
    switch (tag) {
    case TAG_ASK:
        deal(s, from);
        break;
    case TAG_NEED:
        send_pixels(s, from);
        break;
    case TAG_RESULT:
        receive_result(s, from, bytes);
        break;
    case TAG_ERROR:
        mpi->receive(from, TAG_ERROR, text, TEXT, NULL);
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
    for (int r = 1; r < size; r++) {
        all &= s->ended[r];
    }
    return all;
}

/* Until all results are in, and then for those who are still to be told; a rank that says nothing for long is lost.
 */
static void serve(server *s)
{
    const size_t n = s->pool->tasks->n_jobs;
    double over_s = 0;
    for (;;) {
        const bool served = serve_one(s);
        pthread_mutex_lock(&s->lock);
        const bool over = s->left == 0 || s->status;
        const double fraction = n ? 1 - (double)s->left / (double)n : 1;
        pthread_mutex_unlock(&s->lock);
        over_s = !over ? 0 : over_s > 0 ? over_s : now_s();
        if (over && (all_ended(s) || now_s() - over_s > 30)) {
            return;
        }
        if (!over && !koksma__keep_going(s->run, fraction)) {
            stop(s, KOKSMA_INTERRUPTED, "interrupted");
        }
        if (!served) {
            rest();
        }
    }
}

koksma_status koksma__pool_serve(koksma__pool *pool, const koksma_run *run)
{
    const size_t n = pool->tasks->n_jobs;
    server s = {.pool = pool, .run = run, .left = n, .phase = pool->tasks->n && pool->tasks->at[0].image};
    pthread_t helper;
    s.in = calloc(n / 8 + 1, 1);
    s.ended = calloc((size_t)size, sizeof *s.ended);
    if (!s.in || !s.ended) {
        free(s.in);
        free(s.ended);
        return koksma__fail_memory(n / 8 + 1);
    }
    pthread_mutex_init(&s.lock, NULL);
    const koksma_status made = koksma__pool_references(pool, run);
    if (made) {
        stop(&s, made, koksma_error_text());
    }
    for (size_t i = 0; i < n; i++) {
        long long trial;
        const koksma__task *task = koksma__tasks_job(pool->tasks, i, &trial);
        if (koksma__task_is_done(task, trial)) {
            s.in[i / 8] |= (unsigned char)(1u << i % 8);
            s.left--;
        }
    }
    const bool helped = !pthread_create(&helper, NULL, work_here, &s);
    serve(&s);
    if (helped) {
        pthread_join(helper, NULL);
    }
    released = s.status || pool->last;
    const koksma_status status = s.status ? koksma__fail(s.status, "%s", s.text) : KOKSMA_OK;
    pthread_mutex_destroy(&s.lock);
    free(s.in);
    free(s.ended);
    return status;
}

/* ---- The other ranks ----------------------------------------------------------------------------------- */

static koksma_status get_reference(koksma_study *study, size_t index)
{
    koksma__reference_image *r = &study->references[index];
    const unsigned long long number = index;
    int shape[3];
    if (r->image.pixels) {
        return KOKSMA_OK;
    }
    if (!mpi->send(0, TAG_NEED, &number, sizeof number) || !mpi->receive(0, TAG_PIXELS, shape, sizeof shape, NULL)) {
        return koksma__fail(KOKSMA_IO, "rank %d has lost rank 0", rank);
    }
    const koksma_status status = koksma_image_init(&r->image, shape[0], shape[1], shape[2]);
    if (!status) {
        const size_t pixels = (size_t)shape[0] * (size_t)shape[1] * (size_t)shape[2];
        mpi->receive(0, TAG_PIXELS, r->image.pixels, pixels * sizeof *r->image.pixels, NULL);
    }
    return status;
}

static koksma_status answer(koksma_study *study, const koksma__tasks *tasks, unsigned long long job)
{
    long long trial;
    const koksma__task *task = koksma__tasks_job(tasks, job, &trial);
    const size_t bytes = sizeof job + task->n_series * sizeof(koksma__result);
    unsigned char *message = malloc(bytes);
    koksma__result *results = calloc(task->n_series, sizeof *results);
    koksma_status status = message && results ? KOKSMA_OK : koksma__fail_memory(bytes);
    for (size_t r = 0; task->image && !status && r < task->n_series; r++) {
        status = get_reference(study, task->references[r]);
    }
    status = status ? status : koksma__task_do(study, task, trial, results);
    if (!status) {
        memcpy(message, &job, sizeof job);
        memcpy(message + sizeof job, results, bytes - sizeof job);
        mpi->send(0, TAG_RESULT, message, bytes);
    }
    free(message);
    free(results);
    return status;
}

/* Asks and does until the phase is over. */
static koksma_status work_phase(koksma_study *study, int phase, bool *run_over)
{
    koksma__tasks tasks;
    koksma_status status = koksma__tasks_open(study, phase == 1, &tasks);
    double ask[2] = {phase, 0};
    for (bool over = status != KOKSMA_OK || tasks.n_jobs == 0; !over && !status;) {
        unsigned long long jobs[MAX_BATCH];
        size_t got;
        if (!mpi->send(0, TAG_ASK, ask, sizeof ask) || !mpi->receive(0, TAG_JOBS, jobs, sizeof jobs, &got)) {
            status = koksma__fail(KOKSMA_IO, "rank %d has lost rank 0", rank);
            break;
        }
        const int n = (int)(got / sizeof *jobs);
        const double start_s = now_s();
        for (int i = 0; i < n && !status && !over; i++) {
            over = jobs[i] == PHASE_END || jobs[i] == RUN_END;
            *run_over = jobs[i] == RUN_END;
            status = over ? KOKSMA_OK : answer(study, &tasks, jobs[i]);
        }
        ask[1] = n ? (now_s() - start_s) / n : ask[1];
        if (n == 0) {
            rest();
        }
    }
    koksma__tasks_close(&tasks);
    return status;
}

koksma_status koksma__pool_work(koksma_study *study)
{
    koksma_status status = KOKSMA_OK;
    if (koksma__pool_size() < 2) {
        return koksma__fail(KOKSMA_ARGUMENT, "a study without a folder can't be run");
    }
    bool over = false;
    for (int phase = 0; !status && !over && phase < N_PHASES; phase++) {
        status = work_phase(study, phase, &over);
    }
    if (status) { /* rank 0 says it, and ends the others */
        char text[TEXT];
        text[0] = (char)status;
        snprintf(text + 1, TEXT - 1, "%s", koksma_error_text());
        mpi->send(0, TAG_ERROR, text, TEXT);
    }
    return status;
}
