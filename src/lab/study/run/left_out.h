/* SPDX-License-Identifier: Apache-2.0 */
/* The list of failed jobs in a store (left_out.c); failed_jobs.c makes its lines. */
#ifndef KOKSMA_STUDY_RUN_LEFT_OUT_H
#define KOKSMA_STUDY_RUN_LEFT_OUT_H

#include "study/plan/plan.h"
#include "study/store/store.h"

/* Appends a copy of the text. Errors: MEMORY. */
koksma_status koksma__texts_add(koksma__texts *texts, const char *text);

/* Appends the store's lines to `stored`. Errors: those of the store, MEMORY. */
koksma_status koksma__left_out_recall(koksma__store *store, koksma__texts *stored);

/* Makes the lines for readers from the store's lines. Errors: MEMORY. */
koksma_status koksma__left_out_show(const koksma__texts *stored, koksma__texts *lines);

/* Adds up the failed trials of the store's lines. Errors: those of the store, MEMORY. */
koksma_status koksma__left_out_count(koksma__store *store, size_t *trials);

/* Writes the lines, and those for readers, into the store. Errors: those of the store, MEMORY. */
koksma_status koksma__left_out_record(koksma__store *store, const koksma__texts *stored, const koksma__texts *lines);

/* Removes the lines of one run that repeat an earlier line's label, n and reason with no more failed trials. Lines with
   different reasons are of different jobs: the measures of two blocks may refuse the same set. Errors: MEMORY. */
koksma_status koksma__left_out_thin(koksma__texts *lines);

/* Appends the lines to `to`, except those of which `known`, of another run, has a line of equal label and n with at least
   as many failed trials: the reason may be another trial's. Trials that failed once fail in every run, so that the run that
   counted more of them has tried more of them. Errors: MEMORY. */
koksma_status koksma__left_out_add(const koksma__texts *lines, const koksma__texts *known, koksma__texts *to);

#endif
