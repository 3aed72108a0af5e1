/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Who looks at the clock and at the caller's keep_going: only the thread that called, between jobs and within its
 * own; the jobs on other threads hear of it. So a job is left where it is when the time is up, on every thread.
 */
#ifndef KOKSMA_STUDY_RUN_RUN_CONTROL_H
#define KOKSMA_STUDY_RUN_RUN_CONTROL_H

#include <pthread.h>
#include <stdatomic.h>

#include <koksma/koksma.h>

typedef struct koksma__run_control {
    const koksma_run *caller_run; /* may be NULL */
    pthread_t caller;
    double end_s;            /* of the time, by koksma__now_s; 0: none */
    double fraction;         /* done, as last told by the caller's thread */
    double begin, share;     /* of the whole, that the fractions of a phase go over */
    atomic_bool stop;        /* what is at work is to end */
    atomic_bool is_up;       /* because the time is up */
    atomic_bool interrupted; /* because the caller's keep_going said so, before or after that */
    koksma_run run;          /* of the whole, with the caller's threads */
    koksma_run job;          /* of a job, on one thread, which may be any */
} koksma__run_control;

/* The watch must stay where it is. time_limit_s 0: none. */
void koksma__run_control_begin(const koksma_run *run, double time_limit_s, koksma__run_control *watch);

/* Whether the time limit, and not the caller, has ended the work. The caller is asked once more, so that an
   interruption during a long job is not overtaken by the limit. For the caller's thread. */
bool koksma__run_control_time_is_up(koksma__run_control *watch);

#endif
