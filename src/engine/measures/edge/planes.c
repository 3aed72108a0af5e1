/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Half-spaces and the unit cube: volumes, and the potential P and the constant C of measures/l2_edge.c for random
 * planes.
 *
 * Volumes: the axes are exchanged and reflected so that 0 <= a <= b <= d and c <= (a + b + d) / 2. The half-space
 * a x + b y + d z <= c then cuts off the volume
 *
 *     [c^3 - (c-a)^3 - (c-b)^3 - (c-d)^3 + (c-a-b)^3] / (6 a b d),
 *
 * where terms with a negative base are left out. The terms cancel for small a, so the first two are combined into one
 * polynomial; each of the others has a base of at most a.
 *
 * Potential: the distance r from the origin is a homogeneous function of degree 1. Its integral over a box with a
 * corner at the origin is therefore a sum over the three faces that do not touch the origin: a quarter of the
 * distance of the face times the integral of r over the face, which has a closed form. The mean distance of two
 * points of the cube is from Robbins 1978.
 */
#include "measures/edge/edge.h"

#include <math.h>

#include "core/elementary.h"
#include "core/random.h"

/* Returns the volume of the part of the cube with a x + b y + d z <= c, for 0 <= a <= b <= d and c <= (a + b + d) /
   2. */
static double small_part(double a, double b, double d, double c)
{
    if (c <= a) {
        return c > 0 ? c / a * (c / b) * (c / d) / 6 : 0;
    }
    if (c >= a + b && c <= d) {
        return (c - (a + b) / 2) / d;
    }
    double part = ((c - a) / b * (c / d) + a / b * (a / d) / 3) / 2;
    if (c > b) {
        part -= (c - b) / a * ((c - b) / b) * ((c - b) / d) / 6;
    }
    if (c > d) {
        part -= (c - d) / a * ((c - d) / b) * ((c - d) / d) / 6;
    }
    return part;
}

/* Returns the volume of the part of the cube with a x + b y + d z <= c, for a, b, d >= 0. */
static double positive_volume(double a, double b, double d, double c)
{
    double swap;
    if (a > b) {
        swap = a, a = b, b = swap;
    }
    if (b > d) {
        swap = b, b = d, d = swap;
    }
    if (a > b) {
        swap = a, a = b, b = swap;
    }
    const double whole = a + b + d;
    return c <= whole / 2 ? small_part(a, b, d, c) : 1 - small_part(a, b, d, whole - c);
}

double koksma__volume_below(const double a[3], double c)
{
    for (int k = 0; k < 3; k++) {
        c -= a[k] < 0 ? a[k] : 0;
    }
    return positive_volume(fabs(a[0]), fabs(a[1]), fabs(a[2]), c);
}

double koksma__volume_below_through(const double a[3], const double p[3])
{
    double c = 0;
    for (int k = 0; k < 3; k++) {
        c += a[k] < 0 ? -a[k] * (1 - p[k]) : a[k] * p[k];
    }
    return positive_volume(fabs(a[0]), fabs(a[1]), fabs(a[2]), c);
}

/* Returns the integral of sqrt(a^2 + y^2 + z^2) over 0 < y < b, 0 < z < c. */
static double face(double a, double b, double c)
{
    const double r = sqrt(a * a + b * b + c * c);
    double sum = b * c * r / 3;
    sum += b * (b * b + 3 * a * a) / 6 * koksma__asinh(c / koksma__hypot(a, b));
    sum += c * (c * c + 3 * a * a) / 6 * koksma__asinh(b / koksma__hypot(a, c));
    return sum - a * a * a / 3 * koksma__atan2(b * c, a * r);
}

static double box(double a, double b, double c)
{
    if (a < 1e-90 || b < 1e-90 || c < 1e-90) {
        return 0;
    }
    return (a * face(a, b, c) + b * face(b, c, a) + c * face(c, a, b)) / 4;
}

double koksma__plane_potential(const double p[3])
{
    double sum = 0;
    for (int corner = 0; corner < 8; corner++) {
        sum += box(corner & 1 ? 1 - p[0] : p[0], corner & 2 ? 1 - p[1] : p[1], corner & 4 ? 1 - p[2] : p[2]);
    }
    return sum / 3;
}

/* The derivative of the integral over a box by the length of a side is the integral over the face at its end. */
void koksma__plane_potential_slope(const double p[3], double slope[3])
{
    for (int k = 0; k < 3; k++) {
        slope[k] = 0;
        for (int corner = 0; corner < 8; corner++) {
            const double a = corner & 1 ? 1 - p[k] : p[k], b = p[(k + 1) % 3], c = p[(k + 2) % 3];
            const double part = face(a, corner & 2 ? 1 - b : b, corner & 4 ? 1 - c : c) / 3;
            slope[k] += corner & 1 ? -part : part;
        }
    }
}

double koksma__plane_constant(void)
{
    const double root3 = sqrt(3.0);
    return ((4 + 17 * M_SQRT2 - 6 * root3) / 105 + koksma__log(1 + M_SQRT2) / 5 + 2 * koksma__log(2 + root3) / 5 -
            M_PI / 15) /
           3;
}

/* The density of the normal is proportional to the width of the cube, |a1| + |a2| + |a3|. This is a mixture of three
   densities, |a_k| for each axis k; an axis is chosen at random. */
void koksma__random_plane(uint64_t seed, uint64_t index, double a[3], double *c)
{
    double r[2], s[2];
    koksma__random_pair(seed, KOKSMA__PURPOSE_SEARCH, index, 4, r);
    koksma__random_pair(seed, KOKSMA__PURPOSE_SEARCH, index, 5, s);
    const double third = 3 * r[0];
    const int axis = (int)third;
    const double height2 = third - axis, across = sqrt(1 - height2), turn = 2 * M_PI * r[1];
    a[axis] = sqrt(height2);
    a[(axis + 1) % 3] = across * koksma__cos(turn);
    a[(axis + 2) % 3] = across * koksma__sin(turn);
    *c = s[0] * (fabs(a[0]) + fabs(a[1]) + fabs(a[2]));
    for (int k = 0; k < 3; k++) {
        *c += a[k] < 0 ? a[k] : 0;
    }
}
