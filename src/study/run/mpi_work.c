/* SPDX-License-Identifier: Apache-2.0 */
/* The ranks that do what rank 0 deals out. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/processor_clock.h"
#include "core/status.h"
#include "study/run/mpi_ranks.h"

static const double REST_S = 2e-4;

/* Jobs' results on their way. */
typedef struct letter {
    unsigned char *bytes;
    size_t size, room;
    double since_s; /* when its first job began */
} letter;

typedef struct worker {
    const koksma__transport *mpi;
    int rank;
    koksma_study *study;
    const koksma_run *job;
    koksma__tasks tasks;
    letter out;
    double busy_s, began_s; /* began_s: processor time at the phase's start */
} worker;

static koksma_status lost(const worker *w)
{
    return koksma__fail(KOKSMA_IO, "rank %d has lost rank 0", w->rank);
}

/* Waits for rank 0 without holding the processor. */
static bool receive(const worker *w, int wanted, void *bytes, size_t room, size_t *size)
{
    int from, tag;
    size_t coming;
    while (!w->mpi->probe(&from, &tag, &coming)) {
        koksma__ranks_rest(REST_S);
    }
    return w->mpi->receive(0, wanted, bytes, room, size);
}

static koksma_status get_reference(worker *w, size_t index)
{
    koksma__reference_image *r = &w->study->references[index];
    const unsigned long long number = index;
    int shape[3];
    if (r->image.pixels) {
        return KOKSMA_OK;
    }
    if (!w->mpi->send(0, KOKSMA__TAG_NEED, &number, sizeof number) ||
        !receive(w, KOKSMA__TAG_PIXELS, shape, sizeof shape, NULL)) {
        return lost(w);
    }
    const koksma_status status = koksma_image_init(&r->image, shape[0], shape[1], shape[2]);
    if (!status) {
        const size_t pixels = (size_t)shape[0] * (size_t)shape[1] * (size_t)shape[2];
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

static koksma_status send_refusal(const worker *w, unsigned long long job)
{
    koksma__refusal refusal = {.job = job};
    snprintf(refusal.text, sizeof refusal.text, "%s", koksma_error_text());
    return w->mpi->send(0, KOKSMA__TAG_REFUSAL, &refusal, sizeof refusal) ? KOKSMA_OK : lost(w);
}

static koksma_status make_room(letter *l, size_t more)
{
    if (l->size + more > l->room) {
        const size_t room = 2 * (l->size + more);
        unsigned char *bytes = realloc(l->bytes, room);
        if (!bytes) {
            return koksma__fail_memory(room);
        }
        l->bytes = bytes;
        l->room = room;
    }
    return KOKSMA_OK;
}

static koksma_status do_job(worker *w, unsigned long long job)
{
    long long trial;
    const koksma__task *task = koksma__tasks_job(&w->tasks, job, &trial);
    koksma__result *results = calloc(task->n_series, sizeof *results);
    koksma_status status = results ? make_room(&w->out, sizeof job + task->n_series * sizeof *results)
                                   : koksma__fail_memory(task->n_series * sizeof *results);
    for (size_t r = 0; task->image && !status && r < task->n_series; r++) {
        status = get_reference(w, task->references[r]);
    }
    const double start_s = koksma__now_s();
    w->out.since_s = w->out.size ? w->out.since_s : start_s;
    status = status ? status : koksma__task_do(w->study, task, trial, w->job, results);
    if (!status) {
        letter *l = &w->out;
        memcpy(l->bytes + l->size, &job, sizeof job);
        memcpy(l->bytes + l->size + sizeof job, results, task->n_series * sizeof *results);
        l->size += sizeof job + task->n_series * sizeof *results;
        w->busy_s += koksma__now_s() - start_s;
        status = koksma__now_s() - l->since_s > KOKSMA__SEND_S ? send_results(w) : KOKSMA_OK;
    } else if (status == KOKSMA_IMPOSSIBLE) {
        w->busy_s += koksma__now_s() - start_s;
        status = send_refusal(w, job);
    }
    free(results);
    return status;
}

static koksma_status do_part(worker *w, const koksma__part *part)
{
    koksma__replicates sums = {0};
    const double start_s = koksma__now_s();
    koksma_status status = koksma__part_do(w->study, part, w->job, &sums);
    const size_t bytes = koksma__replicates_numbers(&sums) * sizeof *sums.sum;
    unsigned char *message = status ? NULL : malloc(sizeof *part + bytes);
    if (!status && !message) {
        status = koksma__fail_memory(sizeof *part + bytes);
    }
    w->busy_s += koksma__now_s() - start_s;
    if (!status) {
        memcpy(message, part, sizeof *part);
        memcpy(message + sizeof *part, sums.sum, bytes);
        status = w->mpi->send(0, KOKSMA__TAG_PART, message, sizeof *part + bytes) ? KOKSMA_OK : lost(w);
    }
    free(message);
    free(sums.sum);
    return status;
}

/* Does what was dealt; *over, *run_over: there is no more in this phase, or at all. */
static koksma_status do_batch(worker *w, const koksma__deal *deals, size_t n, bool *over, bool *run_over)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < n && !status && !*over; i++) {
        *run_over = deals[i].kind == KOKSMA__DEAL_RUN_OVER;
        *over = *run_over || deals[i].kind == KOKSMA__DEAL_PHASE_OVER;
        if (deals[i].kind == KOKSMA__DEAL_JOB) {
            status = do_job(w, deals[i].number);
        } else if (deals[i].kind == KOKSMA__DEAL_PART) {
            status = do_part(w, &deals[i].part);
        }
    }
    return status ? status : send_results(w);
}

