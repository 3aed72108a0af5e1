/* SPDX-License-Identifier: Apache-2.0 */
/* Runs another program to its end, within limits, and leaves nothing running. */
#ifndef KOKSMA_CORE_CHILD_H
#define KOKSMA_CORE_CHILD_H

#include <koksma/koksma.h>

typedef struct koksma__child {
    const char *name;       /* what errors call it */
    char *const *arguments; /* up to a NULL; the first is the program's path, which is not searched for */
    double seconds;         /* the longest that it may take */
    size_t most_output;     /* bytes on standard output */
    uint64_t most_memory;   /* bytes of data of each of its processes */
} koksma__child;

/* What the program prints, for the caller to free. Its standard input is empty; the last line that it prints to standard
   error explains a failure. When the call returns, every process that the program started has ended.
   Errors: MISSING (it can't be run), MALFORMED (it ended with an exit code or signal, took too long, printed too much),
   INTERRUPTED, MEMORY, SYSTEM. */
koksma_status koksma__child_run(const koksma__child *child, const koksma_run *run, char **output, size_t *size);

#endif
