/* SPDX-License-Identifier: Apache-2.0 */
/*
 * gaussian-blue-noise: points that repel each other with Gaussian forces on the torus, by gradient descent from a
 * uniform start.
 *
 *     energy = sum over i != j of exp(-d_ij^2 / (2 s^2)),   s = sigma / sqrt n
 *
 * Source: Ahmed, Ren & Wonka 2022, in 2D. A step moves a point by step * (sum of unit-scaled forces), cut off at 5 s,
 * and by a part of its last move: 0.9 for the first 128 steps, which settle what is stiff, then 0.98, which speeds up
 * the slow rest five times (heavy ball, Polyak 1964). All points move at once: the order does not matter.
 *
 * With steps=0 the descent ends when the root mean square of the forces is below 2e-5 sigma^2 / sqrt n, about 1e-5 of
 * that of independent points, sqrt(pi) sigma^2 / sqrt n (the cut-off alone makes 1.1e-5), or has not fallen by a
 * tenth for 200 steps; after 400 steps at the least, for few points near a saddle feel next to nothing, and 2,000 at
 * the most. It is some 600 for 64 points and more at sigma 1, and up to 2,000 at sigma < 0.6.
 * Mean power below 0.75 sqrt n at n = 1024: 0.0015; 2,000 steps of 0.9 reach the same, and 400 of them 0.0090.
 *
 * What the cut leaves out, n integral_{5 s}^inf r exp(-r^2 / (2 s^2)) 2 pi r dr = 1.2e-4 sigma^2 s at the points'
 * mean density, is how far it could move a point if all of it pulled the same way. With few points, 5 s > 1/2, a
 * point acts from all of its places within 5 s: the torus is laid out in tiles x tiles copies, which are a torus,
 * too, and that one is wide enough for the shortest way to be the only one that counts.
 *
 * sigma: below 0.13 or so points don't reach far enough to be half the densest packing's distance apart; from about
 * 1.1 on those that are close feel nearly the same force, and many end as one (in 20 sets of 100 points the smallest
 * distance was 0.56 of the densest packing's at 1.05, 0.48 at 1.1, 0.36 at 1.15).
 */
#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/patterns.h"
#include "patterns/shared/fill.h"
#include "patterns/shared/torus_rows.h"

enum { BLOCK = 1024, STIFF_STEPS = 128, LEAST_STEPS = 400, MOST_STEPS = 2000, PATIENCE = 200 };

#define TOLERANCE 2e-5

typedef struct descent {
    koksma__torus_rows rows; /* of all copies; the width of all tiles is 1 */
    size_t n, copies;        /* points; of all tiles, those of the first before the others */
    double s, step, momentum, tiles, cut;
    double *squares; /* of the force on each point; NULL where no one asks */
    double least;    /* smallest sum of the squares so far, lowered only by improvements of 10 %; steps since then */
    int wait;
    double *xs, *moves;
    double *places; /* positions of all points in all tiles; equal to xs if there is one tile */
} descent;

static double wrap(double x)
{
    x -= floor(x);
    return x < 1 ? x : 0;
}

/* Points in the order of their cells, so that those near are in the cache. */
static koksma_status move_block(void *context, size_t block)
{
    const descent *d = context;
    const koksma__torus_rows *rows = &d->rows;
    const size_t end = (block + 1) * BLOCK < d->copies ? (block + 1) * BLOCK : d->copies;
    const double scale = -d->tiles * d->tiles / (2 * d->s * d->s);
    koksma__run_of_points *runs = malloc(koksma__torus_rows_most(rows, d->cut) * sizeof *runs);
    KOKSMA__REQUIRE_MEMORY(runs, koksma__torus_rows_most(rows, d->cut) * sizeof *runs);
    for (size_t at = block * BLOCK; at < end; at++) {
        const double x = rows->xs[at], y = rows->ys[at];
        const size_t i = rows->order[at];
        if (i >= d->n) {
            continue;
        }
        const size_t count = koksma__torus_rows_near(rows, x, y, d->cut, runs);
        double force[2];
        koksma__kernels()->gauss_force(count, &runs->first, rows->xs, rows->ys, x, y, scale, d->cut * d->cut, force);
        if (d->squares) {
            d->squares[i] = d->tiles * d->tiles * (force[0] * force[0] + force[1] * force[1]);
        }
        for (size_t k = 0; k < 2; k++) {
            d->moves[2 * i + k] = d->momentum * d->moves[2 * i + k] + d->step * (d->tiles * force[k]);
            d->xs[2 * i + k] = wrap(d->xs[2 * i + k] + d->moves[2 * i + k]);
        }
    }
    free(runs);
    return KOKSMA_OK;
}

