/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One fault in a run of the program. KOKSMA_FAULT names a kind of call (or none), KOKSMA_FAULT_AT the call of that
 * kind that fails, KOKSMA_FAULT_MODE what failing means: `once`, `on` (that call and all after it), or `end` (the
 * process ends there, as by kill -9). KOKSMA_FAULT_COUNT is a file that is told, a line a kind, how many calls of it
 * there were.
 */
#ifndef KOKSMA_TESTS_FAULTS_H
#define KOKSMA_TESTS_FAULTS_H

#include <stdbool.h>
#include <stddef.h>

typedef enum fault_kind {
    FAULT_NONE,
    FAULT_MEMORY, /* malloc and the like in the program and the libraries, and jansson's */
    FAULT_OPEN,   /* open, fopen, fdopen, fopencookie, memfd_create, mkdir */
    FAULT_READ,   /* reading from a file that fopen or fdopen gave */
    FAULT_WRITE,  /* write, or writing to standard output */
    FAULT_SYNC,   /* fsync */
    FAULT_CLOSE,  /* close, fclose */
    FAULT_RENAME, /* rename */
    FAULT_THREAD, /* pthread_create */
    FAULT_DB,     /* what is asked of SQLite */
    N_FAULTS
} fault_kind;

/* Counts a call, and says whether it is to fail. With mode `end` it does not come back from one that is, unless
   `half` is given: then *half is set, and the caller does half of its work before fault_end(). */
bool fault_here(fault_kind kind, bool *half);
_Noreturn void fault_end(void);

#endif
