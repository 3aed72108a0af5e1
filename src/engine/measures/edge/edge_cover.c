/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Bounds for the discrepancy of half-planes. The domain (the unit square, a disk or a triangle) lies within distance
 * rho of a centre. Turning a line about a point of the domain by up to eta moves the part of the line in the domain
 * by at most s = 2 rho sin(eta/2). So a half-plane whose direction differs by up to eta from a middle direction lies,
 * within the domain, between two half-planes of the middle direction that are shifted inward and outward by s. The
 * counts and masses (areas in the domain, as shares of its area) of these two half-planes bound those of the given
 * one. Over all lines of an interval of directions this gives
 *
 *     excess <= max_c #{x below c}/n - mass(below c - 2s),    deficit <= max_c mass(below c + 2s) - #{x below c}/n,
 *
 * where both bounds are computed from the points sorted along the middle direction. Intervals whose bound exceeds the
 * value of the best line found so far are halved.
 */
#include "measures/edge/edge.h"

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "measures/shared/shared.h"

enum { FIRST_CUTS = 32, MAX_CUTS = 1 << 20 };

static const double finest =
    1e-9; /* smallest width of an interval; near a smooth maximum about width^-1/2 intervals cannot be excluded */

/* An interval of directions, within half a width of the middle one, and the bound for its lines. */
typedef struct cut {
    double middle, bound;
    koksma__edge_line line; /* the best half-plane found in the middle direction */
} cut;

typedef struct cover {
    const koksma__domain *domain;
    size_t n;
    const double *xs;
    double width, deadline_s;
    cut *cuts;
} cover;

/* Returns the mass below the line with unit normal (a, b) at signed distance c from the origin. */
static double mass_below(const cover *v, double a, double b, double c)
{
    return v->domain->area_below_through(a, b, (double[2]){a * c, b * c});
}

/* Bounds an interval and finds the best line of its middle direction (a, b). t[i]: the coordinate of point i along
   (a, b); at: the indices of the points in order of t. */
static void bound_cut(const cover *v, cut *now, double a, double b, const double *t, const uint32_t *at)
{
    const double n = (double)v->n, slack = 4 * v->domain->radius * koksma__sin(v->width / 4) + 1e-14;
    double bounds[2] = {-1, -1};
    size_t best[2] = {0, 0}; /* positions, in the sorted order, of the largest excess and of the largest deficit */
    for (size_t r = 0; r < v->n; r++) {
        const double c = t[at[r]];
        const double excess = (double)(r + 1) / n - mass_below(v, a, b, c - slack);
        const double deficit = mass_below(v, a, b, c + slack) - (double)r / n;
        best[0] = excess > bounds[0] ? r : best[0];
        best[1] = deficit > bounds[1] ? r : best[1];
        bounds[0] = fmax(bounds[0], excess);
        bounds[1] = fmax(bounds[1], deficit);
    }
    now->bound = fmin(now->bound, fmax(bounds[0], bounds[1]) + 1e-14);
    for (int open = 0; open < 2; open++) {
        size_t from = best[open], end = from + 1;
        const double c = t[at[from]];
        for (; from > 0 && t[at[from - 1]] == c; from--) {
        }
        for (; end < v->n && t[at[end]] == c; end++) {
        }
        const double mass = v->domain->area_below_through(a, b, v->xs + 2 * (size_t)at[from]);
        const double value = open ? mass - (double)from / n : (double)end / n - mass;
        if (value > now->line.value) {
            now->line = (koksma__edge_line){value, a, b, c, mass, open ? from : end, !open};
        }
    }
}

static koksma_status look_along(void *context, size_t block)
{
    const cover *v = context;
    cut *now = &v->cuts[block];
    const size_t bytes = v->n * (2 * sizeof(double) + sizeof(uint32_t));
    const double a = koksma__cos(now->middle), b = koksma__sin(now->middle);
    double *t = koksma__now_s() < v->deadline_s ? malloc(bytes) : NULL, low = INFINITY, high = -INFINITY;
    if (!t) {
        return KOKSMA_OK; /* the bound of the wider interval that contains this one is also a bound here */
    }
    double *scaled = t + v->n;
    uint32_t *order = (uint32_t *)(scaled + v->n);
    for (size_t i = 0; i < v->n; i++) {
        t[i] = a * v->xs[2 * i] + b * v->xs[2 * i + 1];
        low = fmin(low, t[i]);
        high = fmax(high, t[i]);
    }
    for (size_t i = 0; i < v->n; i++) {
        scaled[i] = (t[i] - low) / (high > low ? high - low : 1);
    }
    static const koksma_run alone = {.threads = 1};
    const koksma_status status = koksma__order(&alone, v->n, scaled, 1, order);
    if (!status) {
        bound_cut(v, now, a, b, t, order);
    }
    free(t);
    return status;
}

/* Writes to `to` the two halves of each interval whose bound exceeds `lower`. Returns the number of halves. */
static size_t halve(const cover *v, size_t count, double lower, cut *to)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        for (int half = -1; half <= 1 && v->cuts[i].bound > lower; half += 2) {
            to[kept] = v->cuts[i];
            to[kept].line.value = -1;
            to[kept++].middle += half * v->width / 4;
        }
    }
    return kept;
}

/* Halves, in rounds, the intervals of directions that may contain a better line. The search stops when no such
   interval is left, when the deadline has passed, or when the intervals are too many or too narrow. */
static koksma_status refine(cover *v, const koksma_run *run, koksma__edge_line *best, double *upper)
{
    size_t count = FIRST_CUTS;
    for (size_t i = 0; i < count; i++) {
        v->cuts[i] = (cut){.middle = ((double)i + 0.5) * M_PI / FIRST_CUTS, .bound = 1, .line.value = -1};
    }
    for (v->width = M_PI / FIRST_CUTS;; v->width /= 2) {
        KOKSMA__TRY(koksma__parallel(run, count, look_along, v));
        *upper = best->value;
        for (size_t i = 0; i < count; i++) {
            *best = v->cuts[i].line.value > best->value ? v->cuts[i].line : *best;
            *upper = fmax(*upper, fmax(v->cuts[i].bound, best->value));
        }
        size_t open = 0;
        for (size_t i = 0; i < count; i++) {
            open += v->cuts[i].bound > best->value;
        }
        if (open == 0 || open > MAX_CUTS / 2 || v->width < finest || koksma__now_s() >= v->deadline_s) {
            *upper = open == 0 ? best->value : *upper;
            return KOKSMA_OK;
        }
        cut *const halves = malloc(2 * open * sizeof *halves);
        KOKSMA__REQUIRE_MEMORY(halves, 2 * open * sizeof *halves);
        count = halve(v, count, best->value, halves);
        free(v->cuts);
        v->cuts = halves;
    }
}

koksma_status koksma__edge_cover(const koksma__domain *domain, size_t n, const double *xs, const koksma_run *run,
                                 double deadline_s, koksma__edge_line *best, double *upper)
{
    cover v = {.domain = domain, .n = n, .xs = xs, .deadline_s = deadline_s};
    v.cuts = malloc(FIRST_CUTS * sizeof *v.cuts);
    KOKSMA__REQUIRE_MEMORY(v.cuts, FIRST_CUTS * sizeof *v.cuts);
    const koksma_status status = refine(&v, run, best, upper);
    free(v.cuts);
    return status;
}
