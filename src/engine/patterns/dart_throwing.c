/* SPDX-License-Identifier: Apache-2.0 */
/*
 * dart-throwing: exactly n points by dart throwing on the torus. No two points are closer than f times the smallest
 * distance in the densest (hexagonal) packing:
 *
 *     d = f sqrt(2 / (sqrt 3 n))
 *
 * Source: Mitchell 1992 ("dart-throwing Poisson disk"; he does not state the distance: f = 0.75 fits his tables).
 * Dart throwing jams at f = 0.777 on average (random sequential packing covers 0.547 of the plane). A jammed set is
 * discarded and thrown again from the start, at most 200 times. The points are distributed as if all
 * darts were uniform in the square (darts/darts.h). For a small f most darts fit; they are then thrown one by one
 * and checked against a grid of n cells. The cells of darts.h are smaller than d, so there would be far more of
 * them than points.
 */
#include <string.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "patterns/darts/darts.h"
#include "patterns/patterns.h"
#include "patterns/spacing/spacing.h"

enum { RESTARTS = 200 };

#define SPARSE 0.4 /* for smaller f the disks of radius d cover less than 3.63 f^2 = 0.58 of the torus */

static koksma_status throw_one_by_one(uint64_t seed, double d, const koksma_run *run, koksma_points *out)
{
    koksma__torus_grid grid;
    koksma_status status = koksma__torus_grid_init(&grid, out->n, out->xs);
    size_t placed = 0;
    for (uint64_t dart = 0; placed < out->n && !status; dart++) {
        double *point = out->xs + 2 * placed;
        koksma__random_pair(seed, KOKSMA__PURPOSE_DART, dart, 0, point);
        if (!koksma__torus_grid_near(&grid, point[0], point[1], d, true)) {
            koksma__torus_grid_add(&grid, (uint32_t)placed++);
        }
        if (dart % 65536 == 65535 && !koksma__keep_going(run, (double)placed / (double)out->n)) {
            status = koksma__fail_interrupted();
        }
    }
    koksma__torus_grid_fini(&grid);
    return status;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const double f = args->params[0], densest = koksma__packing_distance(out->n, 2, true);
    const double d = out->n == 1 ? 0.5 : f * densest;
    if (out->n > 1 && f < SPARSE) {
        return throw_one_by_one(seed, d, args->run, out);
    }
    size_t most = 0;
    for (uint32_t restart = 0; restart < RESTARTS; restart++) {
        koksma__disks disks;
        const uint64_t own = restart ? koksma__random_seed(seed, restart, KOKSMA__PURPOSE_DART) : seed;
        koksma_status status = koksma__disks_init(&disks, own, d);
        status = status ? status : koksma__disks_fill(&disks, out->n, args->run);
        const bool done = !status && disks.n == out->n;
        if (done) {
            memcpy(out->xs, disks.xs, 2 * out->n * sizeof *out->xs);
        }
        most = disks.n > most ? disks.n : most;
        koksma__disks_fini(&disks);
        if (status || done) {
            return status;
        }
        if (restart >= 5 && (double)most < 0.97 * (double)out->n - 1) {
            break; /* after 6 tries that end far from n points, further tries would fail, too */
        }
    }
    return koksma__fail(KOKSMA_IMPOSSIBLE,
                        "dart-throwing: f=%g jams at %zu of %zu points; dart throwing reaches at most about f=%.2g",
                        f, most, out->n, out->n < 100 ? 0.7 : 0.76);
}

static const koksma_param params[] = {
    {"f", "smallest distance as a fraction of that of the densest packing", 0.75, 0.01, 1, NULL, false},
    {0},
};

const koksma_pattern koksma__pattern_dart_throwing = {
    .name = "dart-throwing",
    .title = "dart throwing on the torus, exactly n points",
    .cite = "mitchell1992 cook1986 ebeida2012",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_FRACTION | KOKSMA_CLAIM_BLUE | KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
};
