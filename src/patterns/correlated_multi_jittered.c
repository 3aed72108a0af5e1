/* SPDX-License-Identifier: Apache-2.0 */
/*
 * correlated-multi-jittered: multi-jittered points with one permutation of the rows for all columns and one of the
 * columns for all rows, in random order; every point on its own from hashes.
 *
 *     x = (c + (p(j) + u) / r) / m,   y = (j + (q(c) + v) / m) / r,   (c, j) = the cell of the permuted index
 *
 * Source: Kensler 2013; the permutation is that of koksma/sampler.h. columns=0 takes the divisor of n nearest to its
 * root from below.
 */
#include <koksma/sampler.h>

#include "core/parallel.h"
#include "patterns/parts/cells.h"
#include "patterns/patterns.h"

enum { GROUP = 1 << 14 };

typedef struct job {
    koksma_domain domain;
    size_t columns, rows;
    koksma_points *out;
} job;

static koksma_status group(void *context, size_t g)
{
    const job *j = context;
    const size_t end = (g + 1) * GROUP < j->out->n ? (g + 1) * GROUP : j->out->n;
    for (size_t i = g * GROUP; i < end; i++) {
        koksma_cmj_2d(j->domain, (uint32_t)i, (uint32_t)j->columns, (uint32_t)j->rows, j->out->xs + 2 * i);
    }
    return KOKSMA_OK;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    job j = {.domain = {seed}, .out = out};
    const koksma_status status =
        koksma__divisors("correlated-multi-jittered", out->n, args->params[0], &j.columns, &j.rows);
    if (status) {
        return status;
    }
    const size_t groups = (out->n + GROUP - 1) / GROUP;
    return groups == 1 ? group(&j, 0) : koksma__parallel(args->run, groups, group, &j);
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
