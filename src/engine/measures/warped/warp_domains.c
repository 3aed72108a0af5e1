/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The disk, the triangle, the hemisphere and the sphere as domains of random lines or great circles: the probability
 * that one of them separates two points, the integral of this probability over the second point (potential), and the
 * integral of the potential (constant).
 */
#include "core/elementary.h"
#include "measures/warped/warped.h"

#include <math.h>

#include "measures/edge/edge.h"

enum { NODES = 64 };

/* Gauss-Legendre nodes and weights on (0, 1), by Newton's iteration on the Legendre polynomial. */
static void gauss(int n, double *x, double *w)
{
    for (int i = 0; i < n; i++) {
        double z = koksma__cos(M_PI * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int step = 0; step < 8; step++) {
            double p0 = 1, p1 = z;
            for (int k = 2; k <= n; k++) {
                const double p2 = ((2 * k - 1) * z * p1 - (k - 1) * p0) / k;
                p0 = p1;
                p1 = p2;
            }
            slope = n * (z * p1 - p0) / (z * z - 1);
            z -= p1 / slope;
        }
        x[i] = (1 - z) / 2;
        w[i] = 1 / ((1 - z * z) * slope * slope);
    }
}

/* ---- The unit disk ------------------------------------------------------------------------------------ */

/* Returns the share of the disk in the half-plane below the line with normal (a, b) through p, from the area of a
   circular segment. */
static double below_in_disk(double a, double b, const double p[2])
{
    const double length = koksma__hypot(a, b), t = (a * p[0] + b * p[1]) / length;
    const double h = t < -1 ? -1 : t > 1 ? 1 : t;
    return (koksma__acos(-h) + h * sqrt((1 - h) * (1 + h))) / M_PI;
}

/* The chord with midpoint p is perpendicular to the radius. If p is the centre, every diameter is such a chord with
   equal areas on both sides, so one of them is enough. */
static void chords_of_disk(const double p[2], koksma__chord chords[KOKSMA__MAX_CHORDS])
{
    const bool central = p[0] == 0 && p[1] == 0;
    chords[0] = central ? (koksma__chord){{1, 0}, {0, 0}} : (koksma__chord){{0, p[1]}, {p[0], 0}};
}

/* Returns the mean distance between p and a uniform random point of the unit disk,

       4 / (9 pi) ((rho^2 + 7) E - 4 (1 - rho^2) K),

   where rho is the distance of p from the centre. K and E are the complete elliptic integrals of modulus rho, computed by
   the arithmetic-geometric mean. */
static double mean_distance_in_disk(const double *p)
{
    const double m = fmin(p[0] * p[0] + p[1] * p[1], 1);
    if (m > 1 - 1e-15) {
        return 32 / (9 * M_PI);
    }
    double a = 1, g = sqrt(1 - m), sum = m / 2, power = 0.5;
    for (int i = 0; i < 40 && fabs(a - g) > 1e-17; i++) {
        const double c = (a - g) / 2, mean = (a + g) / 2;
        g = sqrt(a * g);
        a = mean;
        power *= 2;
        sum += power * c * c;
    }
    const double first = M_PI_2 / a, second = first * (1 - sum);
    return 4 / (9 * M_PI) * ((m + 7) * second - 4 * (1 - m) * first);
}

double koksma__disks_share(double r, double distance)
{
    if (distance >= 1 + r) {
        return 0;
    }
    const double small = fmin(r, 1);
    if (distance <= fabs(1 - r)) {
        return M_PI * small * small;
    }
    /* The overlap consists of two circular segments. Heron's formula gives the area of the triangle of the two
       centres and a point where the circles meet, without cancellation where the circles touch. */
    const double square = distance * distance, rest = (1 - r) * (1 + r);
    const double height =
        sqrt(fmax((1 + r - distance) * (distance + r - 1) * (distance - r + 1) * (distance + r + 1), 0));
    return koksma__atan2(height, square + rest) + r * r * koksma__atan2(height, square - rest) - height / 2;
}

/* ---- The triangle (0,0) (1,0) (0,1) ------------------------------------------------------------------- */

static const double corners[4][2] = {{0, 0}, {1, 0}, {0, 1}, {0, 0}};

static double below_in_triangle(double a, double b, const double p[2])
{
    double polygon[8][2], area = 0;
    int m = 0;
    for (int c = 0; c < 3; c++) {
        const double *u = corners[c], *v = corners[c + 1];
        const double su = a * (p[0] - u[0]) + b * (p[1] - u[1]), sv = a * (p[0] - v[0]) + b * (p[1] - v[1]);
        if (su >= 0) {
            polygon[m][0] = u[0];
            polygon[m++][1] = u[1];
        }
        if ((su > 0 && sv < 0) || (su < 0 && sv > 0)) {
            polygon[m][0] = u[0] + su / (su - sv) * (v[0] - u[0]);
            polygon[m++][1] = u[1] + su / (su - sv) * (v[1] - u[1]);
        }
    }
    for (int c = 0; c < m; c++) {
        area += polygon[c][0] * polygon[(c + 1) % m][1] - polygon[c][1] * polygon[(c + 1) % m][0];
    }
    return area; /* twice the area of the polygon, which is its share of the triangle because the triangle has area
                    1/2 */
}

/* For each corner of the triangle, with s and t the barycentric coordinates of p at the other two corners, p is the
   midpoint of the points at 2s and 2t along the two edges from this corner. If p is a corner, this chord has length
   0, and the two edges at the corner are used instead. Barycentric coordinates that are negative because of rounding
   in maps count as 0. */
