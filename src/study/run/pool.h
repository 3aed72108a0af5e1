/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Who does the jobs: the threads of this process (pool_threads.c), or the ranks of an MPI run (mpi_ranks.h). Of
 * several ranks the first holds the store, deals jobs out and does some itself; the others open the plan without a
 * folder, ask for work and send results back.
 */
#ifndef KOKSMA_STUDY_RUN_POOL_H
#define KOKSMA_STUDY_RUN_POOL_H

#include <pthread.h>
#include <stdatomic.h>

#include "study/run/run_control.h"
#include "study/run/tasks.h"

/* Jobs whose pattern finds no set, or a measure no value (IMPOSSIBLE): the others go on without them. */
typedef struct koksma__refused {
    pthread_mutex_t lock; /* guards what follows */
    size_t n, first;
    char text[480]; /* of job `first`, whoever did it */
} koksma__refused;

typedef struct koksma__pool {
    koksma__tasks *tasks;
    koksma__watch *watch;
    bool last; /* no other kind of jobs comes after */
    koksma__refused refused;
    atomic_size_t done;
    atomic_ullong busy_ns; /* of all workers, on parts of references and on jobs */
    double others_s;       /* processor time of the other ranks */
} koksma__pool;

/* Does all jobs that are not done on the watch's threads. */
koksma_status koksma__pool_threads(koksma__pool *pool);

/* Counts a job that is impossible; the text of the first in their order is kept. */
void koksma__pool_refuse(koksma__pool *pool, size_t job, const char *text);

/* Adds the time since start_s to what the workers were busy. */
void koksma__pool_was_busy(koksma__pool *pool, double start_s);

/* Ranks of this run; 1 without MPI. */
int koksma__pool_size(void);

/* Fails in a build without MPI that runs under mpirun. From here on the other ranks wait for the first, and end with
 * it. */
koksma_status koksma__pool_check(void);

/* The first rank does what comes without the others, which may end before it. */
void koksma__pool_release(void);

/* The first rank's part, and the others': until the first says that all is done. */
koksma_status koksma__pool_serve(koksma__pool *pool);
koksma_status koksma__pool_work(koksma_study *study, const koksma_run *job);

#endif
