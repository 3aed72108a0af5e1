/* SPDX-License-Identifier: Apache-2.0 */
/*
 * poisson-disk-maximal: dart throwing on the torus until no point can be added: no two points are closer than d, and
 * no position is further than d from all points.
 *
 *     d=D   The number of points follows from the distance D (about 0.6965 / D^2); any other n is an error.
 *     d=0   The distance follows from n: darts are thrown at a distance at which slightly fewer than n points fit; then
 *           the distance shrinks, and darts fill the free area that opens, until exactly n points leave no free area
 *           (a bisection over the distance, because free areas open one at a time).
 *
 * Source: Ebeida, Mitchell, Patney, Davidson & Owens 2012 for the flat quadtree of the free area. The points have the
 * distribution of dart throwing and are thus unbiased. Free areas narrower than 2^-30 are ignored. The time is about
 * n log n. In 3 to 6 dimensions (darts/darts.h) sets have n V (d/2)^dim = 0.384, 0.260, 0.171 and 0.109, V the
 * volume of the unit ball: the saturation of random sequential addition (Zhang & Torquato 2013). Time and memory are
 * proportional to n and grow by a factor of 6 to 10 with each dimension: 400 points take 0.01, 0.2 and 2 s in 3, 4
 * and 5 dimensions.
 *
 * With order=progressive the finished set is put into Yuksel's progressive order (2015; spacing/elimination.c): the
 * points are the same, and every prefix is blue noise, too. In the plain order, in which the darts were thrown,
 * prefixes are not blue noise: the first eighth of 512 points in the plane has a relative radius of 0.30, in
 * progressive order 0.64.
 */
#include <math.h>
#include <string.h>

#include "core/elementary.h"
#include "core/random.h"
#include "core/status.h"
#include "patterns/darts/darts.h"
#include "patterns/patterns.h"
#include "patterns/spacing/spacing.h"

enum { TRIES = 100, SEARCHES = 8, MANY = 100000 };

/* A set and the cover of its free volume: disks in the plane, balls in more dimensions. */
typedef struct cover {
    int dim;
    koksma__disks disks;
    koksma__balls balls;
} cover;

static koksma_status cover_init(cover *c, uint64_t seed, double d)
{
    return c->dim == 2 ? koksma__disks_init(&c->disks, seed, d) : koksma__balls_init(&c->balls, seed, c->dim, d);
}

static koksma_status cover_fill(cover *c, size_t n, const koksma_run *run)
{
    return c->dim == 2 ? koksma__disks_fill(&c->disks, n, run) : koksma__balls_fill(&c->balls, n, run);
}

static koksma_status cover_shrink(cover *c, size_t n, double d, const koksma_run *run)
{
    return c->dim == 2 ? koksma__disks_shrink(&c->disks, n, d) : koksma__balls_shrink(&c->balls, n, d, run);
}

static void cover_fini(cover *c)
{
    koksma__disks_fini(&c->disks);
    koksma__balls_fini(&c->balls);
}

static size_t cover_n(const cover *c)
{
    return c->dim == 2 ? c->disks.n : c->balls.n;
}

static double **cover_xs(cover *c)
{
    return c->dim == 2 ? &c->disks.xs : &c->balls.xs;
}

/* Returns the mean of (number of points) * d^dim. */
static double per_volume(int dim)
{
    return dim == 2 ? 0.6965 : koksma__balls_per_volume(dim);
}

/* Returns a number slightly larger than any distance on the torus. */
static double farthest(int dim)
{
    return dim == 2 ? 0.72 : 0.51 * sqrt(dim);
}

/* Returns the distance d at which sets have n points on average. */
static double distance_of(double n, int dim)
{
    const double d = dim == 2 ? sqrt(per_volume(dim) / n) : koksma__pow(per_volume(dim) / n, 1.0 / dim);
    return fmin(d, farthest(dim));
}

/* Returns, rounded, the largest number of points whose cover of the free volume needs at most KOKSMA__BALL_BYTES. */
static size_t feasible(int dim)
{
    static const size_t most[] = {5000000, 800000, 40000, 5000};
    return most[dim - 3];
}

/* Fails with a message that the cover of `n` points has exceeded its limit. */
static koksma_status explain(koksma_status status, const cover *c, double n)
{
    return status != KOKSMA_IMPOSSIBLE
               ? status
               : koksma__fail(KOKSMA_N,
                              "poisson-disk-maximal: about %.3g points in dim %d need a cover of the free volume "
                              "above %zu MiB; %zu points are feasible",
                              n, c->dim, KOKSMA__BALL_BYTES >> 20, feasible(c->dim));
}

static koksma_status try_shrink(void *set, size_t kept, double d, size_t n, const koksma_run *run, size_t *found)
{
    cover *c = set;
    koksma_status status = cover_shrink(c, kept, d, run);
    status = status ? status : cover_fill(c, n, run);
    *found = cover_n(c);
    return explain(status, c, (double)(n - 1));
}

/* Searches for a maximal set of n points. The search starts up to TRIES times, with the seeds number first .. first +
   TRIES - 1. */
