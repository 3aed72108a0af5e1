/* SPDX-License-Identifier: Apache-2.0 */
/* The line of weighted least squares through pairs that come one at a time, twice: first for the means, then for the
   sums about them. All zero is no pairs. */
#ifndef KOKSMA_STATS_LEAST_SQUARES_H
#define KOKSMA_STATS_LEAST_SQUARES_H

#include "core/visibility.h"

typedef struct koksma__fit {
    double weight, x, y; /* of all pairs: their weights' sum, their means */
    double xx, xy, yy;   /* weighted sums of products of the deviations from the means */
} koksma__fit;

/* Takes a pair into the means; with weight 1 for all, fit->weight counts them. */
KOKSMA__LAB void koksma__fit_mean(koksma__fit *fit, double x, double y, double weight);

/* Takes a pair into the sums, after all have been taken into the means. */
KOKSMA__LAB void koksma__fit_add(koksma__fit *fit, double x, double y, double weight);

/* xy / xx; the line is y = fit->y + slope (x - fit->x). NaN or infinite where all x are equal. */
KOKSMA__LAB double koksma__fit_slope(const koksma__fit *fit);

#endif
