/* SPDX-License-Identifier: Apache-2.0 */
/* Upgrades stores of schemas 3 to 6 into a new database of the current schema (schema_upgrade*.sql). Schemas before 7
   lack the rows of metrics, so that the next run renders their images again. Rows of schemas 3 to 5 have no revisions
   and get those with which schema 6 began; their references have no hash of their pixels, so that a run renders a
   reference again before it compares anything with it. Schemas 3 and 4 lack the coherence of errors. A store of
   schema 6 has a seal, which the copy keeps: damage to the old rows is found in the copy. */
#include <string.h>

#include "core/status.h"
#include "study/store/schema_upgrade.h"
#include "study/store/schema_upgrade_3.h"
#include "study/store/schema_upgrade_6.h"
#include "study/store/store_internal.h"

/* Writes the revisions of every series, in the order of ids. */
static koksma_status upgrade_series(koksma__store *store, koksma__statement *get, koksma__statement *put)
{
    koksma_status status = KOKSMA_OK;
    for (long long id = 0; !status;) {
        int column = 1;
        koksma__bind_whole(get, &column, id);
        if (!koksma__next_row(store->database, get, &status)) {
            break;
        }
        id = koksma__column_whole(get, 0);
        status =
            koksma__find_made_by(strcmp(koksma__column_text(get, 1), "discrepancy") != 0, koksma__column_text(get, 2),
                                 koksma__column_text(get, 3), koksma__column_text(get, 4), "", true, &store->made_by);
        koksma__statement_reset(get);
        column = 1;
        koksma__bind_text(put, &column, store->made_by.points);
        koksma__bind_text(put, &column, store->made_by.value);
        koksma__bind_whole(put, &column, id);
        status = status ? status : koksma__statement_run(store->database, put);
    }
    koksma__statement_reset(get);
    return status;
}

static koksma_status upgrade_references(koksma__store *store, koksma__statement *get, koksma__statement *put)
{
    koksma_status status = KOKSMA_OK;
    while (koksma__next_row(store->database, get, &status)) {
        int column = 1;
        status = koksma__find_made_by(true, "", "", koksma__column_text(get, 0), "", true, &store->made_by);
        koksma__bind_text(put, &column, store->made_by.value);
        koksma__bind_text(put, &column, koksma__column_text(get, 0));
        status = status ? status : koksma__statement_run(store->database, put);
    }
    koksma__statement_reset(get);
    return status;
}

static void pass(void *context, long long series, long long trial)
{
    (void)context;
    (void)series;
    (void)trial;
}

/* Schemas 3 to 5: copies references, which had no revisions, then all series and results, and adds revisions. */
static koksma_status upgrade_without_revisions(int schema, koksma__store *store)
{
    static const char *const queries[] = {
        "SELECT id, kind, pattern, options, what FROM main.series WHERE id > ? ORDER BY id LIMIT 1",
        "UPDATE main.series SET made_by = ?, measured_by = ? WHERE id = ?",
        "SELECT DISTINCT reference FROM old.reference", "UPDATE main.reference SET made_by = ? WHERE reference = ?"};
    enum { N = sizeof queries / sizeof *queries };
    koksma__statement *s[N] = {NULL};
    koksma_status status = koksma__database_execute(
        store->database,
        "INSERT INTO main.reference SELECT scene, scene_hash, options, width, height, reference, '', standard_error, "
        "'' FROM old.reference;");
    status = status ? status
                    : koksma__database_execute(store->database, schema == 3 ? koksma__schema_upgrade_3_sql
                                                                            : koksma__schema_upgrade_sql);
    for (int i = 0; !status && i < N; i++) {
        status = koksma__statement_open(store->database, queries[i], &s[i]);
    }
    status = status ? status : upgrade_series(store, s[0], s[1]);
    status = status ? status : upgrade_references(store, s[2], s[3]);
    for (int i = 0; i < N; i++) {
        koksma__statement_close(s[i]);
    }
    /* the series names a pattern or measure that does not exist */
    if (status && status != KOKSMA_IO && status != KOKSMA_MEMORY) {
        return koksma__fail_in(KOKSMA_MALFORMED, koksma__database_path(store->database));
    }
    return status;
}

koksma_status koksma__store_upgrade(int schema, koksma__store *store)
{
    enum { FIRST_WITH_SEAL = 6 };
    koksma_status status = koksma__database_execute(
        store->database,
        "INSERT INTO main.meta SELECT key, value FROM old.meta WHERE key NOT IN ('schema', 'version');"
        "INSERT INTO main.run SELECT * FROM old.run;");
    if (!status) {
        status = schema < FIRST_WITH_SEAL ? upgrade_without_revisions(schema, store)
                                          : koksma__database_execute(store->database, koksma__schema_upgrade_6_sql);
    }
    status = status || schema < FIRST_WITH_SEAL ? status : koksma__seal_read(store);
    store->for_audit = true;
    status = status ? status : koksma__store_scan(store, pass, NULL);
    store->for_audit = false;
    if (schema < FIRST_WITH_SEAL) {
        store->seal = store->found;
    }
    return status;
}
