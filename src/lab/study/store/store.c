/* SPDX-License-Identifier: Apache-2.0 */
/* The lock and transactions of a store, and its tables of texts, references, runs and failed jobs. Statements are gathered
   in one transaction until KOKSMA__WRITE_AFTER_S seconds have passed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/status.h"
#include "study/store/store_internal.h"

/* ---- The lock -------------------------------------------------------------------------------------------------- */

void koksma__store_enter(koksma__store *store)
{
    pthread_mutex_lock(&store->lock);
    store->entered_s = koksma__thread_s();
}

koksma_status koksma__store_leave(koksma__store *store, koksma_status status)
{
    store->seconds += koksma__thread_s() - store->entered_s;
    pthread_mutex_unlock(&store->lock);
    return status;
}

double koksma__store_seconds(koksma__store *store)
{
    pthread_mutex_lock(&store->lock);
    const double seconds = store->seconds;
    pthread_mutex_unlock(&store->lock);
    return seconds;
}

/* ---- Transactions -------------------------------------------------------------------------------------- */

koksma_status koksma__store_begin(koksma__store *store)
{
    KOKSMA__FAIL_IF(store->failed, store->failed, "%s", store->reason);
    if (store->in_transaction) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__database_execute(store->database, "BEGIN EXCLUSIVE");
    store->in_transaction = !status;
    store->began_s = koksma__now_s();
    return status;
}

koksma_status koksma__store_end(koksma__store *store)
{
    if (!store->in_transaction) {
        return KOKSMA_OK;
    }
    store->in_transaction = false;
    return koksma__store_wrote(store, koksma__database_execute(store->database, "COMMIT"));
}

koksma_status koksma__store_wrote(koksma__store *store, koksma_status status)
{
    if (status && !store->failed) {
        store->failed = status;
        snprintf(store->reason, sizeof store->reason, "%s", koksma_error_text());
    }
    return status;
}

koksma_status koksma__store_tick(koksma__store *store)
{
    return koksma__now_s() - store->began_s > KOKSMA__WRITE_AFTER_S ? koksma__store_end(store) : KOKSMA_OK;
}

/* Runs a statement that writes. */
static koksma_status put(koksma__store *store, koksma__query query)
{
    KOKSMA__TRY(koksma__store_begin(store));
    KOKSMA__TRY(koksma__store_wrote(store, koksma__statement_run(store->database, store->queries[query])));
    return koksma__store_tick(store);
}

/* ---- Texts --------------------------------------------------------------------------------------------- */

koksma_status koksma__store_set_text(koksma__store *store, const char *key, const char *value)
{
    koksma__store_enter(store);
    koksma__bind(store->queries[KOKSMA__PUT_TEXT], 1, "tt", key, value);
    return koksma__store_leave(store, put(store, KOKSMA__PUT_TEXT));
}

koksma_status koksma__store_get_text(koksma__store *store, const char *key, char **value)
{
    koksma__statement *s = store->queries[KOKSMA__GET_TEXT];
    koksma_status status = KOKSMA_OK;
    const char *text = NULL;
    koksma__store_enter(store);
    koksma__bind(s, 1, "t", key);
    const bool found = koksma__next_row(store->database, s, &status) && koksma__read(s, 0, "t", &text);
    *value = found ? strdup(text) : NULL;
    if (found && !*value) {
        status = koksma__fail_memory(1);
    }
    koksma__statement_reset(s);
    return koksma__store_leave(store, status);
}

/* ---- References and runs ------------------------------------------------------------------------------- */

void koksma__store_bind_key(koksma__store *store, const koksma__series *series, koksma__series *key)
{
    const bool image = strcmp(series->kind, "discrepancy") != 0;
    *key = *series;
    const koksma__row_texts texts = {image, series->pattern, image ? series->what : ""};
    koksma__hash_with_points(&store->files, series->scene_hash, &texts, store->hash);
    key->metric = series->metric ? series->metric : "";
    koksma__find_made_by(image, series->pattern, series->options, series->what, key->metric, &store->made_by);
    key->scene_hash = store->hash;
    key->made_by = store->made_by.points;
    key->measured_by = store->made_by.value;
}

