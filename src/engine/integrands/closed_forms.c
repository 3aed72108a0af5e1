/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions offset + scale g_1(x_1) .. g_d(x_d): with m the mean of a factor, q the mean of its square and V its
 * variation,
 *
 *     integral             offset + scale prod m
 *     variance             scale^2 (prod q - prod m^2)
 *     Hardy and Krause     |scale| (prod (V_i + |g_i(1)|) - prod |g_i(1)|)
 *
 * The variation in the sense of Hardy and Krause, anchored at 1, is the sum over all u of Vitali's variations of
 * f(x_u, 1), each a product.
 */
#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "integrands/closed_forms.h"

koksma_status koksma__integral_factors(koksma_integral *f)
{
    f->factors = calloc((size_t)f->axes, sizeof *f->factors);
    KOKSMA__REQUIRE_MEMORY(f->factors, (size_t)f->axes * sizeof *f->factors);
    f->scale = 1;
    return KOKSMA_OK;
}

void koksma__integral_of_product(koksma_integral *f)
{
    double mean = 1, all = 1, end = 1, low = 1, high = 1, squares = 1;
    for (int i = 0; i < f->axes; i++) {
        const koksma__factor *g = &f->factors[i];
        const double corners[] = {low * g->lowest, low * g->highest, high * g->lowest, high * g->highest};
        low = fmin(fmin(corners[0], corners[1]), fmin(corners[2], corners[3]));
        high = fmax(fmax(corners[0], corners[1]), fmax(corners[2], corners[3]));
        mean *= g->mean;
        squares *= g->square;
        all *= g->variation + g->end;
        end *= g->end;
    }
    f->value = f->offset + f->scale * mean;
    f->variance = f->scale * f->scale * (squares - mean * mean);
    f->variation = fabs(f->scale) * (all - end);
    f->lowest = f->offset + f->scale * (f->scale < 0 ? high : low);
    f->highest = f->offset + f->scale * (f->scale < 0 ? low : high);
}

koksma_status koksma__integral_of_rows(koksma_integral *f)
{
    const koksma__factor *rows = f->integrand->constants;
    KOKSMA__TRY(koksma__integral_factors(f));
    for (int i = 0; i < f->axes; i++) {
        f->factors[i] = rows[i];
    }
    koksma__integral_of_product(f);
    return KOKSMA_OK;
}

/* ---- Functions of the plane -------------------------------------------------------------------------------------- */

/* Functions of the plane that are not products: regions whose edges are not along an axis. The sum of variations over
   the rectangles of a grid grows without limit along such an edge as the grid is refined, so the variation in the
   sense of Hardy and Krause is infinite. */

koksma_status koksma__integral_of_plane(koksma_integral *f)
{
    const koksma__plane *p = f->integrand->constants;
    f->value = p->value;
    f->variance = p->square - p->value * p->value;
    f->variation = HUGE_VAL;
    f->lowest = 0;
    f->highest = 1;
    return KOKSMA_OK;
}
