/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Radical inverses: phi_b(i) has the digits of i in base b, mirrored at the radix point (van der Corput 1935). Every
 * value is the double nearest to the fraction (numerator / b^m, one rounding), whatever the number of points.
 */
#ifndef KOKSMA_PATTERNS_SHARED_RADICAL_H
#define KOKSMA_PATTERNS_SHARED_RADICAL_H

#include <koksma/koksma.h>

enum { KOKSMA__RADICAL_TABLE = 1024 };

/* What digit a at place j (0: the least significant of i) becomes; NULL is a itself. */
typedef uint32_t (*koksma__digit)(const void *context, uint32_t base, int j, uint32_t a);

/* A coordinate: the mirrored low `digits` digits come from the table, the others are added. */
typedef struct koksma__radical {
    uint32_t base;
    int digits, low_digits; /* of all i < n; of the table */
    uint32_t size;          /* base^low_digits, or n where that is less */
    double high_scale;      /* base^(digits - low_digits) */
    double whole;           /* base^digits */
    double tail;            /* what the infinite row of zero digits adds to the numerator, in [0,1) */
    koksma__digit digit;
    const void *context;
    double *table;
} koksma__radical;

/* Prepares coordinates for the first `count` prime bases and indices below n. Error: N, past the largest power of a base
   up to 2^53, beyond which numerators are not exact.
   All memory is one block that the caller frees with koksma__radicals_fini. */
typedef struct koksma__radicals {
    koksma__radical few[8];
    double room[4 * KOKSMA__RADICAL_TABLE];
    koksma__radical *columns;
    void *memory;
} koksma__radicals;

koksma_status koksma__radicals_init(koksma__radicals *r, int count, uint64_t n, koksma__digit digit,
                                    const void *context);
void koksma__radicals_fini(koksma__radicals *r);

/* out[i] = the value for index first + i, i < count. */
void koksma__radical_column(const koksma__radical *r, uint64_t first, size_t count, double *out);

/* The k-th prime, 0: 2. k < KOKSMA_MAX_DIM. */
uint32_t koksma__prime(int k);

#endif
