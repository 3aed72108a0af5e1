/* SPDX-License-Identifier: Apache-2.0 */
/*
 * correlated-multi-jittered: multi-jittered points in random order, in which all columns share one permutation of the
 * rows, and all rows share one permutation of the columns. Each point is computed only from hashes, without the other
 * points. With m columns, r rows, the permutation p of the rows and the permutation q of the columns:
 *
 *     x = (c + (p(j) + u) / r) / m,   y = (j + (q(c) + v) / m) / r,   (c, j) = the cell of the permuted index
 *
 * Source: Kensler 2013; the permutation is that of koksma/sampler.h. columns=0 takes the largest divisor of n that is
 * at most sqrt(n). Permutations of up to 8 elements (rows, columns or points) are not quite uniform. The probabilities
 * of the positions of a pair of elements have errors of 0.4 to 1.6 % (root mean square over the pairs; at most 7 %,
 * with 6 elements), the probabilities of the position of one element 0.4 % with 3 elements and 0.1 % with 5 to 7.
 */
#include <koksma/sampler.h>

#include <stdlib.h>

#include "core/platform/system.h"
#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/grids/grids.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

enum { FEW = 256, BLOCK = 256 };

/* The grid and its permutations, computed once for all points. (koksma_cmj_2d of koksma/sampler.h computes them for
   each point.) */
typedef struct grid {
    uint64_t seed, key; /* key: the hash key of the permutation that orders the points */
    uint32_t columns, rows;
    uint32_t *in_column, *in_row; /* the permutation p of `rows` numbers, and the permutation q of `columns`
                                     numbers */
} grid;

static void place(const void *context, size_t first, size_t count, bool stream, koksma_points *out)
{
    const grid *g = context;
    const koksma__kernel_table *kernels = koksma__kernels();
    const double cells = (double)out->n, inverse = 1.0 / g->columns;
    (void)stream;
    while (count) {
        uint32_t cell[BLOCK];
        const size_t some = count < BLOCK ? count : BLOCK;
        double *xs = out->xs + 2 * first;
        kernels->permute((uint32_t)first, some, (uint32_t)out->n, g->key, cell);
        kernels->uniform(g->seed, KOKSMA__PURPOSE_POINT, first, 0, some, xs);
        for (size_t i = 0; i < some; i++, xs += 2) {
            /* row = cell / columns, rounded down: a product with the inverse, in which the added half absorbs the
               rounding error. */
            const uint32_t row = (uint32_t)(int32_t)((cell[i] + 0.5) * inverse), column = cell[i] - row * g->columns;
            xs[0] = koksma_place((double)(column * g->rows + g->in_column[row]), xs[0], cells);
            xs[1] = koksma_place((double)(row * g->columns + g->in_row[column]), xs[1], cells);
        }
        first += some;
        count -= some;
    }
}

static uint64_t key_of(const uint32_t words[2])
{
    return (uint64_t)words[1] << 32 | words[0];
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    size_t columns, rows;
    KOKSMA__TRY(koksma__divisors("correlated-multi-jittered", out->n, args->params[0], &columns, &rows));
    uint32_t few[FEW], *orders = few;
    if (columns + rows > FEW) {
        const size_t bytes = (columns + rows) * sizeof *orders;
        orders = malloc(bytes);
        KOKSMA__REQUIRE_MEMORY(orders, bytes);
        koksma__large_pages(orders, bytes);
    }
    const koksma__words keys = koksma__random(seed, KOKSMA__PURPOSE_SHUFFLE, 0, 0);
    const koksma__words more = koksma__random(seed, KOKSMA__PURPOSE_SHUFFLE, 1, 0);
    const grid g = {seed, key_of(keys.w), (uint32_t)columns, (uint32_t)rows, orders, orders + rows};
    koksma__kernels()->permute(0, rows, (uint32_t)rows, key_of(keys.w + 2), g.in_column);
    koksma__kernels()->permute(0, columns, (uint32_t)columns, key_of(more.w), g.in_row);
    const koksma_status status = koksma__fill_rows(args->run, out, place, &g);
    if (orders != few) {
        free(orders);
    }
    return status;
}

static const koksma_param params[] = {KOKSMA__PARAM_DIVISOR, {0}};

const koksma_pattern koksma__pattern_correlated_multi_jittered = {
    .name = "correlated-multi-jittered",
    .title = "multi-jittered points with shared permutations",
    .cite = "kensler2013",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_LATIN | KOKSMA_CLAIM_GRID | KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
};
