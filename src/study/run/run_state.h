/* SPDX-License-Identifier: Apache-2.0 */
/* What is left to do in a phase of an MPI run, and what has come in: rank 0's, whose two threads share it. Something
   that was taken stays out until its results are in, whoever brings them. The first failure is kept and ends the
   phase. */
#ifndef KOKSMA_STUDY_RUN_RUN_STATE_H
#define KOKSMA_STUDY_RUN_RUN_STATE_H

#include <pthread.h>

#include "study/run/mpi_ranks.h"
#include "study/run/queue.h"

typedef struct koksma__ledger {
    koksma__pool *pool;
    pthread_mutex_t lock; /* guards what follows */
    koksma__parts parts;
    koksma__queue part_queue, jobs;
    koksma_status status;
    char text[KOKSMA__RANK_TEXT];
    bool *ready; /* references that have their pixels */
} koksma__ledger;

/* Close also after a failure; until then the ledger may be used and has nothing to do. Errors: MEMORY, and those of
   the parts. */
koksma_status koksma__ledger_open(koksma__pool *pool, koksma__ledger *ledger);
void koksma__ledger_close(koksma__ledger *ledger);

/* The first failure, with its text. */
void koksma__ledger_stop(koksma__ledger *ledger, koksma_status status, const char *text);

/* Whether all is in, or something failed; what part of the jobs is in. */
bool koksma__ledger_is_over(koksma__ledger *ledger);
double koksma__ledger_fraction(koksma__ledger *ledger);

/* Something to do, parts before jobs, which wait for them; false: there is nothing now. With `lost`, when nothing
   else is left, something that is still out. */
bool koksma__ledger_take(koksma__ledger *ledger, bool lost, koksma__deal *deal);

/* So many for one of `ranks` ranks: jobs of about BATCH_S together, or a few parts; fewer towards the end, so that
   nobody is left with many. job_s: what a job takes, 0: not known. */
size_t koksma__ledger_take_batch(koksma__ledger *ledger, double job_s, int ranks,
                                 koksma__deal deals[KOKSMA__MAX_BATCH]);

/* Results, or why there are none; the second of the same are left out. */
void koksma__ledger_put_job(koksma__ledger *ledger, size_t job, const koksma__task *task,
                            const koksma__result *results);
void koksma__ledger_refuse_job(koksma__ledger *ledger, size_t job, const char *text);
void koksma__ledger_put_part(koksma__ledger *ledger, size_t i, const koksma__replicates *sums);

/* The number of a part that a rank has sent back; parts.n: no such. */
size_t koksma__ledger_part(const koksma__ledger *ledger, const koksma__part *part);

#endif
