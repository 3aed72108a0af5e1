/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The one queue of assignments of a run: what is left to do in a phase (the discrepancies or the images of a plan),
 * and what has come in. Threads of this process take from it, and rank 0 of an MPI run hands batches of
 * it to the other ranks (mpi_serve.h). All functions may be called by several threads.
 */
#ifndef KOKSMA_STUDY_RUN_RUN_STATE_H
#define KOKSMA_STUDY_RUN_RUN_STATE_H

#include <pthread.h>

#include "study/run/reference_tiles.h"
#include "study/run/run_control.h"
#include "study/run/work_queue.h"

enum { KOKSMA__MAX_BATCH = 256, KOKSMA__FAILURE_TEXT = 480 };

/* Seconds of work in a batch. A batch is in hand when the next is asked for, and rank 0 may be slow to answer where
   all processors are at work. */
#define KOKSMA__BATCH_S 0.25

typedef enum koksma__assignment_kind {
    KOKSMA__ASSIGN_JOB,
    KOKSMA__ASSIGN_TILE,
    KOKSMA__PHASE_OVER, /* these two for other ranks only */
    KOKSMA__RUN_OVER
} koksma__assignment_kind;

typedef struct koksma__assignment {
    unsigned long long kind, number; /* number: of the job or tile */
    koksma__reference_tile tile;
} koksma__assignment;

/* Jobs whose pattern finds no set, or a measure no value (IMPOSSIBLE): the others go on without them. */
typedef struct koksma__failures {
    size_t n, first;
    char text[KOKSMA__FAILURE_TEXT]; /* of job `first`, whoever did it */
} koksma__failures;

/* Jobs of one kind, and what became of them. */
typedef struct koksma__phase {
    koksma__tasks *tasks;
    koksma__run_control *control;
    bool last; /* no other kind of jobs comes after */
    koksma__failures failures;
    atomic_size_t done;
    atomic_ullong busy_ns; /* of all workers, on tiles and on jobs */
    double others_s;       /* processor time of the other ranks */
} koksma__phase;

/* Adds the time since start_s to what the workers were busy. */
void koksma__phase_was_busy(koksma__phase *phase, double start_s);

typedef struct koksma__run_state {
    koksma__phase *phase;
    pthread_mutex_t lock; /* guards what follows */
    koksma__reference_tiles tiles;
    koksma__work_queue tile_queue, jobs;
    koksma_status status;
    char text[KOKSMA__FAILURE_TEXT];
    bool *ready; /* references that have their pixels */
} koksma__run_state;

/* Close also after a failure; until then the state may be used and has nothing to do. Errors: MEMORY, and those of
   the tiles. */
koksma_status koksma__run_state_open(koksma__phase *phase, koksma__run_state *state);
void koksma__run_state_close(koksma__run_state *state);

/* Ends the phase with the first failure, whose status and text are kept. */
void koksma__run_state_stop(koksma__run_state *state, koksma_status status, const char *text);

/* Whether all is in, or something failed; the part of the jobs that is in. */
bool koksma__run_state_is_over(koksma__run_state *state);
double koksma__run_state_fraction(koksma__run_state *state);

/* The first failure as this thread's error, or OK; after all work has ended. */
koksma_status koksma__run_state_status(const koksma__run_state *state);

/* Something to do, tiles before jobs, which wait for them; false: there is nothing now. With `lost`, when nothing
   else is left, something that is still out. */
bool koksma__run_state_take(koksma__run_state *state, bool lost, koksma__assignment *assignment);

/* So many for one of `ranks` ranks: jobs of about BATCH_S together, or a few tiles; fewer towards the end, so that
   nobody is left with many. job_s: what a job takes, 0: not known. */
size_t koksma__run_state_take_batch(koksma__run_state *state, double job_s, int ranks,
                                    koksma__assignment assignments[KOKSMA__MAX_BATCH]);

/* Results, or why there are none; the second of the same are left out. */
void koksma__run_state_put_job(koksma__run_state *state, size_t job, const koksma__task *task,
                               const koksma__result *results);
void koksma__run_state_fail_job(koksma__run_state *state, size_t job, const char *text);
void koksma__run_state_put_tile(koksma__run_state *state, size_t i, const koksma__replicates *sums);

/* The number of a tile that a rank has sent back; tiles.n: no such. */
size_t koksma__run_state_tile(const koksma__run_state *state, const koksma__reference_tile *tile);

/* Takes and does assignments until the phase is over or has failed. On the thread of the run's caller, asks the
   caller's keep_going between assignments. With redo, does again what nobody has brought back for long. */
void koksma__work(koksma__run_state *state, bool redo);

/* Does a phase on the threads of its run control. */
koksma_status koksma__work_threads(koksma__phase *phase);

#endif
