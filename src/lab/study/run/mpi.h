/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The ranks of an MPI run and the messages between them. transport_mpi.c is built as a separate module, the only object
 * that links MPI. The module uses no function of this library, and this library loads the module only if mpirun has
 * started the process (docs/decisions.md, 8).
 */
#ifndef KOKSMA_STUDY_RUN_MPI_H
#define KOKSMA_STUDY_RUN_MPI_H

#include <stdbool.h>
#include <stddef.h>

#include <koksma/koksma.h>

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

/* This process's rank in an MPI run, and the number of ranks; `mpi` is NULL when this process is the only rank, as one is
   that mpirun did not start. */
typedef struct koksma__mpi {
    int size, rank;
    const koksma__transport *mpi;
    bool released; /* set on rank 0 when all other ranks know that no work is left */
} koksma__mpi;

/* Returns the ranks of this run; the first call loads MPI if mpirun started this process. */
koksma__mpi *koksma__mpi_get(void);

/* The number of ranks of this run; 1 without MPI. */
int koksma__mpi_size(void);

/* Fails in a build without MPI that runs under mpirun. After this call the other ranks wait for rank 0: if rank 0
   exits before koksma__mpi_release, they are aborted. */
koksma_status koksma__mpi_check(void);

/* Declares that rank 0 does the rest of the work alone, so that the other ranks need not wait for it. */
void koksma__mpi_release(void);

/* Sleeps for less than a second, between two polls. */
void koksma__mpi_rest(double seconds);

#endif
