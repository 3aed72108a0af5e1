/* SPDX-License-Identifier: Apache-2.0 */
/* The results of a study in DIR/results.sqlite (schema.sql). Rows survive the death of the program; a row that exists
   is never written again. All calls may come from several threads. */
#ifndef KOKSMA_STUDY_STORE_STORE_H
#define KOKSMA_STUDY_STORE_STORE_H

#include <koksma/koksma.h>

typedef struct koksma__store koksma__store;

/* The key of a row, all but the trial. */
typedef struct koksma__series {
    const char *kind; /* "discrepancy", "image", "coherence" */
    const char *scene, *scene_hash, *options, *pattern, *what;
    long long n, dim, width, height;
} koksma__series;

/* Of a discrepancy only the value; of an image its error's mean, SD, max and RMSE; of a coherence the coherence, its
   p and the peak's frequency in x and y. NaN is no value. */
enum { KOKSMA__RESULT_VALUES = 4 };

typedef struct koksma__result {
    long long trial;
    uint64_t seed;
    double values[KOKSMA__RESULT_VALUES];
} koksma__result;

typedef struct koksma__run_record {
    char started[24], machine[256], version[32];
    long long workers, jobs;
    double seconds, idle_seconds, processor_seconds, store_seconds;
} koksma__run_record;

typedef enum koksma__store_mode {
    KOKSMA__STORE_WRITE, /* opens or creates */
    KOKSMA__STORE_READ   /* opens what is there */
} koksma__store_mode;

/* plan_name NULL: whatever plan it is of. Errors: MISSING (to read), IO (can't be written; another run holds it),
   MALFORMED (not such a database, of another schema, version or plan). */
koksma_status koksma__store_open(const char *path, koksma__store_mode mode, const char *plan_name,
                                 koksma__store **store);
koksma_status koksma__store_close(koksma__store *store);

/* Puts everything so far on disk. */
koksma_status koksma__store_commit(koksma__store *store);

/* Processor time spent in calls of this store so far; gathering rows is a copy and not counted. */
double koksma__store_seconds(koksma__store *store);

/* A text of table meta; set replaces. *value is the caller's, NULL when there is none. */
koksma_status koksma__store_set_text(koksma__store *store, const char *key, const char *value);
koksma_status koksma__store_get_text(koksma__store *store, const char *key, char **value);

/* The id of a series; with `add` it is made when it does not exist, else *id is 0 then. */
koksma_status koksma__store_series(koksma__store *store, const koksma__series *series, bool add, long long *id);

/* Writes results, each of its series, unless there is one of that trial. They are gathered: a later call may be the
   one that fails. */
koksma_status koksma__store_put(koksma__store *store, const long long *series, const koksma__result *results,
                                size_t n);

/* Shows every row that there is. */
koksma_status koksma__store_scan(koksma__store *store, void (*see)(void *context, long long series, long long trial),
                                 void *context);

/* The results of trials below `trials` in their order; *results is the caller's. series 0 has none. */
koksma_status koksma__store_results(koksma__store *store, long long series, long long trials,
                                    koksma__result **results, size_t *n);

/* All rows in order of their keys; a status that is not OK stops and comes back. */
typedef koksma_status (*koksma__row_visitor)(void *context, const koksma__series *series,
                                             const koksma__result *result);
koksma_status koksma__store_visit(koksma__store *store, koksma__row_visitor visit, void *context);

/* The standard error of a reference; series: its scene, hash, options, size, and `what`. NaN when unknown. */
koksma_status koksma__store_put_reference(koksma__store *store, const koksma__series *series, double standard_error);
koksma_status koksma__store_reference(koksma__store *store, const koksma__series *series, double *standard_error);

koksma_status koksma__store_put_run(koksma__store *store, const koksma__run_record *record);
/* Run i in the order in which they ended; *found is false past the end. */
koksma_status koksma__store_run(koksma__store *store, long long i, koksma__run_record *record, bool *found);

#endif
