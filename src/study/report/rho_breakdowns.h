/* SPDX-License-Identifier: Apache-2.0 */
/* Tables of mean rank correlations over parts of the cases. */
#ifndef KOKSMA_STUDY_REPORT_RHO_BREAKDOWNS_H
#define KOKSMA_STUDY_REPORT_RHO_BREAKDOWNS_H

#include "study/report/questions/topic.h"
#include "study/report/rho_ranking.h"

/* A table of the means by scene, by the plan's groups of scenes and by number of samples, each where there are two or
   more, with the best of each and those that are surely worse. Errors: MEMORY. */
koksma_status koksma__rho_breakdowns(koksma__document *d, const koksma__topic *topic, const koksma__rho_means *s);

#endif
