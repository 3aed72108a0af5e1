/* SPDX-License-Identifier: Apache-2.0 */
/* Checksums of a store's rows, and their sum, by which a store knows that it holds what runs wrote. */
#ifndef KOKSMA_STUDY_STORE_SEAL_H
#define KOKSMA_STUDY_STORE_SEAL_H

#include "study/store/store.h"

/* A row of table result: of one trial, what up to four series have. */
typedef struct koksma__row {
    long long id;
    uint64_t seed;
    double values[KOKSMA__RESULT_VALUES];
} koksma__row;

/* How many rows the tables have, and the sum of their checksums. */
typedef struct koksma__seal {
    long long rows;
    uint64_t sum;
} koksma__seal;

uint64_t koksma__checksum_of_row(const koksma__row *row);
uint64_t koksma__checksum_of_series(const koksma__series *key, long long id);
uint64_t koksma__checksum_of_reference(const koksma__series *key, double standard_error, const char *pixels);
uint64_t koksma__checksum_of_text(const char *key, const char *value);

/* Takes a row in, or (-1) out. */
void koksma__seal_add(koksma__seal *seal, int sign, uint64_t checksum);

#endif
