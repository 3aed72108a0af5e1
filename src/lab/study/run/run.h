/* SPDX-License-Identifier: Apache-2.0 */
/* Runs the jobs of one kind: discrepancies or images. */
#ifndef KOKSMA_STUDY_RUN_RUN_H
#define KOKSMA_STUDY_RUN_RUN_H

#include "study/run/run_state.h"

/* Runs the jobs that the store lacks, on threads or MPI ranks, and adds to the summary and the failures. If
   `before`, the status of an earlier kind, is not OK, only counts the jobs and returns `before`. */
koksma_status koksma__run_kind(koksma_study *study, bool images, koksma__run_control *control, koksma_status before,
                               koksma_study_summary *summary, koksma__failures *failures);

/* koksma_study_undone of a study with a folder, by the hashes of files that the study knows. */
koksma_status koksma__count_undone(koksma_study *study, size_t *jobs, size_t *undone);

/* A rough estimate of the work of one kind of jobs: the number of samples of all images, or of points of all sets
   times the number of their measures; 0: unknown. */
double koksma__run_work(koksma_study *study, bool images);

#endif
