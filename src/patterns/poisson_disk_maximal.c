/* SPDX-License-Identifier: Apache-2.0 */
/*
 * poisson-disk-maximal: dart throwing on the torus until no point can be added: no two points are closer than d, and
 * no position is further than d from all of them.
 *     by distance, d=D: the number of points follows from D (about 0.6965 / D^2); any other n is an error
 *     by number, d=0: darts are thrown at a distance at which slightly fewer than n points fit; then the distance
 *         shrinks, and darts fill the free area that opens, until exactly n points leave no free area (a bisection
 *         over the distance, because free areas open one at a time)
 *
 * Source: Ebeida, Mitchell, Patney, Davidson & Owens 2012 for the flat quadtree of the free area. The points have the
 * distribution of dart throwing and are thus unbiased. Free areas narrower than 2^-30 are ignored. The time is about
 * n log n.
 */
#include <math.h>
#include <string.h>

#include "core/random.h"
#include "core/status.h"
#include "patterns/patterns.h"
#include "patterns/shared/dart_cover.h"

enum { TRIES = 100, SEARCHES = 8, MANY = 100000 };

#define PER_AREA 0.6965 /* points times d^2, on average */

/* Extends a maximal set of fewer than n points to one of n points by shrinking the distance. The distance searched for
   is between `low`, at which there were more than n points, and disks->d. Each try gives an estimate of how much the
   distance has to shrink for one point more. */
static koksma_status shrink_to(koksma__disks *disks, size_t n, const koksma_run *run)
{
    const double guess = 0.25 / (double)n;
    double high = disks->d, low = 0, step = guess; /* step: fraction by which d shrinks for one point more */
    size_t kept = disks->n;
    koksma_status status = KOKSMA_OK;
    for (int try = 0; try < TRIES && !status; try++) {
        const double wanted = high * (1 - fmin(step * (double)(n - kept), 0.3));
        const double d = low > 0 ? fmax(wanted, (low + high) / 2) : wanted;
        status = koksma__disks_shrink(disks, kept, d);
        if (!status) {
            status = koksma__disks_fill(disks, n + 1, run);
        }
        if (status || disks->n == n) {
            return status;
        }
        if (disks->n > n) {
            low = d;
            step /= 2;
        } else {
            step = disks->n > kept ? (1 - d / high) / (double)(disks->n - kept) : 2 * step;
            high = d;
            kept = disks->n;
        }
        if (low > 0 && high - low < 1e-12 * high) { /* `low` was found when fewer points were kept; it no longer gives
                                                       too many */
            low = 0;
            step = guess;
        }
    }
    return status
               ? status
               : koksma__fail(KOKSMA_IMPOSSIBLE,
                              "poisson-disk-maximal: the search for %zu points ended with %zu; another seed would do",
                              n, kept);
}

/* Searches for a maximal set of n points; the restarts use the seeds number first to first + TRIES - 1. */
static koksma_status search(uint64_t seed, uint32_t first, size_t n, const koksma_run *run, koksma__disks *disks)
{
    const double few = fmax((double)n - 0.6 * sqrt((double)n) - 0.4, 0.9);
    double d = fmin(sqrt(PER_AREA / few), 0.72);
    koksma_status status = KOKSMA_OK;
    for (uint32_t try = first; try < first + TRIES && !status; try++) {
        status = koksma__disks_init(disks, koksma__random_seed(seed, try, KOKSMA__PURPOSE_DART), d);
        if (!status) {
            status = koksma__disks_fill(disks, n + 1, run);
        }
        if (status || disks->n <= n) {
            break;
        }
        koksma__disks_fini(disks);
        d = fmin(d * (1 + 0.3 / sqrt((double)n)), 0.72);
    }
    return status || disks->n >= n ? status : shrink_to(disks, n, run);
}

/* A search may end without n points: two points on the torus are symmetric about two others, so that free area may
   appear for two points at once. Whether this happens does not depend on the position of the set, so repeating the
   search does not bias it. */
static koksma_status by_number(uint64_t seed, size_t n, const koksma_run *run, koksma__disks *disks)
{
    koksma_status status = search(seed, 0, n, run, disks);
    for (uint32_t again = 1; status == KOKSMA_IMPOSSIBLE && again < SEARCHES; again++) {
        koksma__disks_fini(disks);
        status = search(seed, again * TRIES, n, run, disks);
    }
    return status;
}

static koksma_status by_distance(uint64_t seed, double d, const koksma_run *run, koksma__disks *disks)
{
    const double most = (double)(KOKSMA_MAX_COORDINATES / 2), expected = PER_AREA / d / d;
    KOKSMA__FAIL_IF(expected > most, KOKSMA_N,
                    "poisson-disk-maximal: d=%g has about %.2g points; d=%.2g or more would do", d, expected,
                    1.01 * sqrt(PER_AREA / most));
    koksma_status status = koksma__disks_init(disks, seed, d);
    return status ? status : koksma__disks_fill(disks, SIZE_MAX, run);
}

/* Whether a maximal set of n points with distance d can exist. Its disks of radius d cover the torus and those of
   radius d/2 do not overlap, so that n is between that of the thinnest covering, 2/(sqrt(27) d^2), and that of the
   densest packing, 2/(sqrt(3) d^2). For many points any other n fails before the first dart is thrown. */
static bool is_possible(double d, size_t n)
{
    const double area = (double)n * d * d;
    return area > 0.999 * 2 / sqrt(27) && area < 1.001 * 2 / sqrt(3);
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const double d = args->params[0];
    koksma__disks disks = {0};
    KOKSMA__FAIL_IF(d > 0 && PER_AREA / d / d > MANY && !is_possible(d, out->n), KOKSMA_N,
                    "poisson-disk-maximal: d=%g has about %.3g points, not %zu; no d would do", d, PER_AREA / d / d,
                    out->n);
    koksma_status status =
        d > 0 ? by_distance(seed, d, args->run, &disks) : by_number(seed, out->n, args->run, &disks);
    if (!status && disks.n != out->n) {
        status = koksma__fail(KOKSMA_N,
                              "poisson-disk-maximal: d=%g with this seed has %zu points, not %zu; n = %zu, or no d, "
                              "would do",
                              d, disks.n, out->n, disks.n);
    }
    if (!status) {
        memcpy(out->xs, disks.xs, 2 * out->n * sizeof *out->xs);
    }
    koksma__disks_fini(&disks);
    return status;
}

static koksma_status whole(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    KOKSMA__FAIL_IF(args->params[0] <= 0, KOKSMA_N,
                    "poisson-disk-maximal: without d= the number of points is missing");
    koksma__disks disks = {0};
    koksma_status status = by_distance(seed, args->params[0], args->run, &disks);
    if (!status) {
        out->n = disks.n;
        out->xs = disks.xs;
        disks.xs = NULL;
    }
    koksma__disks_fini(&disks);
    return status;
}

static const koksma_param params[] = {
    {"d", "smallest distance; 0: whichever gives n points", 0, 0, 0.7, NULL, false},
    {0},
};

const koksma_pattern koksma__pattern_poisson_disk_maximal = {
    .name = "poisson-disk-maximal",
    .title = "dart throwing on the torus until nothing fits",
    .cite = "ebeida2012 cook1986",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_MIN_DISTANCE | KOKSMA_CLAIM_MAXIMAL | KOKSMA_CLAIM_BLUE |
              KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
    .whole = whole,
};
