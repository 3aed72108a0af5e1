/* SPDX-License-Identifier: Apache-2.0 */
/* Joining and freeing plans, and searching their lists. */
#ifndef KOKSMA_STUDY_PLAN_PLAN_OWNED_H
#define KOKSMA_STUDY_PLAN_PLAN_OWNED_H

#include "study/plan/plan.h"

/* Makes a newly read plan consist of one part, which gets the plan's title, text and all its blocks. Errors:
   MEMORY. */
koksma_status koksma__plan_own(koksma__plan *plan);

/* Moves everything in `from` to the end of `plan`, and joins the names as "a+b"; `from` is empty afterwards. */
koksma_status koksma__plan_append(koksma__plan *plan, koksma__plan *from);

/* Frees everything that a plan owns. */
void koksma__plan_fini(koksma__plan *plan);

/* Frees a list of texts. */
void koksma__texts_fini(koksma__texts *texts);

/* Whether a list contains a text, or a number. */
bool koksma__texts_have(const koksma__texts *texts, const char *text);

bool koksma__wholes_have(const koksma__wholes *wholes, long long value);

/* The table of a part with this id, and the row of a table with this pattern; NULL: none. */
const koksma__table *koksma__plan_table_of(const koksma__plan *plan, size_t part, const char *id);
const koksma__table_row *koksma__plan_row_of(const koksma__table *table, const char *pattern);

/* Whether the block evaluates this measure on n points of this pattern in dim dimensions, without a warp. */
bool koksma__plan_block_makes(const koksma__discrepancy_block *block, const char *measure, const char *pattern,
                              long long n, long long dim);

#endif
