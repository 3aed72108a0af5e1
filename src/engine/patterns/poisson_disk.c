/* SPDX-License-Identifier: Apache-2.0 */
/*
 * poisson-disk: random points are tried one after the other; a point closer than d to an earlier one is rejected.
 * With torus=1 the distance is that of the torus, so that copies of the set tile the plane.
 *
 *     x_i = the first of u_1, u_2, .. uniform in [0,1)^dim with |u - x_j| >= d for all j < i
 *
 * Source: Shirley 1991, section 5.5.4 (dart throwing in the square, d = 0.1 and 0.2 for 16 points); Cook 1986.
 * Without torus=1 points crowd at the sides, where darts have fewer neighbours: 16 points with d = 0.2 have 1.40 times
 * the mean density in the outer tenths of a coordinate, and .9 times inside. A mean over the square is therefore
 * biased, and for the integrand `checker` the points are no better than jittered ones. The default is Shirley's square
 * without wraparound; torus=1 is recommended: the torus has no sides, and each point is uniform.
 *
 * The set consists of the first n darts that fit. After 3,000 rejections in a row the search restarts with an empty
 * set, and after 200 restarts it fails: the error message then gives the largest d that any n points can have. Dart
 * throwing jams at about 0.77 of that d on the torus. In the plane, a grid of cells finds the points near a dart if n
 * > 256, which does not change the result; in other dimensions a dart is compared with all points. The search also
 * fails after comparing 2^34 + 4096 n coordinates in all restarts together, about 20 s: enough for 65,536 points in 5
 * dimensions if few darts are rejected. The error message then gives the number of points placed.
 */
#include <math.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "patterns/patterns.h"
#include "patterns/spacing/spacing.h"

enum { REJECTIONS = 3000, RESTARTS = 200, FEW = 256, LOOKS = 1 << 24 };

/* The state of a search and the work that it has done. */
typedef struct search {
    bool torus, stopped;
    uint64_t work, asked, most; /* number of coordinates compared: so far, at the last check of `run`, and the limit
                                   */
} search;

/* Returns the fraction of the upper bound on the distance that dart throwing reached in every test with 3 to 300
   points. With few points in many dimensions the bound is far above what any set can reach, especially in the cube.
   */
static double reached(int dim, bool torus)
{
    static const double cube[] = {0.7, 0.7, 0.4, 0.3, 0.3, 0.2, 0.2, 0.2},
                        tiles[] = {0.7, 0.7, 0.65, 0.65, 0.65, 0.6, 0.6, 0.6};
    return torus ? tiles[dim - 1] : cube[dim - 1];
}

static bool fits(const koksma_points *out, size_t placed, const double *dart, double d2, search *s)
{
    size_t i = 0;
    bool room = true;
    for (; i < placed && room; i++) {
        double sum = 0;
        for (int k = 0; k < out->dim; k++) {
            double t = fabs(dart[k] - out->xs[i * (size_t)out->dim + (size_t)k]);
            t = s->torus && t > 0.5 ? 1 - t : t;
            sum += t * t;
        }
        room = sum >= d2;
    }
    s->work += i * (uint64_t)out->dim;
    return room;
}

/* Returns whether the search may go on; every LOOKS comparisons it reports progress to `run` and checks whether to
   stop. */
static bool may_go_on(search *s, double done, const koksma_run *run)
{
    s->work += 64; /* the work of drawing a dart and of checking its neighbours in the grid */
    if (s->work - s->asked >= LOOKS) {
        s->asked = s->work;
        s->stopped = !koksma__keep_going(run, done);
    }
    return !s->stopped && s->work < s->most;
}

/* Throws darts until all points are placed, too many darts in a row are rejected, the work limit is reached or `run`
   stops the search; returns the number of points placed. The grid, if any, must be empty. */
