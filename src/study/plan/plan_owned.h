/* SPDX-License-Identifier: Apache-2.0 */
/* What a plan owns: putting two together, freeing, and looking something up. */
#ifndef KOKSMA_STUDY_PLAN_PLAN_OWNED_H
#define KOKSMA_STUDY_PLAN_PLAN_OWNED_H

#include "study/plan/plan.h"

/* Makes a plan that was read one part of its own. Errors: MEMORY. */
koksma_status koksma__plan_own(koksma__plan *plan);

/* Appends what `from` has to `plan`, whose name becomes "a+b"; `from` is empty afterwards. */
koksma_status koksma__plan_append(koksma__plan *plan, koksma__plan *from);

/* Frees all that a plan owns. */
void koksma__plan_fini(koksma__plan *plan);

/* Frees a list of texts. */
void koksma__texts_fini(koksma__texts *texts);

/* Whether a list has a text or a number. */
bool koksma__texts_have(const koksma__texts *texts, const char *text);

bool koksma__wholes_have(const koksma__wholes *wholes, long long value);

/* Whether the block has these points and this measure. */
bool koksma__plan_block_makes(const koksma__discrepancy_block *block, const char *measure, const char *pattern,
                              long long n, long long dim);

#endif
