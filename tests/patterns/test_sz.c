/* SPDX-License-Identifier: Apache-2.0 */
/*
 * sz as its paper states it (Ahmed, Pharr, Ostromoukhov & Huang 2025): sequences in bases 2, 4, 16 and 256 at once.
 * Coordinates 2 k and 2 k + 1 are a (0,2)-sequence in base 2, 4 k .. 4 k + 3 a (0,4)-sequence in base 4, and so on:
 * every aligned block of b^m points is a (0,m,b)-net in base b, which is counted, box by box, for blocks at the start
 * and elsewhere, plain and scrambled. The claims of the pattern (tests/claims) count the first blocks in bases 2 and 4.
 */
#include <stdlib.h>
#include <string.h>

#include "test.h"

enum { MOST_DIM = 256 };

/* A block of b^m points, and how often each coordinate is divided by b. */
typedef struct block {
    const koksma_points *points;
    size_t base;
    int first, count; /* coordinates */
    int parts[MOST_DIM];
} block;

/* Whether each box of the division has one point. */
static bool one_in_each(const block *b, unsigned char *seen)
{
    const size_t n = b->points->n;
    memset(seen, 0, n);
    for (size_t i = 0; i < n; i++) {
        const double *x = b->points->xs + i * (size_t)b->points->dim + b->first;
        size_t box = 0;
        for (int k = 0; k < b->count; k++) {
            if (b->parts[k]) {
                const size_t parts = (size_t)pow((double)b->base, b->parts[k]);
                box = box * parts + (size_t)(x[k] * (double)parts);
            }
        }
        if (seen[box]) {
            return false;
        }
        seen[box] = 1;
    }
    return true;
}

/* Whether this holds for all ways to divide coordinates k .. count - 1, `left` times in all. */
static bool all_divisions(block *b, int k, int left, unsigned char *seen)
{
    if (k == b->count - 1) {
        b->parts[k] = left;
        return one_in_each(b, seen);
    }
    bool even = true;
    for (int own = 0; own <= left && even; own++) {
        b->parts[k] = own;
        even = all_divisions(b, k + 1, left - own, seen);
    }
    return even;
}

/* Fails unless the block that starts at point `at` is a net in its base. */
static void assert_net(const char *pattern, uint64_t at, size_t base, int m, int first, int dim)
{
    koksma_spec spec;
    koksma_points points;
    block b = {&points, base, first, (int)base, {0}};
    assert_ok(koksma_pattern_spec(pattern, &spec));
    assert_ok(koksma_points_init(&points, (size_t)pow((double)base, m), dim));
    assert_ok(koksma_generate_range(&spec, 3, 0, at, NULL, &points));
    unsigned char *seen = malloc(points.n);
    assert_non_null(seen);
    assert_that(all_divisions(&b, 0, m, seen), "%s: %zu points from %g on, coordinates %d to %d: no net in base %zu",
                pattern, points.n, (double)at, first, first + b.count - 1, base);
    free(seen);
    koksma_points_fini(&points);
}

static const uint64_t blocks[] = {0, 1, 2, 5, 1000, (uint64_t)1 << 20};

static void blocks_are_nets(const char *pattern, size_t base, int most, int dim)
{
    for (int m = 1; m <= most; m++) {
        for (size_t a = 0; a < sizeof blocks / sizeof *blocks; a++) {
            const uint64_t at = blocks[a] * (uint64_t)pow((double)base, m);
            for (int first = 0; first < dim; first += (int)base * (first ? 3 : 1)) {
                assert_net(pattern, at, base, m, first, dim);
            }
        }
    }
}

TEST_CASE(pairs_are_sequences_in_base_2)
{
    blocks_are_nets("sz", 2, 9, 64);
    blocks_are_nets("sz:owen=1", 2, 5, 16);
}

TEST_CASE(quadruples_are_sequences_in_base_4)
{
    blocks_are_nets("sz", 4, 4, 64);
    blocks_are_nets("sz:owen=1", 4, 3, 16);
    assert_net("sz", 0, 4, 5, 0, 4);
    assert_net("sz", (uint64_t)5 << 32, 4, 4, 4, 8); /* beyond 2^32 */
}

TEST_CASE(sixteen_are_sequences_in_base_16)
{
    blocks_are_nets("sz", 16, 2, 64);
    blocks_are_nets("sz:owen=1", 16, 2, 16);
}

/* 256 points fill 256 strata of each coordinate; 65,536 points the 256 x 256 cells of two coordinates, which is tried for
   those at distances of powers of two. */
TEST_CASE(all_are_a_sequence_in_base_256)
{
    enum { BASE = 256, N = BASE * BASE, PAIRS = 64 };
    assert_net("sz", 0, BASE, 1, 0, BASE);
    assert_net("sz", 7 * BASE, BASE, 1, 0, BASE);
    koksma_points points = test_points("sz", N, BASE, 0);
    unsigned char *seen = malloc(N);
    assert_non_null(seen);
    for (int pair = 0; pair < PAIRS; pair++) {
        block b = {&points, BASE, 0, BASE, {0}};
        const int k = pair * 37 % BASE;
        b.parts[k] = b.parts[k ^ 1 << pair % 8] = 1;
        assert_that(one_in_each(&b, seen), "coordinates %d and %d do not fill their cells", k, k ^ 1 << pair % 8);
    }
    free(seen);
    koksma_points_fini(&points);
}