static size_t throw_darts(uint64_t seed, double d, koksma__torus_grid *grid, const koksma_run *run, search *s,
                          koksma_points *out)
{
    size_t placed = 0, dart_number = 0;
    for (int rejections = 0; placed < out->n && rejections < REJECTIONS; dart_number++) {
        double dart[8];
        for (int k = 0; k < out->dim; k += 2) {
            koksma__random_pair(seed, KOKSMA__PURPOSE_DART, dart_number, (uint32_t)k / 2, dart + k);
        }
        if (!may_go_on(s, (double)placed / (double)out->n, run)) {
            return placed;
        }
        if (grid ? koksma__torus_grid_near(grid, dart[0], dart[1], d, s->torus)
                 : !fits(out, placed, dart, d * d, s)) {
            rejections++;
            continue;
        }
        rejections = 0;
        for (int k = 0; k < out->dim; k++) {
            out->xs[placed * (size_t)out->dim + (size_t)k] = dart[k];
        }
        if (grid) {
            koksma__torus_grid_add(grid, (uint32_t)placed);
        }
        placed++;
    }
    return placed;
}

/* Restarts dart throwing until all points are placed or the limits are reached. */
static koksma_status throw_until(uint64_t seed, const koksma_args *args, koksma__torus_grid *grid, koksma_points *out)
{
    const double d = args->params[0];
    const bool torus = args->params[1] != 0;
    const double limit = koksma__packing_distance(out->n, out->dim, torus);
    search s = {.torus = torus, .most = ((uint64_t)1 << 34) + 4096 * (uint64_t)out->n};
    size_t most = 0;
    for (uint32_t restart = 0; restart < RESTARTS; restart++) {
        const uint64_t own = restart ? koksma__random_seed(seed, restart, KOKSMA__PURPOSE_DART) : seed;
        if (grid) {
            koksma__torus_grid_clear(grid);
        }
        const size_t placed = throw_darts(own, d, grid, args->run, &s, out);
        if (placed == out->n) {
            return KOKSMA_OK;
        }
        if (s.stopped || !koksma__keep_going(args->run, 0)) {
            return koksma__fail_interrupted();
        }
        most = placed > most ? placed : most;
        KOKSMA__FAIL_IF(s.work >= s.most, KOKSMA_IMPOSSIBLE,
                        "poisson-disk: dart throwing placed %zu of %zu points at d=%g in dim %d within its limit of "
                        "work; n = %zu or less, or a smaller d, would do",
                        most, out->n, d, out->dim, most);
        if (restart >= 5 && most < out->n * 9 / 10) {
            break; /* after 6 tries that end far from n points, further tries would fail, too */
        }
    }
    return koksma__fail(KOKSMA_IMPOSSIBLE,
                        "poisson-disk: dart throwing placed %zu of %zu points at d=%g and jammed; no d above %.4f is "
                        "possible, and dart throwing reaches about %.3g",
                        most, out->n, d, limit, reached(out->dim, torus) * limit);
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const double d = args->params[0];
    const bool torus = args->params[1] != 0;
    const double limit = koksma__packing_distance(out->n, out->dim, torus);
    KOKSMA__FAIL_IF(d > limit, KOKSMA_IMPOSSIBLE,
                    "poisson-disk: no %zu points in dim %d are d=%g apart; no d above %.4f is possible, and dart "
                    "throwing reaches about %.3g",
                    out->n, out->dim, d, limit, reached(out->dim, torus) * limit);
    koksma__torus_grid grid = {0};
    const bool gridded = out->dim == 2 && out->n > FEW;
    koksma_status status = gridded ? koksma__torus_grid_init(&grid, out->n, out->xs) : KOKSMA_OK;
    status = status ? status : throw_until(seed, args, gridded ? &grid : NULL, out);
    koksma__torus_grid_fini(&grid);
    return status;
}

static const koksma_param params[] = {
    {"d", "smallest distance between two points", 0.1, 0, 1e9, NULL, false},
    {"torus", "1: measure distances on the torus; 0: in the cube, where points crowd at the sides", 0, 0, 1, NULL,
     true},
    {0},
};

const koksma_pattern koksma__pattern_poisson_disk = {
    .name = "poisson-disk",
    .title = "dart throwing with a smallest distance; use torus=1 for an even density",
    .cite = "cook1986 shirley1991",
    .min_dim = 1,
    .max_dim = 8,
    .claims = KOKSMA_CLAIM_MIN_DISTANCE,
    .params = params,
    .generate = generate,
};
