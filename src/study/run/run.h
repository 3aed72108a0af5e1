/* SPDX-License-Identifier: Apache-2.0 */
/* The jobs of one kind. */
#ifndef KOKSMA_STUDY_RUN_RUN_H
#define KOKSMA_STUDY_RUN_RUN_H

#include "study/run/run_state.h"

/* Does the jobs that are not done, on threads or on MPI ranks, and adds to the summary and the failures. Does nothing
   but count with a status `before` that is not OK, which comes back. */
koksma_status koksma__run_kind(koksma_study *study, bool images, koksma__run_control *control, koksma_status before,
                               koksma_study_summary *summary, koksma__failures *failures);

#endif
