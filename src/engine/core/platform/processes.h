/* SPDX-License-Identifier: Apache-2.0 */
/* Runs another program to its end, within limits of time, output and memory, and ends its process group. */
#ifndef KOKSMA_CORE_PLATFORM_PROCESSES_H
#define KOKSMA_CORE_PLATFORM_PROCESSES_H

#include <koksma/koksma.h>

#include "core/visibility.h"

typedef struct koksma__child {
    const char *name;       /* the program's name in error messages */
    char *const *arguments; /* arguments, ended by NULL; the first is the path of the program, for which PATH is not
                               searched */
    double seconds;         /* the time limit */
    size_t most_output;     /* limit of bytes on standard output */
    uint64_t most_memory;   /* limit of data for each of its processes, in bytes; UINT64_MAX: as it is */
    const char *input;      /* its standard input, input_size bytes, of which it may leave some; NULL: none */
    size_t input_size;
} koksma__child;

/* Runs the program and returns its standard output, which the caller frees. The last line that it prints to standard
   error becomes the text of a failure. When the call returns, the
   program's process group has been killed. Errors: MISSING (the program cannot be run), MALFORMED (it ended with an exit
   code or signal, took too long or printed too much), INTERRUPTED, MEMORY, SYSTEM. */
KOKSMA__LAB koksma_status koksma__child_run(const koksma__child *child, const koksma_run *run, char **output,
                                            size_t *size);

#endif
