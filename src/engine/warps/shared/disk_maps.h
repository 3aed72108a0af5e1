/* SPDX-License-Identifier: Apache-2.0 */
/* The two maps of the square onto the unit disk (concentric and polar), and two maps of the disk to the
 * hemisphere. */
#ifndef KOKSMA_WARPS_SHARED_DISK_MAPS_H
#define KOKSMA_WARPS_SHARED_DISK_MAPS_H

#include <math.h>

#include "core/elementary.h"

/* Maps squares about the centre to circles: a point (a, b) of [-1,1]^2 with |a| > |b| goes to radius a and angle
   (pi/4) b/a; one with |a| <= |b| goes to radius b and angle pi/2 - (pi/4) a/b. */
static inline void koksma__map_concentric(const double *u, double *x)
{
    const double a = 2 * u[0] - 1, b = 2 * u[1] - 1;
    if (a == 0 && b == 0) {
        x[0] = x[1] = 0;
    } else if (fabs(a) > fabs(b)) {
        koksma__cos_sin(M_PI / 4 * (b / a), &x[0], &x[1]);
        x[0] *= a;
        x[1] *= a;
    } else {
        koksma__cos_sin(M_PI / 4 * (a / b), &x[1], &x[0]);
        x[0] *= b;
        x[1] *= b;
    }
}

/* Maps (u, v) of the square to radius sqrt(u) and angle 2 pi v. */
static inline void koksma__map_polar(const double *u, double *x)
{
    const double r = sqrt(u[0]);
    koksma__cos_sin(2 * M_PI * u[1], &x[0], &x[1]);
    x[0] *= r;
    x[1] *= r;
}

/* Maps a point of the disk to the hemisphere at height z = 1 - r^2, uniform in solid angle (the inverse of Lambert's
   equal-area projection). */
static inline void koksma__lift_uniform(double *x)
{
    const double square = fmin(x[0] * x[0] + x[1] * x[1], 1), scale = sqrt(2 - square);
    x[0] *= scale;
    x[1] *= scale;
    x[2] = 1 - square;
}

/* Projects a point of the disk vertically onto the hemisphere: the density is proportional to z (Malley's method). */
static inline void koksma__lift_cosine(double *x)
{
    x[2] = sqrt(fmax(1 - x[0] * x[0] - x[1] * x[1], 0));
}

#endif
