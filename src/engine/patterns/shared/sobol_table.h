/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_SHARED_SOBOL_TABLE_H
#define KOKSMA_PATTERNS_SHARED_SOBOL_TABLE_H

#include <stdint.h>

#include "core/visibility.h"
#include "patterns/shared/parts.h"

enum { KOKSMA__SOBOL_DIM = 1111 };

/* The sets of direction numbers: Joe & Kuo's, Bratley & Fox's, and our own of tools/make_sobol_groups.c. */
enum { KOKSMA__JOE_KUO, KOKSMA__BRATLEY_FOX, KOKSMA__GROUPS, KOKSMA__SOBOL_SETS };

/* Returns the number of dimensions of a set of direction numbers. */
KOKSMA__LAB int koksma__sobol_dim(int set);

/* Returns the generator matrix of dimension k, counted from 0: word b is column b, whose first row is the highest bit.
   k is below koksma__sobol_dim(set). */
KOKSMA__LAB const uint32_t *koksma__sobol_directions(int k, int set);

/* Computes the whole generator matrix of dimension k for indices below 2^53: bit 52 of columns[b] is row 1. The first 32
   columns are koksma__sobol_directions(k, set), with zeros in rows 33 to 53. */
void koksma__sobol_columns(int k, int set, uint64_t columns[KOKSMA__DIGITS]);

/* Computes partners[l], l < levels, for the digital sequence with these directions, an upper triangular matrix: for
   i < 2^l, points 2^l + i and i ^ partners[l] have the same first l bits. */
KOKSMA__LAB void koksma__partners(const uint32_t *directions, int levels, uint32_t *partners);

#endif
