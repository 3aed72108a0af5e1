/* SPDX-License-Identifier: Apache-2.0 */
/* The ranks of an MPI run other than rank 0. A rank requests the next batch when it begins a batch, so that the
   answer can arrive while it works. Results are sent back together, at least every KOKSMA__SEND_S. Each rank has the
   plan, makes the same list of jobs as rank 0, fetches the reference images that its jobs need from rank 0, and
   stores no results. */
#include "study/run/run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/clock.h"
#include "core/status.h"

static const double REST_S = 2e-4;

/* Results of jobs that are sent to rank 0 together. */
typedef struct outbox {
    unsigned char *bytes;
    size_t size, capacity;
    double since_s; /* when the first of these jobs began */
} outbox;

typedef struct worker {
    const koksma__transport *mpi;
    int rank;
    koksma_study *study;
    const koksma_run *job;
    koksma__tasks tasks;
    outbox out;
    double busy_s, began_s; /* began_s: processor time at the start of the phase */
} worker;

static koksma_status lost(const worker *w)
{
    return koksma__fail(KOKSMA_IO, "rank %d has lost rank 0", w->rank);
}

/* Waits for a message from rank 0, sleeping between polls so that the processor is free. */
static bool receive(const worker *w, int wanted, void *bytes, size_t room, size_t *size)
{
    int from, tag;
    size_t coming;
    while (!w->mpi->probe(&from, &tag, &coming)) {
        koksma__mpi_rest(REST_S);
    }
    return w->mpi->receive(0, wanted, bytes, room, size);
}

static koksma_status get_reference(worker *w, size_t index)
{
    koksma__reference_image *r = &w->study->references[index];
    const unsigned long long number = index;
    koksma__image_head head;
    if (r->image.pixels || r->failed) {
        return KOKSMA_OK;
    }
    if (!w->mpi->send(0, KOKSMA__TAG_NEED, &number, sizeof number) ||
        !receive(w, KOKSMA__TAG_PIXELS, &head, sizeof head, NULL)) {
        return lost(w);
    }
    if (head.failed) {
        r->failed = true;
        return KOKSMA_OK;
    }
    const koksma_status status = koksma_image_init(&r->image, head.width, head.height, head.channels);
    if (!status) {
        const size_t pixels = (size_t)head.width * (size_t)head.height * (size_t)head.channels;
        if (!receive(w, KOKSMA__TAG_PIXELS, r->image.pixels, pixels * sizeof *r->image.pixels, NULL)) {
            return lost(w);
        }
    }
    return status;
}

static koksma_status send_results(worker *w)
{
    if (w->out.size && !w->mpi->send(0, KOKSMA__TAG_RESULTS, w->out.bytes, w->out.size)) {
        return lost(w);
    }
    w->out.size = 0;
    return KOKSMA_OK;
}

static koksma_status send_failure(const worker *w, unsigned long long job)
{
    koksma__failure failure = {.job = job};
    snprintf(failure.text, sizeof failure.text, "%s", koksma_error_text());
    return w->mpi->send(0, KOKSMA__TAG_FAILURE, &failure, sizeof failure) ? KOKSMA_OK : lost(w);
}

static koksma_status do_job(worker *w, unsigned long long job)
{
    long long trial;
    const koksma__task *task = koksma__tasks_job(&w->tasks, job, &trial);
    koksma__result *results = calloc(task->n_series, sizeof *results);
    outbox *out = &w->out;
    koksma_status status = results ? koksma__reserve(&out->bytes, &out->capacity,
                                                     out->size + sizeof job + task->n_series * sizeof *results, 1)
                                   : koksma__fail_memory(task->n_series * sizeof *results);
    for (size_t r = 0; task->image && !status && r < task->n_series; r++) {
        status = get_reference(w, task->references[r]);
    }
    const double start_s = koksma__now_s();
    w->out.since_s = w->out.size ? w->out.since_s : start_s;
    status = status ? status : koksma__task_do(w->study, task, trial, w->job, results);
    if (!status) {
        outbox *l = &w->out;
        memcpy(l->bytes + l->size, &job, sizeof job);
        memcpy(l->bytes + l->size + sizeof job, results, task->n_series * sizeof *results);
        l->size += sizeof job + task->n_series * sizeof *results;
        w->busy_s += koksma__now_s() - start_s;
        status = koksma__now_s() - l->since_s > KOKSMA__SEND_S ? send_results(w) : KOKSMA_OK;
    } else if (koksma__task_failed_alone(w->study, status)) {
        w->busy_s += koksma__now_s() - start_s;
        status = send_failure(w, job);
    }
    free(results);
    return status;
}

