/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Runs a computation, cut into numbered blocks, on several threads. The caller chooses a fixed size of the blocks,
 * which never depends on the number of threads; each block writes to its own part of the output, and the caller adds
 * the results up in index order.
 */
#ifndef KOKSMA_CORE_PARALLEL_H
#define KOKSMA_CORE_PARALLEL_H

#include <koksma/koksma.h>

#include "core/visibility.h"

typedef koksma_status (*koksma__block_function)(void *context, size_t block);

/* Runs f(context, 0) .. f(context, n_blocks-1), in any order, on run->threads threads, one of which is the caller's.
   Calls run->keep_going between blocks, stops at the first failure and returns its status and text. run may be NULL.
   */
KOKSMA__LAB koksma_status koksma__parallel(const koksma_run *run, size_t n_blocks, koksma__block_function f,
                                           void *context);

/* Returns the number of threads that `run` requests; if it is NULL or requests 0, the number of processors. */
KOKSMA__LAB int koksma__threads(const koksma_run *run);

/* Calls run->keep_going and returns its result; returns true if run or run->keep_going is NULL. */
KOKSMA__LAB bool koksma__keep_going(const koksma_run *run, double fraction_done);

/* Calls koksma__keep_going in one of 4096 steps of a loop whose steps take up to some microseconds. Returns INTERRUPTED
   if the caller wants to stop. */
KOKSMA__LAB koksma_status koksma__look(const koksma_run *run, size_t step, double fraction_done);

/* Sets the error text for a call that run->keep_going stopped, and returns INTERRUPTED. */
KOKSMA__LAB koksma_status koksma__fail_interrupted(void);

/* The number of terms, of some nanoseconds each, after which work that cannot be cut into blocks asks again. */
enum { KOKSMA__ASKED = 1 << 20 };

/* Fails with INTERRUPTED if run->keep_going returns false. For work that does not know which fraction is done. */
KOKSMA__LAB koksma_status koksma__ask(const koksma_run *run);

/* A phase of a call whose work has several: the fractions 0 to 1 that the phase reports to koksma__phase_run count as
   begin .. begin + share of the call, and never fall. The phases of a call take one after another the same struct, of
   zeros at first. share = 0: a phase that is short beside the others. */
typedef struct koksma__phases {
    const koksma_run *run; /* of the call; may be NULL */
    double begin, share;
    double reached; /* the largest fraction of the call that was reported */
} koksma__phases;

/* Begins the next phase, which follows the one before, and returns its run. The struct must not be moved in memory. */
KOKSMA__LAB koksma_run koksma__phase_run(koksma__phases *phases, const koksma_run *run, double share);

/* For callbacks that cost much, such as those of an interpreter: koksma__paced is a keep_going whose context is a
   koksma__pacing. It calls the member `keep_going` at most once in every interval_s, first after one interval, and
   otherwise returns true; once the member has returned false, it always returns false. The Python package has the same
   struct. */
typedef struct koksma__pacing {
    bool (*keep_going)(void *context, double fraction_done);
    void *context;
    double interval_s;
    double next_s; /* time of the next call of `keep_going`; 0 before the first call of koksma__paced */
    bool stopped;  /* true once `keep_going` has returned false */
} koksma__pacing;

KOKSMA__LAB bool koksma__paced(void *pacing, double fraction_done);

/* koksma_allow_exec decides whether a pattern may run the program or library that its path names. */

/* Returns the number of seconds for which the calling thread lets a pattern's program run; 0: the thread allows no
   programs. A function that starts threads reads this number before, and each new thread passes it to
   koksma_allow_exec. */
KOKSMA__LAB double koksma__exec_seconds(void);

#endif
