/* SPDX-License-Identifier: Apache-2.0 */
/*
 * cosine-hemisphere: the concentric map to the disk, then a vertical projection up to z = sqrt(1 - r^2): the
 * directions have the density z/pi. Source: Shirley & Chiu 1997; the projection onto the hemisphere is known as
 * Malley's method.
 */
#include "warps/shared/disk_maps.h"
#include "warps/warps.h"

static void map(const double *u, double *x)
{
    koksma__map_concentric(u, x);
    koksma__lift_cosine(x);
}

const koksma_warp koksma__warp_cosine_hemisphere = {
    .name = "cosine-hemisphere",
    .revision = 1,
    .title = "concentric map to the disk, projected up: density proportional to the cosine",
    .cite = "shirley1997",
    .domain = KOKSMA_DOMAIN_HEMISPHERE_COSINE,
    .dim = 3,
    .map = map,
};
