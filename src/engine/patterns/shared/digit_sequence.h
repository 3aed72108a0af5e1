/* SPDX-License-Identifier: Apache-2.0 */
/* Digital sequences in a prime base from upper triangular generator matrices. */
#ifndef KOKSMA_PATTERNS_SHARED_DIGIT_SEQUENCE_H
#define KOKSMA_PATTERNS_SHARED_DIGIT_SEQUENCE_H

#include <koksma/koksma.h>

/* Fills the upper triangular matrix of coordinate k: entry [r][c] < base is matrix[r * digits + c]. */
typedef void (*koksma__digit_matrix)(uint32_t base, int k, int digits, uint32_t *matrix);

/* Fills `out` with the range of points that begins at args->first. Let y = C a modulo base, where a are the digits of
   the index, the lowest first. A coordinate is the double nearest to y_0 base^-1 + y_1 base^-2 + ... There are at
   most most_digits digits, with base^most_digits <= 2^53. Errors: N where an index needs more digits, MEMORY,
   INTERRUPTED. */
koksma_status koksma__digit_sequence(const char *name, uint32_t base, int most_digits, koksma__digit_matrix fill,
                                     const koksma_args *args, koksma_points *out);

/* Returns the largest number of digits in this base that fit into 53 bits. */
int koksma__digits_of_double(uint32_t base);

/* Fills the powers of Pascal's matrix: entry [r][c] is C(c,r) k^(c-r). */
void koksma__pascal_matrix(uint32_t base, int k, int digits, uint32_t *matrix);

#endif
