/* SPDX-License-Identifier: Apache-2.0 */
/* The rows of a ranking, from the state of its contest. */
#ifndef KOKSMA_STUDY_RANKING_RANKING_ROWS_H
#define KOKSMA_STUDY_RANKING_RANKING_ROWS_H

#include "study/ranking/ranking_contest.h"

/* Stores the excess of a quotient over 1 with its interval, which is NaN at both ends if one of them is not known. */
void koksma__rank_put_behind(koksma__estimate q, double *behind, double *low, double *high);

/* Writes a row for each contestant, in their order, and the fields of *out that follow from the rows. Errors: MEMORY. */
koksma_status koksma__rank_fill_rows(const koksma__contest *c, koksma_rank_row *rows, koksma_ranking *out);

/* Decides the best of the patterns that have a complete round, if there are several, when the time is up for the
   others. Errors: MEMORY. */
koksma_status koksma__rank_settle_without_slow(koksma__rank_table *table);

#endif
