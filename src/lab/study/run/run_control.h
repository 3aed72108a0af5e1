/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The time limit, interruption and progress of a run. Only the caller's thread reads the clock and calls the
 * caller's keep_going, between jobs and within its own jobs; the jobs on other threads read a flag that this thread
 * sets. So when the time limit is reached, every thread abandons its current job.
 */
#ifndef KOKSMA_STUDY_RUN_RUN_CONTROL_H
#define KOKSMA_STUDY_RUN_RUN_CONTROL_H

#include <pthread.h>
#include <stdatomic.h>

#include <koksma/koksma.h>

typedef struct koksma__run_control {
    const koksma_run *caller_run; /* may be NULL */
    pthread_t caller;
    double start_s, end_s;   /* the start, and the deadline or 0 if there is none, as times of koksma__now_s */
    double fraction;         /* completed fraction of the run, as last reported on the caller's thread */
    double begin, share;     /* the current phase covers the fractions begin .. begin + share of the run */
    bool by_time;            /* whether the progress is the elapsed fraction of the time limit */
    atomic_bool stop;        /* whether all work must end */
    atomic_bool is_up;       /* whether the time limit was reached */
    atomic_bool interrupted; /* whether the caller's keep_going has returned false, before or after the time limit */
    koksma_run run;          /* options for the whole run, with the caller's number of threads */
    koksma_run job;          /* options for a single job, on any one thread */
} koksma__run_control;

/* Starts the clock. `watch` must not be moved in memory afterwards. time_limit_s = 0: no limit. */
void koksma__run_control_begin(const koksma_run *run, double time_limit_s, koksma__run_control *watch);

/* Whether the time limit, and not the caller, has ended the work. Calls keep_going once more, so that an interruption
   during a long job takes precedence over the limit. Only the caller's thread may call this function. */
bool koksma__run_control_time_is_up(koksma__run_control *watch);

#endif
