/* SPDX-License-Identifier: Apache-2.0 */
/*
 * best-candidate: each point is the best of several uniform random candidates: the one that is furthest, on the
 * torus, from all earlier points. The points are a sequence: a smaller set is a prefix of a larger one.
 *
 *     x_k = argmax over c of min over j < k of |c - x_j|,   c one of min(candidates * k + 1, most) uniform points
 *
 * Source: Mitchell 1991, where the number of candidates grows with k so that the spectrum keeps its shape.
 */
#include <math.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "patterns/patterns.h"
#include "patterns/spacing/spacing.h"

enum { MAX_DIM = 8, LOOKS = 1 << 24 };

/* Returns the squared distance from x to the nearest of the points. If this distance is at most `enough`, the
   function may return any value up to `enough`. */
static double nearest(const koksma_points *out, size_t placed, const double *x, double enough)
{
    double best = INFINITY; /* squared distances on the torus are at most dim / 4 */
    for (size_t i = 0; i < placed && best > enough; i++) {
        double sum = 0;
        for (int k = 0; k < out->dim; k++) {
            const double t = koksma__torus_difference(x[k], out->xs[i * (size_t)out->dim + (size_t)k]);
            sum += t * t;
        }
        best = fmin(best, sum);
    }
    return best;
}

/* Chooses the next point among its candidates. `looks` counts the comparisons of candidates with points: every LOOKS
   comparisons the function reports progress to `run` and checks whether to stop. */
static koksma_status choose(uint64_t seed, size_t placed, size_t candidates, const koksma__torus_grid *grid,
                            const koksma_run *run, size_t *looks, koksma_points *out)
{
    double best = -1, dart[MAX_DIM];
    double *point = out->xs + placed * (size_t)out->dim;
    for (size_t c = 0; c < candidates; c++) {
        for (int k = 0; k < out->dim; k += 2) {
            koksma__random_pair(seed, KOKSMA__PURPOSE_DART, (uint64_t)placed << 24 | c, (uint32_t)k / 2, dart + k);
        }
        const double d =
            grid ? koksma__torus_grid_nearest(grid, dart[0], dart[1], best) : nearest(out, placed, dart, best);
        if (d > best) {
            best = d;
            for (int k = 0; k < out->dim; k++) {
                point[k] = dart[k];
            }
        }
        *looks += grid ? 64 : placed + 1;
        if (*looks >= LOOKS) {
            *looks = 0;
            if (!koksma__keep_going(run, (double)placed / (double)out->n)) {
                return koksma__fail_interrupted();
            }
        }
    }
    return KOKSMA_OK;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const bool gridded = out->dim == 2 && out->n > 64;
    koksma__torus_grid grid = {0};
    size_t looks = 0;
    koksma_status status = gridded ? koksma__torus_grid_init(&grid, out->n, out->xs) : KOKSMA_OK;
    for (size_t i = 0; i < out->n && !status; i++) {
        const double wanted = args->params[0] * (double)i + 1;
        /* the grid's cells are for n points: among fewer than sqrt(n), a query visits more cells than there are points */
        const bool by_grid = gridded && i > 16 && i > out->n / i;
        status =
            choose(seed, i, (size_t)fmin(wanted, args->params[1]), by_grid ? &grid : NULL, args->run, &looks, out);
        if (gridded) {
            koksma__torus_grid_add(&grid, (uint32_t)i);
        }
    }
    koksma__torus_grid_fini(&grid);
    return status;
}

static const koksma_param params[] = {
    {"candidates", "number of candidates for each earlier point", 1, 1, 100, NULL, true},
    {"most", "largest number of candidates for a point", 1000, 1, 1 << 20, NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_best_candidate = {
    .name = "best-candidate",
    .title = "each point is the random candidate furthest from all earlier points",
    .cite = "mitchell1991",
    .min_dim = 1,
    .max_dim = MAX_DIM,
    .claims = KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_BLUE | KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
};
