/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_STUDY_RUN_MPI_WORK_H
#define KOKSMA_STUDY_RUN_MPI_WORK_H

#include "study/run/study.h"

/* The part of a run on every rank but 0: requests assignments from rank 0 and sends results, until no work is
   left. */
koksma_status koksma__mpi_work(koksma_study *study, const koksma_run *job);

#endif
