/* SPDX-License-Identifier: Apache-2.0 */
/* The measures of boxes against brute force over thousands of random small sets: every critical box by itself, every
   point counted anew; L2 star integrated cell by cell from its definition. */
#include <stdlib.h>

#include "sets.h"

enum { MAX_LEVELS = 40 };

typedef struct levels {
    double at[3][MAX_LEVELS];
    int count[3];
} levels;

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static levels levels_of(const koksma_points *p)
{
    levels l = {.count = {1, 1, 1}};
    for (int k = 0; k < p->dim; k++) {
        int c = 0;
        l.at[k][c++] = 0;
        l.at[k][c++] = 1;
        for (size_t i = 0; i < p->n; i++) {
            l.at[k][c++] = p->xs[i * (size_t)p->dim + (size_t)k];
        }
        qsort(l.at[k], (size_t)c, sizeof(double), compare);
        l.count[k] = c;
    }
    return l;
}

/* |share - volume| of the box, open or closed; anchored boxes hold their lower sides. */
static double deviation(const koksma_points *p, const double *lo, const double *hi, bool closed, bool anchored)
{
    size_t inside = 0;
    double volume = 1;
    for (int k = 0; k < p->dim; k++) {
        volume *= hi[k] - lo[k];
    }
    for (size_t i = 0; i < p->n; i++) {
        bool in = true;
        for (int k = 0; k < p->dim; k++) {
            const double x = p->xs[i * (size_t)p->dim + (size_t)k];
            in = in && (closed ? x >= lo[k] && x <= hi[k] : (anchored || x > lo[k]) && x < hi[k]);
        }
        inside += in;
    }
    return fabs((double)inside / (double)p->n - volume);
}

static double brute_star(const koksma_points *p)
{
    const levels l = levels_of(p);
    const double zero[3] = {0};
    double best = 0;
    for (int a = 0; a < l.count[0]; a++) {
        for (int b = 0; b < l.count[1]; b++) {
            for (int c = 0; c < l.count[2]; c++) {
                const double hi[3] = {l.at[0][a], l.at[1][b], l.at[2][c]};
                best = fmax(best, deviation(p, zero, hi, true, true));
                best = fmax(best, deviation(p, zero, hi, false, true));
            }
        }
    }
    return best;
}

static double brute_extreme(const koksma_points *p)
{
    const levels l = levels_of(p);
    double best = 0;
    const int third = p->dim == 3 ? l.count[2] : 1;
    for (int a = 0; a < l.count[0] * l.count[0]; a++) {
        for (int b = 0; b < l.count[1] * l.count[1]; b++) {
            for (int c = 0; c < third * third; c++) {
                const double lo[3] = {l.at[0][a / l.count[0]], l.at[1][b / l.count[1]], l.at[2][c / third]};
                const double hi[3] = {l.at[0][a % l.count[0]], l.at[1][b % l.count[1]], l.at[2][c % third]};
                if (lo[0] <= hi[0] && lo[1] <= hi[1] && (p->dim < 3 || lo[2] <= hi[2])) {
                    best = fmax(best, deviation(p, lo, hi, true, false));
                    best = fmax(best, deviation(p, lo, hi, false, false));
                }
            }
        }
    }
    return best;
}

static double brute_extreme_grid(const koksma_points *p, int m)
{
    double best = 0;
    for (int code = 0; code < m * m * m * m; code++) {
        const int a = code % m, b = code / m % m + 1, c = code / m / m % m, d = code / m / m / m + 1;
        size_t inside = 0;
        for (size_t i = 0; i < p->n && a < b && c < d; i++) {
            const double x = p->xs[2 * i], y = p->xs[2 * i + 1];
            inside += x >= (double)a / m && x < (double)b / m && y >= (double)c / m && y < (double)d / m;
        }
        if (a < b && c < d) {
            best = fmax(best, fabs((double)inside / (double)p->n - (double)(b - a) * (d - c) / ((double)m * m)));
        }
    }
    return best;
}

