/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The state of a phase of a run (the discrepancies or the images of a plan): the assignments that are left, and the
 * results received. Threads of this process take assignments from it, and rank 0 of an MPI run sends batches of them
 * to the other ranks (mpi_serve.h). The koksma__run_state functions may be called by several threads.
 */
#ifndef KOKSMA_STUDY_RUN_RUN_STATE_H
#define KOKSMA_STUDY_RUN_RUN_STATE_H

#include <pthread.h>

#include "study/run/failed_jobs.h"
#include "study/run/reference_tiles.h"
#include "study/run/run_control.h"
#include "study/run/work_queue.h"

enum { KOKSMA__MAX_BATCH = 256 };

/* Seconds of work in a batch: long enough for a slow answer of rank 0, because a rank requests the next batch when it
   begins one. */
#define KOKSMA__BATCH_S 0.25

typedef enum koksma__assignment_kind {
    KOKSMA__ASSIGN_JOB,
    KOKSMA__ASSIGN_TILE,
    KOKSMA__PHASE_OVER, /* no work is left in the phase (sent only to other ranks) */
    KOKSMA__RUN_OVER    /* the run has failed (sent only to other ranks) */
} koksma__assignment_kind;

typedef struct koksma__assignment {
    unsigned long long kind, number; /* number: index of the job or tile */
    koksma__reference_tile tile;
} koksma__assignment;

/* The jobs of one kind, and their progress. */
typedef struct koksma__phase {
    koksma__tasks *tasks;
    koksma__run_control *control;
    bool last; /* whether this is the last phase of the run */
    koksma__failures failures;
    atomic_size_t done;
    atomic_ullong busy_ns; /* time that all workers together spent on tiles and jobs */
    double others_s;       /* processor time of the other ranks */
} koksma__phase;

/* Adds the time since start_s to the busy time of the workers. */
void koksma__phase_was_busy(koksma__phase *phase, double start_s);

typedef struct koksma__run_state {
    koksma__phase *phase;
    pthread_mutex_t lock; /* guards the following fields */
    koksma__reference_tiles tiles;
    koksma__work_queue tile_queue, jobs;
    double tile_work, job_work; /* mean number of samples of a tile and of a job that is left (of points: 1) */
    double work; /* the work of the whole phase in these units; an audit's phase has no jobs done before */
    koksma_status status;
    char text[KOKSMA__FAILURE_TEXT];
    bool *ready; /* per reference: whether its pixels are complete */
} koksma__run_state;

/* Call koksma__run_state_close even after a failed open; until then the state may be used, but has no assignments.
   Errors: MEMORY, and those of koksma__tiles_open. */
koksma_status koksma__run_state_open(koksma__phase *phase, koksma__run_state *state);
void koksma__run_state_close(koksma__run_state *state);

/* Ends the phase with a failure; the first failure's status and text are kept. */
void koksma__run_state_stop(koksma__run_state *state, koksma_status status, const char *text);

/* koksma__run_state_is_over: whether all results have arrived, or the phase has failed. koksma__run_state_fraction:
   the completed fraction of the work of all tiles and jobs. */
bool koksma__run_state_is_over(koksma__run_state *state);
double koksma__run_state_fraction(koksma__run_state *state);

/* Returns the first failure, as this thread's error, or OK. The work must have ended before the call. */
koksma_status koksma__run_state_status(const koksma__run_state *state);

/* Takes an assignment: tiles first, because jobs wait for them. Returns false if none is ready now. If `lost` is
   true and all assignments are taken, takes one again whose result has not arrived. */
bool koksma__run_state_take(koksma__run_state *state, bool lost, koksma__assignment *assignment);

/* Takes a batch of assignments for one of `ranks` ranks and returns their number: jobs of about KOKSMA__BATCH_S
   seconds together, or a few tiles; fewer towards the end, so that no rank works long after the others. job_s:
   seconds per job; 0: unknown. */
size_t koksma__run_state_take_batch(koksma__run_state *state, double job_s, int ranks,
                                    koksma__assignment assignments[KOKSMA__MAX_BATCH]);

/* Receive the results of a job or tile, or the failure of a job; a second result of one job or tile is ignored. */
void koksma__run_state_put_job(koksma__run_state *state, size_t job, const koksma__task *task,
                               const koksma__result *results);
void koksma__run_state_fail_job(koksma__run_state *state, size_t job, const char *text);
void koksma__run_state_put_tile(koksma__run_state *state, size_t i, const koksma__replicates *sums);

/* The index of a tile that a rank has sent back, or tiles.n if there is no such tile. */
size_t koksma__run_state_tile(const koksma__run_state *state, const koksma__reference_tile *tile);

/* Takes and does assignments until the phase is over or has failed. On the thread of the run's caller, asks the
   caller's keep_going between assignments. If `redo`, also does assignments of other ranks if their results are
   overdue. */
void koksma__work(koksma__run_state *state, bool redo);

/* Runs a phase on the number of threads that its run control allows. */
koksma_status koksma__work_threads(koksma__phase *phase);

#endif
