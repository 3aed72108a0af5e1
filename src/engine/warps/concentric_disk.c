/* SPDX-License-Identifier: Apache-2.0 */
/*
 * concentric-disk: maps squares about the centre of the unit square to circles about the centre of the unit disk. The
 * map is continuous and preserves ratios of areas. With (a,b) = 2u - 1: if |a| > |b|, radius a and angle (pi/4)(b/a);
 * else radius b and angle pi/2 - (pi/4)(a/b). Source: Shirley & Chiu 1997. Known exactly: the centre of the square is
 * mapped to the centre of the disk, and its corners to the points of the circle on the diagonals.
 */
#include "warps/shared/disk_maps.h"
#include "warps/warps.h"

const koksma_warp koksma__warp_concentric_disk = {
    .name = "concentric-disk",
    .revision = 1,
    .title = "low-distortion map of concentric squares to concentric circles",
    .cite = "shirley1997",
    .domain = KOKSMA_DOMAIN_DISK,
    .dim = 2,
    .map = koksma__map_concentric,
};
