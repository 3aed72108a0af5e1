/* SPDX-License-Identifier: Apache-2.0 */
/* The ranks of an MPI run other than rank 0. A rank requests the next batch when it begins a batch, so that the
   answer can arrive while it works. Results are sent back together, at least every KOKSMA__SEND_S. Each rank has the
   plan, makes the same list of jobs as rank 0, fetches the reference images that its jobs need from rank 0, and
   stores no results. */
#include "study/run/run.h"

#include <stdio.h>
#include <stdlib.h>

#include "core/capacity.h"
#include "core/clock.h"
#include "core/status.h"

static const double REST_S = 2e-4;

typedef struct worker {
    const koksma__transport *mpi;
    int rank;
    koksma_study *study;
    const koksma_run *job;
    koksma__tasks tasks;
    koksma__outcomes out;   /* outcomes that are sent to rank 0 together */
    double since_s;         /* when the first of them began */
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
    if (r->image.pixels) {
        return KOKSMA_OK;
    }
    if (!w->mpi->send(0, KOKSMA__TAG_NEED, &number, sizeof number) ||
        !receive(w, KOKSMA__TAG_PIXELS, &head, sizeof head, NULL)) {
        return lost(w);
    }
    KOKSMA__TRY(koksma_image_init(&r->image, head.width, head.height, head.channels));
    const size_t pixels = (size_t)head.width * (size_t)head.height * (size_t)head.channels;
    return receive(w, KOKSMA__TAG_PIXELS, r->image.pixels, pixels * sizeof *r->image.pixels, NULL) ? KOKSMA_OK
                                                                                                   : lost(w);
}

static koksma_status send_results(worker *w)
{
    if (w->out.size && !w->mpi->send(0, KOKSMA__TAG_RESULTS, w->out.bytes, w->out.size)) {
        return lost(w);
    }
    w->out.size = 0;
    return KOKSMA_OK;
}

/* Does a job or tile. What comes of it is sent at once if the first unsent one began some time ago. */
static koksma_status do_assignment(worker *w, const koksma__assignment *assignment)
{
    long long trial;
    koksma_status status = KOKSMA_OK;
    if (assignment->kind == KOKSMA__ASSIGN_JOB) {
        const koksma__task *task = koksma__tasks_job(&w->tasks, assignment->number, &trial);
        for (size_t r = 0; task->image && !status && r < task->n_series; r++) {
            status = get_reference(w, task->references[r]);
        }
    }
    const double start_s = koksma__now_s();
    w->since_s = w->out.size ? w->since_s : start_s;
    status = status ? status : koksma__do_assignment(&w->tasks, assignment, w->job, &w->out);
    w->busy_s += koksma__now_s() - start_s;
    return status || koksma__now_s() - w->since_s < KOKSMA__SEND_S ? status : send_results(w);
}

/* Does the assignments. Sets *over if no work is left in this phase, and *run_over if none is left in the run. */
static koksma_status do_batch(worker *w, const koksma__assignment *assignments, size_t n, bool *over, bool *run_over)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < n && !status && !*over; i++) {
        *run_over = assignments[i].kind == KOKSMA__RUN_OVER;
        *over = *run_over || assignments[i].kind == KOKSMA__PHASE_OVER;
        if (!*over) {
            status = do_assignment(w, &assignments[i]);
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
