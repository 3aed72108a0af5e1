/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The lens is a disk or, for an iris with straight blades, a regular polygon. The camera's warp maps the unit square
 * to the disk; for a polygon a second map takes the disk to the polygon. Let V_k be the polygon's n corners on the
 * rim of the disk. The point at distance r from the centre and (k + t) / n of a turn beyond the angle pi / 4 is
 * mapped to
 *
 *     (r, k, t)  ->  r ((1 - t) V_k + t V_(k+1))
 *
 * The element of area of the disk is (2 pi / n) r dr dt and that of the polygon |V_k x V_(k+1)| r dr dt, so that the
 * map preserves ratios of areas; it is continuous in both directions. Equal strata of the square thus become
 * connected regions of equal area, and neighbours remain neighbours; choosing one of n triangles by a coordinate
 * would cut the square into pieces. The concentric map takes the corners of the square to the angles pi / 4, 3 pi /
 * 4, ...; for four blades both maps together are a similarity, so that strata remain squares.
 */
#include "core/elementary.h"
#include "render/one_image.h"

#include <math.h>

/* The camera's y axis points down, but blade_angle_rad is measured towards up; hence the minus sign of y. */
static void disk_to_polygon(const koksma__camera *camera, int n, float *x, float *y)
{
    const double corner = 2 * M_PI / camera->blades;
    for (int i = 0; i < n; i++) {
        const double r = koksma__hypot((double)x[i], (double)y[i]);
        const double turn = (koksma__atan2((double)y[i], (double)x[i]) - M_PI / 4) / (2 * M_PI);
        const double at = (turn - floor(turn)) * camera->blades, k = floor(at), t = at - k;
        const double a = k * corner + camera->blade_angle_rad, b = a + corner;
        x[i] = (float)(r * ((1 - t) * koksma__cos(a) + t * koksma__cos(b)));
        y[i] = (float)(-r * ((1 - t) * koksma__sin(a) + t * koksma__sin(b)));
    }
}

void koksma__lens_points(const koksma__camera *camera, const koksma__batch_table *batch, const float *pairs, int n,
                         float *x, float *y)
{
    const bool concentric = camera->lens_map == koksma_warp_find("concentric-disk");
    for (int i = 0; i < n; i++) {
        const double square[2] = {(double)pairs[2 * i], (double)pairs[2 * i + 1]};
        double disk[2] = {square[0], square[1]};
        if (!concentric) {
            camera->lens_map->map(square, disk);
        }
        x[i] = (float)disk[0];
        y[i] = (float)disk[1];
    }
    if (concentric) {
        batch->to_disk(n, x, y);
    }
    if (camera->blades) {
        disk_to_polygon(camera, n, x, y);
    }
}
