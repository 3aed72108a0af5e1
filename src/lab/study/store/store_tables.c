/* SPDX-License-Identifier: Apache-2.0 */
/* Reads rows of the store's tables and checks that every column has the type that the schema gives it, because a
   damaged file may hold anything. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/hash.h"
#include "core/status.h"
#include "study/store/store_internal.h"

static koksma_status fail_row(const koksma__store *store, const char *table, long long id)
{
    return koksma__fail(KOKSMA_MALFORMED,
                        "%s: row %lld of table %s has a value that is infinite, of the wrong type or out of range; "
                        "move it away to begin anew",
                        koksma__database_path(store->database), id, table);
}

static koksma_status fail_reference(const koksma__store *store, const koksma__series *key)
{
    return koksma__fail(KOKSMA_MALFORMED,
                        "%s: the standard error of reference %.200s of %.200s%s%.100s, %lld x %lld, is infinite or "
                        "no number; move the file away to begin anew",
                        koksma__database_path(store->database), key->what, key->scene, key->options[0] ? ", " : "",
                        key->options, key->width, key->height);
}

koksma_status koksma__store_read_row(koksma__store *store, koksma__statement *s, int column, koksma__row *row)
{
    long long seed;
    const bool right =
        koksma__read(s, column, "wnnnn", &seed, &row->values[0], &row->values[1], &row->values[2], &row->values[3]);
    row->seed = (uint64_t)seed;
    return right && row->id >> 32 < KOKSMA__MOST_TRIALS ? KOKSMA_OK : fail_row(store, "result", row->id);
}

/* Reads the columns of GET_SERIES. */
koksma_status koksma__store_read_series(koksma__store *store, koksma__statement *s, koksma__series *key,
                                        long long *id)
{
    *key = (koksma__series){0};
    const bool right = koksma__read(s, 0, "tttttwwwwttttw", &key->kind, &key->scene, &key->scene_hash, &key->options,
                                    &key->pattern, &key->n, &key->dim, &key->width, &key->height, &key->what,
                                    &key->metric, &key->made_by, &key->measured_by, id);
    key->id = *id;
    return right ? KOKSMA_OK : fail_row(store, "series", *id);
}

koksma_status koksma__store_visit_series(koksma__store *store,
                                         koksma_status (*visit)(void *context, const koksma__series *key,
                                                                long long id),
                                         void *context)
{
    koksma__statement *s = store->queries[KOKSMA__GET_SERIES];
    koksma_status status = KOKSMA_OK;
    koksma__series key;
    long long id;
    while (koksma__next_row(store->database, s, &status)) {
        status = koksma__store_read_series(store, s, &key, &id);
        status = status ? status : visit(context, &key, id);
    }
    koksma__statement_reset(s);
    return status;
}

koksma_status koksma__store_visit_references(koksma__store *store,
                                             koksma_status (*visit)(void *context, const koksma__series *key,
                                                                    const koksma__reference_row *row),
                                             void *context)
{
    koksma__statement *s = store->queries[KOKSMA__GET_REFERENCES];
    koksma_status status = KOKSMA_OK;
    while (koksma__next_row(store->database, s, &status)) {
        koksma__series key = {.kind = "image", .pattern = ""};
        koksma__reference_row row;
        const char *pixels;
        const bool right = koksma__read(s, 0, "tttwwttnt", &key.scene, &key.scene_hash, &key.options, &key.width,
                                        &key.height, &key.what, &key.made_by, &row.standard_error, &pixels);
        snprintf(row.pixels, sizeof row.pixels, "%s", pixels);
        status = right ? visit(context, &key, &row) : fail_reference(store, &key);
    }
    koksma__statement_reset(s);
    return status;
}

static koksma_status add_series(void *context, const koksma__series *key, long long id)
{
    koksma__seal_add(context, 1, koksma__checksum_of_series(key, id));
    return KOKSMA_OK;
}

static koksma_status add_reference(void *context, const koksma__series *key, const koksma__reference_row *row)
{
    koksma__seal_add(context, 1, koksma__checksum_of_reference(key, row->standard_error, row->pixels));
    return KOKSMA_OK;
}

