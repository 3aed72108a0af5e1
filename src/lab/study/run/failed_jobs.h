/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The jobs of a run that failed alone, without ending the run: their pattern has no point set, or their measure has
 * no value (koksma__is_impossible). A run lists them in the store, so that report and export can say why a table has gaps.
 */
#ifndef KOKSMA_STUDY_RUN_FAILED_JOBS_H
#define KOKSMA_STUDY_RUN_FAILED_JOBS_H

#include "study/run/tasks.h"

enum { KOKSMA__FAILURE_TEXT = 480 };

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
    koksma__texts lines;             /* of a run: a line for each task with failed jobs, as the store has them */
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

#endif
