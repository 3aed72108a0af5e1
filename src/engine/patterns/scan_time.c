/* SPDX-License-Identifier: Apache-2.0 */
/*
 * scan-time: jittered x and y. The cells are visited in scan order, and each point's time t is the best of some
 * random candidates: the one whose smallest distance to the finished points, on the unit 3-torus, is largest.
 *
 *     t_i = argmax over candidates t of min over j < i of |(x_i, y_i, t) - (x_j, y_j, t_j)|
 *
 * Source: Mitchell 1992, table 2 ("Scan-Time", after his 1991 paper), which states neither the distance nor the
 * number of candidates. With 16 candidates the L2 star discrepancy of 16, 256, 1600 points is about 0.0463, 0.0074,
 * 0.0023; the paper gives 0.0473, 0.00721, 0.00235. A candidate is worse than the best so far if some finished point
 * is nearer to it than the smallest distance of the best candidate. Only cells within that distance can contain such
 * a point, so only these are searched.
 */
#include <math.h>

#include "core/parallel.h"
#include "core/random.h"
#include "patterns/grids/grids.h"
#include "patterns/patterns.h"

typedef struct scan {
    const koksma_points *out;
    size_t columns, rows;
} scan;

static double around(double t)
{
    t = fabs(t);
    return t > 0.5 ? 1 - t : t;
}

/* Returns the squared distance from (x, y, t) to the nearest finished point, where (x, y) is point i and finished
   points have lower indices. The search stops when this distance is at most `enough`. */
static double nearest(const scan *s, size_t i, double t, double enough)
{
    const double *own = s->out->xs + 3 * i;
    double best = 0.75;
    const long column = (long)(i / s->rows), row = (long)(i % s->rows);
    const long columns = (long)s->columns, rows = (long)s->rows;
    for (long dx = 0; dx <= columns / 2 && best > enough; dx++) {
        const double gap = fmax(0, (double)(dx - 1)) / (double)columns;
        if (gap * gap >= best) {
            break;
        }
        const long reach = (long)fmin((double)rows / 2, ceil(sqrt(best - gap * gap) * (double)rows) + 1);
        for (int side = 0; side < 2; side++) {
            const long c = (column + (side ? -dx : dx) + columns) % columns;
            for (long dy = -reach; dy <= reach; dy++) {
                const size_t j = (size_t)(c * rows + (row + dy + rows) % rows);
                const double *x = s->out->xs + 3 * j;
                if (j >= i) {
                    continue;
                }
                const double a = around(x[0] - own[0]), b = around(x[1] - own[1]), d = around(x[2] - t);
                best = fmin(best, a * a + b * b + d * d);
            }
        }
    }
    return best;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    scan s = {.out = out};
    const koksma_points plane = {out->n, 2, out->xs};
    koksma_status status = koksma__cells("scan-time", &plane, args->params[0], &s.columns, &s.rows);
    status = status ? status : koksma__fill_jittered_time("scan-time", seed, args, out);
    const size_t candidates = (size_t)args->params[1], often = 1 + 16384 / candidates;
    for (size_t i = 0; i < out->n && !status; i++) {
        double best = -1, best_t = 0;
        for (size_t c = 0; c < candidates; c += 2) {
            double pair[2];
            koksma__random_pair(seed, KOKSMA__PURPOSE_DART, i * 512 + c / 2, 0, pair);
            for (size_t h = 0; h < 2 && c + h < candidates; h++) {
                const double d = nearest(&s, i, pair[h], best);
                if (d > best) {
                    best = d;
                    best_t = pair[h];
                }
            }
        }
        out->xs[3 * i + 2] = best_t;
        if (i % often == often - 1 && !koksma__keep_going(args->run, (double)i / (double)out->n)) {
            status = koksma__fail_interrupted();
        }
    }
    return status;
}

static const koksma_param params[] = {
    KOKSMA__PARAM_COLUMNS,
    {"candidates", "number of random candidates for each time", 16, 1, 1000, NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_scan_time = {
    .name = "scan-time",
    .title = "jittered x and y, with times far from those of neighbouring points",
    .cite = "mitchell1992 mitchell1991",
    .min_dim = 3,
    .max_dim = 3,
    .claims = KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
};
