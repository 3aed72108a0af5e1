/* SPDX-License-Identifier: Apache-2.0 */
/* This process's rank in an MPI run, and the number of ranks; a process that mpirun did not start is the only
   rank. */
#ifndef KOKSMA_STUDY_RUN_MPI_RANK_H
#define KOKSMA_STUDY_RUN_MPI_RANK_H

#include <koksma/koksma.h>

#include "study/run/transport.h"

/* The ranks of this run; `mpi` is NULL when this process is the only rank. */
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
