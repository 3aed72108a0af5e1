/* SPDX-License-Identifier: Apache-2.0 */
/* The SHA-256 of all rows of a store. */
#ifndef KOKSMA_STUDY_REPORT_EXPORT_H
#define KOKSMA_STUDY_REPORT_EXPORT_H

#include "study/store/store.h"

/* SHA-256 of the bytes that koksma_study_export writes as CSV. run: asked whether to go on, always with the fraction 0; may
   be NULL. Errors: those of the store, MEMORY, INTERRUPTED. */
koksma_status koksma__rows_sha256(koksma__store *store, const koksma_run *run, char text[KOKSMA__SHA256_TEXT]);

#endif
