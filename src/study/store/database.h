/* SPDX-License-Identifier: Apache-2.0 */
/* An SQLite file, without any knowledge of studies: database.c alone includes SQLite. The caller lets one thread at a
   time call these functions. Errors of those that return a status: IO (can't be written; another run holds it),
   MALFORMED (no database, or a damaged one), MEMORY. */
#ifndef KOKSMA_STUDY_STORE_DATABASE_H
#define KOKSMA_STUDY_STORE_DATABASE_H

#include <koksma/koksma.h>

typedef struct koksma__database koksma__database;
typedef struct sqlite3_stmt koksma__statement;

/* The first 100 bytes of a file, read before SQLite opens it. */
typedef struct koksma__database_header {
    bool exists, is_empty, has_journal; /* journal: another program was killed at work on it */
    uint32_t application_id, version;   /* PRAGMA application_id and user_version */
} koksma__database_header;

/* Errors: MALFORMED (neither empty nor a database; no plain file), IO (can't be read). */
koksma_status koksma__database_look(const char *path, koksma__database_header *header);

typedef enum koksma__database_mode {
    KOKSMA__DATABASE_READ,  /* changes no byte of the file and of its folder, which need not be writable; a run can't
                               begin until it is closed */
    KOKSMA__DATABASE_WRITE, /* of a file that exists: by itself, with a write-ahead log */
    KOKSMA__DATABASE_LOCK,  /* the same; all that is written is what a log or a journal holds */
    KOKSMA__DATABASE_BUILD  /* of an empty file that nobody else knows; "": in memory */
} koksma__database_mode;

koksma_status koksma__database_open(const char *path, koksma__database_mode mode, koksma__database **out);
void koksma__database_close(koksma__database *database); /* after its statements; what was not committed is lost */

/* The file `old`, which must stay open, as it is now: its tables are old.NAME. */
koksma_status koksma__database_attach(koksma__database *database, const koksma__database *old);

/* Whether another file has the name since this one was opened. */
bool koksma__database_has_moved(koksma__database *database);

/* For errors. */
const char *koksma__database_path(const koksma__database *database);

/* One statement or several, without values; their rows are passed over. */
koksma_status koksma__database_execute(koksma__database *database, const char *sql);

/* How many rows the last statement inserted, also one that failed; whether it failed because there is such a row. */
int koksma__database_changes(koksma__database *database);
bool koksma__database_had_conflict(koksma__database *database);

/* A statement that is carried out often, with a value for each '?'. */
koksma_status koksma__statement_open(koksma__database *database, const char *sql, koksma__statement **out);
void koksma__statement_close(koksma__statement *statement);

/* The value of the *column-th '?', from 1, which is counted on. A text must outlive the statement's next reset; NaN
   is stored as NULL. */
void koksma__bind_text(koksma__statement *statement, int *column, const char *text);
void koksma__bind_whole(koksma__statement *statement, int *column, long long value);
void koksma__bind_number(koksma__statement *statement, int *column, double value);

/* Carries out a statement that has no rows. */
koksma_status koksma__statement_run(koksma__database *database, koksma__statement *statement);

/* Whether there is a next row, to be read until the next call; does nothing unless *status is OK. After the last row
   that was wanted comes a reset. */
bool koksma__next_row(koksma__database *database, koksma__statement *statement, koksma_status *status);
void koksma__statement_reset(koksma__statement *statement);

/* A column of the row, from 0. A damaged database may have NULL where the schema forbids it: that is an empty text,
   0, and NaN. */
const char *koksma__column_text(koksma__statement *statement, int column);
long long koksma__column_whole(koksma__statement *statement, int column);
double koksma__column_number(koksma__statement *statement, int column);
bool koksma__column_is_null(koksma__statement *statement, int column);

/* Whether a column is what the schema says: a finite number or NULL; a whole number; a text. */
bool koksma__column_has_number(koksma__statement *statement, int column);
bool koksma__column_has_whole(koksma__statement *statement, int column);
bool koksma__column_has_text(koksma__statement *statement, int column);

#endif
