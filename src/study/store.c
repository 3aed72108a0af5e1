/* SPDX-License-Identifier: Apache-2.0 */
#include "study/store.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <sqlite3.h>

#include "core/status.h"
#include "study/schema.h"

#define SCHEMA_VERSION "1"

enum {
    HAS_DISCREPANCY,
    HAS_IMAGE,
    PUT_DISCREPANCY,
    PUT_IMAGE,
    PUT_REFERENCE,
    GET_DISCREPANCIES,
    GET_IMAGES,
    GET_REFERENCE,
    N_STATEMENTS
};

static const char *const statements[N_STATEMENTS] = {
    [HAS_DISCREPANCY] = "SELECT 1 FROM discrepancy WHERE pattern=? AND n=? AND dim=? AND measure=? AND trial=?",
    [HAS_IMAGE] = "SELECT 1 FROM image_error WHERE scene=? AND scene_hash=? AND pattern=? AND spp=? AND width=? AND "
                  "height=? AND reference=? AND trial=?",
    [PUT_DISCREPANCY] = "INSERT OR IGNORE INTO discrepancy VALUES (?,?,?,?,?,?,?)",
    [PUT_IMAGE] = "INSERT OR IGNORE INTO image_error VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?)",
    [PUT_REFERENCE] = "INSERT OR REPLACE INTO reference VALUES (?,?,?,?)",
    [GET_DISCREPANCIES] = "SELECT value FROM discrepancy WHERE pattern=? AND n=? AND dim=? AND measure=? AND trial<? "
                          "ORDER BY trial",
    [GET_IMAGES] =
        "SELECT mean, sd, max, rmse FROM image_error WHERE scene=? AND scene_hash=? AND pattern=? AND spp=? "
        "AND width=? AND height=? AND reference=? AND trial<? ORDER BY trial",
    [GET_REFERENCE] = "SELECT standard_error FROM reference WHERE scene=? AND scene_hash=? AND reference=?",
};

/* Writes are gathered into transactions of at most COMMIT_AFTER_S, so that neither a million small rows cost a
   million commits nor a killed run loses more than that. */
static const double COMMIT_AFTER_S = 0.2;

struct koksma__store {
    sqlite3 *database;
    sqlite3_stmt *prepared[N_STATEMENTS];
    char *path;
    pthread_mutex_t lock;
    bool in_transaction;
    double began_s;
};

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static koksma_status fail(koksma__store *store)
{
    const int code = sqlite3_errcode(store->database);
    if (code == SQLITE_BUSY || code == SQLITE_LOCKED) {
        return koksma__fail(KOKSMA_IO, "%s: another run is writing to it", store->path);
    }
    if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) {
        return koksma__fail(KOKSMA_MALFORMED, "%s: %s; move it away to begin anew", store->path,
                            sqlite3_errmsg(store->database));
    }
    if (code == SQLITE_NOMEM) {
        return koksma__fail(KOKSMA_MEMORY, "%s: out of memory", store->path);
    }
    return koksma__fail(KOKSMA_IO, "%s: %s", store->path, sqlite3_errmsg(store->database));
}

static koksma_status execute(koksma__store *store, const char *sql)
{
    return sqlite3_exec(store->database, sql, NULL, NULL, NULL) == SQLITE_OK ? KOKSMA_OK : fail(store);
}

static koksma_status commit(koksma__store *store)
{
    if (!store->in_transaction) {
        return KOKSMA_OK;
    }
    store->in_transaction = false;
    return execute(store, "COMMIT");
}

static koksma_status begin(koksma__store *store)
{
    if (store->in_transaction) {
        return KOKSMA_OK;
    }
    const koksma_status status = execute(store, "BEGIN IMMEDIATE");
    store->in_transaction = !status;
    store->began_s = now_s();
    return status;
}

static koksma_status check_meta(koksma__store *store, const char *key, const char *value)
{
    sqlite3_stmt *query = NULL;
    koksma_status status = KOKSMA_OK;
    if (sqlite3_prepare_v2(store->database, "INSERT OR IGNORE INTO meta VALUES (?,?)", -1, &query, NULL) !=
        SQLITE_OK) {
        return fail(store);
    }
    sqlite3_bind_text(query, 1, key, -1, SQLITE_STATIC);
    sqlite3_bind_text(query, 2, value, -1, SQLITE_STATIC);
    const int code = sqlite3_step(query);
    sqlite3_finalize(query);
    if (code != SQLITE_DONE) {
        return fail(store);
    }
    if (sqlite3_prepare_v2(store->database, "SELECT value FROM meta WHERE key=?", -1, &query, NULL) != SQLITE_OK) {
        return fail(store);
    }
    sqlite3_bind_text(query, 1, key, -1, SQLITE_STATIC);
    const char *found = sqlite3_step(query) == SQLITE_ROW ? (const char *)sqlite3_column_text(query, 0) : "";
    if (strcmp(found ? found : "", value) != 0) {
        status = koksma__fail(KOKSMA_MALFORMED, "%s: its %s is '%s' and this run's is '%s'; choose another folder",
                              store->path, key, found ? found : "", value);
    }
    sqlite3_finalize(query);
    return status;
}

