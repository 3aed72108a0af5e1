/* SPDX-License-Identifier: Apache-2.0 */
/*
 * All shadow rays from a part F of a surface to a light L lie in the convex hull of both. A shape in a sphere of centre
 * c and radius r blocks none of them if a plane separates the hull from the sphere:
 *
 *     a.(x - c) > r for all corners x of F and L, for some unit vector a.
 *
 * The only vector a that is tried points from the centre c to the nearest point of the line from the middle of F to
 * the middle of L.
 *
 * batch_shapes.c computes in floats, so r is increased by 2^-9 R, where R is the largest coordinate. The test of a
 * sphere compares squares that are off by about 10 units in the last place, 10 2^-24 R^2; the margin changes them by
 * more than 2^-18 R^2. A hit position has an error of 10 2^-24 R divided by the sine of the angle between ray and
 * surface, which frustum_cull.c bounds.
 */
#include "render/shadow_cull.h"

#include <math.h>

#define MARGIN 0x1p-9

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The corners of the light, and its middle. */
static void corners_of(const koksma__batch_light *l, double corners[4][3], double middle[3])
{
    for (int k = 0; k < 3; k++) {
        const double x = (double)l->edge_x[k], y = (double)l->edge_y[k], c = (double)l->corner[k];
        const double at[4] = {c, c + x, c + y, c + x + y};
        for (int i = 0; i < 4; i++) {
            corners[i][k] = at[i];
        }
        middle[k] = c + (x + y) / 2;
    }
}

/* The vector from c to the nearest point of the line through f and g. */
static void nearest(const double f[3], const double g[3], const double c[3], double to[3])
{
    double along[3], from[3];
    for (int k = 0; k < 3; k++) {
        along[k] = g[k] - f[k];
        from[k] = f[k] - c[k];
    }
    const double t = -dot(from, along) / dot(along, along), in = t > 0 ? t < 1 ? t : 1 : 0;
    for (int k = 0; k < 3; k++) {
        to[k] = from[k] + in * along[k];
    }
}

/* The smallest a.(x - c) over n points x; *size is raised to the largest sum of the absolute coordinates of a
   point. */
static double least(const double (*at)[3], int n, const double a[3], const double c[3], double *size)
{
    double low = (double)INFINITY;
    for (int i = 0; i < n; i++) {
        const double x[3] = {at[i][0] - c[0], at[i][1] - c[1], at[i][2] - c[2]};
        low = fmin(low, dot(a, x));
        *size = fmax(*size, fabs(at[i][0]) + fabs(at[i][1]) + fabs(at[i][2]));
    }
    return low;
}

bool koksma__shadow_cull_clear(const koksma__footprint *part, const koksma__batch_light *light,
                               const koksma__batch_shape *shape)
{
    const double c[3] = {(double)shape->centre[0], (double)shape->centre[1], (double)shape->centre[2]};
    const double radius =
        shape->is_flat ? hypot((double)shape->half_u, (double)shape->half_v) : sqrt((double)shape->radius2);
    double corners[4][3], g[3], f[3] = {0, 0, 0}, a[3], size = fabs(c[0]) + fabs(c[1]) + fabs(c[2]) + radius;
    corners_of(light, corners, g);
    for (int i = 0; i < part->n; i++) {
        for (int k = 0; k < 3; k++) {
            f[k] += part->at[i][k] / part->n;
        }
    }
    nearest(f, g, c, a);
    const double lit = least((const double(*)[3])corners, 4, a, c, &size);
    const double seen = least(part->at, part->n, a, c, &size), length = sqrt(dot(a, a));
    const double reach = radius + MARGIN * (size + part->radius);
    return !shape->moves && !shape->turns && lit > reach * length && seen > (reach + part->radius) * length;
}
