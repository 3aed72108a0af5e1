/* SPDX-License-Identifier: Apache-2.0 */
/*
 * triangle: maps (u_0, u_1) to (1 - sqrt u_0, u_1 sqrt u_0). Lines of constant u_0 become lines parallel to a side of
 * the triangle, and ratios of areas are preserved. The side u_0 = 0 of the square shrinks to a corner of the
 * triangle.
 * Source: Turk 1990.
 */
#include <math.h>

#include "warps/warps.h"

static void map(const double *u, double *x)
{
    const double root = sqrt(u[0]);
    x[0] = 1 - root;
    x[1] = u[1] * root;
}

const koksma_warp koksma__warp_triangle = {
    .name = "triangle",
    .title = "(u, v) to (1 - sqrt u, v sqrt u) in the triangle (0,0) (1,0) (0,1)",
    .cite = "turk1990",
    .domain = KOKSMA_DOMAIN_TRIANGLE,
    .dim = 2,
    .map = map,
};
