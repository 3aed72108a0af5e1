/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Integrals over the distributions ("laws") of the radius of random disks and balls: the mean overlap of two balls of
 * the same random radius whose centres are a given distance apart, and the means of the area and its square. Two disks
 * overlap in a lens of area 2 r^2 atan2(s, h) - 2 h s, h = distance / 2 and s = sqrt(r^2 - h^2), which the kernel
 * disk_overlaps integrates over the distribution of r.
 */
#include "measures/disk/disk.h"

#include <math.h>

#include "core/elementary.h"
#include "core/random.h"

const char *const koksma__disk_laws[] = {"fixed", "radius", "area", NULL};

double koksma__disk_radius(koksma__disk_law law, double r)
{
    return r > 0 ? r : law == KOKSMA__DISKS_FIXED ? 0.25 : 0.5;
}

double koksma__disk_area(koksma__disk_law law, double r)
{
    return law == KOKSMA__DISKS_FIXED    ? 2 * r * r * M_PI_2
           : law == KOKSMA__DISKS_RADIUS ? 2 * r * r * r * M_PI_2 / (3 * r)
                                         : r * r * r * r * M_PI_2 / (r * r);
}

double koksma__disk_square(koksma__disk_law law, double r)
{
    static const double divisors[] = {1, 5, 3};
    return M_PI * M_PI * r * r * r * r / divisors[law];
}

/* Here h is half of the distance and t = r - h. Two balls of radius h + s overlap in a volume of (2 pi / 3) (2 s + 3
   h) s^2. */
double koksma__ball_overlap(koksma__disk_law law, double r, double distance2)
{
    const double h = sqrt(distance2) / 2, t = r - h;
    if (t <= 0) {
        return 0;
    }
    if (law == KOKSMA__DISKS_FIXED) {
        return 2 * M_PI / 3 * (2 * t + 3 * h) * t * t;
    }
    if (law == KOKSMA__DISKS_AREA) {
        const double sum = ((t / 3 + 7 * h / 5) * t + 2 * h * h) * t + h * h * h;
        return 2 * M_PI / (r * r * r) * t * t * t * sum;
    }
    return M_PI * t * t * t * (r + h) / (3 * r);
}

/* Returns the derivative of the mean overlap by the distance. For a given radius this derivative is minus the length
   of the common chord of two disks, or minus the area of the disk in which two spheres intersect. */
double koksma__overlap_slope(koksma__disk_law law, int dim, double r, double distance)
{
    const double h = distance / 2;
    if (h >= r) {
        return 0;
    }
    const double s2 = (r - h) * (r + h), s = sqrt(s2), h3 = h * h * h, r3 = r * r * r;
    if (dim == 3) {
        const double whole = (r3 * r * r - h3 * h * h) / 5 - h * h * (r3 - h3) / 3;
        return law == KOKSMA__DISKS_FIXED    ? -M_PI * s2
               : law == KOKSMA__DISKS_RADIUS ? -M_PI / r * (r3 / 3 - h * h * r + 2 * h3 / 3)
                                             : -3 * M_PI / r3 * whole;
    }
    const double logarithm = h > 0 ? h * h * koksma__log((r + s) / h) : 0;
    return law == KOKSMA__DISKS_FIXED    ? -2 * s
           : law == KOKSMA__DISKS_RADIUS ? -(r * s - logarithm) / r
                                         : -4 * s * s2 / (3 * r * r);
}

double koksma__ball_square(koksma__disk_law law, double r)
{
    static const double divisors[] = {1, 7, 3};
    const double volume = 4 * M_PI / 3 * r * r * r;
    return volume * volume / divisors[law];
}

void koksma__random_disk(koksma__disk_law law, double r, uint64_t seed, uint64_t index, int dim, double centre[3],
                         double *radius2)
{
    double u[2];
    koksma__random_pair(seed, KOKSMA__PURPOSE_SEARCH, index, 2, centre);
    koksma__random_pair(seed, KOKSMA__PURPOSE_SEARCH, index, 3, u);
    centre[2] = u[1];
    *radius2 = r * r;
    if (law == KOKSMA__DISKS_RADIUS) {
        *radius2 *= u[0] * u[0];
    } else if (law == KOKSMA__DISKS_AREA) {
        *radius2 *= dim == 3 ? koksma__cbrt(u[0] * u[0]) : u[0];
    }
}
