/* SPDX-License-Identifier: Apache-2.0 */
/*
 * polar-disk: radius sqrt(u_0), angle 2 pi u_1. The map preserves ratios of areas but not distances: two sides of the
 * square meet along one radius of the disk, and a third side shrinks to the centre. Source: Shirley 1991, section
 * 5.5, which prefers another map to the disk.
 */
#include "warps/shared/disk_maps.h"
#include "warps/warps.h"

const koksma_warp koksma__warp_polar_disk = {
    .name = "polar-disk",
    .revision = 1,
    .title = "(u, v) to radius sqrt(u) and angle 2 pi v",
    .cite = "shirley1991",
    .domain = KOKSMA_DOMAIN_DISK,
    .dim = 2,
    .map = koksma__map_polar,
};
