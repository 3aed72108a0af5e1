/* SPDX-License-Identifier: Apache-2.0 */
/* Runs: the jobs that fail alone, the work that is left, and who does it, on threads or MPI ranks. */
#ifndef KOKSMA_STUDY_RUN_RUN_H
#define KOKSMA_STUDY_RUN_RUN_H

#include <pthread.h>

#include <koksma/koksma.h>

#include "study/plan/plan.h"
#include "study/run/mpi.h"
#include "study/run/references.h"
#include "study/run/run_control.h"
#include "study/run/study.h"
#include "study/run/tasks.h"
#include "study/store/store.h"

/* ---- Failed jobs --------------------------------------------------------------------------------------------- */

/*
 * The jobs of a run that failed alone, without ending the run: their pattern has no point set, or their measure has
 * no value (koksma__is_impossible). A run lists them in the store, so that report and export can say why a table has gaps.
 */
enum { KOKSMA__FAILURE_TEXT = 480 }; /* a multiple of 8, as outcomes have texts */

/* The failed jobs of one task. */
typedef struct koksma__failed_task {
    size_t n;
    long long trial; /* the first trial that failed */
    char *reason;    /* the error text of this trial without the job's name */
} koksma__failed_task;

/* The failed jobs of a run, or of one of its phases. */
typedef struct koksma__failures {
    size_t n;                        /* number of failed jobs of the run or phase */
    size_t n_refused;                /* number of failed jobs whose block has no `skip` */
    size_t first;                    /* the lowest failed job; if n_refused > 0, the lowest of these */
    char text[KOKSMA__FAILURE_TEXT]; /* the error text of job `first` */
    koksma__failed_task *tasks;      /* of a phase: one for each task, or NULL if no job failed */
    size_t n_list;                   /* length of `list`, which has the tasks of a run with failed jobs */
    koksma__failed *list;
} koksma__failures;

void koksma__failures_fini(koksma__failures *failures);

/* Counts a job of a phase that failed. Errors: MEMORY. */
koksma_status koksma__failures_count(const koksma__tasks *tasks, size_t job, const char *text,
                                     koksma__failures *failures);

/* Adds the failures of a phase to those of its run, in the order of the plan. Errors: MEMORY. */
koksma_status koksma__failures_add(koksma__failures *run, const koksma__failures *phase, const koksma__tasks *tasks);

/* Writes the list of the run, and all lines that koksma_study_left_out_at returns, into the store. all: whether the
   run tried every job; otherwise the lines of earlier runs stay in the store unless this run counted as many failed
   trials. Errors: those of the store, MEMORY. */
koksma_status koksma__failures_record(koksma_study *study, const koksma__failures *run, bool all);

/* ---- Work ---------------------------------------------------------------------------------------------------- */

/* The numbers 0 .. n-1, each of which is taken once. */
typedef struct koksma__work_queue {
    size_t n, left;       /* left: how many numbers are not done */
    size_t next;          /* all numbers below `next` are taken */
    unsigned char *taken; /* one bit per number */
} koksma__work_queue;

/*
 * References that are being rendered, in tiles of whole rows. Memory holds only the sums of references that are being
 * rendered.
 */

typedef struct koksma__reference_tile {
    unsigned long long reference; /* index in study->references */
    long long first_row, rows;
} koksma__reference_tile;

typedef struct koksma__reference_tiles {
    koksma_study *study;
    size_t n;
    koksma__reference_tile *at;
    koksma__replicates *sums; /* one entry per reference of the study */
    long long *rows_left;     /* per reference: number of rows not yet rendered */
} koksma__reference_tiles;

/*
 * The state of a phase of a run (the discrepancies or the images of a plan): the assignments that are left, and the
 * results received. Threads of this process take assignments from it, and rank 0 of an MPI run sends batches of them
 * to the other ranks (mpi_work.c). The koksma__run_state functions may be called by several threads.
 */
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

/* Takes an assignment: tiles first, because jobs wait for them. Returns false if none is ready now. */
bool koksma__run_state_take(koksma__run_state *state, koksma__assignment *assignment);

/* Takes a batch of assignments for one of `ranks` ranks and returns their number: jobs of about KOKSMA__BATCH_S
   seconds together, or a few tiles; fewer towards the end, so that no rank works long after the others. job_s:
   seconds per job; 0: unknown. */
size_t koksma__run_state_take_batch(koksma__run_state *state, double job_s, int ranks,
                                    koksma__assignment assignments[KOKSMA__MAX_BATCH]);

/* What came of an assignment, as it is sent between ranks: this head, and then so many bytes. */
typedef enum koksma__outcome_kind {
    KOKSMA__OUTCOME_RESULTS, /* of job `number` */
    KOKSMA__OUTCOME_TILE,    /* the sums of tile `number` */
    KOKSMA__OUTCOME_FAILURE  /* a text of KOKSMA__FAILURE_TEXT bytes: why job `number` is impossible */
} koksma__outcome_kind;

typedef struct koksma__outcome {
    unsigned long long kind, number, size;
} koksma__outcome;

typedef struct koksma__outcomes {
    unsigned char *bytes;
    size_t size, capacity;
} koksma__outcomes;

/* Does an assignment and appends what came of it. The references that a job is compared with must be there. Errors: those
   that end the run. */
koksma_status koksma__do_assignment(const koksma__tasks *tasks, const koksma__assignment *assignment,
                                    const koksma_run *run, koksma__outcomes *to);

/* Takes the outcomes of assignments. */
void koksma__run_state_put(koksma__run_state *state, const koksma__outcomes *outcomes);

/* Takes and does assignments until the phase is over or has failed. On the thread of the run's caller, asks the
   caller's keep_going between assignments. */
void koksma__work(koksma__run_state *state);

/* Runs a phase on the number of threads that its run control allows. */
koksma_status koksma__work_threads(koksma__phase *phase);

/* ---- MPI (mpi_work.c) -------------------------------------------------------------------------------------------- */

/* Rank 0's part of a phase: sends assignments to the other ranks, receives their results, and does some assignments
   itself. */
koksma_status koksma__mpi_serve(koksma__phase *phase);

/* The part of a run on every rank but 0: requests assignments from rank 0 and sends results, until no work is
   left. */
koksma_status koksma__mpi_work(koksma_study *study, const koksma_run *job);

/* ---- Runs ---------------------------------------------------------------------------------------------------- */

/* Runs the jobs that the store lacks, on threads or MPI ranks, and adds to the summary and the failures. If
   `before`, the status of an earlier kind, is not OK, only counts the jobs and returns `before`. */
koksma_status koksma__run_kind(koksma_study *study, bool images, koksma__run_control *control, koksma_status before,
                               koksma_study_summary *summary, koksma__failures *failures);

/* koksma_study_undone of a study with a folder, by the hashes of files that the study knows. */
koksma_status koksma__count_undone(koksma_study *study, size_t *jobs, size_t *undone);

/* A rough estimate of the work of one kind of jobs: the number of samples of all images, or of points of all sets
   times the number of their measures; 0: unknown. */
double koksma__run_work(koksma_study *study, bool images);

#endif
