/* SPDX-License-Identifier: Apache-2.0 */
/* The limits of what the blocks of a plan have together. */
#ifndef KOKSMA_STUDY_RUN_TASK_LIMITS_H
#define KOKSMA_STUDY_RUN_TASK_LIMITS_H

#include "study/run/study.h"

/* Checks the sums over all blocks from the lengths of their lists: of tasks (tasks.h), of series, and of references. The
   sums have what a block leaves out, and what blocks share once for each. The plan of an audit is not checked: rows of the
   store are behind each of its tasks, series and references, so that it is at most some times as long as the store.
   Errors: ARGUMENT. */
koksma_status koksma__task_limits_check(const koksma_study *study);

#endif
