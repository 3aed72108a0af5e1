/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Messages between the ranks of a run. transport_mpi.c is built as a separate module, the only object that links
 * MPI. The module uses no function of this library, and this library loads the module only if mpirun has started the
 * process (docs/decisions.md, 8).
 */
#ifndef KOKSMA_STUDY_RUN_TRANSPORT_H
#define KOKSMA_STUDY_RUN_TRANSPORT_H

#include <stdbool.h>
#include <stddef.h>

/* The version of the struct, raised with every change, so that a module of an incompatible build is rejected. */
enum { KOKSMA__TRANSPORT_VERSION = 1 };
#define KOKSMA__TRANSPORT_SYMBOL "koksma__transport_mpi"

typedef struct koksma__transport {
    unsigned version;
    bool (*start)(int *size, int *rank);
    bool (*send)(int to, int tag, const void *bytes, size_t size);
    /* Waits for a message of at most `room` bytes; *size gets the number of bytes received, unless size is NULL. */
    bool (*receive)(int from, int tag, void *bytes, size_t room, size_t *size);
    /* Whether a message of any rank has arrived, with its sender, tag and size; does not wait. */
    bool (*probe)(int *from, int *tag, size_t *size);
    /* Ends MPI on this rank; an abort_code other than 0 aborts all ranks. Does nothing if MPI has ended. */
    void (*finish)(int abort_code);
} koksma__transport;

/* The module's functions, or NULL, with the reason in *problem. */
const koksma__transport *koksma__transport_load(const char **problem);

#endif
