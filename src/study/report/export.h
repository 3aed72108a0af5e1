/* SPDX-License-Identifier: Apache-2.0 */
/* The SHA-256 of all rows of a store. */
#ifndef KOKSMA_STUDY_REPORT_EXPORT_H
#define KOKSMA_STUDY_REPORT_EXPORT_H

#include "study/store/store.h"

/* SHA-256 of the bytes that koksma_study_export writes as CSV. */
koksma_status koksma__rows_sha256(koksma__store *store, char text[KOKSMA__SHA256_TEXT]);

#endif
