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

/* Calls `see` for every result in the store. */
koksma_status koksma__store_scan(koksma__store *store, void (*see)(void *context, long long series, long long trial),
                                 void *context);

/* Like koksma__store_scan, but passes on every row: one without a value as a result of the first series of its group.
   Runs write such rows only for images whose error is no number. */
koksma_status koksma__store_scan_rows(koksma__store *store,
                                      void (*see)(void *context, long long series, long long trial), void *context);

/* Reads the values of a trial in the four series from `group`, a multiple of four; *found: whether there is such
   a row. */
koksma_status koksma__store_row(koksma__store *store, long long group, long long trial, uint64_t *seed,
                                double values[KOKSMA__RESULT_VALUES], bool *found);

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

/* ---- Failed jobs (store_failed.c) ---------------------------------------------------------------------------- */

/* Appends the store's lines to `stored`. Errors: those of the store, MEMORY. */
koksma_status koksma__left_out_recall(koksma__store *store, koksma__texts *stored);

/* Makes the lines for readers from the store's lines. Errors: MEMORY. */
koksma_status koksma__left_out_show(const koksma__texts *stored, koksma__texts *lines);

/* Adds up the failed trials of the store's lines. Errors: those of the store, MEMORY. */
koksma_status koksma__left_out_count(koksma__store *store, size_t *trials);

/* Writes the lines, and those for readers, into the store. Errors: those of the store, MEMORY. */
koksma_status koksma__left_out_record(koksma__store *store, const koksma__texts *stored, const koksma__texts *lines);

/* Reads the lines for readers that a run wrote, each ended by a newline. The caller frees *lines. */
koksma_status koksma__left_out_text(koksma__store *store, char **lines);

/* Removes the lines of one run that repeat an earlier line's label, n and reason with no more failed trials. Lines with
   different reasons are of different jobs: the measures of two blocks may refuse the same set. Errors: MEMORY. */
koksma_status koksma__left_out_thin(koksma__texts *lines);

/* Appends the lines to `to`, except those of which `known`, of another run, has a line of equal label and n with at least
   as many failed trials: the reason may be another trial's. Trials that failed once fail in every run, so that the run that
   counted more of them has tried more of them. Errors: MEMORY. */
koksma_status koksma__left_out_add(const koksma__texts *lines, const koksma__texts *known, koksma__texts *to);

#endif
