/* SPDX-License-Identifier: Apache-2.0 */
/*
 * star-space: minimises the star discrepancy in three dimensions, by descent on the sum of squared excesses over a
 * target f,
 *
 *     E = sum over corners (X_i, Y_j, Z_k) of max(0, c - n X_i Y_j Z_k - n f)^2 + max(0, n X_i Y_j Z_k - o - n f)^2,
 *
 * where c and o are the numbers of points in the closed and in the open box of the corner, and X, Y and Z are the
 * sorted coordinates of the points, followed by 1. For fixed ranks the counts are fixed, and the coordinates with E = 0
 * form a convex set in log X, log Y, log Z. Coordinates with E = 0 have a star discrepancy of at most f; once they
 * are found, a slightly lower target is tried, until a target is not reached.
 *
 * A vectorised pass over all corners (far_corners) gives the star discrepancy and a list of the corners whose local
 * discrepancy is near it. L-BFGS uses only the listed corners, about 1 % of all corners, and ignores changes of
 * ranks; the next pass checks the result. A search begins with a descent from near the best set. Three of four searches
 * walk on from there. The other searches then walk from the best of DRAWS sets of points {i a + s} (fractional parts);
 * a new walk starts after STALE kicks (random changes) without a gain. A kick exchanges a coordinate of two points so
 * that a listed box with too many points loses one, or a box with too few gains one, because no other exchange can help;
 * one kick in five (with keep=net every kick) replaces a point by a random one. The walk accepts the result of a
 * descent if its star discrepancy exceeds that of the walk's current set by at most a threshold.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "measures/measures.h"
#include "measures/shared/shared.h"
#include "optimise/search.h"

enum { MAX_N = 1024, ITERATIONS = 20, DRAWS = 16, STALE = 60, CAPACITY = 1 << 18, LANES = 32 };

/* A corner. at[k]: the point with the same coordinate k (n: none, the coordinate is 1). count: the number of points in
   its box. sign: 1 for the closed box, which may have too many points; -1 for the open box, which may have too few.
   difference: n times its local discrepancy when it was listed. */
typedef struct corner {
    uint16_t at[3];
    int16_t count, sign;
    float difference;
} corner;

typedef struct job {
    size_t n, stride; /* stride: length of a row of counts in memory */
    double target;
    uint32_t *order, *found; /* order: the points sorted along each axis, followed by their ranks along each axis */
    double *low, *x;         /* x: for each axis the sorted coordinates, followed by 1 */
    float *z;                /* the sorted coordinates along the third axis, followed by 1 and by zeros */
    int16_t *open, *closed;  /* for the current i: numbers of points with rank below i (closed: at most i) by x and
                                ranks below j and k by y and z */
    double value;            /* of the best set of the search so far, which is in `result` */
    koksma_points *result;
    corner *corners, *kept; /* kept: the corners listed for the walk's current set */
    size_t listed, n_kept;
    void *memory;
} job;

static koksma_status job_init(job *j, size_t n)
{
    const size_t stride = (n + 1 + LANES - 1) / LANES * LANES + LANES, matrix = (n + 2) * stride;
    const size_t bytes = 3 * (2 * n + 1) * sizeof(double) + 2 * CAPACITY * sizeof(corner) + stride * sizeof(float) +
                         (6 * n + stride + 1) * sizeof(uint32_t) + 2 * matrix * sizeof(int16_t);
    *j = (job){.n = n, .stride = stride, .memory = calloc(1, bytes)};
    KOKSMA__REQUIRE_MEMORY(j->memory, bytes);
    j->low = j->memory;
    j->x = j->low + 3 * n;
    j->z = (float *)(j->x + 3 * (n + 1));
    j->order = (uint32_t *)(j->z + stride);
    j->found = j->order + 6 * n;
    j->corners = (corner *)(j->found + stride + 1);
    j->kept = j->corners + CAPACITY;
    j->open = (int16_t *)(j->kept + CAPACITY);
    j->closed = j->open + matrix;
    return KOKSMA_OK;
}

