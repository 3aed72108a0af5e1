/* SPDX-License-Identifier: Apache-2.0 */
/* Workers: each takes an assignment of the run state, does it, and puts the result back, until nothing is left. A run
   without MPI is as many workers as it has threads; rank 0 of an MPI run has one beside the thread that serves the
   other ranks (mpi_serve.c). A worker that finds nothing to take, because jobs wait for the last tiles of a
   reference, rests shortly. What a result is depends on its job alone, so that it does not matter who did it, nor
   when. */
#include "study/run/workers.h"

#include <stdlib.h>

#include "core/parallel.h"
#include "core/processor_clock.h"
#include "core/status.h"
#include "study/run/mpi_rank.h"

static const double REST_S = 1e-4;

static void do_job(koksma__run_state *state, size_t job)
{
    koksma__phase *phase = state->phase;
    long long trial;
    const koksma__task *task = koksma__tasks_job(phase->tasks, job, &trial);
    koksma__result *results = calloc(task->n_series, sizeof *results);
    const koksma_status status =
        results ? koksma__task_do(phase->tasks->study, task, trial, &phase->control->job, results)
                : koksma__fail_memory(task->n_series * sizeof *results);
    if (koksma__task_failed_alone(phase->tasks->study, status)) {
        koksma__run_state_fail_job(state, job, koksma_error_text());
    } else if (status) {
        koksma__run_state_stop(state, status, koksma_error_text());
    } else {
        koksma__run_state_put_job(state, job, task, results);
    }
    free(results);
}

static void do_tile(koksma__run_state *state, size_t i)
{
    koksma__replicates sums = {0};
    const koksma_status status =
        koksma__tile_do(state->phase->tasks->study, &state->tiles.at[i], &state->phase->control->job, &sums);
    if (status) {
        koksma__run_state_stop(state, status, koksma_error_text());
    } else {
        koksma__run_state_put_tile(state, i, &sums);
    }
    free(sums.sum);
}

void koksma__work(koksma__run_state *state, bool redo)
{
    koksma__run_control *control = state->phase->control;
    const bool asks = pthread_equal(pthread_self(), control->caller);
    double since_s = koksma__now_s(), took_s = 0;
    koksma__assignment assignment;
    for (;;) {
        if (asks && !koksma__keep_going(&control->run, koksma__run_state_fraction(state))) {
            koksma__run_state_stop(state, KOKSMA_INTERRUPTED, "interrupted");
        }
        /* A batch is late when it takes much longer than an assignment here; then it may be lost. */
        const bool late = redo && koksma__now_s() - since_s > 1 + 20 * took_s;
        if (koksma__run_state_take(state, late, &assignment)) {
            const double start_s = koksma__now_s();
            (assignment.kind == KOKSMA__ASSIGN_JOB ? do_job : do_tile)(state, assignment.number);
            koksma__phase_was_busy(state->phase, start_s);
            since_s = koksma__now_s();
            took_s = since_s - start_s;
        } else if (koksma__run_state_is_over(state)) {
            return;
        } else {
            koksma__mpi_rest(REST_S);
        }
    }
}

static koksma_status work_block(void *context, size_t i)
{
    (void)i;
    koksma__work(context, false);
    return KOKSMA_OK;
}

koksma_status koksma__work_threads(koksma__phase *phase)
{
    koksma__run_state state;
    const koksma_run threads = {.threads = phase->control->run.threads};
    koksma_status status = koksma__run_state_open(phase, &state);
    status = status ? status : koksma__parallel(&threads, (size_t)threads.threads, work_block, &state);
    status = status ? status : koksma__run_state_status(&state);
    koksma__run_state_close(&state);
    return status;
}
