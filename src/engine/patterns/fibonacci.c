/* SPDX-License-Identifier: Apache-2.0 */
/*
 * fibonacci: the lattice of two neighbouring Fibonacci numbers, F_(m-1) and n = F_m.
 *
 *     x = i / n,   y = {i F_(m-1) / n}
 *
 * Source: Zaremba 1966. The lattice has the lowest possible periodic L2 discrepancy for n = 1, 2, 3, 5, 8, 13
 * (Hinrichs & Oettershagen 2016). Known exactly: n = 13: D* = 0.165680473, L2 star = 0.065208186. The pattern golden
 * is the analogue for any n.
 */
#include "core/status.h"
#include "patterns/lattices/lattices.h"
#include "patterns/patterns.h"

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    uint64_t before = 1, number = 1;
    while (number < args->n) {
        const uint64_t next = before + number;
        before = number;
        number = next;
    }
    KOKSMA__FAIL_IF(number != args->n, KOKSMA_N,
                    "fibonacci: n = %llu is not a Fibonacci number; n = %llu or %llu would do",
                    (unsigned long long)args->n, (unsigned long long)before, (unsigned long long)number);
    const uint64_t z[2] = {args->n > 1, args->n > 1 ? before : 0};
    return koksma__range_lattice(args, z, out);
}

const koksma_pattern koksma__pattern_fibonacci = {
    .name = "fibonacci",
    .title = "the lattice of two neighbouring Fibonacci numbers",
    .cite = "zaremba1966 hinrichs2016",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_LATTICE,
    .generate = generate,
    .ranges = koksma__ranges_always,
};
