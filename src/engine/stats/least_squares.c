/* SPDX-License-Identifier: Apache-2.0 */
/* Fits a line by least squares in two passes: first the means by updates (Welford 1962), then sums of squares and
   products about the means. Unlike sums of raw squares, these lose no digits if the means are large. The caller
   stores the pairs and omits those with NaN. */
#include "stats/least_squares.h"

void koksma__fit_mean(koksma__fit *fit, double x, double y, double weight)
{
    fit->weight += weight;
    fit->x += weight * (x - fit->x) / fit->weight;
    fit->y += weight * (y - fit->y) / fit->weight;
}

void koksma__fit_add(koksma__fit *fit, double x, double y, double weight)
{
    const double dx = x - fit->x, dy = y - fit->y;
    fit->xx += weight * dx * dx;
    fit->xy += weight * dx * dy;
    fit->yy += weight * dy * dy;
}

double koksma__fit_slope(const koksma__fit *fit)
{
    return fit->xy / fit->xx;
}