static koksma_status prepare(koksma__store *store, const char *plan_name)
{
    /* One writer: a second run on the same folder is told so instead of doing the same work. */
    koksma_status status =
        execute(store, "PRAGMA locking_mode=EXCLUSIVE; PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL;");
    status = status ? status : begin(store);
    status = status ? status : execute(store, koksma__schema_sql);
    status = status ? status : check_meta(store, "schema", SCHEMA_VERSION);
    status = status ? status : check_meta(store, "version", koksma_version());
    status = status ? status : check_meta(store, "plan", plan_name);
    status = status ? status : commit(store);
    for (int i = 0; !status && i < N_STATEMENTS; i++) {
        if (sqlite3_prepare_v2(store->database, statements[i], -1, &store->prepared[i], NULL) != SQLITE_OK) {
            status = fail(store);
        }
    }
    return status;
}

koksma_status koksma__store_open(const char *path, const char *plan_name, koksma__store **out)
{
    koksma__store *store = calloc(1, sizeof *store);
    *out = NULL;
    if (!store || !(store->path = strdup(path))) {
        free(store);
        return koksma__fail_memory(sizeof *store);
    }
    pthread_mutex_init(&store->lock, NULL);
    koksma_status status = KOKSMA_OK;
    if (sqlite3_open_v2(path, &store->database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, NULL) != SQLITE_OK) {
        status = koksma__fail(KOKSMA_IO, "%s: %s", path, sqlite3_errmsg(store->database));
    }
    if (!status) {
        status = prepare(store, plan_name);
    }
    if (status) {
        store->in_transaction = false; /* closing rolls back */
        koksma__store_close(store);
        return status;
    }
    *out = store;
    return KOKSMA_OK;
}

koksma_status koksma__store_close(koksma__store *store)
{
    if (!store) {
        return KOKSMA_OK;
    }
    const koksma_status status = commit(store);
    for (int i = 0; i < N_STATEMENTS; i++) {
        sqlite3_finalize(store->prepared[i]);
    }
    sqlite3_close(store->database);
    pthread_mutex_destroy(&store->lock);
    free(store->path);
    free(store);
    return status;
}

/* ---- Binding and stepping; the caller holds the lock -------------------------------------------------- */

static void bind_text(sqlite3_stmt *s, int *column, const char *text)
{
    sqlite3_bind_text(s, (*column)++, text, -1, SQLITE_STATIC);
}

static void bind_whole(sqlite3_stmt *s, int *column, long long value)
{
    sqlite3_bind_int64(s, (*column)++, value);
}

static int bind_discrepancy(sqlite3_stmt *s, const koksma__discrepancy_key *key)
{
    int column = 1;
    bind_text(s, &column, key->pattern);
    bind_whole(s, &column, key->n);
    bind_whole(s, &column, key->dim);
    bind_text(s, &column, key->measure);
    bind_whole(s, &column, key->trial);
    return column;
}

static int bind_image(sqlite3_stmt *s, const koksma__image_key *key)
{
    int column = 1;
    bind_text(s, &column, key->scene);
    bind_text(s, &column, key->scene_hash);
    bind_text(s, &column, key->pattern);
    bind_whole(s, &column, key->spp);
    bind_whole(s, &column, key->width);
    bind_whole(s, &column, key->height);
    bind_text(s, &column, key->reference);
    bind_whole(s, &column, key->trial);
    return column;
}

static koksma_status step_exists(koksma__store *store, sqlite3_stmt *s, bool *has)
{
    const int code = sqlite3_step(s);
    *has = code == SQLITE_ROW;
    sqlite3_reset(s);
    return code == SQLITE_ROW || code == SQLITE_DONE ? KOKSMA_OK : fail(store);
}

static koksma_status step_put(koksma__store *store, sqlite3_stmt *s)
{
    koksma_status status = begin(store);
    if (!status && sqlite3_step(s) != SQLITE_DONE) {
        status = fail(store);
    }
    sqlite3_reset(s);
    if (!status && now_s() - store->began_s > COMMIT_AFTER_S) {
        status = commit(store);
    }
    return status;
}

/* Reads all rows of `width` doubles. */
static koksma_status step_rows(koksma__store *store, sqlite3_stmt *s, size_t width, double **values, size_t *n)
{
    size_t room = 0;
    int code;
    koksma_status status = KOKSMA_OK;
    *values = NULL;
    *n = 0;
    while (!status && (code = sqlite3_step(s)) == SQLITE_ROW) {
        if (*n == room) {
            room = room ? 2 * room : 128;
            double *more = realloc(*values, room * width * sizeof *more);
            if (!more) {
                status = koksma__fail_memory(room * width * sizeof *more);
                break;
            }
            *values = more;
        }
        for (size_t k = 0; k < width; k++) {
            (*values)[*n * width + k] = sqlite3_column_double(s, (int)k);
        }
        (*n)++;
    }
    if (!status && code != SQLITE_DONE) {
        status = fail(store);
    }
    sqlite3_reset(s);
    return status;
}

