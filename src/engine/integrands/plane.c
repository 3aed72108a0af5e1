/* SPDX-License-Identifier: Apache-2.0 */
/* Functions of the plane that are not products: regions whose edges are not along an axis. The sum of variations over
   the rectangles of a grid grows without limit along such an edge as the grid is refined, so the variation in the
   sense of Hardy and Krause is infinite. */
#include "integrands/plane.h"

#include <math.h>

static double explained(const koksma_integral *f, const bool *held)
{
    const koksma__plane *p = f->integrand->constants;
    const double mean = p->value * p->value;
    return held[0] ? (held[1] ? p->square : p->of_x) - mean : held[1] ? p->of_y - mean : 0;
}

koksma_status koksma__integral_of_plane(koksma_integral *f)
{
    const koksma__plane *p = f->integrand->constants;
    f->value = p->value;
    f->variance = p->square - p->value * p->value;
    f->variation = HUGE_VAL;
    f->lowest = 0;
    f->highest = 1;
    f->explained = explained;
    return KOKSMA_OK;
}