/* Adds the i-th point, in increasing order of x, to the counts. */
static void count(const job *j, size_t i, int16_t *counts)
{
    const size_t n = j->n, point = j->order[i];
    const uint32_t *rank = j->order + 3 * n;
    for (size_t b = rank[n + point] + 1; b < n + 2; b++) {
        for (size_t c = rank[2 * n + point] + 1; c < n + 2; c++) {
            counts[b * j->stride + c]++;
        }
    }
}

static koksma_status sort(job *j, const double *xs)
{
    const size_t n = j->n;
    const koksma_run one_thread = {.threads = 1};
    for (size_t k = 0; k < 3; k++) {
        uint32_t *order = j->order + k * n;
        const koksma_status status = koksma__order(&one_thread, n, xs + k, 3, order);
        if (status) {
            return status;
        }
        for (size_t i = 0; i < n; i++) {
            j->x[k * (n + 1) + i] = xs[3 * order[i] + k];
            j->order[(3 + k) * n + order[i]] = (uint32_t)i;
        }
        j->x[k * (n + 1) + n] = 1;
    }
    for (size_t i = 0; i <= n; i++) {
        j->z[i] = (float)j->x[2 * (n + 1) + i];
    }
    return KOKSMA_OK;
}

/* Raises the limit until a quarter of the full list is free, and removes the corners that are not above it. */
static void thin(job *j, double *limit)
{
    while (j->listed > CAPACITY / 4 * 3) {
        size_t left = 0;
        *limit *= 1.02;
        for (size_t l = 0; l < j->listed; l++) {
            j->corners[left] = j->corners[l];
            left += (double)j->corners[l].difference > *limit;
        }
        j->listed = left;
    }
}

/* Lists those corners (X_i, Y_b, any Z) whose local discrepancy times n is above *limit, and raises *largest to the
   largest such product. The limit is raised if the list is full. */
static void list_row(job *j, size_t i, size_t b, int16_t sign, double *limit, double *largest)
{
    const size_t n = j->n, columns = (n + 1 + LANES - 1) / LANES * LANES;
    const int16_t *counts = sign > 0 ? j->closed + (b + 1) * j->stride + 1 : j->open + b * j->stride;
    const double area = (double)n * j->x[i] * j->x[n + 1 + b];
    const float rounding = (float)n * 0x1p-21F;
    const size_t found = koksma__kernels()->far_corners(columns, counts, j->z, sign, (float)(sign * area),
                                                        fmaxf(0, (float)*limit - rounding), j->found);
    for (size_t f = 0; f < found; f++) {
        const size_t c = j->found[f];
        const double difference = sign * (counts[c] - area * j->x[2 * (n + 1) + c]);
        *largest = fmax(*largest, difference);
        if (j->listed == CAPACITY) {
            thin(j, limit);
        }
        j->corners[j->listed++] =
            (corner){{(uint16_t)(i < n ? j->order[i] : n), (uint16_t)(b < n ? j->order[n + b] : n),
                      (uint16_t)(c < n ? j->order[2 * n + c] : n)},
                     counts[c],
                     sign,
                     (float)difference};
    }
}

/* Lists the corners whose local discrepancy is above `limit`; *value receives the largest local discrepancy. The limit
   is raised during the pass if there are too many corners; if there are none, another pass is made with half of it. */
static koksma_status list(job *j, koksma__descent *d, double limit, double *value)
{
    const size_t n = j->n;
    const koksma_status status = sort(j, d->points.xs);
    *value = 0;
    j->listed = 0;
    for (limit *= (double)n; !status && j->listed == 0; limit *= 0.5) {
        memset(j->open, 0, 2 * (n + 2) * j->stride * sizeof(int16_t));
        *value = 0;
        for (size_t i = 0; i <= n; i++) {
            KOKSMA__TRY(koksma__ask(d->run));
            if (i > 0) {
                count(j, i - 1, j->open);
            }
            if (i < n) {
                count(j, i, j->closed);
            }
            for (size_t b = 0; b <= n; b++) {
                list_row(j, i, b, 1, &limit, value);
                list_row(j, i, b, -1, &limit, value);
            }
        }
        d->work += koksma__pow((double)n + 1, 3) / 12 + (double)j->listed;
    }
    *value /= (double)n;
    d->cost = 100 + 2 * (double)n + (double)j->listed / 2;
    return status;
}

