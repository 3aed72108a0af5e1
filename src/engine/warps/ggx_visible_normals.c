/* SPDX-License-Identifier: Apache-2.0 */
/*
 * ggx-visible-normals: normals of the microfacets that a viewer sees, as a renderer samples rough metal. Warps have no
 * parameters, so the surface is one example: slopes of the GGX law with alpha = 1/2 (a `roughness` of sqrt(1/2) in scene
 * files), seen from v = (sqrt(3)/2, 0, 1/2), 60 degrees from the surface's normal. The density at h is
 *     D(h) G1(v) max(v.h, 0) / v.z
 *
 * Stretching by alpha makes the surface a hemisphere, of which v sees a half-disk and a half-ellipse: the polar map to the
 * disk across v, with the half y < 0 compressed to the ellipse, lifted to the hemisphere, and stretched back. Source:
 * Heitz 2018, listing 1; the renderer's materials sample by the same map.
 */
#include <math.h>

#include "warps/shared/disk_maps.h"
#include "warps/warps.h"

static const double alpha = 0.5;

static void map(const double *u, double *x)
{
    const double length = sqrt(7), vx = sqrt(3) / length, vz = 2 / length; /* (alpha v.x, 0, v.z), normalised */
    double disk[2];
    koksma__map_polar(u, disk);
    const double seen = (1 + vz) / 2, across = disk[0], half = sqrt(fmax(1 - across * across, 0));
    const double along = (1 - seen) * half + seen * disk[1];
    const double towards = sqrt(fmax(1 - across * across - along * along, 0));
    const double h[3] = {alpha * (towards * vx - along * vz), alpha * across, fmax(along * vx + towards * vz, 0)};
    const double norm = sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
    for (int k = 0; k < 3; k++) {
        x[k] = h[k] / norm;
    }
}

const koksma_warp koksma__warp_ggx_visible_normals = {
    .name = "ggx-visible-normals",
    .title = "GGX microfacet normals of alpha 1/2 that are visible at 60 degrees",
    .cite = "heitz2018",
    .domain = KOKSMA_DOMAIN_GGX_VISIBLE,
    .dim = 3,
    .map = map,
};
