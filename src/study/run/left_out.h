/* SPDX-License-Identifier: Apache-2.0 */
/* The list of failed jobs in a store (left_out.c), of which failed_jobs.c makes the lines. */
#ifndef KOKSMA_STUDY_RUN_LEFT_OUT_H
#define KOKSMA_STUDY_RUN_LEFT_OUT_H

#include "study/plan/plan.h"
#include "study/store/store.h"

/* Appends a copy of the text. Errors: MEMORY. */
koksma_status koksma__texts_add(koksma__texts *texts, const char *text);

/* Appends the store's lines to `stored`. Errors: those of the store, MEMORY. */
koksma_status koksma__left_out_recall(koksma__store *store, koksma__texts *stored);

/* Makes the readers' lines of the store's lines. Errors: MEMORY. */
koksma_status koksma__left_out_show(const koksma__texts *stored, koksma__texts *lines);

/* Writes the lines, and those for readers, into the store. Errors: those of the store, MEMORY. */
koksma_status koksma__left_out_record(koksma__store *store, const koksma__texts *stored, const koksma__texts *lines);

/* Whether the store's lines have one of the same task with at least as many failed trials. A trial that failed fails again,
   so that of two runs the one that tried more of them knows more. */
bool koksma__left_out_knows(const koksma__texts *lines, const char *line);

#endif