/* Returns whether a point is inside a corner's box along all axes except the axis `but`. */
static bool inside(const job *j, const corner *at, const double *xs, size_t point, size_t but)
{
    bool in = true;
    for (size_t k = 0; k < 3; k++) {
        const double side = at->at[k] < j->n ? xs[3 * at->at[k] + k] : 1;
        in = in && (k == but || xs[3 * point + k] < side || (at->sign > 0 && xs[3 * point + k] == side));
    }
    return in;
}

/* Computes E, summed over the listed corners, and its derivatives. */
static koksma_status excesses(const void *context, const koksma_points *points, double *value, double *gradient)
{
    const job *j = context;
    const size_t n = j->n;
    const double *xs = points->xs, share = (double)n, limit = share * j->target;
    static const double sides[3] = {1, 1, 1};
    double sum = 0, unused[3];
    memset(gradient, 0, 3 * n * sizeof *gradient);
    for (size_t l = 0; l < j->listed; l++) {
        const corner c = j->corners[l];
        const double *x = c.at[0] < n ? xs + 3 * c.at[0] : sides, *y = c.at[1] < n ? xs + 3 * c.at[1] : sides,
                     *z = c.at[2] < n ? xs + 3 * c.at[2] : sides;
        const double e = c.sign * (c.count - share * x[0] * y[1] * z[2]) - limit;
        if (e > 0) {
            const double slope = -2 * c.sign * share * e;
            sum += e * e;
            *(c.at[0] < n ? gradient + 3 * c.at[0] : unused) += slope * y[1] * z[2];
            *(c.at[1] < n ? gradient + 3 * c.at[1] + 1 : unused) += slope * x[0] * z[2];
            *(c.at[2] < n ? gradient + 3 * c.at[2] + 2 : unused) += slope * x[0] * y[1];
        }
    }
    *value = sum;
    return KOKSMA_OK;
}

/* Exchanges a coordinate of a point on the border of a corner's box with that of a near point that is outside of the
   box along another axis. The box thus loses the point on its border if it has too many points, or gains it if it has
   too few. */
static void exchange(const job *j, double *xs, koksma__stream *random)
{
    const corner *at = &j->kept[koksma__next_below(random, j->n_kept)];
    const size_t k = koksma__next_below(random, 3), point = at->at[k];
    size_t skipped = koksma__next_below(random, 3);
    double near = at->sign > 0 ? 2 : -1, from = point < j->n ? xs[3 * point + k] : 0;
    for (size_t nearest = j->n; point<j->n; from = near, near = at->sign> 0 ? 2 : -1, nearest = j->n) {
        for (size_t p = 0; p < j->n; p++) {
            const double x = xs[3 * p + k];
            if ((at->sign > 0 ? x > from && x < near : x < from && x > near) && !inside(j, at, xs, p, k)) {
                near = x;
                nearest = p;
            }
        }
        if (nearest == j->n) {
            return;
        }
        if (skipped-- == 0) {
            xs[3 * nearest + k] = xs[3 * point + k];
            xs[3 * point + k] = near;
            return;
        }
    }
}

static void kick(const job *j, koksma__descent *d, koksma_keep keep, koksma__stream *random)
{
    if (keep == KOKSMA_KEEP_NONE && koksma__next_unit(random) < 0.8) {
        exchange(j, d->points.xs, random);
        return;
    }
    const size_t first = 3 * koksma__next_below(random, d->points.n);
    for (size_t c = first; c < first + 3; c++) {
        d->points.xs[c] = d->low[c] + d->length * koksma__next_unit(random);
    }
}

