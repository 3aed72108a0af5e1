/* SPDX-License-Identifier: Apache-2.0 */
/*
 * l2-edge-in-disk: the points are mapped to the unit disk; the root mean square, over isotropic random lines that hit
 * the disk, of the difference between the share of points on a side and its share of the area.
 *
 * Formula: a line that hits the disk separates x and y with probability |x - y|/pi (Cauchy-Crofton), so the square is
 * ((1/n) sum P(x_i) - (1/n^2) sum_{i<j} |x_i - x_j| - C/2)/pi with the mean distance of x from the disk,
 * P = (4/(9 pi)) ((7 + a^2) E(a) - 4 (1 - a^2) K(a)), a = |x|, and C = 128/(45 pi).
 * Source: Santalo 1976 for the line measure; Alexander 1990 for the energy. Known exactly: one point at the centre,
 * 2/(3 pi) - 64/(45 pi^2); random points, the mean of the square is 64/(45 pi^2 n).
 * Limits: sums are compensated; the square is good to about 1e-16.
 */
#include <math.h>

#include "measures/measures.h"
#include "measures/parts/energy.h"

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const koksma__energy energy = {koksma__disk_potential, NULL, KOKSMA__DISK_SELF, 1 / M_PI};
    koksma__warped w;
    koksma_status status = koksma__warped_init(&w, points, koksma__warps_to_disk, args->params[0]);
    if (!status) {
        status = koksma__energy_measure(&w, &energy, args->run, out);
    }
    koksma__warped_fini(&w);
    return status;
}

static const koksma_param params[] = {KOKSMA__WARP_PARAM(koksma__warps_to_disk, 1), {0}};

const koksma_measure koksma__measure_l2_edge_in_disk = {
    .name = "l2-edge-in-disk",
    .title = "L2 over lines on the points mapped to the unit disk",
    .cite = "santalo1976 alexander1990 shirley1997",
    .cost = "n^2",
    .min_dim = 2,
    .max_dim = 2,
    .params = params,
    .eval = eval,
};
