/* SPDX-License-Identifier: Apache-2.0 */
/*
 * gaussian-blue-noise: points that repel each other with Gaussian forces on the torus, by gradient descent from a
 * uniform start.
 *
 *     energy = sum over i != j of exp(-d_ij^2 / (2 s^2)),   s = sigma / sqrt n
 *
 * Source: Ahmed, Ren & Wonka 2022. In 3 and 4 dimensions s = sigma n^(-1/dim), in 5 and 6 dimensions s = 0.8 sigma
 * n^(-1/dim), and shared/space_forces.c computes the forces. With s = n^(-1/dim) the smallest distance of 200 points in
 * 6 dimensions was 1.5 times that of random points, and the mean power below n^(1/dim) 0.34; now they are 2.2 times and
 * 0.002. The rest of this comment describes the plane. A step moves a point by step * (sum of forces in units of s),
 * where forces beyond the distance 5 s are ignored, and by a fraction of its last move (the momentum of the heavy
 * ball method, Polyak 1964). This fraction is 0.9 for the first 128 steps, in which the stiff modes converge, and
 * then 0.98, with which the slow modes converge five times faster. All points move simultaneously, so that their
 * order does not matter.
 *
 * With steps=0 the descent ends when the root mean square of the forces is below 2e-5 sigma^2 / sqrt n, or when it
 * has not decreased by 10 % within 200 steps. This limit is 1.13e-5 times the root mean square of the forces between
 * independent random points, which is sqrt(pi) sigma^2 / sqrt n. A smaller limit would gain nothing: the forces that
 * the cut-off leaves out of a converged set are 1.5e-5 times this root mean square (sigma = 1, n = 1024 and 4096).
 * The descent takes at least 400 steps, because a few points near a saddle feel almost no force, and at most 2,000.
 * At sigma = 1 it takes about 600 steps for 64 and more points, and at sigma < 0.6 up to 2,000. At n = 1024 the mean
 * power at frequencies below 0.75 sqrt n is 0.0015; with a constant momentum of 0.9 this power is the same after
 * 2,000 steps, but 0.0090 after 400.
 *
 * If all forces beyond the cut-off had the same direction, at the mean density of the points their sum would be n
 * integral_{5 s}^inf r exp(-r^2 / (2 s^2)) 2 pi r dr = 1.2e-4 sigma^2 s. This sum bounds the error of a move. With
 * few points, where 5 s > 1/2, several periodic images of a point are within 5 s and all exert forces. The torus is
 * then repeated in tiles x tiles copies, which form a torus so large that only the nearest image of a point is within
 * the cut-off.
 *
 * Limits of sigma: below about 0.13 the forces are too short to push points apart to half the distance of the densest
 * packing; from about 1.1 on, points that are close together feel nearly the same force, and many end at the same
 * position (in 20 sets of 100 points the smallest distance, divided by that of the densest packing, was 0.56 at sigma
 * = 1.05, 0.48 at 1.1 and 0.36 at 1.15).
 *
 * With order=progressive the finished set is put into Yuksel's progressive order (2015; spacing/elimination.c): the
 * points are the same, and every prefix is blue noise, too. The plain order is random.
 */
#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "core/torus_rows.h"
#include "kernels/kernels.h"
#include "patterns/grids/grids.h"
#include "patterns/patterns.h"
#include "patterns/spacing/spacing.h"

enum { BLOCK = 1024, BLOCK_IN_SPACE = 64, STIFF_STEPS = 128, LEAST_STEPS = 400, MOST_STEPS = 2000, PATIENCE = 200 };

enum { MOST_PAIRED = 20000 };

#define TOLERANCE 2e-5
#define NARROW 0.8 /* s over sigma n^(-1/dim) from 5 dimensions on */

typedef struct descent {
    int dim;
    koksma__space_forces forces; /* used in more than 2 dimensions; rows, tiles, copies and places are used in the
                                    plane */
    koksma__torus_rows rows;     /* sorted positions of all copies; all tiles together have the width 1 */
    size_t n, copies; /* number of points in one tile, and in all tiles; the points of the first tile come first */
    double s, step, momentum, tiles, cut;
    double limit;    /* limit of the square root of the sum of squared forces */
    double *squares; /* squared force on each point; NULL if the number of steps is fixed, because the forces then
                        need no test */
    double least;    /* smallest sum of squares so far; it is replaced only when the root mean square has decreased by
                     10 % */
    int wait;        /* number of steps since `least` was replaced */
    double *xs, *moves;
    double *places; /* positions of all points in all tiles; equal to xs if there is one tile */
} descent;

static double wrap(double x)
{
    x -= floor(x);
    return x < 1 ? x : 0;
}

/* Moves one block of points in more dimensions than 2. */
static koksma_status move_block_in_space(void *context, size_t block)
{
    const descent *d = context;
    const size_t dim = (size_t)d->dim, end = (block + 1) * BLOCK_IN_SPACE;
    for (size_t at = block * BLOCK_IN_SPACE; at < end && at < d->n; at++) {
        const size_t i = d->forces.order[at];
        double force[KOKSMA__FORCE_DIMS], square = 0;
        koksma__space_force(&d->forces, at, force);
        for (size_t k = 0; k < dim; k++) {
            square += force[k] * force[k];
            d->moves[i * dim + k] = d->momentum * d->moves[i * dim + k] + d->step * force[k];
            d->xs[i * dim + k] = wrap(d->xs[i * dim + k] + d->moves[i * dim + k]);
        }
        if (d->squares) {
            d->squares[i] = square;
        }
    }
    return KOKSMA_OK;
}

/* Moves one block of points. Points are visited in the order of their cells, so that neighbours are in the cache. */
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

/* Returns whether the descent may end. The squares are summed in the order of the points, so that the result does not
   depend on the number of threads. */