void koksma__store_forget_files(koksma__store *store)
{
    koksma__store_enter(store);
    koksma__point_files_fini(&store->files);
    koksma__store_leave(store, KOKSMA_OK);
}

static void bind_reference(koksma__store *store, koksma__statement *s, const koksma__series *series,
                           koksma__series *key)
{
    koksma__store_bind_key(store, series, key);
    /* In a series of image errors, measured_by has the revisions that made the reference; this row belongs to the
       reference itself. */
    key->made_by = key->measured_by;
    koksma__bind(s, 1, "tttwwtt", key->scene, key->scene_hash, key->options, key->width, key->height, key->what,
                 key->made_by);
}

static koksma_status find_reference(koksma__store *store, const koksma__series *series, koksma__series *key,
                                    koksma__reference_row *row, bool *found)
{
    koksma__statement *s = store->queries[KOKSMA__GET_REFERENCE];
    koksma_status status = KOKSMA_OK;
    const char *pixels;
    bind_reference(store, s, series, key);
    *row = (koksma__reference_row){.standard_error = NAN};
    *found = koksma__next_row(store->database, s, &status);
    if (*found) {
        koksma__read(s, 0, "nt", &row->standard_error, &pixels);
        snprintf(row->pixels, sizeof row->pixels, "%s", pixels);
    }
    koksma__statement_reset(s);
    return status;
}

koksma_status koksma__store_put_reference(koksma__store *store, const koksma__series *series,
                                          const koksma__reference_row *row)
{
    koksma__statement *s = store->queries[KOKSMA__PUT_REFERENCE];
    koksma__series key;
    koksma__store_enter(store);
    bind_reference(store, s, series, &key);
    koksma__bind(s, 8, "nt", row->standard_error, row->pixels);
    return koksma__store_leave(store, put(store, KOKSMA__PUT_REFERENCE));
}

koksma_status koksma__store_reference(koksma__store *store, const koksma__series *series, koksma__reference_row *row)
{
    koksma__series key;
    bool found;
    koksma__store_enter(store);
    return koksma__store_leave(store, find_reference(store, series, &key, row, &found));
}

koksma_status koksma__store_put_run(koksma__store *store, const koksma__run_record *record)
{
    koksma__statement *s = store->queries[KOKSMA__PUT_RUN];
    koksma__store_enter(store);
    koksma__bind(s, 1, "tttwwnnnn", record->started, record->machine, record->version, record->workers, record->jobs,
                 record->seconds, record->idle_seconds, record->processor_seconds, record->store_seconds);
    return koksma__store_leave(store, put(store, KOKSMA__PUT_RUN));
}

koksma_status koksma__store_run(koksma__store *store, long long i, koksma__run_record *record, bool *found)
{
    koksma__statement *s = store->queries[KOKSMA__GET_RUN];
    koksma_status status = KOKSMA_OK;
    const char *started, *machine, *version;
    koksma__store_enter(store);
    koksma__bind(s, 1, "w", i);
    *found = koksma__next_row(store->database, s, &status);
    if (*found) {
        const bool right =
            koksma__read(s, 0, "tttwwnnnn", &started, &machine, &version, &record->workers, &record->jobs,
                         &record->seconds, &record->idle_seconds, &record->processor_seconds,
                         &record->store_seconds) &&
            !isnan(record->seconds + record->idle_seconds + record->processor_seconds + record->store_seconds);
        snprintf(record->started, sizeof record->started, "%s", started);
        snprintf(record->machine, sizeof record->machine, "%s", machine);
        snprintf(record->version, sizeof record->version, "%s", version);
        if (!right) {
            status = koksma__fail(KOKSMA_MALFORMED,
                                  "%s: the run of %.24s in table run has a time that is infinite or no number; move "
                                  "the file away to begin anew",
                                  koksma__database_path(store->database), record->started);
        }
    }
    koksma__statement_reset(s);
    return koksma__store_leave(store, status);
}

/* ---- Failed jobs ----------------------------------------------------------------------------------------------- */

/* For readers, rows of equal label become one line: "poisson-disk:d=0.3, N = 64 (100 of 100 trials), 256 (100 of 100
   trials): reason". Rows of equal n as well, which have different reasons, are in several lines. Table left_out has the
   lines on the plan's blocks with `skip`, followed by these. */

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