/* Over the corners of a grid of m x m, with the points on the sides counted (Shirley 1991, table 5.6's note). */
static double brute_star_grid(const koksma_points *p, int m)
{
    double best = 0;
    for (int code = 0; code < (m + 1) * (m + 1); code++) {
        const double x = (double)(code % (m + 1)) / m, y = (double)(code / (m + 1)) / m;
        size_t inside = 0;
        for (size_t i = 0; i < p->n; i++) {
            inside += p->xs[2 * i] <= x && p->xs[2 * i + 1] <= y;
        }
        best = fmax(best, fabs((double)inside / (double)p->n - x * y));
    }
    return best;
}

/* The integral of (count/n - x y z)^2 over the cells between neighbouring levels, in each of which count is fixed. */
static double brute_l2_star(const koksma_points *p)
{
    const levels l = levels_of(p);
    const int third = p->dim == 3 ? l.count[2] - 1 : 1;
    long double sum = 0;
    for (int a = 0; a + 1 < l.count[0]; a++) {
        for (int b = 0; b + 1 < l.count[1]; b++) {
            for (int c = 0; c < third; c++) {
                const int at[3] = {a, b, c};
                long double first = 1, second = 1, volume = 1;
                size_t inside = 0;
                for (int k = 0; k < p->dim; k++) {
                    const long double lo = l.at[k][at[k]], hi = l.at[k][at[k] + 1];
                    volume *= hi - lo;
                    first *= (hi * hi - lo * lo) / 2;
                    second *= (hi * hi * hi - lo * lo * lo) / 3;
                }
                for (size_t i = 0; i < p->n; i++) {
                    bool in = true;
                    for (int k = 0; k < p->dim; k++) {
                        in = in && p->xs[i * (size_t)p->dim + (size_t)k] <= l.at[k][at[k]];
                    }
                    inside += in;
                }
                const long double share = (long double)inside / (long double)p->n;
                sum += share * share * volume - 2 * share * first + second;
            }
        }
    }
    return (double)sqrtl(sum > 0 ? sum : 0);
}

typedef double twin(const koksma_points *points);

static double brute_grid7(const koksma_points *p)
{
    return brute_extreme_grid(p, 7);
}

static double brute_grid4(const koksma_points *p)
{
    return brute_extreme_grid(p, 4);
}

static double brute_corners9(const koksma_points *p)
{
    return brute_star_grid(p, 9);
}

static double brute_corners4(const koksma_points *p)
{
    return brute_star_grid(p, 4);
}

static void compare_sets(const char *measure, twin *brute, int dim, size_t max_n, int sets, double bound)
{
    for (int s = 0; s < sets; s++) {
        const size_t n = 1 + (size_t)(s / SETS_KINDS) % max_n;
        koksma_points p = sets_points(n, dim, s % SETS_KINDS, (uint64_t)s);
        const double ours = test_measure(measure, &p).value, theirs = brute(&p);
        if (!(fabs(ours - theirs) <= bound)) {
            sets_print(&p);
            fail_msg("%s of set %d: %.17g, brute force %.17g", measure, s, ours, theirs);
        }
        koksma_points_fini(&p);
    }
}

TEST_CASE(star_equals_brute_force)
{
    compare_sets("star", brute_star, 2, 20, 2400, 1e-15);
    compare_sets("star", brute_star, 3, 9, 600, 1e-15);
}

TEST_CASE(extreme_equals_brute_force)
{
    compare_sets("extreme", brute_extreme, 2, 8, 2000, 1e-15);
    compare_sets("extreme", brute_extreme, 3, 3, 150, 1e-15);
}

TEST_CASE(extreme_grid_equals_brute_force)
{
    compare_sets("extreme:grid=7", brute_grid7, 2, 12, 600, 1e-15);
    compare_sets("extreme:grid=4", brute_grid4, 2, 12, 1500, 1e-15);
}

TEST_CASE(star_grid_equals_brute_force)
{
    compare_sets("star:grid=9", brute_corners9, 2, 12, 600, 1e-15);
    compare_sets("star:grid=4", brute_corners4, 2, 12, 1500, 1e-15);
}

TEST_CASE(l2_star_equals_its_integral)
{
    compare_sets("l2-star", brute_l2_star, 2, 16, 2000, 1e-14);
    compare_sets("l2-star", brute_l2_star, 3, 8, 600, 1e-14);
}
