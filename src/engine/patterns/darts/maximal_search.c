/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Searches for the distance at which a maximal set has exactly n points, starting from a maximal set of fewer points.
 * Each try lets the distance shrink and fills the free area that opens. How far the distance shrinks is estimated
 * from the last try, in which each added point took some change of the distance. When more than n points fit, the
 * points of this try are removed and the distance is bisected. The bisection ends with n points because free areas
 * open one at a time.
 */
#include "patterns/darts/darts.h"

#include <math.h>

#include "core/status.h"

enum { TRIES = 100 };

/* The distance searched for is between `low`, at which there were more than n points, and `high`. */
koksma_status koksma__maximal_shrink(int dim, double high, size_t kept, size_t n, const koksma_run *run,
                                     koksma__maximal_try attempt, void *set)
{
    const double guess = 0.5 / dim / (double)n;
    double low = 0, step = guess; /* step: the fraction by which d shrinks for each further point */
    for (int try = 0; try < TRIES; try++) {
        const double wanted = high * (1 - fmin(step * (double)(n - kept), 0.3));
        const double d = low > 0 ? fmax(wanted, (low + high) / 2) : wanted;
        size_t found;
        KOKSMA__TRY(attempt(set, kept, d, n + 1, run, &found));
        if (found == n) {
            return KOKSMA_OK;
        }
        if (found > n) {
            low = d;
            step /= 2;
        } else {
            step = found > kept ? (1 - d / high) / (double)(found - kept) : 2 * step;
            high = d;
            kept = found;
        }
        if (low > 0 && high - low < 1e-12 * high) { /* the distance `low` gave more than n points when fewer points
                                                       were kept; with the points kept now it gives fewer than n */
            low = 0;
            step = guess;
        }
    }
    return koksma__fail(KOKSMA_IMPOSSIBLE,
                        "poisson-disk-maximal: the search for %zu points ended with %zu; another seed would do", n,
                        kept);
}
