/* SPDX-License-Identifier: Apache-2.0 */
/*
 * concentric-hemisphere: the concentric map to the disk, followed by a lift that maps radius r to radius r sqrt(2 -
 * r^2) at height z = 1 - r^2. The directions are uniform in solid angle. Source: Shirley & Chiu 1997.
 */
#include "warps/shared/disk_maps.h"
#include "warps/warps.h"

static void map(const double *u, double *x)
{
    koksma__map_concentric(u, x);
    koksma__lift_uniform(x);
}

const koksma_warp koksma__warp_concentric_hemisphere = {
    .name = "concentric-hemisphere",
    .revision = 1,
    .title = "concentric map to the disk, lifted to uniform directions",
    .cite = "shirley1997",
    .domain = KOKSMA_DOMAIN_HEMISPHERE,
    .dim = 3,
    .map = map,
};
