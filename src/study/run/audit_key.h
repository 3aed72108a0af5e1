/* SPDX-License-Identifier: Apache-2.0 */
/* Whether the key of a series or reference in a store is one that a run writes. */
#ifndef KOKSMA_STUDY_RUN_AUDIT_KEY_H
#define KOKSMA_STUDY_RUN_AUDIT_KEY_H

#include "study/store/store.h"

/* The columns that rows of the key's kind do not use must be empty or 0, as runs write them. A reference is a row of table
   `reference`. Errors: MALFORMED. */
koksma_status koksma__audit_unused(const koksma__series *key, bool is_reference);

/* All texts must be canonical, as runs of this program write them. Errors: MALFORMED, those of the specs. */
koksma_status koksma__audit_texts(const koksma__series *key, bool is_reference);

#endif
