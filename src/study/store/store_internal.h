/* SPDX-License-Identifier: Apache-2.0 */
/* The store from inside: store_open.c makes and opens it, store_schema.c knows its tables, store_upgrade.c brings old
   ones up, store_tables.c reads their rows, store_series.c knows its series, store_rows.c writes their results,
   store_results.c reads them; store.c has the rest. */
#ifndef KOKSMA_STUDY_STORE_STORE_INTERNAL_H
#define KOKSMA_STUDY_STORE_STORE_INTERNAL_H

#include <pthread.h>

#include "study/plan/made_by.h"
#include "study/plan/point_files.h"
#include "study/store/database.h"
#include "study/store/seal.h"
#include "study/store/store.h"

/* The statements of store_open.c. */
typedef enum koksma__query {
    KOKSMA__FIND_SERIES,
    KOKSMA__NEXT_SERIES,
    KOKSMA__ADD_SERIES,
    KOKSMA__PUT_ROW,
    KOKSMA__PUT_ROWS,
    KOKSMA__GET_ROW,
    KOKSMA__GET_RESULTS,
    KOKSMA__FILTER_RESULTS,
    KOKSMA__GET_IDS,
    KOKSMA__GET_SERIES,
    KOKSMA__LAST_SERIES,
    KOKSMA__PUT_REFERENCE,
    KOKSMA__GET_REFERENCE,
    KOKSMA__GET_REFERENCES,
    KOKSMA__PUT_TEXT,
    KOKSMA__GET_TEXT,
    KOKSMA__GET_TEXTS,
    KOKSMA__PUT_RUN,
    KOKSMA__GET_RUN,
    KOKSMA__N_QUERIES
} koksma__query;

/* Rows that PUT_ROWS takes; columns of GET_SERIES before the id. */
enum { KOKSMA__ROWS_AT_ONCE = 32, KOKSMA__SERIES_COLUMNS = 12, KOKSMA__SCHEMA = 6 };

/* Rows are gathered in memory and written together: a statement a row would take most of the time of small jobs. A
   killed run loses what was gathered in this time, or in one job if that takes longer. */
static const double KOKSMA__WRITE_AFTER_S = 0.2;

/* Results lie four in a row. Of an image or a coherence they are one result; of point sets one value each of four
   measures: the series of one pattern, n, dim and options have ids that follow each other from a multiple of GROUP,
   as far as they were made one after the other. A row's id is in the order in which a run makes rows, so that they
   are appended. */
enum { KOKSMA__GROUP = KOKSMA__RESULT_VALUES };

static inline long long koksma__group_of(long long series)
{
    return series - series % KOKSMA__GROUP;
}

typedef struct koksma__rows {
    size_t n;
    koksma__row *at;
} koksma__rows;

typedef struct koksma__known_series {
    bool alone;           /* its four values are one result; else the results of up to four series share a row */
    long long end, count; /* all its trials are below; how many there are */
} koksma__known_series;

struct koksma__store {
    koksma__database *database;
    koksma__statement *queries[KOKSMA__N_QUERIES];
    pthread_mutex_t lock;        /* guards the database, and what follows */
    bool in_transaction, failed; /* failed: a write did, and nothing is written any more */
    koksma__seal seal, sealed;   /* of what was written; as meta has it */
    koksma__seal found;          /* of what the last scan has read */
    bool for_audit;              /* where these two differ, it is no error */
    double began_s, entered_s, seconds;
    koksma__rows spare;
    size_t n_known;              /* of `known`, by the id of a series */
    koksma__known_series *known; /* read when it is first wanted */
    bool knows_ends;
    pthread_mutex_t gather_lock; /* taken within the other; guards what follows */
    koksma__rows gathered;
    double written_s; /* when something was last written */
    koksma__point_files files;
    char hash[KOKSMA__HASH_TEXT]; /* these two are bound */
    koksma__made_by made_by;
};

/* ---- store.c: all of it but enter with the lock held ----------------------------------------------------------- */

/* Takes the lock and counts the time until it is left; leave hands the status on. */
void koksma__store_enter(koksma__store *store);
koksma_status koksma__store_leave(koksma__store *store, koksma_status status);

/* The key of the series' row: with the hash of a points' file where its pattern, or its reference, names one, and
   with the revisions of this program; until the next call. */
void koksma__store_bind_key(koksma__store *store, const koksma__series *series, koksma__series *key);

/* What a statement that writes has come to: after a failure nothing is written any more, as what is in the seal may
   not be in the file. */
koksma_status koksma__store_wrote(koksma__store *store, koksma_status status);

/* Reads the seal from meta. */
koksma_status koksma__seal_read(koksma__store *store);

/* A transaction, unless there is one; its end, if there is one. */
koksma_status koksma__store_begin(koksma__store *store);
koksma_status koksma__store_end(koksma__store *store);

/* Carries out a statement that writes, in a transaction, which ends when it has lasted. */
koksma_status koksma__store_write(koksma__store *store, koksma__query query);

koksma_status koksma__store_put_text(koksma__store *store, const char *key, const char *value);
koksma_status koksma__store_find_text(koksma__store *store, const char *key, char **value);

/* ---- store_schema.c ------------------------------------------------------------------------------------------- */

/* Whether the database has the tables of a schema of ours and nothing else: KOKSMA__SCHEMA, or an older one that
   can be upgraded. Errors: MALFORMED (another program's, or a newer schema). */
koksma_status koksma__schema_of(koksma__database *database, const koksma__database_header *header, int *schema);

/* Whether the header has our application's id. */
bool koksma__schema_is_ours(const koksma__database_header *header);

/* Makes the tables of KOKSMA__SCHEMA in an empty database. */
koksma_status koksma__schema_make(koksma__database *database);

/* ---- store_upgrade.c ------------------------------------------------------------------------------------------ */

/* The rows of `old`, which is of that schema and attached, into a new store. */
koksma_status koksma__store_upgrade(int schema, koksma__store *store);

/* ---- store_tables.c ------------------------------------------------------------------------------------------- */

/* Adds the rows of all tables but result. */
koksma_status koksma__seal_rest(koksma__store *store, koksma__seal *seal);

/* MALFORMED: what is there is not what was written. */
koksma_status koksma__seal_fail(const koksma__store *store);

/* The row of table series that a statement is at (GET_SERIES). */
koksma_status koksma__store_read_series(koksma__store *store, koksma__statement *s, koksma__series *key,
                                        long long *id);

/* The row of table result from a column on: seed, values. The id is set. */
koksma_status koksma__store_read_row(koksma__store *store, koksma__statement *s, int column, koksma__row *row);

/* ---- store_series.c ---------------------------------------------------------------------------------------------
 */

/* Reads which series have rows alone, unless that is known. */
koksma_status koksma__store_know_series(koksma__store *store);
void koksma__store_forget(koksma__store *store);

/* ---- store_rows.c -----------------------------------------------------------------------------------------------
 */

koksma_status koksma__store_rows_init(koksma__store *store);
void koksma__store_rows_fini(koksma__store *store);

/* Writes and commits all rows that were gathered. */
koksma_status koksma__store_write_rows(koksma__store *store);

#endif