koksma_status koksma__store_commit(koksma__store *store)
{
    pthread_mutex_lock(&store->lock);
    const koksma_status status = commit(store);
    pthread_mutex_unlock(&store->lock);
    return status;
}

koksma_status koksma__store_has_discrepancy(koksma__store *store, const koksma__discrepancy_key *key, bool *has)
{
    pthread_mutex_lock(&store->lock);
    bind_discrepancy(store->prepared[HAS_DISCREPANCY], key);
    const koksma_status status = step_exists(store, store->prepared[HAS_DISCREPANCY], has);
    pthread_mutex_unlock(&store->lock);
    return status;
}

koksma_status koksma__store_has_image(koksma__store *store, const koksma__image_key *key, bool *has)
{
    pthread_mutex_lock(&store->lock);
    bind_image(store->prepared[HAS_IMAGE], key);
    const koksma_status status = step_exists(store, store->prepared[HAS_IMAGE], has);
    pthread_mutex_unlock(&store->lock);
    return status;
}

koksma_status koksma__store_put_discrepancy(koksma__store *store, const koksma__discrepancy_key *key, uint64_t seed,
                                            double value)
{
    sqlite3_stmt *s = store->prepared[PUT_DISCREPANCY];
    pthread_mutex_lock(&store->lock);
    int column = bind_discrepancy(s, key);
    bind_whole(s, &column, (long long)seed);
    sqlite3_bind_double(s, column, value);
    const koksma_status status = step_put(store, s);
    pthread_mutex_unlock(&store->lock);
    return status;
}

koksma_status koksma__store_put_image(koksma__store *store, const koksma__image_key *key, uint64_t seed,
                                      const koksma_image_error *error)
{
    sqlite3_stmt *s = store->prepared[PUT_IMAGE];
    pthread_mutex_lock(&store->lock);
    int column = bind_image(s, key);
    bind_whole(s, &column, (long long)seed);
    sqlite3_bind_double(s, column++, error->mean);
    sqlite3_bind_double(s, column++, error->sd);
    sqlite3_bind_double(s, column++, error->max);
    sqlite3_bind_double(s, column, error->rmse);
    const koksma_status status = step_put(store, s);
    pthread_mutex_unlock(&store->lock);
    return status;
}

koksma_status koksma__store_put_reference(koksma__store *store, const char *scene, const char *scene_hash,
                                          const char *reference, double standard_error)
{
    sqlite3_stmt *s = store->prepared[PUT_REFERENCE];
    int column = 1;
    pthread_mutex_lock(&store->lock);
    bind_text(s, &column, scene);
    bind_text(s, &column, scene_hash);
    bind_text(s, &column, reference);
    sqlite3_bind_double(s, column, standard_error); /* NaN is stored as NULL */
    const koksma_status status = step_put(store, s);
    pthread_mutex_unlock(&store->lock);
    return status;
}

koksma_status koksma__store_discrepancies(koksma__store *store, const koksma__discrepancy_key *key, double **values,
                                          size_t *n)
{
    pthread_mutex_lock(&store->lock);
    bind_discrepancy(store->prepared[GET_DISCREPANCIES], key);
    const koksma_status status = step_rows(store, store->prepared[GET_DISCREPANCIES], 1, values, n);
    pthread_mutex_unlock(&store->lock);
    return status;
}

koksma_status koksma__store_images(koksma__store *store, const koksma__image_key *key, koksma_image_error **errors,
                                   size_t *n)
{
    double *values;
    pthread_mutex_lock(&store->lock);
    bind_image(store->prepared[GET_IMAGES], key);
    koksma_status status = step_rows(store, store->prepared[GET_IMAGES], 4, &values, n);
    pthread_mutex_unlock(&store->lock);
    *errors = status ? NULL : calloc(*n ? *n : 1, sizeof **errors);
    if (!status && !*errors) {
        status = koksma__fail_memory(*n * sizeof **errors);
    }
    for (size_t i = 0; !status && i < *n; i++) {
        (*errors)[i] = (koksma_image_error){values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]};
    }
    free(values);
    return status;
}

koksma_status koksma__store_reference(koksma__store *store, const char *scene, const char *scene_hash,
                                      const char *reference, double *standard_error)
{
    sqlite3_stmt *s = store->prepared[GET_REFERENCE];
    int column = 1;
    pthread_mutex_lock(&store->lock);
    bind_text(s, &column, scene);
    bind_text(s, &column, scene_hash);
    bind_text(s, &column, reference);
    const bool found = sqlite3_step(s) == SQLITE_ROW && sqlite3_column_type(s, 0) != SQLITE_NULL;
    *standard_error = found ? sqlite3_column_double(s, 0) : (double)NAN;
    sqlite3_reset(s);
    pthread_mutex_unlock(&store->lock);
    return KOKSMA_OK;
}
