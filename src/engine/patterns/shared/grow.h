/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Stochastic generation (Helmer, Christensen & Kensler 2021): a digital sequence in base 2 with exact Owen (nested
 * uniform) scrambling, in O(1) for each coordinate of a point. Point 2^l + i is put at a random position in a stratum
 * of width 2^-l, in the half that does not contain the earlier point number i XOR partner. The low bits of
 * coordinate k of point p come from word p % 4 of koksma__random(seed, purpose, p / 4, k). This is Owen scrambling given
 * that digits 33 to 53 of the first 2^32 points are 0: a coordinate is uniform on the multiples of 2^-32 for those
 * points, and its first 32 digits are uniform for all points.
 */
#ifndef KOKSMA_PATTERNS_SHARED_GROW_H
#define KOKSMA_PATTERNS_SHARED_GROW_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Fills `out` with the first points; partners[32 k + l] is the partner of level l for coordinate k < dim. */
koksma_status koksma__grow(uint64_t seed, uint32_t purpose, const uint32_t *partners, const koksma_run *run,
                           koksma_points *out);

/* A part of the sequence beyond point 2^32 (patterns/shared/parts.h), and the partners of the levels from 32 on:
   late_partners[21 k + l] is that of level 32 + l for coordinate k. */
typedef struct koksma__grow_part {
    uint64_t part;
    const uint64_t *late_partners;
} koksma__grow_part;

/* Fills `out` with points args->first, args->first + 1, ... of a part of the sequence of koksma__grow, up to the end of
   this part. partners has 32 levels unless args->first is 0.
     part  NULL: the first 2^32 points, whose coordinates have 32 digits; all other points have 53 */
koksma_status koksma__grow_range(uint64_t seed, uint32_t purpose, const uint32_t *partners,
                                 const koksma__grow_part *part, const koksma_args *args, koksma_points *out);

/* The partners of pmj02. The generator matrix of its coordinate 0 is the matrix of the Stirling numbers of the first
   kind modulo 2; the matrix of coordinate 1 is the same matrix shifted by a row and a column. */
extern KOKSMA__LAB const uint32_t koksma__pmj02_partners[2 * 32];

/* Computes coordinate 0 of the first n points as 32-bit fractions: v[i] is 2^32 times coordinate 0 of point i.
   partners[l] is the partner for level l < 32. */
koksma_status koksma__grow_column(uint64_t seed, uint32_t purpose, const uint32_t *partners, const koksma_run *run,
                                  size_t n, uint32_t *v);

#endif
