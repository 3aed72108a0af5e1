/* SPDX-License-Identifier: Apache-2.0 */
/*
 * disk: the largest absolute difference, over all disks on the torus with a radius up to r, between the share of
 * points in the disk and its area.
 *
 * Formula: sup over c and 0 <= s <= r of |#{x_i within s of c}/n - pi s^2|, r < 1/2. The largest excess of points is
 * reached at the smallest closed disk that contains some subset of the points: a disk of radius 0 about a point, a
 * disk with two points at the ends of a diameter, or one with three points on its rim. The largest deficit is reached
 * at an open disk with three points on its rim, or of radius r with one or two points on its rim. The centres of all
 * disks with two given points on their rim lie on the bisector of these points; every other point is inside the disk
 * while the centre is on one half-line of the bisector.
 * Source: derived; the critical disks are the same as for smallest enclosing circles (Megiddo 1983) and for an
 * arrangement of circles of equal radius.
 * Known exactly: one point has the value 1; the m x m lattice with r < 1/(2m) has 1/n.
 * Limits: a point counts as on the rim if its squared distance from the centre is within 4e-15 of the squared radius,
 * so that rounding does not separate cocircular points; the error of the value is up to 1e-14. With up to 64 points
 * the disks through all pairs of points are tried. For more points a branch and bound search (shared/disk_cover.c)
 * stops at the time limit or, without one, after 2^28 point tests. The value is then a lower bound and comes with an
 * upper bound; this happens for lattices of a few hundred points and for the first 4,096 points of sobol.
 */
#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/disk/disk.h"
#include "measures/measures.h"
#include "measures/shared/shared.h"

enum { PAIRS_TO = 64 };

typedef struct search {
    koksma__disk_set set;
    koksma__disk_best start, *blocks; /* start: the best disk before most pairs are tried; blocks[i]: the best disk of
                                         the pairs of points i and j > i */
} search;

/* Tries the disk of radius 0 about each point. */
static void try_points(search *s)
{
    for (size_t i = 0; i < s->set.m; i++) {
        koksma__disk_try(&s->set, &s->start, true, s->set.weights[i], (double[]){s->set.xs[i], s->set.ys[i]}, 0);
    }
}

/* Tries open disks of the largest radius with one point on the rim. */
static void try_singles(search *s)
{
    const koksma__disk_set *set = &s->set;
    const double r = set->r;
    for (size_t i = 0; i < set->m; i++) {
        const double centre[2] = {set->xs[i] + r, set->ys[i]};
        size_t inside = 0;
        for (size_t k = 0; k < set->m; k++) {
            const double dx = set->xs[k] - centre[0], dy = set->ys[k] - centre[1], a = dx - round(dx),
                         b = dy - round(dy);
            inside += a * a + b * b < r * r - KOKSMA__DISK_RIM ? set->weights[k] : 0;
        }
        koksma__disk_try(set, &s->start, false, inside, centre, r * r);
    }
}

static koksma_status block(void *context, size_t i)
{
    search *s = context;
    s->blocks[i] = s->start;
    return koksma__disk_pencils(&s->set, i, &s->blocks[i]);
}

static int compare_points(const void *a, const void *b)
{
    const double *p = a, *q = b;
    return p[0] != q[0] ? (p[0] > q[0]) - (p[0] < q[0]) : (p[1] > q[1]) - (p[1] < q[1]);
}

/* Fills the struct with the distinct points and their multiplicities. The coordinate 1 becomes 0, and so do
   coordinates up to 2^-400, because squares of such small differences could underflow. */
static koksma_status fill_set(koksma__disk_set *set, const koksma_points *points)
{
    const size_t n = points->n;
    double *sorted = malloc(2 * n * sizeof(double));
    set->xs = malloc(2 * n * sizeof(double));
    set->weights = malloc(n * sizeof(size_t));
    if (!sorted || !set->xs || !set->weights) {
        free(sorted);
        return koksma__fail_memory(5 * n * sizeof(double));
    }
    set->ys = set->xs + n;
    for (size_t c = 0; c < 2 * n; c++) {
        sorted[c] = points->xs[c] < 1 && points->xs[c] > 0x1p-400 ? points->xs[c] : 0;
    }
    qsort(sorted, n, 2 * sizeof(double), compare_points);
    for (size_t i = 0; i < n; i++) {
        if (i == 0 || compare_points(sorted + 2 * i, sorted + 2 * (i - 1))) {
            set->xs[set->m] = sorted[2 * i];
            set->ys[set->m] = sorted[2 * i + 1];
            set->weights[set->m++] = 0;
        }
        set->weights[set->m - 1]++;
    }
    free(sorted);
    return KOKSMA_OK;
}

