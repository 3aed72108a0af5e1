/* SPDX-License-Identifier: Apache-2.0 */
/* The results of a study in DIR/results.sqlite (schema.sql). Rows survive the death of the program; a row that exists
   is never written again. All calls may come from several threads. */
#ifndef KOKSMA_STUDY_STORE_STORE_H
#define KOKSMA_STUDY_STORE_STORE_H

#include <koksma/koksma.h>

#include "core/sha256.h"

typedef struct koksma__store koksma__store;

/* The key of a row, all but the trial. */
typedef struct koksma__series {
    const char *kind; /* "discrepancy", "image", "coherence" */
    const char *scene, *scene_hash, *options, *pattern, *what;
    long long n, dim, width, height;
    const char *made_by, *measured_by; /* revisions (made_by.h), of a series that was read; to look one up or to add
                                          it, those of this program go in by themselves */
} koksma__series;

/* Of a discrepancy only the value; of an image its error's mean, SD, max and RMSE; of a coherence the coherence, its
   p and the peak's frequency in x and y. NaN is no value. */
enum { KOKSMA__RESULT_VALUES = 4 };

typedef struct koksma__result {
    long long trial;
    uint64_t seed;
    double values[KOKSMA__RESULT_VALUES];
} koksma__result;

/* A reference: its standard error, NaN when unknown, and the SHA-256 of its pixels, "" when unknown. */
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
    KOKSMA__STORE_WRITE, /* opens or creates */
    KOKSMA__STORE_READ,  /* opens what is there, and changes no byte of the folder, which need not be writable */
    KOKSMA__STORE_AUDIT  /* the same, and rows that aren't what runs wrote are no error */
} koksma__store_mode;

/* plan_name NULL: whatever plan it is of. A store of an older schema is upgraded: to write through a copy that takes
   its place when it is whole, to read in memory. Errors: MISSING (to read), IO (can't be written; another run holds
   it), MALFORMED (not such a database, of a newer schema, or of another plan; it is not changed then). */
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

/* The values that a trial has in each of the four series from `group` on, a multiple of four; *found: there is such a
   row. */
koksma_status koksma__store_row(koksma__store *store, long long group, long long trial, uint64_t *seed,
                                double values[KOKSMA__RESULT_VALUES], bool *found);

/* Whether the rows are, by their seal, those that runs wrote; after a scan. */
bool koksma__store_is_sealed(const koksma__store *store);

/* All series; all references, with key.made_by. */
koksma_status koksma__store_visit_series(koksma__store *store,
                                         koksma_status (*visit)(void *context, const koksma__series *key,
                                                                long long id),
                                         void *context);
koksma_status koksma__store_visit_references(koksma__store *store,
                                             koksma_status (*visit)(void *context, const koksma__series *key,
                                                                    const koksma__reference_row *row),
                                             void *context);

/* The results of trials below `trials` in their order; *results is the caller's. series 0 has none. */
koksma_status koksma__store_results(koksma__store *store, long long series, long long trials,
                                    koksma__result **results, size_t *n);

/* All rows in order of their keys; a status that is not OK stops and comes back. */
typedef koksma_status (*koksma__row_visitor)(void *context, const koksma__series *series,
                                             const koksma__result *result);
koksma_status koksma__store_visit(koksma__store *store, koksma__row_visitor visit, void *context);

/* series: its scene, hash, options, size, and `what`. */
koksma_status koksma__store_put_reference(koksma__store *store, const koksma__series *series,
                                          const koksma__reference_row *row);
koksma_status koksma__store_reference(koksma__store *store, const koksma__series *series, koksma__reference_row *row);

koksma_status koksma__store_put_run(koksma__store *store, const koksma__run_record *record);
/* Run i in the order in which they ended; *found is false past the end. */
koksma_status koksma__store_run(koksma__store *store, long long i, koksma__run_record *record, bool *found);

#endif