/* Draws DRAWS sets, and leaves the one with the least value in d->points. */
static koksma_status start(job *j, koksma__descent *d, const koksma_points *points, koksma_keep keep, double *best,
                           double value, koksma__stream *random)
{
    double least = HUGE_VAL, found;
    koksma_status status = KOKSMA_OK;
    for (int draw = 0; draw < DRAWS && !status; draw++) {
        if (keep == KOKSMA_KEEP_NONE) {
            koksma__descent_kronecker(d, random);
        } else {
            status = koksma__descent_start(d, points, keep, random);
        }
        status = status ? status : list(j, d, value, &found);
        if (!status && found < least) {
            least = found;
            memcpy(best, d->points.xs, d->count * sizeof(double));
        }
    }
    memcpy(d->points.xs, best, d->count * sizeof(double));
    return status;
}

/* Descends with each coordinate confined to an interval of length 2 r about its present value, where r is the
   difference between the value and the target. (An interval that would leave the coordinate's range is shifted.) Most
   corners that are not listed then stay below the target: their local discrepancies are at least about r below it, and
   moving one coordinate by r raises a local discrepancy by at most r. The next pass over all corners finds those that
   rise above the target. */
static koksma_status descend_near(job *j, koksma__descent *d, double value)
{
    const double length = d->length, reach = fmin(value - j->target, length / 2);
    for (size_t c = 0; c < d->count; c++) {
        j->low[c] = d->low[c];
        d->low[c] = fmin(fmax(d->points.xs[c] - reach, d->low[c]), d->low[c] + length - 2 * reach);
    }
    d->length = 2 * reach;
    double left;
    const koksma_status status = koksma__descend(d, ITERATIONS, &left);
    memcpy(d->low, j->low, d->count * sizeof(double));
    d->length = length;
    return status;
}

/* Keeps a set that is better than all sets of the search so far. */
static void keep_better(job *j, const koksma__descent *d, double value)
{
    if (value < j->value) {
        j->value = value;
        memcpy(j->result->xs, d->points.xs, d->count * sizeof(double));
    }
}

/* Descends to targets below the value as long as that helps: the first target is far below the value if `cut` is
   infinite (a start), and a little below it otherwise (after a kick). *lowest receives the least value, and `best` its
   set. Ends early if the value stays above `cut`. */
static koksma_status follow(job *j, koksma__descent *d, double cut, double *best, double *lowest)
{
    static const double shares[] = {0.7, 0.85, 0.95, 0.98, 0.99, 0.995, 0.998};
    const size_t n_shares = sizeof shares / sizeof *shares, first = cut < HUGE_VAL ? 2 : 0;
    double value;
    koksma_status status = list(j, d, fmin(*lowest, cut) * (2 * shares[first] - 1), &value);
    keep_better(j, d, status ? HUGE_VAL : value);
    *lowest = value;
    memcpy(best, d->points.xs, d->count * sizeof(double));
    for (size_t k = first;
         !status && k < n_shares && (k < first + 2 || *lowest <= cut * 1.002) && d->work < d->budget;) {
        j->target = fmin(*lowest, cut) * shares[k];
        status = descend_near(j, d, fmin(*lowest, cut));
        status = status ? status : list(j, d, fmin(*lowest, cut) * (2 * shares[k] - 1), &value);
        k = value >= *lowest * (1 - 1e-4) ? k + 1 : k > first + 1 ? k - 1 : first;
        if (!status && value < *lowest) {
            *lowest = value;
            keep_better(j, d, value);
            memcpy(best, d->points.xs, d->count * sizeof(double));
        } else if (!status && value > 1.05 * *lowest && k < n_shares) {
            memcpy(d->points.xs, best, d->count * sizeof(double));
            status = list(j, d, fmin(*lowest, cut) * (2 * shares[k] - 1), &value);
        }
    }
    return status;
}