koksma_status koksma__seal_rest(koksma__store *store, koksma__seal *seal)
{
    koksma__statement *s = store->queries[KOKSMA__GET_TEXTS];
    koksma_status status = koksma__store_visit_series(store, add_series, seal);
    status = status ? status : koksma__store_visit_references(store, add_reference, seal);
    while (koksma__next_row(store->database, s, &status)) {
        const char *key, *value;
        koksma__read(s, 0, "tt", &key, &value);
        koksma__seal_add(seal, 1, koksma__checksum_of_text(key, value));
    }
    koksma__statement_reset(s);
    return status;
}

koksma_status koksma__seal_fail(const koksma__store *store)
{
    return koksma__fail(
        KOKSMA_MALFORMED,
        "%s: damaged or changed by hand: %lld rows with the checksum %016" PRIx64
        " are stored, but runs wrote %lld with %016" PRIx64
        "; 'koksma study audit' names the rows that differ; restore a copy, or move the file away to begin anew",
        koksma__database_path(store->database), store->found.rows, store->found.sum, store->seal.rows,
        store->seal.sum);
}

/* ---- Checksums ----------------------------------------------------------------------------------------------- */

/*
 * The seal of a store: the number of rows of its tables (except `run`, on which no result depends) and the sum
 * modulo 2^64 of their checksums, kept in table meta. Writing a row adds its checksum in the same transaction, so
 * that the seal is right even after a kill; a program that reads all rows compares them with the seal. If one row was
 * changed, removed or added by anything other than a run, the seal certainly differs, because the checksum is a
 * bijection of each word of the row; changes of several rows are missed with probability 2^-64. The seal protects
 * against damage and edits by hand, not against forgery, because a forger can write a new seal; `koksma study audit`
 * detects forged rows by computing them again.
 *
 * Checksum of the words x: h = 0, and for each h = (h + x) c mod 2^64, h ^= h >> 32, with c = 0x9e3779b97f4a7c15.
 * The first word is the table's number; a text's word is its hash (core/hash.h), a number's word is the bits of the
 * double. The word of a series' metric comes last, and only if it is not empty.
 */

enum { RESULT = 1, SERIES, REFERENCE, META };

static uint64_t fold(uint64_t h, uint64_t x)
{
    h = (h + x) * 0x9e3779b97f4a7c15u;
    return h ^ h >> 32;
}

static uint64_t fold_number(uint64_t h, double number)
{
    uint64_t bits = 0x7ff8000000000000u; /* the bits that represent NULL */
    if (!isnan(number)) {
        memcpy(&bits, &number, sizeof bits);
    }
    return fold(h, bits);
}

static uint64_t fold_text(uint64_t h, const char *text)
{
    return fold(h, koksma__hash(text, strlen(text)));
}

uint64_t koksma__checksum_of_row(const koksma__row *row)
{
    uint64_t h = fold(fold(fold(0, RESULT), (uint64_t)row->id), row->seed);
    for (int k = 0; k < KOKSMA__RESULT_VALUES; k++) {
        h = fold_number(h, row->values[k]);
    }
    return h;
}

uint64_t koksma__checksum_of_series(const koksma__series *key, long long id)
{
    const char *const texts[] = {key->kind,    key->scene, key->scene_hash, key->options,
                                 key->pattern, key->what,  key->made_by,    key->measured_by};
    const long long wholes[] = {key->n, key->dim, key->width, key->height};
    uint64_t h = fold(fold(0, SERIES), (uint64_t)id);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        h = fold_text(h, texts[i]);
    }
    for (size_t i = 0; i < sizeof wholes / sizeof *wholes; i++) {
        h = fold(h, (uint64_t)wholes[i]);
    }
    return key->metric[0] ? fold_text(h, key->metric) : h;
}

uint64_t koksma__checksum_of_reference(const koksma__series *key, double standard_error, const char *pixels)
{
    const char *const texts[] = {key->scene, key->scene_hash, key->options, key->what, key->made_by, pixels};
    uint64_t h = fold(fold(fold(0, REFERENCE), (uint64_t)key->width), (uint64_t)key->height);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        h = fold_text(h, texts[i]);
    }
    return fold_number(h, standard_error);
}

uint64_t koksma__checksum_of_text(const char *key, const char *value)
{
    return fold_text(fold_text(fold(0, META), key), value);
}

void koksma__seal_add(koksma__seal *seal, int sign, uint64_t checksum)
{
    seal->rows += sign;
    seal->sum += sign > 0 ? checksum : -checksum;
}
