/* SPDX-License-Identifier: Apache-2.0 */
/* Quantiles of Student's t and of chi-squared, accurate to 1e-9. */
#ifndef KOKSMA_STATS_QUANTILES_H
#define KOKSMA_STATS_QUANTILES_H

#include "core/visibility.h"

/* Returns the quantile of Student's t: x with P(T <= x) = p, for 0.5 <= p < 1 and degrees > 0. */
KOKSMA__LAB double koksma__student_quantile(double p, double degrees);

/* Returns P(T > t) for t > 0 and degrees > 0. */
KOKSMA__LAB double koksma__student_tail(double t, double degrees);

/* Returns the quantile of chi-squared: x with P(X <= x) = p, for 0 < p < 1 and degrees > 0. */
KOKSMA__LAB double koksma__chi_squared_quantile(double p, double degrees);

#endif
