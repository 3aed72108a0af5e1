/* SPDX-License-Identifier: Apache-2.0 */
/*
 * gaussian-blue-noise: points that repel each other with Gaussian forces on the torus, by gradient descent from a
 * uniform start.
 *
 *     energy = sum over i != j of exp(-d_ij^2 / (2 s^2)),   s = sigma / sqrt n
 *
 * Source: Ahmed, Ren & Wonka 2022, in 2D. A step moves a point by step * (sum of unit-scaled forces), cut off at 5 s,
 * and by 0.9 of its last move (heavy ball, Polyak 1964: without it ten times as many steps are needed); the number of
 * steps is fixed, so it always ends. All points move at once: the order does not matter.
 *
 * What the cut leaves out, n integral_{5 s}^inf r exp(-r^2 / (2 s^2)) 2 pi r dr = 1.2e-4 sigma^2 s at the points'
 * mean density, is how far it could move a point if all of it pulled the same way. With few points, 5 s > 1/2, the
 * cut is at 1/2: a point acts from one of its places on the torus.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "patterns/parts/fill.h"
#include "patterns/parts/torus_grid.h"
#include "patterns/patterns.h"

enum { BLOCK = 1024 };

#define MOMENTUM 0.9

typedef struct descent {
    koksma__torus_grid grid;
    size_t n;
    double s, step;
    double *next, *moves;
} descent;

typedef struct force {
    const descent *d;
    uint32_t self;
    double x, y;
} force;

static void push(void *context, uint32_t point, double dx, double dy)
{
    force *f = context;
    const double s = f->d->s, w = point == f->self ? 0 : koksma__exp(-(dx * dx + dy * dy) / (2 * s * s));
    f->x -= w * dx;
    f->y -= w * dy;
}

static double wrap(double x)
{
    x -= floor(x);
    return x < 1 ? x : 0;
}

static koksma_status move_block(void *context, size_t block)
{
    const descent *d = context;
    const size_t end = (block + 1) * BLOCK < d->n ? (block + 1) * BLOCK : d->n;
    for (size_t i = block * BLOCK; i < end; i++) {
        force f = {.d = d, .self = (uint32_t)i};
        const double *x = d->grid.xs + 2 * i;
        koksma__torus_grid_each(&d->grid, x[0], x[1], fmin(5 * d->s, 0.5), push, &f);
        double *move = d->moves + 2 * i;
        move[0] = MOMENTUM * move[0] + d->step * f.x;
        move[1] = MOMENTUM * move[1] + d->step * f.y;
        d->next[2 * i] = wrap(x[0] + move[0]);
        d->next[2 * i + 1] = wrap(x[1] + move[1]);
    }
    return KOKSMA_OK;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const size_t bytes = 2 * out->n * sizeof *out->xs;
    descent d = {.n = out->n, .s = args->params[1] / sqrt((double)out->n), .step = args->params[2]};
    koksma_status status = koksma__fill_uniform(seed, KOKSMA__PURPOSE_POINT, args->run, 2 * out->n, out->xs);
    d.next = calloc(2, bytes);
    if (!d.next) {
        return koksma__fail_memory(2 * bytes);
    }
    d.moves = d.next + 2 * out->n;
    if (!status) {
        status = koksma__torus_grid_init(&d.grid, out->n, out->xs);
    }
    const int steps = (int)args->params[0];
    for (int t = 0; t < steps && !status; t++) {
        koksma__torus_grid_clear(&d.grid);
        for (size_t i = 0; i < out->n; i++) {
            koksma__torus_grid_add(&d.grid, (uint32_t)i);
        }
        const size_t blocks = (out->n + BLOCK - 1) / BLOCK;
        const koksma_run quiet = {.threads = koksma__threads(args->run)};
        status = blocks == 1 ? move_block(&d, 0) : koksma__parallel(&quiet, blocks, move_block, &d);
        memcpy(out->xs, d.next, bytes);
        if (!status && !koksma__keep_going(args->run, (double)t / steps)) {
            status = koksma__fail_interrupted();
        }
    }
    koksma__torus_grid_fini(&d.grid);
    free(d.next);
    return status;
}

static const koksma_param params[] = {
    {"steps", "of the descent", 400, 0, 100000, NULL, true},
    {"sigma", "of the Gaussian, in units of 1/sqrt n", 1, 0.1, 3, NULL, false},
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