static void chords_of_triangle(const double p[2], koksma__chord chords[KOKSMA__MAX_CHORDS])
{
    const double share[3] = {fmax(1 - p[0] - p[1], 0), fmax(p[0], 0), fmax(p[1], 0)};
    for (int c = 0; c < 3; c++) {
        const double s = share[(c + 1) % 3], t = share[(c + 2) % 3];
        const double *here = corners[c], *e1 = corners[(c + 1) % 3], *e2 = corners[(c + 2) % 3];
        if (s == 0 && t == 0) {
            chords[0] = (koksma__chord){{e1[0], here[0]}, {e1[1], here[1]}};
            chords[1] = (koksma__chord){{e2[0], here[0]}, {e2[1], here[1]}};
            return;
        }
        if (s <= 0.5 && t <= 0.5) {
            chords[c].across[0] = t * (e2[0] - here[0]) - s * (e1[0] - here[0]);
            chords[c].up[0] = t * (e2[1] - here[1]) - s * (e1[1] - here[1]);
        }
    }
}

/* Returns the integral of the distance from p over the triangle that p forms with an edge. */
static double edge_integral(const double p[2], const double u[2], const double v[2])
{
    const double dx = v[0] - u[0], dy = v[1] - u[1], length = koksma__hypot(dx, dy);
    const double h = fabs(dx * (u[1] - p[1]) - dy * (u[0] - p[0])) / length;
    if (h < 1e-150) {
        return 0;
    }
    double sum = 0;
    for (int end = 0; end < 2; end++) {
        const double *e = end ? v : u, t = (dx * (e[0] - p[0]) + dy * (e[1] - p[1])) / length / h;
        sum += (end ? 1 : -1) * (t * sqrt(1 + t * t) + koksma__asinh(t)) / 2;
    }
    return h * h * h * sum / 3;
}

static double mean_distance_in_triangle(const double *p)
{
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        sum += edge_integral(p, corners[c], corners[c + 1]);
    }
    return 2 * sum;
}

static double triangle_constant(void)
{
    double x[NODES], w[NODES], sum = 0;
    gauss(NODES, x, w);
    for (int i = 0; i < NODES; i++) {
        for (int j = 0; j < NODES; j++) {
            const double p[2] = {x[i] * (1 - x[j]), x[i] * x[j]};
            sum += 2 * w[i] * w[j] * x[i] * koksma__domain_potential(KOKSMA__TRIANGLE, p);
        }
    }
    return sum;
}

/* ---- The hemisphere z >= 0 ---------------------------------------------------------------------------- */

/* If the normal of a plane through the centre is at angle theta from the pole, a fraction 1 - theta/pi of the
   hemisphere is on the side of the normal. The potential P of a point p at angle alpha from the pole is the mean of
   theta/pi over the normals on the side of p. */
static double hemisphere_potential(const double *p)
{
    const double alpha = koksma__atan2(koksma__hypot(p[0], p[1]), p[2]);
    double x[NODES], w[NODES], sum = 0;
    gauss(NODES, x, w);
    for (int i = 0; i < NODES; i++) {
        const double below = x[i] * (M_PI_2 - alpha); /* all normals at this theta are on the side of p */
        const double phase = M_PI * (x[i] - 0.5), theta = M_PI_2 + alpha * koksma__sin(phase);
        const double cotangents =
            alpha > 0 ? koksma__cos(theta) / koksma__sin(theta) * koksma__cos(alpha) / koksma__sin(alpha) : 0;
        const double part = koksma__acos(fmin(1, fmax(-1, -cotangents))) / M_PI;
        sum += w[i] * (M_PI_2 - alpha) * below * koksma__sin(below);
        sum += w[i] * M_PI * alpha * koksma__cos(phase) * theta * koksma__sin(theta) * part;
    }
    return sum / M_PI;
}

/* ---- All ---------------------------------------------------------------------------------------------- */

const koksma__domain koksma__domains[2] = {
    {below_in_disk, chords_of_disk, 1},
    {below_in_triangle, chords_of_triangle, M_SQRT1_2},
};

/* 2 / perimeter (Crofton's formula): the measure of the lines that meet a convex domain is its perimeter, and that of
 * the lines that meet a segment is twice the segment's length. */
static double line_density(koksma__domain_kind kind)
{
    return kind == KOKSMA__DISK ? 1 / M_PI : 2 / (2 + M_SQRT2);
}

double koksma__domain_separates(koksma__domain_kind kind, const double *p, const double *q)
{
    if (kind < KOKSMA__HEMISPHERE) {
        return line_density(kind) * koksma__hypot(p[0] - q[0], p[1] - q[1]);
    }
    double minus = 0, plus = 0;
    for (int k = 0; k < 3; k++) {
        minus += (p[k] - q[k]) * (p[k] - q[k]);
        plus += (p[k] + q[k]) * (p[k] + q[k]);
    }
    return 2 * koksma__atan2(sqrt(minus), sqrt(plus)) /
           M_PI; /* for nearly opposite points this is more accurate than the arc sine of half the distance */
}

double koksma__domain_potential(koksma__domain_kind kind, const double *p)
{
    if (kind == KOKSMA__HEMISPHERE) {
        return hemisphere_potential(p);
    }
    if (kind == KOKSMA__SPHERE) {
        return 0.5; /* by symmetry: a point and its opposite are on different sides of every plane */
    }
    return line_density(kind) * (kind == KOKSMA__DISK ? mean_distance_in_disk : mean_distance_in_triangle)(p);
}

double koksma__domain_constant(koksma__domain_kind kind)
{
    if (kind == KOKSMA__DISK) {
        return 128 / (45 * M_PI * M_PI);
    }
    return kind == KOKSMA__TRIANGLE ? triangle_constant() : kind == KOKSMA__SPHERE ? 0.5 : 4 / (M_PI * M_PI);
}
