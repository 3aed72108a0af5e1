/* SPDX-License-Identifier: Apache-2.0 */
/*
 * polar-disk: radius sqrt(u_0), angle 2 pi u_1; area is kept, distances are not: the square is cut open along one
 * radius and squeezed at the centre. Source: Shirley 1991, section 5.5, the contrast to its preferred disk map.
 */
#include "warps/shared/disk_maps.h"
#include "warps/warps.h"

static void map(const double *u, double *x)
{
    koksma__map_polar(u, x);
}

const koksma_warp koksma__warp_polar_disk = {
    .name = "polar-disk",
    .title = "radius sqrt(u), angle 2 pi v",
    .cite = "shirley1991",
    .domain = KOKSMA_DOMAIN_DISK,
    .dim = 2,
    .map = map,
};
