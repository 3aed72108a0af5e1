/* SPDX-License-Identifier: Apache-2.0 */
/*
 * triangle-heitz: moves the corner (1,1) of the square to the middle of the diagonal from (1,0) to (0,1). The map
 * preserves ratios of areas, and no side of the square shrinks to a point. (u, v) is mapped to (u/2, v - u/2) if v >=
 * u, else to (u - v/2, v/2). Source: Heitz 2019.
 */
#include "warps/warps.h"

static void map(const double *u, double *x)
{
    const double a = u[0], b = u[1]; /* copied because x may be the same array as u */
    x[0] = b > a ? a / 2 : a - b / 2;
    x[1] = b > a ? b - a / 2 : b / 2;
}

const koksma_warp koksma__warp_triangle_heitz = {
    .name = "triangle-heitz",
    .title = "low-distortion map to a triangle",
    .cite = "heitz2019",
    .domain = KOKSMA_DOMAIN_TRIANGLE,
    .dim = 2,
    .map = map,
};
