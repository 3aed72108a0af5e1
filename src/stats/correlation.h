/* SPDX-License-Identifier: Apache-2.0 */
/* Rank correlation. */
#ifndef KOKSMA_STATS_CORRELATION_H
#define KOKSMA_STATS_CORRELATION_H

#include <stddef.h>

/* Spearman's rho: Pearson's correlation of the mean ranks. Kendall's tau-b. Values that compare equal are
   ties. NaN when one side is constant. */
double koksma__spearman(const double *x, const double *y, size_t n);
double koksma__kendall(const double *x, const double *y, size_t n);

/* out: the centred mean ranks of n values over the root of their sum of squares, so that the sum of the products of
   two such lists is Spearman's rho; zeros where all values compare equal. */
void koksma__unit_ranks(const double *values, size_t n, double *out);

#endif
