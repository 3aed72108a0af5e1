/* SPDX-License-Identifier: Apache-2.0 */
/* An SQLite file, independent of studies; only database.c includes SQLite. The caller must let only one thread at a
   time call these functions. Errors of those that return a status: IO (the file can't be written, or another run
   uses it), MALFORMED (it is not a database, or is damaged), MEMORY. */
#ifndef KOKSMA_STUDY_STORE_DATABASE_H
#define KOKSMA_STUDY_STORE_DATABASE_H

#include <koksma/koksma.h>

typedef struct koksma__database koksma__database;
typedef struct sqlite3_stmt koksma__statement;

/* Facts about a file from its first 100 bytes, read before SQLite opens it. */
typedef struct koksma__database_header {
    bool exists;
    uint32_t application_id, version; /* values of PRAGMA application_id and user_version */
} koksma__database_header;

/* Reads the header of a file. Errors: MALFORMED (no database, or not a regular file), IO (can't be read). */
koksma_status koksma__database_look(const char *path, koksma__database_header *header);

typedef enum koksma__database_mode {
    /* reads the file and changes no byte of it or of its folder, which need not be writable; no run can begin
       meanwhile */
    KOKSMA__DATABASE_READ,
    KOKSMA__DATABASE_WRITE, /* writes an existing file, with exclusive access and a write-ahead log */
    KOKSMA__DATABASE_BUILD  /* fills an empty file that no other program knows */
} koksma__database_mode;

/* Opens the file `path`; error messages call it `shown`, the path that the user knows. */
koksma_status koksma__database_open(const char *path, const char *shown, koksma__database_mode mode,
                                    koksma__database **out);
/* Closes a database whose statements are closed; what was not committed is lost. */
void koksma__database_close(koksma__database *database);

/* Whether the path now leads to another file than when the database was opened. */
bool koksma__database_has_moved(koksma__database *database);

/* The path of the database, for error messages. */
const char *koksma__database_path(const koksma__database *database);

/* Runs one or more SQL statements without parameters and ignores the rows that they return. */
koksma_status koksma__database_execute(koksma__database *database, const char *sql);

/* The first function returns how many rows the last statement inserted before it ended or failed, the second whether
   it failed because a row existed. */
int koksma__database_changes(koksma__database *database);
bool koksma__database_had_conflict(koksma__database *database);

/* A prepared statement, for repeated use with a value for each '?'. */
koksma_status koksma__statement_open(koksma__database *database, const char *sql, koksma__statement **out);
void koksma__statement_close(koksma__statement *statement);

/* Bind a value to parameter number *column, counted from 1, and increment *column. A text must stay valid until the
   statement's next reset; NaN is stored as NULL. */
void koksma__bind_text(koksma__statement *statement, int *column, const char *text);
void koksma__bind_whole(koksma__statement *statement, int *column, long long value);
void koksma__bind_number(koksma__statement *statement, int *column, double value);

/* Runs a statement that returns no rows. */
koksma_status koksma__statement_run(koksma__database *database, koksma__statement *statement);

/* Steps to the next row and returns whether there is one; its columns can be read until the next call. Does
   nothing unless *status is OK. Resets the statement after the last row that the caller needs. */
bool koksma__next_row(koksma__database *database, koksma__statement *statement, koksma_status *status);
void koksma__statement_reset(koksma__statement *statement);

/* Columns of the current row, counted from 0. A damaged database may contain NULL where the schema forbids it: NULL
   is returned as an empty text, 0, or NaN. */
const char *koksma__column_text(koksma__statement *statement, int column);
long long koksma__column_whole(koksma__statement *statement, int column);
double koksma__column_number(koksma__statement *statement, int column);
bool koksma__column_is_null(koksma__statement *statement, int column);

/* Whether a column has the type of the schema: a finite number or NULL, which is read as NaN; a whole number; a text. */
bool koksma__column_read_number(koksma__statement *statement, int column, double *number);
bool koksma__column_has_whole(koksma__statement *statement, int column);
bool koksma__column_has_text(koksma__statement *statement, int column);

#endif
