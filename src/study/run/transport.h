/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Messages between the ranks of a run. transport_mpi.c is a module of its own, the only object that links MPI; it
 * takes nothing from this library, and this library loads it when mpirun has started the process
 * (docs/decisions/0008-mpi-as-a-module.md).
 */
#ifndef KOKSMA_STUDY_RUN_TRANSPORT_H
#define KOKSMA_STUDY_RUN_TRANSPORT_H

#include <stdbool.h>
#include <stddef.h>

/* Raised with every change of the struct: a module of another build is not taken. */
enum { KOKSMA__TRANSPORT_VERSION = 1 };
#define KOKSMA__TRANSPORT_SYMBOL "koksma__transport_mpi"

typedef struct koksma__transport {
    unsigned version;
    bool (*start)(int *size, int *rank);
    bool (*send)(int to, int tag, const void *bytes, size_t size);
    /* Waits for a message of at most `room` bytes; *size (or NULL) is what came. */
    bool (*receive)(int from, int tag, void *bytes, size_t room, size_t *size);
    /* Without waiting: whether some rank's message is there, and whose. */
    bool (*probe)(int *from, int *tag, size_t *size);
    /* Ends this rank's part; abort_code not 0 ends all ranks. Does nothing when MPI has ended. */
    void (*finish)(int abort_code);
} koksma__transport;

/* The module's functions, or NULL with *problem in words. */
const koksma__transport *koksma__transport_load(const char **problem);

#endif
