/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Computes the largest d such that n points can all be at least d apart, or an upper bound of it:
 *   square, n <= 30: the proven optima (Schaer 1965, Peikert 1991, Nurmela & Ostergard 1999, Markot & Csendes 2005);
 *   square, larger n: Oler 1961: n <= (2/sqrt 3) / d^2 + 2/d + 1;
 *   torus, 2D: the hexagonal packing: d <= sqrt(2 / (sqrt 3 n)) (Fejes Toth 1940);
 *   other dimensions: the volume of n disjoint balls of radius d/2 is at most that of the cube, which is enlarged by
 *   d/2 on each side unless it is the torus.
 */
#include "core/elementary.h"
#include "patterns/spacing/spacing.h"

#include <math.h>

#include "stats/stats.h"

static const double square_optima[] = {
    1.4142135624, 1.0352761804, 1,
    0.7071067812, 0.6009252126, 0.5358983849,
    0.5176380902, 0.5,          0.4212795440,
    0.3982073102, 0.3887301263, 0.3660960078,
    0.3489152604, 0.3410813774, 0.3333333333,
    0.3061539853, 0.3004626063, 0.2895419920,
    0.2866116524, 0.2718122554, 0.2679584016,
    0.2588190451, 0.2543330950, 0.25,
    0.2387347572, 0.2358495283, 0.2305354936,
    0.2268829007, 0.2245029645,
}; /* n = 2 .. 30 */

double koksma__packing_distance(size_t n, int dim, bool torus)
{
    const double count = (double)n;
    if (n == 1) {
        return INFINITY;
    }
    if (dim == 1) {
        return torus ? 1 / count : 1 / (count - 1);
    }
    if (dim == 2 && torus) {
        return fmin(sqrt(2 / (sqrt(3) * count)), sqrt(0.5));
    }
    if (dim == 2 && n <= 30) {
        return square_optima[n - 2] * (1 + 1e-9);
    }
    if (dim == 2) {
        return (1 + sqrt(1 + 2 / sqrt(3) * (count - 1))) / (count - 1);
    }
    const double ball =
        koksma__exp(0.5 * dim * koksma__log(M_PI) - koksma__log_gamma(0.5 * dim + 1)); /* volume of the unit ball */
    const double d = 2 * koksma__pow(1 / (count * ball), 1.0 / dim);
    if (torus) {
        return fmin(d, sqrt(dim) / 2);
    }
    return d < 1 ? fmin(d / (1 - d), sqrt(dim)) : sqrt(dim);
}