/* Lists the corners whose local discrepancy is near the value of the walk's set; kicks use this list. */
static koksma_status keep_corners(job *j, koksma__descent *d, const double *at, double value)
{
    double found;
    memcpy(d->points.xs, at, d->count * sizeof(double));
    const koksma_status status = list(j, d, value * 0.99, &found);
    memcpy(j->kept, j->corners, j->listed * sizeof(corner));
    j->n_kept = j->listed;
    return status;
}

/* Moves all coordinates by up to a random reach, at most half of the spacing 1/n, within their intervals. */
static void jitter(koksma__descent *d, koksma__stream *random)
{
    const double u = koksma__next_unit(random), reach = fmin(0.5 / (double)d->points.n, d->length) * u * u;
    for (size_t c = 0; c < d->count; c++) {
        const double x = d->points.xs[c] + reach * (2 * koksma__next_unit(random) - 1);
        d->points.xs[c] = fmin(fmax(x, d->low[c]), d->low[c] + d->length);
    }
}

/* Walks until the budget is used up. Each search begins with a descent from near the best set, which may be one of a
   pattern. */
static koksma_status wander(koksma_keep keep, koksma__descent *d, job *j, koksma__stream *random, double *best)
{
    const koksma_points *points = j->result;
    const double value = j->value;
    const bool anew = koksma__next_below(random, 4) == 0;
    const double threshold = 1 + 0.01 * koksma__next_unit(random);
    const size_t bytes = d->count * sizeof(double);
    double *at = best + d->count, current = HUGE_VAL, lowest;
    memcpy(at, points->xs, bytes);
    koksma_status status = KOKSMA_OK;
    for (int stale = 0, round = 0; !status && d->work < d->budget; stale++, round++) {
        if (anew && (round == 1 || stale > STALE)) {
            stale = 0;
            current = HUGE_VAL;
            status = start(j, d, points, keep, best, value, random);
        } else {
            memcpy(d->points.xs, at, bytes);
            if (round == 0) {
                jitter(d, random);
            } else {
                kick(j, d, keep, random);
            }
        }
        lowest = value;
        status = status ? status : follow(j, d, current * threshold, best, &lowest);
        if (!status && lowest <= current * threshold) {
            stale = lowest < current * (1 - 1e-4) ? 0 : stale;
            current = lowest;
            memcpy(at, best, bytes);
            status = keep_corners(j, d, at, current);
        }
    }
    return status;
}

static koksma_status search(const koksma_spec *measure, const koksma_optimise_options *o, uint64_t seed, double value,
                            const koksma_run *run, koksma_points *points)
{
    (void)measure;
    koksma__stream random = {.seed = seed};
    koksma__descent d;
    job j;
    const size_t n = points->n, bytes = 6 * n * sizeof(double);
    koksma_status status = job_init(&j, n);
    double *best = status ? NULL : malloc(bytes); /* the best set of a descent, followed by the set of the walk */
    if (!status && !best) {
        status = koksma__fail_memory(bytes);
    }
    if (!status) {
        status = koksma__descent_init(&d, points, o->keep, true, 0);
        if (!status) {
            d.function = excesses;
            d.context = &j;
            d.run = run;
            d.budget = fmax(1.5e7 + 6e5 * (double)n, 5 * koksma__pow((double)n + 1, 3));
            j.value = value;
            j.result = points;
            status = wander(o->keep, &d, &j, &random, best);
            koksma__descent_fini(&d);
        }
    }
    free(best);
    free(j.memory);
    return status;
}

static int serves(const koksma_spec *measure, const koksma_optimise_options *o)
{
    return measure->measure == &koksma__measure_star && !(measure->params[0] > 0) && o->dim == 3 && o->n <= MAX_N &&
                   !o->n_projections && (o->keep == KOKSMA_KEEP_NONE || o->keep == KOKSMA_KEEP_NET)
               ? 10
               : 0;
}

const koksma_method koksma__method_star_space = {
    .name = "star-space",
    .title = "descent on the largest local discrepancies (star, 3D)",
    .cite = "nocedal2006",
    .serves = serves,
    .search = search,
};
