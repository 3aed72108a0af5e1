/* SPDX-License-Identifier: Apache-2.0 */
#include "measures/parts/disk_laws.h"

#include <math.h>

const char *const koksma__disk_laws[] = {"fixed", "radius", "area", NULL};

double koksma__disk_radius(koksma__disk_law law, double r)
{
    return r > 0 ? r : law == KOKSMA__DISKS_FIXED ? 0.25 : 0.5;
}

double koksma__disk_overlap(koksma__disk_law law, double r, double distance2)
{
    const double h = sqrt(distance2) / 2;
    if (h >= r) {
        return 0;
    }
    const double s = sqrt((r - h) * (r + h)), angle = atan2(s, h);
    if (law == KOKSMA__DISKS_FIXED) {
        return 2 * r * r * angle - 2 * h * s;
    }
    if (law == KOKSMA__DISKS_AREA) {
        return (r * r * r * r * angle - 5 * h * s * s * s / 3 - h * h * h * s) / (r * r);
    }
    const double logarithm = h > 0 ? h * h * h * log((r + s) / h) : 0;
    return (2 * r * r * r * angle - 4 * h * r * s + 2 * logarithm) / (3 * r);
}

double koksma__disk_square(koksma__disk_law law, double r)
{
    static const double divisors[] = {1, 5, 3};
    return M_PI * M_PI * r * r * r * r / divisors[law];
}
