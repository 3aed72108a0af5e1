/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Lines and the unit square: the area on one side of a line, from the triangles at corners that the line cuts off;
 * the probability sigma that a random line separates two points, for each distribution ("law") of lines; and the
 * integrals of sigma over the square (potential and constant), by closed forms or by the double exponential rule. The
 * formulas are in measures/l2_edge.c.
 */
#include "measures/edge/edge.h"

#include <math.h>

#include "core/elementary.h"
#include "core/random.h"
#include "core/status.h"

const char *const koksma__line_laws[] = {"isotropic", "mitchell", NULL};

koksma_status koksma__fail_law_of_plane(const char *measure)
{
    return koksma__fail(KOKSMA_ARGUMENT,
                        "%s: law=mitchell is only for lines in the plane; use law=isotropic in 3 dimensions",
                        measure);
}

/* Returns the area of the triangle that a line cuts off from a corner at distances c/a and c/b. */
static double triangle(double a, double b, double c)
{
    return a * b > 0x1p-900 ? c * c / (2 * a * b) : c / a * (c / b) / 2;
}

/* Returns the area of the part of the square with a x + b y <= c, for a >= b >= 0. */
static double corner_area(double a, double b, double c)
{
    if (c <= 0) {
        return 0;
    }
    if (c <= b) {
        return triangle(a, b, c);
    }
    return c <= a ? (c - b / 2) / a : c < a + b ? 1 - triangle(a, b, a + b - c) : 1;
}

static double positive_area(double a, double b, double c)
{
    return a >= b ? corner_area(a, b, c) : corner_area(b, a, c);
}

double koksma__area_below(double a, double b, double c)
{
    return positive_area(fabs(a), fabs(b), c + (a < 0 ? -a : 0) + (b < 0 ? -b : 0));
}

double koksma__area_below_through(double a, double b, const double p[2])
{
    if (fabs(a) < 0x1p-400 && fabs(b) < 0x1p-400) { /* the general formula would lose digits here */
        a *= 0x1p600;
        b *= 0x1p600;
    }
    const double x = a < 0 ? 1 - p[0] : p[0], y = b < 0 ? 1 - p[1] : p[1];
    return positive_area(fabs(a), fabs(b), fabs(a) * x + fabs(b) * y);
}

double koksma__line_separates(koksma__line_law law, double dx, double dy)
{
    const double x = fabs(dx), y = fabs(dy);
    if (law == KOKSMA__LINES_ISOTROPIC) {
        return sqrt(x * x + y * y) / 2;
    }
    const double a = x > y ? x : y, b = x > y ? y : x;
    return a > 0 ? ((a + b) * koksma__log1p(b / a) + a - b) / 2 : 0;
}

/* Returns the integral of sigma(1, s) over 0 < s < t. */
static double integral(koksma__line_law law, double t)
{
    if (law == KOKSMA__LINES_ISOTROPIC) {
        return (t * koksma__hypot(1, t) + koksma__asinh(t)) / 4;
    }
    const double first = t < 1 ? t : 1, s = (1 + first) * (1 + first);
    double sum = (s / 2 * koksma__log1p(first) - (s - 1) / 4 + first - first * first / 2) / 2;
    if (t > 1) {
        sum += ((1 + t) * (1 + t) / 2 * koksma__log1p(1 / t) + (koksma__log(t) + t) / 2 + t * t / 2 - t) / 2;
        sum -= (2 * M_LN2 + 0.5 + 0.5 - 1) / 2;
    }
    return sum;
}

/* Returns the integral of sigma over [0, a] x [0, b]. */
static double rectangle(koksma__line_law law, double a, double b)
{
    if (a < 1e-90 || b < 1e-90) {
        return 0;
    }
    return (a * a * a * integral(law, b / a) + b * b * b * integral(law, a / b)) / 3;
}

/* The same of isotropic lines: over [0, a] x [0, b] it is (2 a b r + a^3 asinh(b/a) + b^3 asinh(a/b)) / 12 with r^2 = a^2 +
   b^2, and asinh(b/a) = log((b + r) / a), so that two rectangles with a common side share a logarithm. */
