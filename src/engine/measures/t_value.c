/* SPDX-License-Identifier: Apache-2.0 */
/*
 * t-value: the quality parameter of the points as a (t,m,s)-net in a base: the least t such that every elementary
 * interval of volume base^(t-m) holds base^t points. The best value is 0; the worst is m, because every set of points
 * is an (m,m,s)-net.
 *
 * Formula: n = base^m; elementary intervals are products of [a/base^d, (a+1)/base^d), where the d of all coordinates
 * add up to m - t.
 * Source: Niederreiter 1987.
 * Known exactly: Hammersley's points have t = 0 in base 2; n equal points have t = m.
 * Limits: n must be a power of the base. A coordinate that is the double nearest to a/base^d counts as this fraction
 * (core/net.c). A coordinate that was rounded to fewer digits, as in a text file with six digits, may fall into the
 * next lower interval. A coordinate of 1 is counted in the last interval.
 */
#include "core/points.h"
#include "core/status.h"
#include "measures/measures.h"

enum { MAX_DIM = 16 };

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const double base = args->params[0];
    int use[MAX_DIM], t = 0;
    koksma__net net;
    koksma_status status = koksma__net_init(points, (size_t)base, &net);
    if (!status && net.powers[net.digits] != points->n) {
        const size_t below = net.powers[net.digits];
        status =
            koksma__fail(KOKSMA_N, "t-value: n = %zu is not a power of base=%g; the nearest powers are %zu and %.0f",
                         points->n, base, below, base * (double)below);
    }
    for (int k = 0; k < points->dim; k++) {
        use[k] = k;
    }
    status = status ? status : koksma__net_quality(&net, net.digits, use, points->dim, args->run, &t);
    out->value = t;
    koksma__net_fini(&net);
    return status;
}

static const koksma_param params[] = {
    {"base", "the base of the net", 2, 2, 1024, NULL, true},
    {0},
};

const koksma_measure koksma__measure_t_value = {
    .name = "t-value",
    .title = "quality parameter t as a (t,m,s)-net",
    .cite = "niederreiter1987",
    .cost = "n m^d",
    .min_dim = 1,
    .max_dim = MAX_DIM,
    .params = params,
    .eval = eval,
};