static koksma_status ask(const worker *w, int phase, double job_s)
{
    const koksma__ask ask = {phase, job_s, w->busy_s, koksma__processor_s() - w->began_s};
    return w->mpi->send(0, KOKSMA__TAG_ASK, &ask, sizeof ask) ? KOKSMA_OK : lost(w);
}

/* Asks and does until the phase is over. */
static koksma_status work_phase(worker *w, int phase, bool *run_over)
{
    koksma_status status = koksma__tasks_open(w->study, phase == 1, &w->tasks);
    bool over = status || w->tasks.n_jobs == 0;
    double job_s = 0;
    w->busy_s = 0;
    w->began_s = koksma__processor_s();
    status = over ? status : ask(w, phase, job_s);
    while (!over && !status) {
        koksma__deal deals[KOKSMA__MAX_BATCH];
        size_t got;
        if (!receive(w, KOKSMA__TAG_DEAL, deals, sizeof deals, &got)) {
            status = lost(w);
            break;
        }
        const size_t n = got / sizeof *deals;
        const double busy_s = w->busy_s;
        const bool ahead = n && deals[0].kind <= KOKSMA__DEAL_PART;
        status = ahead ? ask(w, phase, job_s) : KOKSMA_OK;
        status = status ? status : do_batch(w, deals, n, &over, run_over);
        if (ahead && deals[n - 1].kind == KOKSMA__DEAL_JOB) {
            job_s = (w->busy_s - busy_s) / (double)n;
        }
        if (n == 0 && !status) {
            koksma__ranks_rest(REST_S);
            status = ask(w, phase, job_s);
        }
    }
    koksma__tasks_close(&w->tasks);
    return status;
}

koksma_status koksma__pool_work(koksma_study *study, const koksma_run *job)
{
    const koksma__ranks *ranks = koksma__ranks_get();
    worker w = {.mpi = ranks->mpi, .rank = ranks->rank, .study = study, .job = job};
    koksma_status status = KOKSMA_OK;
    if (ranks->size < 2) {
        return koksma__fail(KOKSMA_ARGUMENT, "a study without a folder can't be run");
    }
    bool over = false;
    for (int phase = 0; !status && !over && phase < KOKSMA__PHASES; phase++) {
        status = work_phase(&w, phase, &over);
    }
    free(w.out.bytes);
    if (status) { /* rank 0 says it, and ends the others */
        char text[KOKSMA__RANK_TEXT];
        text[0] = (char)status;
        snprintf(text + 1, sizeof text - 1, "%s", koksma_error_text());
        w.mpi->send(0, KOKSMA__TAG_ERROR, text, sizeof text);
    }
    return status;
}