static void lay_out(const descent *d)
{
    const size_t tiles = (size_t)d->tiles;
    for (size_t t = 0; t < tiles * tiles && tiles > 1; t++) {
        for (size_t i = 0; i < d->n; i++) {
            double *place = d->places + 2 * (t * d->n + i);
            place[0] = wrap((d->xs[2 * i] + (double)(t % tiles)) / d->tiles);
            place[1] = wrap((d->xs[2 * i + 1] + (double)(t / tiles)) / d->tiles);
        }
    }
}

/* The sum is in the order of the points: the same on any number of threads. */
static bool converged(descent *d)
{
    double sum = 0;
    for (size_t i = 0; i < d->n; i++) {
        sum += d->squares[i];
    }
    const double limit = TOLERANCE * d->s * d->s * (double)d->n; /* n squares of 1 / sqrt n */
    d->wait = sum < 0.81 * d->least ? 0 : d->wait + 1;
    d->least = d->wait ? d->least : sum;
    return sum <= limit * limit || d->wait >= PATIENCE;
}

static koksma_status descend(descent *d, int steps, const koksma_run *run)
{
    const size_t blocks = (d->copies + BLOCK - 1) / BLOCK;
    const koksma_run quiet = {.threads = koksma__threads(run)};
    koksma_status status = KOKSMA_OK;
    for (int t = 0; t < steps && !status; t++) {
        d->momentum = t < STIFF_STEPS ? 0.9 : 0.98;
        lay_out(d);
        koksma__torus_rows_sort(&d->rows, d->copies, d->places);
        status = blocks == 1 ? move_block(d, 0) : koksma__parallel(&quiet, blocks, move_block, d);
        if (!status && !koksma__keep_going(run, (double)t / steps)) {
            status = koksma__fail_interrupted();
        }
        if (d->squares && !status && converged(d) && t >= LEAST_STEPS) {
            break;
        }
    }
    return status;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const size_t n = out->n;
    descent d = {.n = n, .s = args->params[1] / sqrt((double)n), .step = args->params[2], .xs = out->xs};
    d.tiles = fmax(ceil(10 * d.s), 1);
    d.cut = 5 * d.s / d.tiles;
    d.copies = n * (size_t)(d.tiles * d.tiles);
    const int steps = (int)args->params[0];
    const size_t numbers = 3 * n + (d.tiles > 1 ? 2 * d.copies : 0);
    d.moves = calloc(numbers, sizeof *d.moves);
    KOKSMA__REQUIRE_MEMORY(d.moves, numbers * sizeof *d.moves);
    d.least = INFINITY;
    d.squares = steps ? NULL : d.moves + 2 * n;
    d.places = d.tiles > 1 ? d.moves + 3 * n : d.xs;
    koksma_status status = koksma__torus_rows_init(&d.rows, d.copies);
    if (!status) {
        status = koksma__fill_uniform(seed, KOKSMA__PURPOSE_POINT, args->run, 2 * n, out->xs);
    }
    status = status ? status : descend(&d, steps ? steps : MOST_STEPS, args->run);
    koksma__torus_rows_fini(&d.rows);
    free(d.moves);
    return status;
}

static const koksma_param params[] = {
    {"steps", "of the descent; 0: until it has converged, 2000 at most", 0, 0, 100000, NULL, true},
    {"sigma", "of the Gaussian, in units of 1/sqrt n", 1, 0.15, 1.05, NULL, false},
    {"step", "how far a point follows its force", 0.4, 0.001, 1, NULL, false},
    {0},
};

const koksma_pattern koksma__pattern_gaussian_blue_noise = {
    .name = "gaussian-blue-noise",
    .title = "points that repel each other with Gaussian forces",
    .cite = "ahmed2022 polyak1964",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_BLUE | KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
};
