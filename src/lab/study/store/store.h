/* SPDX-License-Identifier: Apache-2.0 */
/* The results of a study in DIR/results.sqlite (schema.sql). Committed rows survive a kill of the program;
   existing values are never overwritten. Several threads may call all functions. */
#ifndef KOKSMA_STUDY_STORE_STORE_H
#define KOKSMA_STUDY_STORE_STORE_H

#include <koksma/koksma.h>

#include "core/hash.h"
#include "study/plan/plan.h"

typedef struct koksma__store koksma__store;

/* The key of a row, except for the trial. */
typedef struct koksma__series {
    const char *kind;   /* "discrepancy", "image", "coherence" or "metric" */
    const char *metric; /* canonical spec of the metric of a series of kind "metric"; else "", or NULL in a lookup */
    const char *scene, *scene_hash, *options, *pattern, *what;
    long long n, dim, width, height;
    /* The revisions of the code (made_by.h) that made the points or the image, and that measured them. Reading a
       series sets them; looking one up or adding one ignores them and uses the revisions of this program. */
    const char *made_by, *measured_by;
    long long id; /* id of a series that was read; 0: unknown */
} koksma__series;

/* The values of a result. A discrepancy has one value; an image the mean, SD, maximum and RMSE of its error; a
   coherence the coherence, its p and the peak's frequency in x and y; a metric its value, the robust value and the
   share of the pixels with the largest errors (koksma_metric_value). NaN: no value. */
enum { KOKSMA__RESULT_VALUES = 4 };

typedef struct koksma__result {
    long long trial;
    uint64_t seed;
    double values[KOKSMA__RESULT_VALUES];
} koksma__result;

/* A reference: its standard error, NaN if unknown, and the SHA-256 of its pixels, "" if unknown. */
typedef struct koksma__reference_row {
    double standard_error;
    char pixels[KOKSMA__SHA256_TEXT];
} koksma__reference_row;

typedef struct koksma__run_record {
    char started[24], machine[256], version[32];
    long long workers, jobs;
    double seconds, idle_seconds, processor_seconds, store_seconds;
} koksma__run_record;

typedef enum koksma__store_mode {
    KOKSMA__STORE_WRITE, /* opens a store to write, or creates it */
    KOKSMA__STORE_READ   /* opens an existing store; changes no byte of the folder, which need not be writable */
} koksma__store_mode;

/* Opens a store; if plan_name is NULL, the store may belong to any plan. Errors: MISSING (to read), IO (can't
   be written, or another run holds it), MALFORMED (not a store, of another schema, or of another plan; the file is
   not changed). */
koksma_status koksma__store_open(const char *path, koksma__store_mode mode, const char *plan_name,
                                 koksma__store **store);
koksma_status koksma__store_close(koksma__store *store);

/* Commits all results so far to disk. */
koksma_status koksma__store_commit(koksma__store *store);

/* Seconds of processor time spent so far in calls of this store, except those that only copy rows into memory. */
double koksma__store_seconds(koksma__store *store);

/* Forgets the hashes of the files that patterns name, so that the next key has the hash of the file as it is then. */
void koksma__store_forget_files(koksma__store *store);

/* Writes or replaces a text of table meta; reads one. The caller frees *value, which is NULL if there is no such
   text. */
koksma_status koksma__store_set_text(koksma__store *store, const char *key, const char *value);
koksma_status koksma__store_get_text(koksma__store *store, const char *key, char **value);

/* Finds the id of a series. If the series does not exist, creates it if `add`, and otherwise sets *id to 0. */
koksma_status koksma__store_series(koksma__store *store, const koksma__series *series, bool add, long long *id);

/* Writes results, each to its series, unless the series already has a result of that trial. Results are gathered
   before they are written, so that an error may be returned by a later call. */
koksma_status koksma__store_put(koksma__store *store, const long long *series, const koksma__result *results,
                                size_t n);

/* Calls `see` for each result in the store; every: also for rows without a value, which runs write only for images whose
   error is no number. */
koksma_status koksma__store_scan(koksma__store *store, bool every,
                                 void (*see)(void *context, long long series, long long trial), void *context);

/* Reads the seed and the values of the trial result->trial of a series; *found: whether there is such a row. */
koksma_status koksma__store_row(koksma__store *store, long long series, koksma__result *result, bool *found);

/* Reads the results of a series with trials below `trials`, in order; the caller frees *results. Series 0 has
   none. */
koksma_status koksma__store_results(koksma__store *store, long long series, long long trials,
                                    koksma__result **results, size_t *n);

/* Calls `visit` for all rows in the order of their keys; stops at the first status that is not OK, and returns
   it. */
typedef koksma_status (*koksma__row_visitor)(void *context, const koksma__series *series,
                                             const koksma__result *result);
koksma_status koksma__store_visit(koksma__store *store, koksma__row_visitor visit, void *context);

/* Write and read a reference. From `series` they use the scene, its hash, the options, the size, and `what`. */
koksma_status koksma__store_put_reference(koksma__store *store, const koksma__series *series,
                                          const koksma__reference_row *row);
koksma_status koksma__store_reference(koksma__store *store, const koksma__series *series, koksma__reference_row *row);

koksma_status koksma__store_put_run(koksma__store *store, const koksma__run_record *record);
/* Reads run number i, in the order in which runs ended; *found is false if there are no more. */
koksma_status koksma__store_run(koksma__store *store, long long i, koksma__run_record *record, bool *found);

/* ---- Failed jobs (store.c) ---------------------------------------------------------------------------- */

/* The failed jobs of a task. label: all that tells it from others but n. */
typedef struct koksma__failed {
    char *label, *reason;
    long long n, failed, trials;
} koksma__failed;

/* Writes the failed jobs of a run. all: whether the run tried every job; otherwise the rows of earlier runs stay, except
   those of which this run has one of equal label and n with at least as many failed trials, and vice versa: the reason may
   be another trial's. Trials that failed once fail in every run, so that the run that counted more of them has tried more.
   Of rows of one run with equal label, n and reason that with the most failed trials counts; those with different
   reasons are of different jobs: the measures of two blocks may refuse the same set. */
koksma_status koksma__store_put_failed(koksma__store *store, const koksma__failed *at, size_t n, bool all);

/* Appends the lines for readers. */
koksma_status koksma__store_failed(koksma__store *store, koksma__texts *lines);

/* Adds up the failed trials. */
koksma_status koksma__store_count_failed(koksma__store *store, size_t *trials);

/* Write and append the lines of all that was left out. */
koksma_status koksma__store_put_left_out(koksma__store *store, const koksma__texts *lines);
koksma_status koksma__store_left_out(koksma__store *store, koksma__texts *lines);

#endif
