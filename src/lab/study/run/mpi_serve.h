/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_STUDY_RUN_MPI_SERVE_H
#define KOKSMA_STUDY_RUN_MPI_SERVE_H

#include "study/run/run_state.h"

/* Rank 0's part of a phase: sends assignments to the other ranks, receives their results, and does some assignments
   itself. */
koksma_status koksma__mpi_serve(koksma__phase *phase);

#endif