static koksma_status do_tile(worker *w, const koksma__reference_tile *tile)
{
    koksma__replicates sums = {0};
    const double start_s = koksma__now_s();
    const koksma__reference_image *reference = &w->study->references[tile->reference];
    const bool failed = reference->failed;
    koksma_status status = koksma__tile_do(w->study, tile, w->job, &sums);
    if (!status && reference->failed && !failed) {
        status = send_failure(w, w->tasks.n_jobs + tile->reference);
    }
    const size_t bytes = koksma__replicates_numbers(&sums) * sizeof *sums.sum;
    unsigned char *message = status ? NULL : malloc(sizeof *tile + bytes);
    if (!status && !message) {
        status = koksma__fail_memory(sizeof *tile + bytes);
    }
    w->busy_s += koksma__now_s() - start_s;
    if (!status) {
        memcpy(message, tile, sizeof *tile);
        memcpy(message + sizeof *tile, sums.sum, bytes);
        status = w->mpi->send(0, KOKSMA__TAG_TILE, message, sizeof *tile + bytes) ? KOKSMA_OK : lost(w);
    }
    free(message);
    free(sums.sum);
    return status;
}

/* Does the assignments. Sets *over if no work is left in this phase, and *run_over if none is left in the run. */
static koksma_status do_batch(worker *w, const koksma__assignment *assignments, size_t n, bool *over, bool *run_over)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < n && !status && !*over; i++) {
        *run_over = assignments[i].kind == KOKSMA__RUN_OVER;
        *over = *run_over || assignments[i].kind == KOKSMA__PHASE_OVER;
        if (assignments[i].kind == KOKSMA__ASSIGN_JOB) {
            status = do_job(w, assignments[i].number);
        } else if (assignments[i].kind == KOKSMA__ASSIGN_TILE) {
            status = do_tile(w, &assignments[i].tile);
        }
    }
    return status ? status : send_results(w);
}

static koksma_status request(const worker *w, int phase, double job_s)
{
    const koksma__request next = {phase, job_s, w->busy_s, koksma__processor_s() - w->began_s};
    return w->mpi->send(0, KOKSMA__TAG_REQUEST, &next, sizeof next) ? KOKSMA_OK : lost(w);
}

/* Requests and does assignments until the phase is over. */
static koksma_status work_phase(worker *w, int phase, bool *run_over)
{
    koksma_status status = koksma__tasks_open(w->study, phase == 1, &w->tasks);
    bool over = status || !koksma__tasks_have_work(&w->tasks, phase == 1);
    double job_s = 0;
    w->busy_s = 0;
    w->began_s = koksma__processor_s();
    status = over ? status : request(w, phase, job_s);
    while (!over && !status) {
        koksma__assignment assignments[KOKSMA__MAX_BATCH];
        size_t got;
        if (!receive(w, KOKSMA__TAG_ASSIGNMENTS, assignments, sizeof assignments, &got)) {
            status = lost(w);
            break;
        }
        const size_t n = got / sizeof *assignments;
        const double busy_s = w->busy_s;
        const bool ahead = n && assignments[0].kind <= KOKSMA__ASSIGN_TILE;
        status = ahead ? request(w, phase, job_s) : KOKSMA_OK;
        status = status ? status : do_batch(w, assignments, n, &over, run_over);
        if (ahead && assignments[n - 1].kind == KOKSMA__ASSIGN_JOB) {
            job_s = (w->busy_s - busy_s) / (double)n;
        }
        if (n == 0 && !status) {
            koksma__mpi_rest(REST_S);
            status = request(w, phase, job_s);
        }
    }
    koksma__tasks_close(&w->tasks);
    return status;
}

koksma_status koksma__mpi_work(koksma_study *study, const koksma_run *job)
{
    const koksma__mpi *mpi = koksma__mpi_get();
    worker w = {.mpi = mpi->mpi, .rank = mpi->rank, .study = study, .job = job};
    koksma_status status = KOKSMA_OK;
    KOKSMA__FAIL_IF(mpi->size < 2, KOKSMA_ARGUMENT, "a study that was opened without a folder can't be run");
    bool over = false;
    for (int phase = 0; !status && !over && phase < KOKSMA__PHASES; phase++) {
        status = work_phase(&w, phase, &over);
    }
    free(w.out.bytes);
    if (status) { /* rank 0 reports the error and ends the other ranks */
        char text[KOKSMA__FAILURE_TEXT];
        text[0] = (char)status;
        snprintf(text + 1, sizeof text - 1, "%s", koksma_error_text());
        w.mpi->send(0, KOKSMA__TAG_ERROR, text, sizeof text);
    }
    return status;
}
