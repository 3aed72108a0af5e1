/* SPDX-License-Identifier: Apache-2.0 */
/*
 * progressive-elimination: the sequence of `length` points that sample elimination selects from `factor` times as
 * many uniform random points, in Yuksel's progressive order: elimination removes half of the points, then half of the
 * rest, and so on. The points are listed in the reverse order of their removal.
 *
 * Source: Yuksel 2015, section on progressive sampling; spacing/elimination.c gives the formulas. The first n points
 * of a sequence do not depend on n, but they depend on `length`. Generating n points always takes the time of the
 * whole sequence, so choose a small `length`.
 */
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "patterns/patterns.h"
#include "patterns/spacing/spacing.h"

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const size_t length = (size_t)args->params[0], factor = (size_t)args->params[1], dim = (size_t)out->dim;
    KOKSMA__FAIL_IF(out->n > length, KOKSMA_N,
                    "progressive-elimination: length=%zu has %zu points, not %zu; n = %zu or less, or "
                    "length=%zu, would do",
                    length, length, out->n, length, out->n);
    KOKSMA__FAIL_IF(length > KOKSMA_MAX_COORDINATES / dim / factor, KOKSMA_N,
                    "progressive-elimination: length=%zu is too large; length=%zu or less would do", length,
                    KOKSMA_MAX_COORDINATES / dim / factor);
    double *xs = malloc(length * dim * sizeof *xs);
    KOKSMA__REQUIRE_MEMORY(xs, length * dim * sizeof *xs);
    const koksma_status status =
        koksma__eliminated_set("progressive-elimination", seed, length, out->dim, factor, true, args->run, xs);
    if (!status) {
        memcpy(out->xs, xs, out->n * dim * sizeof *xs);
    }
    free(xs);
    return status;
}

static const koksma_param params[] = {
    {"length", "number of points in the sequence", 1024, 1, 1 << 27, NULL, true},
    {"factor", "number of candidates for each point of the sequence", 5, 2, 20, NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_progressive_elimination = {
    .name = "progressive-elimination",
    .title = "sample elimination in an order whose prefixes are blue noise",
    .cite = "yuksel2015",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_BLUE | KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
    .revision = 1, /* no weight limit from 4 dimensions on */
};
