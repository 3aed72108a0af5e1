/* SPDX-License-Identifier: Apache-2.0 */
/* Rank correlation. */
#ifndef KOKSMA_STATS_CORRELATION_H
#define KOKSMA_STATS_CORRELATION_H

#include <stddef.h>

/* Spearman's rho, which is Pearson's correlation of the mean ranks, and Kendall's tau-b. Values that
   koksma__compare finds equal are ties. Both are NaN when x or y is constant. */
double koksma__spearman(const double *x, const double *y, size_t n);
double koksma__kendall(const double *x, const double *y, size_t n);

/* Writes to `out` the centred mean ranks of n values, divided by the root of their sum of squares, so that the
   dot product of two such lists is Spearman's rho; if all values are equal, it writes zeros. */
void koksma__unit_ranks(const double *values, size_t n, double *out);

#endif
