/* SPDX-License-Identifier: Apache-2.0 */
/*
 * hemisphere: the polar map to the disk, followed by a lift that maps radius r to radius r sqrt(2 - r^2) at height z
 * = 1 - r^2. The height is thus 1 - u_0, the angle 2 pi u_1, and the directions are uniform in solid angle. Source:
 * Shirley 1991; the map from the disk to the hemisphere is the inverse of Lambert's equal-area projection.
 */
#include "warps/shared/disk_maps.h"
#include "warps/warps.h"

static void map(const double *u, double *x)
{
    koksma__map_polar(u, x);
    koksma__lift_uniform(x);
}

const koksma_warp koksma__warp_hemisphere = {
    .name = "hemisphere",
    .revision = 1,
    .title = "(u, v) to height 1 - u and angle 2 pi v; uniform directions",
    .cite = "shirley1991",
    .domain = KOKSMA_DOMAIN_HEMISPHERE,
    .dim = 3,
    .map = map,
};
