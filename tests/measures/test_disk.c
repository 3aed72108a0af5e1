/* SPDX-License-Identifier: Apache-2.0 */
/* The largest deviation over disks: every critical disk by itself in long double, and a dense search of centres that
   knows nothing of critical disks. */
#include <stdlib.h>

#include "sets.h"

static const long double rim = 1e-13L;

/* |share - area| of the disk; points within rim of the circle count for the better. */
static long double deviation(const koksma_points *p, long double x, long double y, long double r2, bool closed)
{
    size_t inside = 0;
    for (size_t i = 0; i < p->n; i++) {
        const long double dx = p->xs[2 * i] - x, dy = p->xs[2 * i + 1] - y, a = dx - roundl(dx), b = dy - roundl(dy);
        inside += closed ? a * a + b * b <= r2 + rim : a * a + b * b < r2 - rim;
    }
    const long double excess = (long double)inside / (long double)p->n - acosl(-1) * r2;
    return closed ? excess : -excess;
}

static void try_circle(const koksma_points *p, long double x, long double y, long double r2, double *best)
{
    *best = fmax(*best, (double)fmaxl(deviation(p, x, y, r2, true), deviation(p, x, y, r2, false)));
}

/* Point i seen in one of nine copies of the torus. */
static void copy(const koksma_points *p, size_t i, int image, long double *x)
{
    x[0] = (long double)p->xs[2 * i] + image % 3 - 1;
    x[1] = (long double)p->xs[2 * i + 1] + image / 3 - 1;
}

static void try_triple(const koksma_points *p, const long double *a, const long double *b, const long double *c,
                       long double r, double *best)
{
    const long double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
    const long double area = 2 * (bx * cy - by * cx), b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
    if (fabsl(area) < 1e-12L) {
        return;
    }
    const long double x = (cy * b2 - by * c2) / area, y = (bx * c2 - cx * b2) / area;
    if (x * x + y * y <= r * r) {
        try_circle(p, a[0] + x, a[1] + y, x * x + y * y, best);
    }
}

static void try_pair(const koksma_points *p, const long double *a, const long double *b, long double r, double *best)
{
    const long double dx = b[0] - a[0], dy = b[1] - a[1], h2 = (dx * dx + dy * dy) / 4;
    if (h2 == 0 || h2 > r * r) {
        return;
    }
    const long double t = sqrtl(r * r - h2) / sqrtl(4 * h2);
    try_circle(p, a[0] + dx / 2, a[1] + dy / 2, h2, best);
    try_circle(p, a[0] + dx / 2 - t * dy, a[1] + dy / 2 + t * dx, r * r, best);
    try_circle(p, a[0] + dx / 2 + t * dy, a[1] + dy / 2 - t * dx, r * r, best);
}

static double brute(const koksma_points *p, long double r)
{
    double best = 0;
    for (size_t i = 0; i < p->n; i++) {
        long double a[2], b[2], c[2];
        copy(p, i, 4, a);
        try_circle(p, a[0], a[1], 0, &best);
        try_circle(p, a[0] + r, a[1], r * r, &best);
        for (size_t j = 9 * i; j < 9 * p->n; j++) {
            copy(p, j / 9, (int)(j % 9), b);
            if (hypotl(a[0] - b[0], a[1] - b[1]) > 2 * r) {
                continue;
            }
            try_pair(p, a, b, r, &best);
            for (size_t k = 9 * (j / 9); k < 9 * p->n; k++) {
                copy(p, k / 9, (int)(k % 9), c);
                try_triple(p, a, b, c, r, &best);
            }
        }
    }
    return best;
}

