/* SPDX-License-Identifier: Apache-2.0 */
/* Quantiles of Student's t and of chi-squared, to 1e-9. */
#ifndef KOKSMA_STATS_QUANTILES_H
#define KOKSMA_STATS_QUANTILES_H

#include "core/visibility.h"

/* x with P(T <= x) = p, 0.5 <= p < 1, degrees > 0. */
KOKSMA__LAB double koksma__student_quantile(double p, double degrees);

/* x with P(X <= x) = p, 0 < p < 1, degrees > 0. */
KOKSMA__LAB double koksma__chi_squared_quantile(double p, double degrees);

#endif
