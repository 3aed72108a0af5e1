/* SPDX-License-Identifier: Apache-2.0 */
/* Checks which tables a file has. The SQL of every table and view, as SQLite stores it, is compared with the
   statements of schema.sql after removing comments (from -- to the end of the line) and replacing white space by one
   blank: the file must have each statement once and nothing else. A file from an untrusted source thus has no
   triggers, further tables or views, virtual tables, or computed columns. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/store/schema.h"
#include "study/store/store_internal.h"

/* "Kksm", which no other program has in SQLite's own list of application ids (magic.txt). */
static const uint32_t APPLICATION = 0x4b6b736d;

enum { STATEMENTS = 6 };

/* Writes one statement to `out` without comments that begin with -- and with one blank for each stretch of white space,
   both outside quotes. The statement ends at the first ';' outside quotes, or at the end of the text. Returns the rest of
   the SQL. */
static const char *normal_form(const char *sql, char *out)
{
    char *to = out;
    for (char quote = 0; *sql && (quote || *sql != ';'); sql++) {
        if (!quote && sql[0] == '-' && sql[1] == '-') {
            sql += strcspn(sql, "\n") - 1;
            continue;
        }
        if (quote || !isspace((unsigned char)*sql)) {
            *to++ = *sql;
        } else if (to > out && to[-1] != ' ') {
            *to++ = ' ';
        }
        quote = quote ? (*sql == quote ? 0 : quote) : strchr("'\"`", *sql) ? *sql : 0;
    }
    to -= to > out && to[-1] == ' ';
    *to = '\0';
    return *sql ? sql + 1 : sql;
}

/* Returns the index of the statement in `schema` that equals `sql`, or -1; `out` receives the normal form of
   `sql`. */
static int find_statement(const char *schema, const char *sql, char *out, char *known)
{
    normal_form(sql, out);
    for (int i = 0; *schema; i++) {
        schema = normal_form(schema, known);
        if (*known && !strcmp(known, out)) {
            return i;
        }
    }
    return -1;
}

/* Checks that every entry of the file's schema is a statement of schema.sql and that none is repeated; *n is the number
   of entries. */
static koksma_status compare(koksma__database *database, int *n)
{
    koksma__statement *s;
    bool seen[STATEMENTS] = {false};
    char *out = NULL, *known = malloc(strlen(koksma__schema_sql) + 1);
    koksma_status status = koksma__statement_open(database, "SELECT sql, type, name FROM sqlite_schema", &s);
    *n = 0;
    while (koksma__next_row(database, s, &status)) {
        const char *sql, *type, *name;
        if (!koksma__read(s, 0, "ttt", &sql, &type, &name) && !strcmp(type, "index") &&
            !strncmp(name, "sqlite_autoindex_", 17)) {
            continue; /* skips the indices that SQLite makes for UNIQUE and PRIMARY KEY */
        }
        free(out);
        out = malloc(strlen(sql) + 1);
        const int i = out && known ? find_statement(koksma__schema_sql, sql, out, known) : -1;
        if (!out || !known) {
            status = koksma__fail_memory(strlen(sql));
        } else if (i < 0 || i >= STATEMENTS || seen[i]) {
            status = koksma__fail(
                KOKSMA_MALFORMED,
                "%s: not a store of koksma study: its %.20s '%.100s' is another program's; choose another folder",
                koksma__database_path(database), type, name);
        } else {
            seen[i] = true;
            ++*n;
        }
    }
    koksma__statement_close(s);
    free(out);
    free(known);
    return status;
}

koksma_status koksma__schema_check(koksma__database *database, const koksma__database_header *header)
{
    const char *path = koksma__database_path(database);
    const bool ours = header->application_id == APPLICATION;
    int n = 0;
    KOKSMA__FAIL_IF(ours && header->version != KOKSMA__SCHEMA, KOKSMA_MALFORMED,
                    "%s: the file has schema %u, but this program has schema %d; choose another folder", path,
                    (unsigned)header->version, KOKSMA__SCHEMA);
    const koksma_status status = ours ? compare(database, &n) : KOKSMA_OK;
    KOKSMA__FAIL_IF(!status && n != STATEMENTS, KOKSMA_MALFORMED,
                    "%s: not a store of koksma study; choose another folder", path);
    return status;
}

koksma_status koksma__schema_make(koksma__database *database)
{
    char header[96];
    snprintf(header, sizeof header, "PRAGMA application_id=%u; PRAGMA user_version=%d", (unsigned)APPLICATION,
             KOKSMA__SCHEMA);
    const koksma_status status = koksma__database_execute(database, header);
    return status ? status : koksma__database_execute(database, koksma__schema_sql);
}
