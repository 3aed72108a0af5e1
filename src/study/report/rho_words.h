/* SPDX-License-Identifier: Apache-2.0 */
/* The sentences and tables on which measures order the patterns as the errors do. */
#ifndef KOKSMA_STUDY_REPORT_RHO_WORDS_H
#define KOKSMA_STUDY_REPORT_RHO_WORDS_H

#include "study/report/document.h"
#include "study/report/rho_ranking.h"

/* The headline, which states only what holds over all scenes and whichever one is left out, and says what does not.
 */
void koksma__rho_sentence(koksma__document *d, const koksma__rho_means *s, const koksma__rho_jackknife *jackknife);

/* The table of all measures over all cases. */
void koksma__rho_table(koksma__document *d, const char *id, const koksma__rho_means *s,
                       const koksma__rho_jackknife *jackknife);

#endif