TEST_CASE(equals_brute_force)
{
    static const double radii[] = {0.25, 0.1, 0.375, 0.49};
    for (int s = 0; s < test_repeats(900, 90); s++) {
        char spec[32];
        const double r = radii[s % 4];
        koksma_points p = sets_points(1 + (size_t)(s / 24) % 7, 2, s % SETS_KINDS, (uint64_t)s);
        snprintf(spec, sizeof spec, "disk:r=%.17g", r);
        const double ours = test_measure(spec, &p).value, theirs = brute(&p, r);
        if (!(fabs(ours - theirs) <= 2e-12)) {
            sets_print(&p);
            fail_msg("%s of set %d: %.17g, brute force %.17g", spec, s, ours, theirs);
        }
        koksma_points_fini(&p);
    }
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* All radii about the centres of a lattice: never above the supremum, and near it. */
static double dense(const koksma_points *p, double r)
{
    enum { STEPS = 160, MAX = 64 };
    double best = 0, d[MAX];
    for (int c = 0; c < STEPS * STEPS; c++) {
        const double x = (c % STEPS + 0.5) / STEPS, y = (c / STEPS + 0.5) / STEPS;
        size_t near = 0;
        for (size_t i = 0; i < p->n; i++) {
            const double dx = p->xs[2 * i] - x, dy = p->xs[2 * i + 1] - y;
            d[near] = hypot(dx - round(dx), dy - round(dy));
            near += d[near] <= r;
        }
        qsort(d, near, sizeof *d, compare);
        for (size_t i = 0; i <= near; i++) {
            const double s = i < near ? d[i] : r, area = M_PI * s * s, n = (double)p->n;
            best = fmax(best, fmax(area - (double)i / n, i < near ? (double)(i + 1) / n - area : 0));
        }
    }
    return best;
}

TEST_CASE(agrees_with_a_dense_search)
{
    for (int s = 0; s < test_repeats(24, 6); s++) {
        const double r = s % 2 ? 0.25 : 0.45;
        koksma_points p = sets_points(5 + (size_t)s * 2, 2, s % SETS_KINDS, (uint64_t)s);
        const double ours = test_measure(s % 2 ? "disk" : "disk:r=0.45", &p).value;
        assert_true(dense(&p, r) <= ours + 1e-12);
        /* A centre of the lattice is within 0.71 / 160 of the best, and needs as much more radius for an excess. */
        assert_true(ours <= dense(&p, r + 0.71 / 160) + 2 * M_PI * r / 160);
        koksma_points_fini(&p);
    }
}

/* How many points the witness has, compared in doubles as koksma.h says. */
static size_t count_in(const koksma_points *p, const koksma_witness *w)
{
    size_t count = 0;
    for (size_t i = 0; i < p->n; i++) {
        const double dx = p->xs[2 * i] - w->lo[0], dy = p->xs[2 * i + 1] - w->lo[1], a = dx - round(dx),
                     b = dy - round(dy), r2 = w->hi[0] * w->hi[0];
        count += w->closed ? a * a + b * b <= r2 : a * a + b * b < r2;
    }
    return count;
}

/* Whoever counts the points in the witness finds the value; on any number of threads it is the same disk. */
TEST_CASE(witness_shows_the_value)
{
    koksma_spec spec;
    assert_ok(koksma_measure_spec("disk:r=0.3", &spec));
    for (int s = 0; s < test_repeats(120, 24); s++) {
        koksma_points p = sets_points(1 + (size_t)s / 3, 2, s % SETS_KINDS, (uint64_t)s);
        koksma_value v, other;
        assert_ok(koksma_evaluate(&spec, &p, &(koksma_run){.threads = 1}, &v));
        assert_ok(koksma_evaluate(&spec, &p, &(koksma_run){.threads = 3}, &other));
        const koksma_witness *w = &v.witness;
        assert_int_equal(w->kind, KOKSMA_WITNESS_DISK);
        assert_true(w->hi[0] <= 0.3 + 1e-14);
        assert_int_equal(count_in(&p, w), w->count);
        assert_near((double)deviation(&p, w->lo[0], w->lo[1], (long double)w->hi[0] * w->hi[0], w->closed), v.value,
                    1e-12);
        assert_near(fabs((double)w->count / (double)p.n - w->volume), v.value, 1e-15);
        assert_memory_equal(w, &other.witness, sizeof *w);
        koksma_points_fini(&p);
    }
}

/* Squares of their differences are 0. */
TEST_CASE(points_too_near_to_0)
{
    double xs[] = {0, 0, 1e-170, 0, 0, 1e-300, 0.5, 0.5};
    koksma_points p = {4, 2, xs};
    koksma_spec spec;
    koksma_value v;
    assert_ok(koksma_measure_spec("disk:r=0.05", &spec));
    assert_ok(koksma_evaluate(&spec, &p, NULL, &v));
    assert_true(v.exact && v.witness.count == 3);
    assert_near(v.value, 0.75, 1e-15);
}

/* Points that are there several times do not change the value, but the method: branch and bound against all pairs. */
TEST_CASE(branch_and_bound_agrees_with_all_pairs)
{
    static const double radii[] = {0.25, 0.1, 0.375, 0.499};
    for (int s = 0; s < test_repeats(160, 32); s++) {
        char spec[32];
        snprintf(spec, sizeof spec, "disk:r=%.17g", radii[s % 4]);
        koksma_points few = sets_points(22 + (size_t)s / 4, 2, s / 4 % SETS_KINDS, (uint64_t)s), many;
        assert_ok(koksma_points_init(&many, 3 * few.n, 2));
        for (size_t i = 0; i < 2 * many.n; i++) {
            many.xs[i] = few.xs[i % (2 * few.n)];
        }
        const koksma_value v = test_measure(spec, &many);
        const double all_pairs = test_measure(spec, &few).value;
        if (!(v.exact ? fabs(v.value - all_pairs) <= 1e-13 : v.lower <= all_pairs && all_pairs <= v.upper)) {
            sets_print(&few);
            fail_msg("%s of set %d: %.17g to %.17g, all pairs %.17g", spec, s, v.lower, v.upper, all_pairs);
        }
        koksma_points_fini(&few);
        koksma_points_fini(&many);
    }
}

TEST_CASE(bounds_when_cut_short)
{
    koksma_spec spec;
    koksma_value v, one, three;
    koksma_points p = test_points("jittered", 900, 2, 1);
    assert_ok(koksma_measure_spec("disk:r=0.1", &spec));
    assert_ok(koksma_evaluate(&spec, &p, &(koksma_run){.threads = 1}, &one));
    assert_ok(koksma_evaluate(&spec, &p, &(koksma_run){.threads = 3}, &three));
    assert_true(one.exact);
    assert_memory_equal(&one.witness, &three.witness, sizeof one.witness);
    assert_ok(koksma_evaluate(&spec, &p, &(koksma_run){.time_limit_s = 0.003}, &v));
    assert_true(v.lower <= one.value && one.value <= v.upper);
    assert_true(v.exact == (v.lower == v.upper));
    koksma_points_fini(&p);
    p = test_points("regular", 256, 2, 0); /* 2^28 looks don't do */
    v = test_measure("disk", &p);
    assert_true(!v.exact && v.lower == v.value && v.lower < v.upper);
    koksma_points_fini(&p);
}
