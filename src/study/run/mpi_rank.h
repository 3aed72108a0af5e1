/* SPDX-License-Identifier: Apache-2.0 */
/* This process's place among the ranks of an MPI run; a process that mpirun did not start is alone. */
#ifndef KOKSMA_STUDY_RUN_MPI_RANK_H
#define KOKSMA_STUDY_RUN_MPI_RANK_H

#include <koksma/koksma.h>

#include "study/run/transport.h"

/* mpi is NULL when the process is alone. */
typedef struct koksma__mpi {
    int size, rank;
    const koksma__transport *mpi;
    bool released; /* set on rank 0 when all other ranks know that no work is left */
} koksma__mpi;

/* Finds out at the first call, which loads MPI if mpirun started this process. */
koksma__mpi *koksma__mpi_get(void);

/* Ranks of this run; 1 without MPI. */
int koksma__mpi_size(void);

/* Fails in a build without MPI that runs under mpirun. From here on the other ranks wait for rank 0, and end with it.
 */
koksma_status koksma__mpi_check(void);

/* Rank 0 does what comes without the others, which may end before it. */
void koksma__mpi_release(void);

/* Sleeps: a short rest of one who polls. */
void koksma__mpi_rest(double seconds);

#endif
