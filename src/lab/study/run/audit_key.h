/* SPDX-License-Identifier: Apache-2.0 */
/* Whether the key of a series or reference in a store is one that a run writes. */
#ifndef KOKSMA_STUDY_RUN_AUDIT_KEY_H
#define KOKSMA_STUDY_RUN_AUDIT_KEY_H

#include "study/plan/made_by.h"
#include "study/store/store.h"

/* The columns that rows of the key's kind do not use must be empty or 0, as runs write them. A reference is a row of table
   `reference`. Errors: MALFORMED. */
koksma_status koksma__audit_unused(const koksma__series *key, bool is_reference);

/* Compares the revisions of a key with those of this program, `here`: they must have the same names in the same order, each
   with a whole number. *other: whether a number differs; *newer: whether a number is above that of this program, so that a
   newer version made the row. Errors: MALFORMED. */
koksma_status koksma__audit_revisions(const koksma__series *key, const koksma__made_by *here, bool *other,
                                      bool *newer);

/* All texts must be canonical, as runs of this program write them. Errors: MALFORMED, those of the specs. */
koksma_status koksma__audit_texts(const koksma__series *key, bool is_reference);

#endif
