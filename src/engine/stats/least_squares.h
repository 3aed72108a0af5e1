/* SPDX-License-Identifier: Apache-2.0 */
/* Fits a line by weighted least squares to pairs that the caller passes one at a time, twice: first for the
   means, then for the sums about the means. A koksma__fit of zeros has no pairs. */
#ifndef KOKSMA_STATS_LEAST_SQUARES_H
#define KOKSMA_STATS_LEAST_SQUARES_H

#include "core/visibility.h"

typedef struct koksma__fit {
    double weight, x, y; /* sum of the weights, weighted means of x and y */
    double xx, xy, yy;   /* weighted sums of products of deviations from the means */
} koksma__fit;

/* Adds a pair to the means; with weight 1 for all pairs, fit->weight is their number. */
KOKSMA__LAB void koksma__fit_mean(koksma__fit *fit, double x, double y, double weight);

/* Adds a pair to the sums; call it after all pairs have been added to the means. */
KOKSMA__LAB void koksma__fit_add(koksma__fit *fit, double x, double y, double weight);

/* Returns the slope xy / xx of the line y = fit->y + slope (x - fit->x), which is NaN or infinite if all x are equal.
   */
KOKSMA__LAB double koksma__fit_slope(const koksma__fit *fit);

#endif
