/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Work in blocks over threads. The blocks are of a fixed size that the caller chooses, never a function of the
 * number of threads; each block writes to its own place, and the caller adds the results up in index order.
 */
#ifndef KOKSMA_CORE_PARALLEL_H
#define KOKSMA_CORE_PARALLEL_H

#include <koksma/koksma.h>

#include "core/visibility.h"

typedef koksma_status (*koksma__block_function)(void *context, size_t block);

/* Runs f(context, 0) .. f(context, n_blocks-1), in any order, on run->threads threads (the caller's is one of
   them). Asks run->keep_going between blocks; stops early on the first failure, whose text it hands on.
   run may be NULL. */
KOKSMA__LAB koksma_status koksma__parallel(const koksma_run *run, size_t n_blocks, koksma__block_function f,
                                           void *context);

/* The number of threads that run asks for. */
KOKSMA__LAB int koksma__threads(const koksma_run *run);

/* False when run says stop. */
KOKSMA__LAB bool koksma__keep_going(const koksma_run *run, double fraction_done);

/* The status of a call that was told to stop. */
KOKSMA__LAB koksma_status koksma__fail_interrupted(void);

#endif
