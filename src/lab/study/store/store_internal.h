/* SPDX-License-Identifier: Apache-2.0 */
/* The internal interface of the store: database.c has SQLite, store_rows.c the series and their rows, store.c
   all other tables. */
#ifndef KOKSMA_STUDY_STORE_STORE_INTERNAL_H
#define KOKSMA_STUDY_STORE_STORE_INTERNAL_H

#include <pthread.h>

#include <koksma/koksma.h>

#include "study/plan/made_by.h"
#include "study/store/store.h"

/* An SQLite file, independent of studies; only database.c includes SQLite. The caller must let only one thread at a
   time call these functions. Errors of those that return a status: IO (the file can't be written, or another run
   uses it), MALFORMED (it is not a database, or is damaged), MEMORY. */

typedef struct koksma__database koksma__database;
typedef struct sqlite3_stmt koksma__statement;

/* Opens a file, or a new one if it `writes`. */
koksma_status koksma__database_open(const char *path, bool writes, koksma__database **out);
/* Closes a database whose statements are closed; what was not committed is lost. */
void koksma__database_close(koksma__database *database);

/* The path of the database, for error messages. */
const char *koksma__database_path(const koksma__database *database);

/* Runs one or more SQL statements without parameters and ignores the rows that they return. */
koksma_status koksma__database_execute(koksma__database *database, const char *sql);

/* A prepared statement, for repeated use with a value for each '?'. */
koksma_status koksma__statement_open(koksma__database *database, const char *sql, koksma__statement **out);
void koksma__statement_close(koksma__statement *statement);

/* Binds values to the parameters of a statement from number `first` on, counted from 1. types has a letter for each, which
   is the type of its argument: t a text, which must stay valid until the statement's next reset; w a long long; n a double,
   of which NaN is stored as NULL. */
void koksma__bind(koksma__statement *statement, int first, const char *types, ...);

/* Runs a statement that returns no rows. */
koksma_status koksma__statement_run(koksma__database *database, koksma__statement *statement);

/* Steps to the next row and returns whether there is one; its columns can be read until the next call. Does
   nothing unless *status is OK. Resets the statement after the last row that the caller needs. */
bool koksma__next_row(koksma__database *database, koksma__statement *statement, koksma_status *status);
void koksma__statement_reset(koksma__statement *statement);

/* Reads columns of the current row from number `first` on, counted from 0: t a const char *, w a long long, n a double,
   whose addresses follow. A damaged database may contain anything: NULL is read as an empty text, 0, or NaN. Returns
   whether every column has its type: a text; a whole number; a finite number or NULL. */
bool koksma__read(koksma__statement *statement, int first, const char *types, ...);

/* A row of table result: one trial of a series; id: 2^32 trial + series. */
typedef struct koksma__row {
    long long id;
    uint64_t seed;
    double values[KOKSMA__RESULT_VALUES];
} koksma__row;

/* The prepared statements, whose SQL is in store_open.c. */
typedef enum koksma__query {
    KOKSMA__FIND_SERIES,
    KOKSMA__ADD_SERIES,
    KOKSMA__PUT_ROW,
    KOKSMA__PUT_ROWS,
    KOKSMA__GET_ROW,
    KOKSMA__GET_RESULTS,
    KOKSMA__GET_ROWS,
    KOKSMA__GET_SERIES,
    KOKSMA__GET_TABLES,
    KOKSMA__PUT_REFERENCE,
    KOKSMA__GET_REFERENCE,
    KOKSMA__PUT_TEXT,
    KOKSMA__GET_TEXT,
    KOKSMA__PUT_FAILED,
    KOKSMA__GET_FAILED,
    KOKSMA__COUNT_FAILED,
    KOKSMA__PUT_LEFT_OUT,
    KOKSMA__GET_LEFT_OUT,
    KOKSMA__PUT_RUN,
    KOKSMA__GET_RUN,
    KOKSMA__N_QUERIES
} koksma__query;

/* Number of rows that PUT_ROWS inserts; version of the schema. */
enum { KOKSMA__ROWS_AT_ONCE = 32, KOKSMA__SCHEMA = 8 };

/* Rows are gathered in memory and written together, because one statement for each row would take most of the
   time of small jobs. A killed run loses the rows of this many seconds, or of one job if that takes longer. */
static const double KOKSMA__WRITE_AFTER_S = 0.2;

typedef struct koksma__rows {
    size_t n;
    koksma__row *at;
} koksma__rows;

struct koksma__store {
    koksma__database *database;
    koksma__statement *queries[KOKSMA__N_QUERIES];
    pthread_mutex_t lock; /* guards the database and the members below */
    bool in_transaction;
    koksma_status failed; /* status of the first write that failed, after which nothing more is written */
    char reason[512];     /* its error text */
    double began_s, entered_s, seconds;
    koksma__rows spare;
    bool sorted;                 /* whether the table temp.sorted has all rows of result */
    pthread_mutex_t gather_lock; /* guards the members below; may be taken while `lock` is held */
    koksma__rows gathered;
    double written_s; /* time of the last write of rows (koksma__now_s) */
    koksma__point_files files;
    char hash[KOKSMA__HASH_TEXT]; /* the hash and made_by are bound to statements, and so must outlive them */
    koksma__made_by made_by;
};

/* ---- store.c: the lock must be held for all of these but koksma__store_enter -------------------------------------- */

/* koksma__store_enter takes the lock and starts to count processor time; koksma__store_leave stops counting, releases
   the lock and returns `status`. */
void koksma__store_enter(koksma__store *store);
koksma_status koksma__store_leave(koksma__store *store, koksma_status status);

/* Sets *key to the key of the series' row: `series`, the hash of a points file that its pattern or reference names,
   and the revisions of this program. *key is valid until the next call. */
void koksma__store_bind_key(koksma__store *store, const koksma__series *series, koksma__series *key);

/* Records the status of a statement that writes, and returns it. After a failure nothing more is written. */
koksma_status koksma__store_wrote(koksma__store *store, koksma_status status);

/* Begin a transaction unless one is open; end the open transaction if there is one, if it has lasted
   KOKSMA__WRITE_AFTER_S seconds (tick) or at once. */
koksma_status koksma__store_begin(koksma__store *store);
koksma_status koksma__store_tick(koksma__store *store);
koksma_status koksma__store_end(koksma__store *store);

/* ---- store_rows.c ------------------------------------------------------------------------------------------------ */

koksma_status koksma__store_rows_init(koksma__store *store);
void koksma__store_rows_fini(koksma__store *store);

/* Writes and commits all gathered rows. */
koksma_status koksma__store_write_rows(koksma__store *store);

#endif
