/* SPDX-License-Identifier: Apache-2.0 */
/* Checksums of a store's rows and their sum, the seal, which shows whether the store holds exactly what runs
   wrote. */
#ifndef KOKSMA_STUDY_STORE_SEAL_H
#define KOKSMA_STUDY_STORE_SEAL_H

#include "study/store/store.h"

/* A row of table result: the results of one trial in up to four series. */
typedef struct koksma__row {
    long long id;
    uint64_t seed;
    double values[KOKSMA__RESULT_VALUES];
} koksma__row;

/* The number of rows in the tables and the sum of their checksums. */
typedef struct koksma__seal {
    long long rows;
    uint64_t sum;
} koksma__seal;

uint64_t koksma__checksum_of_row(const koksma__row *row);
uint64_t koksma__checksum_of_series(const koksma__series *key, long long id);
uint64_t koksma__checksum_of_reference(const koksma__series *key, double standard_error, const char *pixels);
uint64_t koksma__checksum_of_text(const char *key, const char *value);

/* Adds a row to the seal (sign 1) or removes it (sign -1). */
void koksma__seal_add(koksma__seal *seal, int sign, uint64_t checksum);

#endif