static double isotropic_potential(const double p[2])
{
    const double a[2] = {p[0], 1 - p[0]}, b[2] = {p[1], 1 - p[1]};
    double sum = 0, far[2] = {1, 1}, high[2] = {1, 1};
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) {
            const double r = sqrt(a[i] * a[i] + b[j] * b[j]);
            sum += 2 * a[i] * b[j] * r;
            far[i] *= b[j] + r;
            high[j] *= a[i] + r;
        }
    }
    for (int k = 0; k < 2; k++) {
        sum += a[k] < 1e-90 ? 0 : a[k] * a[k] * a[k] * koksma__log(far[k] / (a[k] * a[k]));
        sum += b[k] < 1e-90 ? 0 : b[k] * b[k] * b[k] * koksma__log(high[k] / (b[k] * b[k]));
    }
    return sum / 12;
}

double koksma__line_potential(koksma__line_law law, const double p[2])
{
    const double x = p[0], y = p[1];
    if (law == KOKSMA__LINES_ISOTROPIC) {
        return isotropic_potential(p);
    }
    return (rectangle(law, x, y) + rectangle(law, 1 - x, 1 - y)) +
           (rectangle(law, 1 - x, y) + rectangle(law, x, 1 - y));
}

void koksma__line_separates_slope(koksma__line_law law, double dx, double dy, double slope[2])
{
    const double x = fabs(dx), y = fabs(dy), r = sqrt(x * x + y * y), ratio = x > y ? y / x : x / y;
    slope[0] = slope[1] = 0;
    if (r > 0 && law == KOKSMA__LINES_ISOTROPIC) {
        slope[0] = dx / r / 2;
        slope[1] = dy / r / 2;
    } else if (r > 0) {
        const double far = (koksma__log1p(ratio) - ratio + 1) / 2, near = koksma__log1p(ratio) / 2;
        slope[0] = copysign(x > y ? far : near, dx);
        slope[1] = copysign(x > y ? near : far, dy);
    }
}

/* Returns the integral of sigma over a side of length b at distance a, which is the derivative of rectangle(law, a,
   b) by a. */
static double side(koksma__line_law law, double a, double b)
{
    return a < 1e-90 ? 0 : a * a * integral(law, b / a);
}

void koksma__line_potential_slope(koksma__line_law law, const double p[2], double slope[2])
{
    for (int k = 0; k < 2; k++) {
        const double x = p[k], y = p[1 - k];
        slope[k] = (side(law, x, y) + side(law, x, 1 - y)) - (side(law, 1 - x, y) + side(law, 1 - x, 1 - y));
    }
}

double koksma__line_constant(koksma__line_law law)
{
    return law == KOKSMA__LINES_ISOTROPIC ? (2 + M_SQRT2 + 5 * koksma__asinh(1)) / 30 : 8 * M_LN2 / 15 - 1.0 / 9;
}

void koksma__random_line(koksma__line_law law, uint64_t seed, uint64_t index, double *a, double *b, double *c)
{
    double r[2], s[2];
    koksma__random_pair(seed, KOKSMA__PURPOSE_SEARCH, index, 0, r);
    koksma__random_pair(seed, KOKSMA__PURPOSE_SEARCH, index, 1, s);
    if (law == KOKSMA__LINES_ISOTROPIC) {
        /* the angle of the normal has a density proportional to cos + sin, which is the width of the square */
        const double angle = M_PI_4 + koksma__asin((2 * r[0] - 1) / M_SQRT2);
        koksma__cos_sin(angle, a, b);
        *b = r[1] < 0.5 ? *b : -*b;
        *c = s[0] * (*a + fabs(*b)) + (*b < 0 ? *b : 0);
        return;
    }
    double run = r[1] - 0.5;
    run = run == 0 ? 0x1p-54 : run;
    const double m = (r[0] - 0.5) / run;
    *a = -m;
    *b = 1;
    *c = m < 0 ? (1 - m) * s[0] : 1 - (1 + m) * s[0];
}
