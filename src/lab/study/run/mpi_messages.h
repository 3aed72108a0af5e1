/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The messages between the ranks of an MPI run (sent by transport.h). Rank 0 holds the store: it sends tiles of
 * references and jobs in batches, one batch for each request, and does some itself on a second thread; only its
 * first thread sends and receives. The other ranks have the plan and hence the same list of jobs, so a job is
 * identified by its number. Ranks get reference images from rank 0 when they first need them, so that only the
 * plan's own files must be readable on every machine.
 *
 * Messages to rank 0:
 *     REQUEST  koksma__request: asks for the batch after the current one, so that no rank waits for an answer
 *     RESULTS  job numbers, each followed by the job's results
 *     FAILURE  koksma__failure: a job that is impossible; in an audit also a reference, whose number is that of
 *              the jobs plus its index
 *     TILE     koksma__reference_tile, followed by the tile's sums
 *     NEED     index of a reference whose pixels the rank needs
 *     ERROR    status and text of a rank that fails; all ranks then end
 *     PIECES   this rank's pieces of a shared search (koksma_study_mpi_processes)
 * Messages from rank 0:
 *     ASSIGNMENTS  jobs or tiles to do, or the end of the phase or of the run; if empty, the rank requests again
 *     PIXELS       a reference image: koksma__image_head; its pixels follow in a second message, unless it failed
 *     PIECES       the pieces of all ranks
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

/* Seconds after which a rank sends its results. If the rank is lost, the results of so many seconds are lost with
   it, or of one job if that takes longer. */
#define KOKSMA__SEND_S 0.02

typedef struct koksma__request {
    double phase;       /* 0: discrepancies, 1: images */
    double job_s;       /* mean seconds of a job in the last batch; 0: unknown */
    double busy_s;      /* seconds that this rank has worked in this phase so far */
    double processor_s; /* this rank's processor time in this phase so far */
} koksma__request;

typedef struct koksma__failure {
    unsigned long long job;
    char text[KOKSMA__FAILURE_TEXT];
} koksma__failure;

/* The first message about a reference image. A rank that has rendered no tile of a reference learns here that an audit
   can't render it; the rows that need it then fail on every rank. */
typedef struct koksma__image_head {
    int width, height, channels;
    int failed; /* 1: koksma__reference_image.failed; no pixels follow, because no row is compared with them */
} koksma__image_head;

#endif
