/* SPDX-License-Identifier: Apache-2.0 */
/*
 * hemisphere-polar: the polar map to the disk, then z = 1 - r^2 and radius r sqrt(2 - r^2): uniform solid angle.
 * Source: Shirley & Chiu 1997; the lift is Lambert's equal-area projection.
 */
#include "warps/parts/disk_maps.h"
#include "warps/warps.h"

static void map(const double *u, double *x)
{
    koksma__map_polar(u, x);
    koksma__lift_uniform(x);
}

const koksma_warp koksma__warp_hemisphere_polar = {
    .name = "hemisphere-polar",
    .title = "uniform hemisphere over the polar disk",
    .cite = "shirley1997",
    .domain = KOKSMA_DOMAIN_HEMISPHERE,
    .dim = 3,
    .map = map,
};
