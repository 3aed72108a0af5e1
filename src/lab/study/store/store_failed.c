/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The list of failed jobs in a store, table failed, and its form for readers. For readers, rows of equal label become one
 * line: "poisson-disk:d=0.3, N = 64 (100 of 100 trials), 256 (100 of 100 trials): reason". Rows of equal n as well, which
 * have different reasons, are in several lines. Table left_out has the lines on the plan's blocks with `skip`, followed by
 * these.
 */
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/store/store_internal.h"

/* Adds the rows of a query as lines of UTF-8: a pattern may name a file whose name has control characters. */
static koksma_status list_lines(koksma__store *store, koksma__query query, koksma__texts *lines)
{
    koksma__statement *s = store->queries[query];
    koksma_status status = KOKSMA_OK;
    const char *text;
    koksma__store_enter(store);
    while (koksma__next_row(store->database, s, &status)) {
        koksma__read(s, 0, "t", &text);
        const size_t size = 4 * strlen(text) + 1;
        char *line = malloc(size);
        if (line) {
            strcpy(line, text);
            koksma_text_escape(line, size);
        }
        status = line ? koksma__texts_add(lines, line) : koksma__fail_memory(size);
        free(line);
    }
    koksma__statement_reset(s);
    return koksma__store_leave(store, status);
}

koksma_status koksma__store_failed(koksma__store *store, koksma__texts *lines)
{
    return list_lines(store, KOKSMA__GET_FAILED, lines);
}

koksma_status koksma__store_left_out(koksma__store *store, koksma__texts *lines)
{
    return list_lines(store, KOKSMA__GET_LEFT_OUT, lines);
}

koksma_status koksma__store_count_failed(koksma__store *store, size_t *trials)
{
    koksma__statement *s = store->queries[KOKSMA__COUNT_FAILED];
    koksma_status status = KOKSMA_OK;
    long long sum = 0;
    koksma__store_enter(store);
    if (koksma__next_row(store->database, s, &status)) {
        koksma__read(s, 0, "w", &sum);
    }
    koksma__statement_reset(s);
    *trials = sum > 0 ? (size_t)sum : 0;
    return koksma__store_leave(store, status);
}

static koksma_status put_failed(koksma__store *store, const koksma__failed *at, size_t n, bool all)
{
    KOKSMA__TRY(koksma__store_begin(store));
    KOKSMA__TRY(koksma__database_execute(store->database, "DELETE FROM fresh"));
    for (size_t i = 0; i < n; i++) {
        koksma__bind(store->queries[KOKSMA__PUT_FAILED], 1, "twwwt", at[i].label, at[i].n, at[i].failed, at[i].trials,
                     at[i].reason);
        KOKSMA__TRY(koksma__statement_run(store->database, store->queries[KOKSMA__PUT_FAILED]));
    }
    KOKSMA__TRY(koksma__database_execute(
        store->database,
        all ? "DELETE FROM failed"
            : "DELETE FROM failed WHERE EXISTS (SELECT 1 FROM fresh WHERE fresh.label = failed.label "
              "AND fresh.n = failed.n AND fresh.failed >= failed.failed)"));
    return koksma__database_execute(
        store->database,
        "INSERT INTO failed (label, n, failed, trials, reason) SELECT label, n, failed, trials, reason "
        "FROM fresh WHERE NOT EXISTS (SELECT 1 FROM failed WHERE failed.label = fresh.label AND "
        "failed.n = fresh.n AND failed.failed >= fresh.failed) ORDER BY id");
}

koksma_status koksma__store_put_failed(koksma__store *store, const koksma__failed *at, size_t n, bool all)
{
    koksma__store_enter(store);
    return koksma__store_leave(store, koksma__store_wrote(store, put_failed(store, at, n, all)));
}

koksma_status koksma__store_put_left_out(koksma__store *store, const koksma__texts *lines)
{
    koksma__store_enter(store);
    koksma_status status = koksma__store_begin(store);
    status = status ? status : koksma__database_execute(store->database, "DELETE FROM left_out");
    for (size_t i = 0; !status && i < lines->n; i++) {
        koksma__bind(store->queries[KOKSMA__PUT_LEFT_OUT], 1, "t", lines->at[i]);
        status = koksma__statement_run(store->database, store->queries[KOKSMA__PUT_LEFT_OUT]);
    }
    return koksma__store_leave(store, koksma__store_wrote(store, status));
}
