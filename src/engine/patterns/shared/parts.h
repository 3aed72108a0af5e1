/* SPDX-License-Identifier: Apache-2.0 */
/* Digital sequences in base 2 beyond point 2^32. Index i is 2^32 part + rest. Generator matrices are upper triangular:
   their columns 0 to 31 are zero below row 32. The first 32 digits of point i are therefore those of point `rest`, xor
   32 digits that only `part` decides; digits 33 to 53 depend on `part` alone. Points of part 0 have 32 digits. */
#ifndef KOKSMA_PATTERNS_SHARED_PARTS_H
#define KOKSMA_PATTERNS_SHARED_PARTS_H

#include <koksma/koksma.h>

enum {
    KOKSMA__DIGITS = 53,     /* binary digits of a coordinate; a matrix has as many columns */
    KOKSMA__LATE_DIGITS = 21 /* binary digits of a coordinate after the first 32 */
};

#define KOKSMA__LATE_MASK (((uint64_t)1 << KOKSMA__LATE_DIGITS) - 1)

/* Generates the points of one part from number args->first < 2^32 of this part. */
typedef koksma_status (*koksma__part)(const void *context, uint64_t part, const koksma_args *args,
                                      koksma_points *out);

/* Returns whether all points of a range have numbers below 2^32. Patterns then generate the range at once, without
   koksma__range_parts, which saves time. */
static inline bool koksma__in_first_part(const koksma_args *args, const koksma_points *out)
{
    return args->first + out->n <= (uint64_t)1 << 32;
}

/* Cuts a range into its parts and calls f for each. */
koksma_status koksma__range_parts(const koksma_args *args, koksma_points *out, koksma__part f, const void *context);

/* Returns the exclusive or of the columns 32 + b of a matrix over the bits b of `part`. A column is a whole number
   whose 53 bits are its entries; the highest bit is the entry of row 1. */
uint64_t koksma__part_sum(const uint64_t columns[KOKSMA__DIGITS], uint64_t part);

/* Returns the first 32 digits of a sum of columns. */
static inline uint32_t koksma__early_digits(uint64_t sum)
{
    return (uint32_t)(sum >> KOKSMA__LATE_DIGITS);
}

/* Returns the column whose entry in row r is bit r of `rows`. Rows after the 53rd are cut off. */
uint64_t koksma__mirror_digits(uint64_t rows);

/* Adds digits 33 to 53 of sums[k] to coordinate k of all points. */
koksma_status koksma__add_late_digits(const koksma_run *run, const uint64_t *sums, koksma_points *out);

/* Computes partners[l - 32] for levels l = 32 .. 52, as koksma__partners does for the levels below 32: for i < 2^l,
   points 2^l + i and i ^ partner have the same first l digits. */
void koksma__late_partners(const uint64_t columns[KOKSMA__DIGITS], uint64_t partners[KOKSMA__LATE_DIGITS]);

#endif