static bool converged(descent *d)
{
    double sum = 0;
    for (size_t i = 0; i < d->n; i++) {
        sum += d->squares[i];
    }
    d->wait = sum < 0.81 * d->least ? 0 : d->wait + 1;
    d->least = d->wait ? d->least : sum;
    return sum <= d->limit * d->limit || d->wait >= PATIENCE;
}

static koksma_status descend(descent *d, int steps, const koksma_run *run)
{
    const bool plane = d->dim == 2;
    const size_t blocks = plane ? (d->copies + BLOCK - 1) / BLOCK : (d->n + BLOCK_IN_SPACE - 1) / BLOCK_IN_SPACE;
    const koksma__block_function move = plane ? move_block : move_block_in_space;
    koksma__phases phases = {0};
    koksma_status status = KOKSMA_OK;
    for (int t = 0; t < steps && !status; t++) {
        d->momentum = t < STIFF_STEPS ? 0.9 : 0.98;
        if (plane) {
            lay_out(d);
            koksma__torus_rows_sort(&d->rows, d->copies, d->places, true);
        } else {
            koksma__space_forces_sort(&d->forces, d->xs);
        }
        const koksma_run step = koksma__phase_run(&phases, run, 1.0 / steps);
        status = blocks == 1 ? move(d, 0) : koksma__parallel(&step, blocks, move, d);
        if (!status && !koksma__keep_going(&step, 1)) {
            status = koksma__fail_interrupted();
        }
        if (d->squares && !status && converged(d) && t >= LEAST_STEPS) {
            break;
        }
    }
    return status;
}

/* The descent stops at 1.13e-5 times the root mean square of the forces between independent random points, which is s
   sqrt(dim/2) pi^(dim/4) sigma^(dim/2). The stiffness of a crystal grows as (2 pi)^(dim/2); the step is therefore
   divided by this number, relative to its value in the plane. */
static koksma_status generate_in_space(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const size_t n = out->n, numbers = n * (size_t)out->dim;
    const double sigma = args->params[1] * (out->dim > 4 ? NARROW : 1);
    const int steps = (int)args->params[0];
    descent d = {.dim = out->dim, .n = n, .s = sigma * koksma__pow((double)n, -1.0 / out->dim), .xs = out->xs};
    KOKSMA__FAIL_IF(d.s > 0.1 && n > MOST_PAIRED, KOKSMA_N,
                    "gaussian-blue-noise: n = %zu is too large in dim %d, where all pairs of points act; n = %d or "
                    "less would do",
                    n, d.dim, MOST_PAIRED);
    d.step = args->params[2] / koksma__pow(2 * M_PI, 0.5 * d.dim - 1);
    d.limit = TOLERANCE / sqrt(M_PI) * d.s * sqrt(0.5 * d.dim) * koksma__pow(M_PI, 0.25 * d.dim) *
              koksma__pow(sigma, 0.5 * d.dim) * sqrt((double)n);
    d.least = INFINITY;
    d.moves = calloc(numbers + n, sizeof *d.moves);
    KOKSMA__REQUIRE_MEMORY(d.moves, (numbers + n) * sizeof *d.moves);
    d.squares = steps ? NULL : d.moves + numbers;
    koksma_status status = koksma__space_forces_init(&d.forces, n, d.dim, d.s);
    status = status ? status : koksma__fill_uniform(seed, KOKSMA__PURPOSE_POINT, args->run, numbers, out->xs);
    status = status ? status : descend(&d, steps ? steps : MOST_STEPS, args->run);
    koksma__space_forces_fini(&d.forces);
    free(d.moves);
    return status;
}

static koksma_status generate_in_plane(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const size_t n = out->n;
    descent d = {.dim = 2, .n = n, .s = args->params[1] / sqrt((double)n), .step = args->params[2], .xs = out->xs};
    d.limit = TOLERANCE * d.s * d.s * (double)n; /* limit of the square root of the sum (not the mean) of the n
                                                    squared forces */
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
    koksma_status status = koksma__torus_rows_init(&d.rows, d.copies, (size_t)ceil(sqrt((double)d.copies)));
    status = status ? status : koksma__fill_uniform(seed, KOKSMA__PURPOSE_POINT, args->run, 2 * n, out->xs);
    status = status ? status : descend(&d, steps ? steps : MOST_STEPS, args->run);
    koksma__torus_rows_fini(&d.rows);
    free(d.moves);
    return status;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const koksma_status status =
        out->dim > 2 ? generate_in_space(seed, args, out) : generate_in_plane(seed, args, out);
    return status || !(args->params[3] > 0) ? status : koksma__order_progressively(args->run, out);
}

static const char *const orders[] = {"plain", "progressive", NULL};

static const koksma_param params[] = {
    {"steps", "number of steps of the descent; 0: until it has converged, at most 2000", 0, 0, 100000, NULL, true},
    {"sigma",
     "standard deviation of the Gaussian in units of n^(-1/dim) (1/sqrt n in 2D), from 5D on of 0.8 n^(-1/dim)", 1,
     0.15, 1.05, NULL, false},
    {"step", "distance that a point moves per unit of force", 0.4, 0.001, 1, NULL, false},
    {"order", "order of the points: plain, or progressive (every prefix is blue noise, too)", 0, 0, 1, orders, true},
    {0},
};

const koksma_pattern koksma__pattern_gaussian_blue_noise = {
    .name = "gaussian-blue-noise",
    .title = "points that repel each other with Gaussian forces",
    .cite = "ahmed2022 polyak1964 yuksel2015",
    .min_dim = 2,
    .max_dim = KOKSMA__FORCE_DIMS,
    .claims = KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_BLUE | KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
    .revision = 2, /* own elementary functions */
};
