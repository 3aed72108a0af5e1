/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The numbers of points: how they lie in the unit cube, and how they were rounded.
 *
 * Coordinates outside [0,1] are taken for whole numbers below n (divided by n), for [-1/2,1/2] (offsets from a pixel's
 * centre), for [-1,1], or for a box whose bounds are the roundest decimals within 3/n of its width around the points.
 * Numbers that all are floats, all multiples of 2^-k with k <= 32, or all decimals of up to 12 places may be rounded
 * ones: they are compared within such a rounding, after an attempt with the precision of double.
 */
#include <math.h>

#include "core/elementary.h"
#include "core/status.h"
#include "identify/sample.h"

/* Returns the decimal with the fewest digits in [lo, hi]. */
static double roundest(double lo, double hi)
{
    if (lo <= 0 && hi >= 0) {
        return 0;
    }
    for (int e = 18; e >= -18; e--) {
        const double unit = koksma__pow(10, e), up = ceil(lo / unit - 1e-12 * fabs(lo / unit));
        if (up * unit <= hi + 1e-12 * fabs(hi)) {
            return e < 0 ? up / koksma__pow(10, -e) : up * unit;
        }
    }
    return lo;
}

typedef struct bounds {
    double lo, hi;
} bounds;

static void map_coordinate(koksma_points *points, int k, bounds b)
{
    for (size_t i = 0; i < points->n; i++) {
        double *x = &points->xs[i * (size_t)points->dim + (size_t)k];
        *x = fmin(1, fmax(0, (*x - b.lo) / (b.hi - b.lo)));
    }
}

koksma_status koksma__map_to_cube(koksma__sample *s)
{
    koksma_points *points = &s->points;
    const size_t n = points->n, dim = (size_t)points->dim;
    double least = INFINITY, most = -INFINITY;
    bool whole = true;
    for (size_t i = 0; i < n * dim; i++) {
        KOKSMA__FAIL_IF(!isfinite(points->xs[i]), KOKSMA_ARGUMENT, "identify: point %zu: a coordinate is not finite",
                        i / dim);
        least = fmin(least, points->xs[i]);
        most = fmax(most, points->xs[i]);
        whole = whole && points->xs[i] == floor(points->xs[i]);
    }
    if (least >= 0 && most <= 1) {
        return KOKSMA_OK;
    }
    char text[400] = "";
    s->largest = fmax(-least, most);
    s->width = INFINITY;
    const bool indices = whole && least >= 0 && most < (double)n, centred = least >= -1 && most <= 1;
    for (size_t k = 0; k < dim; k++) {
        bounds b = {0, (double)n};
        if (centred && !indices) {
            b = least >= -.5 && most <= .5 ? (bounds){-.5, .5} : (bounds){-1, 1};
        } else if (!indices) {
            bounds x = {INFINITY, -INFINITY};
            for (size_t i = 0; i < n; i++) {
                x.lo = fmin(x.lo, points->xs[i * dim + k]);
                x.hi = fmax(x.hi, points->xs[i * dim + k]);
            }
            const double margin = 3 * (x.hi - x.lo) / (double)n + (x.hi == x.lo);
            b = (bounds){roundest(x.lo - margin, x.lo), roundest(x.hi, x.hi + margin)};
        }
        koksma__append(text, sizeof text, "%s[%g, %g]", k ? " x " : "", b.lo, b.hi);
        map_coordinate(points, (int)k, b);
        s->width = fmin(s->width, b.hi - b.lo);
    }
    return koksma__say(s, "scaled", "mapped to the unit cube", "", 0,
                       indices ? "whole numbers, divided by n: %s" : "from %s", text);
}

static bool all_multiples(const koksma_points *points, double scale, double slack)
{
    for (size_t i = 0; i < points->n * (size_t)points->dim; i++) {
        const double x = points->xs[i] * scale;
        if (fabs(x - nearbyint(x)) > slack) {
            return false;
        }
    }
    return true;
}

static bool all_floats(const koksma_points *points)
{
    for (size_t i = 0; i < points->n * (size_t)points->dim; i++) {
        if ((double)(float)points->xs[i] < points->xs[i] || (double)(float)points->xs[i] > points->xs[i]) {
            return false;
        }
    }
    return true;
}

int koksma__precisions(koksma__sample *s, const koksma_points *points, double tolerances[KOKSMA__PRECISIONS])
{
    int count = 0;
    const double most = s->width / (64 * (double)points->n); /* more would leave little to compare */
    const double ulp = ldexp(s->largest, -24);
    int bits = 1;
    tolerances[count++] = s->found->count ? fmax(s->largest / s->width, 8) * 0x1p-50 : 0x1p-50;
    while (bits <= 32 && !all_multiples(points, ldexp(1, bits), 0)) {
        bits++;
    }
    if (bits <= 32 && ldexp(1, -bits) <= most) {
        tolerances[count++] = ldexp(1, -bits) / s->width;
    }
    for (int d = 2; d <= 12 && bits > 32; d++) {
        if (all_multiples(points, koksma__pow(10, d), 1e-3 * koksma__pow(10, d - 12))) {
            tolerances[count] = koksma__pow(10, -d) / s->width;
            count += koksma__pow(10, -d) <= most;
            s->few_digits = koksma__pow(10, -d) > most ? koksma__pow(10, -d) / s->width : 0;
            return count;
        }
    }
    s->floats = bits > 24 && ulp <= most && all_floats(points);
    if (s->floats) {
        tolerances[count++] = ulp / s->width;
    }
    return count;
}
