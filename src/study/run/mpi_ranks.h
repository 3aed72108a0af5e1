/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the ranks of an MPI run say to each other (the messages go by transport.h). Rank 0 holds the store: it deals
 * parts of references and jobs out in batches, a request at a time, and does some itself on a second thread; only its
 * first thread sends and receives. The other ranks have the plan and so the same list of jobs; a job is its number.
 * They get reference images from rank 0 when they first need them, so that only the plan's own files must be readable
 * everywhere.
 *
 * To rank 0: ASK (koksma__ask; for the batch after the one in hand, so that nobody waits for an answer), RESULTS
 * (jobs' numbers, each before its results), REFUSAL (koksma__refusal: a job that is impossible), PART (koksma__part,
 * its sums), NEED (a reference), ERROR (a rank's last words, which end all). From it: DEAL (what to do; nothing: ask
 * again; one that is over: the phase, or the run, is), PIXELS.
 */
#ifndef KOKSMA_STUDY_RUN_MPI_RANKS_H
#define KOKSMA_STUDY_RUN_MPI_RANKS_H

#include "study/run/pool.h"
#include "study/run/reference_tiles.h"
#include "study/run/transport.h"

enum {
    KOKSMA__TAG_ASK = 1,
    KOKSMA__TAG_RESULTS,
    KOKSMA__TAG_REFUSAL,
    KOKSMA__TAG_PART,
    KOKSMA__TAG_NEED,
    KOKSMA__TAG_ERROR,
    KOKSMA__TAG_DEAL,
    KOKSMA__TAG_PIXELS
};

enum { KOKSMA__PHASES = 2, KOKSMA__MAX_BATCH = 256, KOKSMA__RANK_TEXT = 480 };

/* Seconds of work in a batch. A batch is in hand when the next is asked for, and rank 0 may be slow to answer where
   all processors are at work. */
#define KOKSMA__BATCH_S 0.25

/* Seconds after which a rank sends what it has done: so much is lost with it, or a job if that takes longer. */
#define KOKSMA__SEND_S 0.02

typedef struct koksma__ask {
    double phase;       /* 0 discrepancies, 1 images */
    double job_s;       /* what one job took of late; 0: not known */
    double busy_s;      /* at work in this phase so far */
    double processor_s; /* of this rank's processor time, likewise */
} koksma__ask;

typedef struct koksma__refusal {
    unsigned long long job;
    char text[KOKSMA__RANK_TEXT];
} koksma__refusal;

typedef enum koksma__deal_kind {
    KOKSMA__DEAL_JOB,
    KOKSMA__DEAL_PART,
    KOKSMA__DEAL_PHASE_OVER,
    KOKSMA__DEAL_RUN_OVER
} koksma__deal_kind;

typedef struct koksma__deal {
    unsigned long long kind, number; /* number: of the job */
    koksma__part part;
} koksma__deal;

/* This process's place in the run; mpi is NULL when it is alone. */
typedef struct koksma__ranks {
    int size, rank;
    const koksma__transport *mpi;
    bool released; /* of rank 0: the others know that there is no more to do */
} koksma__ranks;

koksma__ranks *koksma__ranks_get(void);

/* A short rest of one who polls. */
void koksma__ranks_rest(double seconds);

#endif
