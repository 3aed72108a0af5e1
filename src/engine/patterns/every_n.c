/* SPDX-License-Identifier: Apache-2.0 */
/*
 * every-n: a sequence whose first n points are even for every n, found by search, in 2, 3 and 4 dimensions.
 *
 *     x_i,k = {t_j,k / 2^24 + b a_k},   j = i mod 1024, b = floor(i / 1024)
 *
 * t is a table of 1,024 points for each number of dimensions, and a_k = g^-k as in r-sequence: from the second block on,
 * the table is shifted on the torus by the vector b a. The points of the tables were added one by one, each where the L2
 * star discrepancy of the points so far becomes small, and then moved to a small mean of squared L2 star discrepancies
 * of all prefixes, relative to those before the moves. In the plane the first 128 points minimise the mean of D*(n) /
 * record(n) over n = 8 .. 128 instead, where record(n) is the star discrepancy of the best known set of n points.
 *
 * Source: this project's search (docs/findings/any-n.md). Kritzinger (2022) adds points greedily by the L2 star discrepancy
 * in one dimension.
 * Known: the modifier shift makes it unbiased, and so do owen and digital-shift (each point is uniform); none of them
 * keeps the star discrepancy (docs/findings/any-n.md).
 */
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

#include "patterns/data/every_n.inc" /* plane, space and four, made from every_n.csv */

enum { LENGTH = 1024, DIGITS = 24 };

/* The tables, and the powers of 1/g in units of 2^-64, by the number of dimensions less 2. */
static const struct {
    const uint32_t *points;
    uint64_t shifts[4];
} tables[] = {
    {plane, {0xC13FA9A902A6328Fu, 0x91E10DA5C79E7B1Du}},
    {space, {0xD1B54A32D192ED04u, 0xABC98388FB8FAC03u, 0x8CB92BA72F3D8DD7u}},
    {four, {0xDB4F0B9175AE2165u, 0xBBE0563303A4615Fu, 0xA0F2EC75A1FE1576u, 0x89E182857D9ED689u}},
};

_Static_assert(sizeof plane == 2 * LENGTH * sizeof *plane && sizeof space == 3 * LENGTH * sizeof *space &&
                   sizeof four == 4 * LENGTH * sizeof *four,
               "each table has 1024 points");

static void column(const void *context, int k, uint64_t first, size_t count, double *xs)
{
    const int dim = *(const int *)context;
    for (size_t i = 0; i < count; i++) {
        const uint64_t at = first + i, t = tables[dim - 2].points[at % LENGTH * (uint64_t)dim + (uint64_t)k];
        const uint64_t x = (t << (64 - DIGITS)) + at / LENGTH * tables[dim - 2].shifts[k];
        xs[i] = (double)(int64_t)(x >> 11) * 0x1p-53;
    }
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    return koksma__range_columns(args, out, column, &out->dim);
}

const koksma_pattern koksma__pattern_every_n = {
    .name = "every-n",
    .title = "a sequence found by search, even for every number of points, not only for powers of 2",
    .cite = "kritzinger2022 roberts2018",
    .min_dim = 2,
    .max_dim = 4,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N,
    .revision = 1, /* a better start of the table of the plane */
    .generate = generate,
    .ranges = koksma__ranges_always,
};
