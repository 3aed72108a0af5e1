/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Studies: patterns x measures and patterns x scenes, over many trials, with the results in DIR/results.sqlite and a
 * report in DIR/report.html. Part of koksma-lab.
 *
 *     koksma_study *study;
 *     if (!koksma_study_open("shirley1991", "out", 0, &study) && !koksma_study_run(study, NULL, NULL))
 *         koksma_study_report(study, NULL);
 *     koksma_study_close(study);
 *
 * A run that was interrupted, in whatever way, goes on where it was: results that are in the store are kept. The rows
 * and the report are the same for any number of threads and interruptions.
 */
#ifndef KOKSMA_STUDY_H
#define KOKSMA_STUDY_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct koksma_study koksma_study;

/* The name of shipped plan i, NULL past the end. */
KOKSMA_API const char *koksma_plan_name_at(size_t i);

/* Opens a plan (a shipped name, or a JSON file when the text has a '/' or ends in ".json") on a folder, which is made
   when it does not exist. trials > 0 replaces the numbers of trials of the plan.
   Errors: UNKNOWN, MISSING, MALFORMED (with file, line and reason), IO (the folder can't be written, another run
   holds it), MEMORY. */
KOKSMA_API koksma_status koksma_study_open(const char *plan, const char *folder, long long trials,
                                           koksma_study **out);

/* Commits what is not yet on disk. Takes NULL. Errors: IO. */
KOKSMA_API koksma_status koksma_study_close(koksma_study *study);

typedef struct koksma_study_summary {
    size_t jobs, done_before, done_now; /* a job is one point set or one render */
} koksma_study_summary;

/* Does the jobs that are not done. run and summary may be NULL. Errors: INTERRUPTED (what is done is kept), IO, and
   what generating, measuring or rendering says. */
KOKSMA_API koksma_status koksma_study_run(koksma_study *study, const koksma_run *run, koksma_study_summary *summary);

/* Writes DIR/report.html: one file that needs no network. */
KOKSMA_API koksma_status koksma_study_report(koksma_study *study, const koksma_run *run);

/* The id of table i of the plan, NULL past the end. */
KOKSMA_API const char *koksma_study_table_at(const koksma_study *study, size_t i);

/* A row of a published table beside ours. NaN where there is no number. */
typedef struct koksma_study_row {
    const char *pattern, *label;
    double published[3];    /* mean, SD, max */
    double mean, low, high; /* our mean over the trials and its 95 % interval */
    double sd, max;         /* image tables: means over the trials; discrepancies: SD over the sets, mean of the
                               largest of 100 */
    double converged;       /* image tables: the mean against the last reference of the plan */
    size_t trials;
} koksma_study_row;

/* Row i of the published table `id` ("5.1"), from what the store has. *found is false past the end. */
KOKSMA_API koksma_status koksma_study_table_row(koksma_study *study, const char *id, size_t i, koksma_study_row *row,
                                                bool *found);

#ifdef __cplusplus
}
#endif

#endif
