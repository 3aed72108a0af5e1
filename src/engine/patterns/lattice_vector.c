/* SPDX-License-Identifier: Apache-2.0 */
/*
 * lattice-vector: the rank-1 lattice of a generating vector written in the spec, as in
 * lattice-vector:1:182667:469891.
 *
 *     x_i,k = {i z_k / n}
 *
 * The components z_1, z_2, ... are whole numbers below 2^52, separated by colons; lattice-file reads longer vectors
 * from a file. The points are Latin if no z_k has a divisor in common with n.
 * Source: Sloan & Reztsov 2002 (rank-1 lattices); the user chooses the vector. Known: lattice-vector:1:8 with n = 13
 * gives the points of fibonacci.
 */
#include <stdlib.h>

#include "core/status.h"
#include "patterns/lattices/lattices.h"
#include "patterns/patterns.h"

/* Largest number of components that fit into a spec: each needs at least two characters, a digit and a colon. */
enum { MOST = KOKSMA_MAX_SPEC / 2 };

static const uint64_t LIMIT = UINT64_C(1) << 52;

static koksma_status parse(const char *text, uint64_t *z, int *count)
{
    const char *at = text;
    for (*count = 0; *count < MOST; at++) {
        char *end = (char *)(uintptr_t)at;
        const unsigned long long number = *at >= '0' && *at <= '9' ? strtoull(at, &end, 10) : LIMIT;
        KOKSMA__FAIL_IF(number >= LIMIT || (*end && *end != ':'), KOKSMA_ARGUMENT,
                        "lattice-vector:%s: it takes whole numbers below 2^52 with colons between them, as in "
                        "lattice-vector:1:182667",
                        text);
        z[(*count)++] = number;
        if (!*end) {
            return KOKSMA_OK;
        }
        at = end;
    }
    return koksma__fail(KOKSMA_ARGUMENT, "lattice-vector:%s: it takes at most %d numbers", text, MOST);
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    uint64_t z[MOST];
    int count = 0;
    (void)seed;
    KOKSMA__TRY(parse(args->path, z, &count));
    KOKSMA__FAIL_IF(count < out->dim, KOKSMA_DIM, "lattice-vector:%s: it has %d dimensions, not %d", args->path,
                    count, out->dim);
    for (int k = 0; k < out->dim; k++) {
        z[k] %= args->n;
    }
    return koksma__range_lattice(args, z, out);
}

const koksma_pattern koksma__pattern_lattice_vector = {
    .name = "lattice-vector",
    .title = "rank-1 lattice whose generating vector is part of the spec: lattice-vector:1:182667:469891",
    .cite = "sloan2002",
    .min_dim = 1,
    .max_dim = MOST,
    .claims =
        KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_DIMENSION_PREFIXES | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_LATTICE,
    .generate = generate,
    .operand = "Z1:Z2:..",
    .ranges = koksma__ranges_always,
};
