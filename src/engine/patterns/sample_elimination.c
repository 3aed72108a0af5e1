/* SPDX-License-Identifier: Apache-2.0 */
/*
 * sample-elimination: starts from factor * n uniform random points and repeatedly removes the point with the largest
 * weight, which has the most and nearest neighbours on the torus, until n points are left.
 *
 *     weight of i = sum over j with d_ij < d_max of (1 - max(d_ij, d_min) / d_max)^8
 *     d_max = the distance of the densest packing of n points,  d_min = d_max (1 - factor^-1.5) 0.65 (dim <= 3)
 *
 * Source: Yuksel 2015, in any dimension; spacing/elimination.c gives the formulas in detail. The points come in the
 * order in which they were drawn; progressive-elimination orders them so that the first k are blue noise, too.
 * Relative radius at n = 1024 in the plane, mean of 10 sets: 0.696 at factor 5, 0.770 at factor 20.
 *
 * From 4 dimensions on d_min is 0, unlike in the paper: there d_max follows from balls that fill the volume without
 * gaps, and d_min = 0.59 d_max is above the distances that the set reaches, so that a pair at any smaller distance
 * would weigh the same and stay. At n = 64 in 4 dimensions the smallest distance of 20 sets is 0.275 on average; with
 * the paper's limit, here as in Yuksel's program, 0.099, and of random points 0.103.
 */
#include "patterns/patterns.h"
#include "patterns/spacing/spacing.h"

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    return koksma__eliminated_set("sample-elimination", seed, out->n, out->dim, (size_t)args->params[0], false,
                                  args->run, out->xs);
}

static const koksma_param params[] = {
    {"factor", "number of candidates for each remaining point", 5, 2, 20, NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_sample_elimination = {
    .name = "sample-elimination",
    .title = "points that remain when the most crowded candidates are removed one by one",
    .cite = "yuksel2015",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_BLUE | KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
    .revision = 1, /* no weight limit from 4 dimensions on */
};