static koksma_status search_pairs(search *s, const koksma_run *run)
{
    s->blocks = malloc(s->set.m * sizeof *s->blocks);
    KOKSMA__REQUIRE_MEMORY(s->blocks, s->set.m * sizeof *s->blocks);
    try_singles(s);
    /* All blocks use this lower bound for pruning. The bound is computed before the blocks start, so that results do
       not depend on the number of threads. */
    koksma_status status = koksma__disk_pencils(&s->set, s->set.m / 2, &s->start);
    status = status ? status : koksma__parallel(run, s->set.m, block, s);
    for (size_t i = 0; !status && i < s->set.m; i++) {
        s->start = s->blocks[i].value > s->start.value ? s->blocks[i] : s->start;
    }
    free(s->blocks);
    return status;
}

/* The squared distance of a point on the rim may differ from the squared radius by up to KOKSMA__DISK_RIM. Adjusts
   the radius of the witness so that comparisons in doubles, as koksma.h defines them, count the same points as the
   search. The radius of a closed disk grows until it contains all its points; that of an open disk shrinks until all
   other points are outside. */
static void settle_radius(const koksma_points *points, koksma_witness *w)
{
    for (;;) {
        const double square = w->hi[0] * w->hi[0];
        double next = w->closed ? HUGE_VAL : 0;
        size_t count = 0;
        for (size_t i = 0; i < points->n; i++) {
            const double dx = points->xs[2 * i] - w->lo[0], dy = points->xs[2 * i + 1] - w->lo[1];
            const double a = dx - round(dx), b = dy - round(dy), here = a * a + b * b;
            const bool inside = w->closed ? here <= square : here < square;
            count += inside;
            if (inside != w->closed) {
                next = w->closed ? fmin(next, here) : fmax(next, here);
            }
        }
        const bool right = w->closed ? count >= w->count : count <= w->count;
        if (right || fabs(next - square) > 4 * KOKSMA__DISK_RIM) {
            return;
        }
        w->hi[0] = sqrt(next);
        while (w->closed ? w->hi[0] * w->hi[0] < next : w->hi[0] * w->hi[0] > next) {
            w->hi[0] = nextafter(w->hi[0], w->closed ? 1 : 0);
        }
    }
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    search s = {.set = {.n = points->n, .r = args->params[0]}, .start.value = -1};
    const double end_s = koksma__deadline_s(args->run, 0.95);
    koksma_status status = fill_set(&s.set, points);
    if (!status) {
        try_points(&s);
        out->upper = -1;
        status = points->n <= PAIRS_TO ? search_pairs(&s, args->run)
                                       : koksma__disk_cover(&s.set, args->run, end_s, &s.start, &out->upper);
    }
    if (!status) {
        out->exact = out->upper <= s.start.value;
        out->value = out->lower = s.start.value;
        out->witness = s.start.witness;
        settle_radius(points, &out->witness);
    }
    free(s.set.weights);
    free(s.set.xs);
    return status;
}

static const koksma_param params[] = {
    {"r", "the largest radius", 0.25, 0.001, 0.499, NULL, false},
    {0},
};

const koksma_measure koksma__measure_disk = {
    .name = "disk",
    .title = "discrepancy of disks on the torus, up to a radius",
    .cite = "mitchell1992 megiddo1983",
    .cost = "n^3 up to 64 points, about n^2.5 above; after 2^28 point tests only bounds",
    .family = KOKSMA_FAMILY_DISKS,
    .min_dim = 2,
    .max_dim = 2,
    .params = params,
    .eval = eval,
};
