/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The messages between the ranks of an MPI run (they go by transport.h). Rank 0 holds the store: it hands tiles of
 * references and jobs out in batches, one for each request, and does some itself on a second thread; only its first
 * thread sends and receives. The other ranks have the plan and so the same list of jobs; a job is its number. They
 * get reference images from rank 0 when they first need them, so that only the plan's own files must be readable
 * everywhere.
 *
 * To rank 0: REQUEST (koksma__request; for the batch after the one in hand, so that nobody waits for an answer),
 * RESULTS (jobs' numbers, each before its results), FAILURE (koksma__failure: a job that is impossible), TILE
 * (koksma__reference_tile, its sums), NEED (a reference), ERROR (status and text of a rank that ends, which ends
 * all), PIECES (of a shared search: koksma_study_mpi_processes). From it: PIECES (of all), ASSIGNMENTS (what to do; none: request again; the phase, or the run, is over), PIXELS.
 */
#ifndef KOKSMA_STUDY_RUN_MPI_MESSAGES_H
#define KOKSMA_STUDY_RUN_MPI_MESSAGES_H

#include "study/run/run_state.h"

enum {
    KOKSMA__TAG_REQUEST = 1,
    KOKSMA__TAG_RESULTS,
    KOKSMA__TAG_FAILURE,
    KOKSMA__TAG_TILE,
    KOKSMA__TAG_NEED,
    KOKSMA__TAG_ERROR,
    KOKSMA__TAG_ASSIGNMENTS,
    KOKSMA__TAG_PIXELS,
    KOKSMA__TAG_PIECES
};

enum { KOKSMA__PHASES = 2 };

/* Seconds after which a rank sends what it has done: so much is lost with it, or a job if that takes longer. */
#define KOKSMA__SEND_S 0.02

typedef struct koksma__request {
    double phase;       /* 0 discrepancies, 1 images */
    double job_s;       /* what one job took of late; 0: not known */
    double busy_s;      /* at work in this phase so far */
    double processor_s; /* of this rank's processor time, likewise */
} koksma__request;

typedef struct koksma__failure {
    unsigned long long job;
    char text[KOKSMA__FAILURE_TEXT];
} koksma__failure;

#endif
