/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One fault in a run of the program. KOKSMA_FAULT names a kind of call (or none), KOKSMA_FAULT_AT the call of that
 * kind that fails, KOKSMA_FAULT_MODE what failing means: `once`, `on` (that call and all after it), or `end` (the
 * process ends there, as by kill -9). KOKSMA_FAULT_COUNT is a file that is told, a line a kind, how many calls of it
 * there were, and the first and the last from each place. KOKSMA_FAULT_LOG is a file that is told each change of a file
 * or folder, in order; then time runs fast, so that stores commit often, and their logs are checkpointed after a few pages.
 * KOKSMA_FAULT_PAUSE is a file that is made before the first file is removed or linked; the program waits until it is gone.
 */
#ifndef KOKSMA_TESTS_FAULTS_H
#define KOKSMA_TESTS_FAULTS_H

#include <stdbool.h>
#include <stddef.h>

typedef enum fault_kind {
    FAULT_NONE,
    FAULT_MEMORY,    /* malloc and the like in the program and the libraries, and jansson's */
    FAULT_OPEN,      /* open, openat, fopen, fdopen, fopencookie, memfd_create, mkdir */
    FAULT_READ,      /* reading from a file that fopen or fdopen gave */
    FAULT_WRITE,     /* write, or writing to standard output */
    FAULT_SYNC,      /* fsync */
    FAULT_CLOSE,     /* close, fclose */
    FAULT_RENAME,    /* renameat, renameat2 */
    FAULT_THREAD,    /* pthread_create */
    FAULT_DB,        /* what SQLite asks of its files */
    FAULT_DB_MEMORY, /* SQLite's memory */
    N_FAULTS
} fault_kind;

/* Counts a call, and says whether it is to fail. With mode `end` it does not come back from one that is, unless
   `half` is given: then *half is set, and the caller does half of its work before fault_end(). */
bool fault_here(fault_kind kind, bool *half);
_Noreturn void fault_end(void);

/* A line of KOKSMA_FAULT_LOG; nothing where there is none. */
bool fault_logs(void);
void fault_note(const char *format, ...) __attribute__((format(printf, 1, 2)));
void fault_note_write(unsigned long long inode, long long offset, const void *bytes, size_t size);

/* faults_sqlite.c: puts SQLite's files and memory under test; before SQLite is used. */
void fault_install_sqlite(void);

#endif
