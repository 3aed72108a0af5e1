/* SPDX-License-Identifier: Apache-2.0 */
/* Tables of mean rank correlations over parts of the cases. */
#ifndef KOKSMA_STUDY_REPORT_RHO_BREAKDOWNS_H
#define KOKSMA_STUDY_REPORT_RHO_BREAKDOWNS_H

#include "study/report/questions/topic.h"
#include "study/report/rho_ranking.h"

/* Writes a table of the means by group of scenes if the plan has groups, one by scene if there are two or more
   scenes, and one by number of samples if there are two or more. Each row names its best measure and those that are
   significantly worse. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__rho_breakdowns(koksma__document *d, const koksma__topic *topic, const koksma__rho_means *s);

#endif
