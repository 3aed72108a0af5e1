/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Radical inverses: phi_b(i) has the digits of i in base b, mirrored at the radix point (van der Corput 1935). Every
 * value is the double nearest to the exact fraction numerator / b^m, with one rounding, and does not depend on the
 * number of points.
 */
#ifndef KOKSMA_PATTERNS_SHARED_RADICAL_H
#define KOKSMA_PATTERNS_SHARED_RADICAL_H

#include <koksma/koksma.h>

enum { KOKSMA__RADICAL_TABLE = 1024 };

/* Maps the digit a at position j of i (0: the least significant) to another digit. If a koksma__digit is NULL, digits
   are not mapped. */
typedef uint32_t (*koksma__digit)(const void *context, uint32_t base, int j, uint32_t a);

/* One coordinate. The table has the values of all combinations of the `low_digits` lowest digits, mirrored; the
   contribution of the higher digits is added to an entry. */
typedef struct koksma__radical {
    uint32_t base;
    int digits, low_digits; /* number of digits of the numerator; number of digits of the table's indices */
    uint32_t size;          /* size of the table: base^low_digits, or n if that is less */
    double high_scale;      /* base^(digits - low_digits) */
    double whole;           /* base^digits */
    double tail;            /* the amount, in [0,1), that the mapped infinitely many leading zeros add to the
                            numerator */
    koksma__digit digit;
    const void *context;
    double *table;
} koksma__radical;

/* Coordinates of radical inverses. koksma__radicals_init prepares them for the first `count` prime bases and indices
   below n. This function fails with KOKSMA_N if numerators would not be exact: if n is above the largest power of a
   base up to 2^53 or, with mapped digits, above 2^53 / base. All memory is one block, which koksma__radicals_fini
   frees. */
typedef struct koksma__radicals {
    koksma__radical few[8];
    double room[4 * KOKSMA__RADICAL_TABLE];
    koksma__radical *columns;
    void *memory;
} koksma__radicals;

koksma_status koksma__radicals_init(koksma__radicals *r, int count, uint64_t n, koksma__digit digit,
                                    const void *context);
void koksma__radicals_fini(koksma__radicals *r);

/* Fills `out` with points args->first, args->first + 1, ..., all below n: their coordinates are radical inverses. If
   `offset` is not NULL, coordinate 0 of point i is (i + *offset) / n, and the radical inverses are the others. */
koksma_status koksma__range_radicals(const koksma_args *args, uint64_t n, const double *offset, koksma__digit digit,
                                     const void *context, koksma_points *out);

/* Computes out[i], i < count, the radical inverse of first + i. */
void koksma__radical_column(const koksma__radical *r, uint64_t first, size_t count, double *out);

#endif
