/* SPDX-License-Identifier: Apache-2.0 */
/* The sentences and the table of a report that answer which measures order the patterns as their image errors do. */
#ifndef KOKSMA_STUDY_REPORT_RHO_WORDS_H
#define KOKSMA_STUDY_REPORT_RHO_WORDS_H

#include "study/report/document.h"
#include "study/report/rho_ranking.h"

/* Writes the answer. The answer states only results that hold over all scenes and whichever one scene is left out,
   and counts the results that hold over all scenes but not if some scene is left out. */
void koksma__rho_sentence(koksma__document *d, const koksma__rho_means *s, const koksma__rho_jackknife *jackknife);

/* Writes the table of all measures, with their means over all cases. */
void koksma__rho_table(koksma__document *d, const char *id, const koksma__rho_means *s,
                       const koksma__rho_jackknife *jackknife);

#endif
