/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_STUDY_RUN_MPI_WORK_H
#define KOKSMA_STUDY_RUN_MPI_WORK_H

#include "study/run/study.h"

/* The other ranks' part of a run: requests assignments of rank 0 and sends results, until rank 0 has no more. */
koksma_status koksma__mpi_work(koksma_study *study, const koksma_run *job);

#endif
