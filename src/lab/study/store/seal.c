/* SPDX-License-Identifier: Apache-2.0 */
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
#include "study/store/seal.h"

#include <math.h>
#include <string.h>

#include "core/hash.h"

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