static koksma_status search(uint64_t seed, uint32_t first, size_t n, const koksma_run *run, cover *c)
{
    double d = distance_of(fmax((double)n - 0.6 * sqrt((double)n) - 0.4, 0.9), c->dim);
    koksma_status status = KOKSMA_OK;
    for (uint32_t try = first; try < first + TRIES && !status; try++) {
        status = cover_init(c, koksma__random_seed(seed, try, KOKSMA__PURPOSE_DART), d);
        status = status ? status : explain(cover_fill(c, n + 1, run), c, (double)n);
        if (status || cover_n(c) <= n) {
            break;
        }
        cover_fini(c);
        d = fmin(d * (1 + 0.6 / c->dim / sqrt((double)n)), farthest(c->dim));
    }
    return status || cover_n(c) >= n ? status : koksma__maximal_shrink(c->dim, d, cover_n(c), n, run, try_shrink, c);
}

/* A search may end without n points, because free area can appear for two points at the same distance: two positions
   on the torus can be symmetric about two points of the set. Whether this happens does not depend on the position of
   the set, so repeating the search does not bias it. */
static koksma_status by_number(uint64_t seed, size_t n, const koksma_run *run, cover *c)
{
    koksma_status status = search(seed, 0, n, run, c);
    for (uint32_t again = 1; status == KOKSMA_IMPOSSIBLE && again < SEARCHES; again++) {
        cover_fini(c);
        status = search(seed, again * TRIES, n, run, c);
    }
    return status;
}

static koksma_status by_distance(uint64_t seed, double d, const koksma_run *run, cover *c)
{
    const double most = (double)(KOKSMA_MAX_COORDINATES / (size_t)c->dim),
                 expected = per_volume(c->dim) / koksma__pow(d, c->dim);
    KOKSMA__FAIL_IF(
        expected > most, KOKSMA_N,
        "poisson-disk-maximal: d=%g would give about %.2g points, which is too many; d=%.2g or more would do", d,
        expected, 1.01 * distance_of(most, c->dim));
    koksma_status status = cover_init(c, seed, fmin(d, farthest(c->dim)));
    return status ? status : explain(cover_fill(c, SIZE_MAX, run), c, expected);
}

/* Returns whether a maximal set of n points with distance d can exist. The disks of radius d about the points of such
   a set cover the torus, and the disks of radius d/2 do not overlap. Therefore n is at least 2/(sqrt(27) d^2), as in
   the thinnest covering, and at most 2/(sqrt(3) d^2), as in the densest packing. In more dimensions n balls of radius
   d have at least, and n balls of radius d/2 at most, the volume of the torus. With this test an impossible n fails
   before the first dart is thrown. */
static bool is_possible(double d, size_t n, int dim)
{
    const double area = (double)n * koksma__pow(d, dim), packed = koksma__packing_distance(n, dim, true) / d;
    return dim == 2 ? area > 0.999 * 2 / sqrt(27) && area < 1.001 * 2 / sqrt(3) : packed > 0.999 && packed < 2.002;
}

static koksma_status finish(koksma_status status, const koksma_args *args, koksma_points *out)
{
    return status || !(args->params[1] > 0) ? status : koksma__order_progressively(args->run, out);
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const double d = args->params[0], expected = per_volume(out->dim) / koksma__pow(d, out->dim);
    cover c = {.dim = out->dim};
    KOKSMA__FAIL_IF(d > 0 && expected > MANY && !is_possible(d, out->n, out->dim), KOKSMA_N,
                    "poisson-disk-maximal: d=%g gives about %.3g points, not %zu; leave out d to get n points", d,
                    expected, out->n);
    koksma_status status = d > 0 ? by_distance(seed, d, args->run, &c) : by_number(seed, out->n, args->run, &c);
    if (!status && cover_n(&c) != out->n) {
        status = koksma__fail(
            KOKSMA_N,
            "poisson-disk-maximal: d=%g with this seed gives %zu points, not %zu; n = %zu, or no d, would do", d,
            cover_n(&c), out->n, cover_n(&c));
    }
    if (!status) {
        memcpy(out->xs, *cover_xs(&c), (size_t)c.dim * out->n * sizeof *out->xs);
    }
    cover_fini(&c);
    return finish(status, args, out);
}

static koksma_status whole(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    KOKSMA__FAIL_IF(args->params[0] <= 0, KOKSMA_N,
                    "poisson-disk-maximal: without d= the number of points is missing");
    cover c = {.dim = out->dim};
    koksma_status status = by_distance(seed, args->params[0], args->run, &c);
    if (!status) {
        out->n = cover_n(&c);
        out->xs = *cover_xs(&c);
        *cover_xs(&c) = NULL;
    }
    cover_fini(&c);
    return finish(status, args, out);
}

static const char *const orders[] = {"plain", "progressive", NULL};

static const koksma_param params[] = {
    {"d", "smallest distance; 0: the distance that gives n points", 0, 0, 1e9, NULL, false},
    {"order", "order of the points: plain, or progressive (every prefix is blue noise, too)", 0, 0, 1, orders, true},
    {0},
};

const koksma_pattern koksma__pattern_poisson_disk_maximal = {
    .name = "poisson-disk-maximal",
    .title = "dart throwing on the torus until no further point fits",
    .cite = "ebeida2012 cook1986 zhang2013 yuksel2015",
    .min_dim = 2,
    .max_dim = KOKSMA__BALL_DIMS,
    .claims = KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_MIN_DISTANCE | KOKSMA_CLAIM_MAXIMAL | KOKSMA_CLAIM_BLUE |
              KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
    .whole = whole,
};
