/* SPDX-License-Identifier: Apache-2.0 */
/*
 * l2-cap-on-hemisphere: the points are mapped to the hemisphere; the root mean square, over isotropic random planes
 * that hit the whole sphere, of the difference between the share of points on a side and that of the hemisphere's
 * measure: solid angle, or weighted by the cosine for the warps that are.
 *
 * Formula: Stolarsky's invariance principle for a measure on a part of the sphere: a cap {y.z >= t}, z uniform on the
 * sphere and t on (-1,1), parts x from y with probability |x - y|/4, so the square is
 * ((1/n) sum P(x_i) - (1/n^2) sum_{i<j} |x_i - x_j| - C/2)/4. P, the mean distance of x from the hemisphere, is an
 * integral of complete elliptic integrals over its circles of latitude; C, the mean of P, is 32/(9 pi) for solid
 * angle and 2048/(675 pi) with the cosine (closed forms recognised from 18 digits). Source: Stolarsky 1973; Alexander
 * 1990. Known exactly: P is 2 sqrt(2)/3 at the pole and 4/3 at the rim; with the cosine 8 sqrt(2)/15 and 64/(15 pi).
 * Random points, the mean of the square is C/(8n). Limits: P is integrated to about 1e-15; the square is good to
 * about 1e-15.
 */
#include <math.h>

#include "measures/measures.h"
#include "measures/parts/energy.h"

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    static const double self_uniform = 32 / (9 * M_PI), self_cosine = 2048 / (675 * M_PI);
    koksma__warped w;
    koksma_status status = koksma__warped_init(&w, points, koksma__warps_to_hemisphere, args->params[0]);
    if (!status) {
        const bool cosine = w.warp->domain == KOKSMA_DOMAIN_HEMISPHERE_COSINE;
        const koksma__energy energy = {koksma__hemisphere_potential, cosine ? &w : NULL,
                                       cosine ? self_cosine : self_uniform, 0.25};
        status = koksma__energy_measure(&w, &energy, args->run, out);
    }
    koksma__warped_fini(&w);
    return status;
}

static const koksma_param params[] = {KOKSMA__WARP_PARAM(koksma__warps_to_hemisphere, 3), {0}};

const koksma_measure koksma__measure_l2_cap_on_hemisphere = {
    .name = "l2-cap-on-hemisphere",
    .title = "L2 over spherical caps on the points mapped to the hemisphere",
    .cite = "stolarsky1973 alexander1990 shirley1997",
    .cost = "n^2",
    .min_dim = 2,
    .max_dim = 2,
    .params = params,
    .eval = eval,
};
