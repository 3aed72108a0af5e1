/* SPDX-License-Identifier: Apache-2.0 */
/* The best box between two vertical lines. */
#ifndef KOKSMA_MEASURES_SHARED_EXTREME_STRIP_H
#define KOKSMA_MEASURES_SHARED_EXTREME_STRIP_H

#include <koksma/koksma.h>

/* Finds the best box between x = left and x = right and writes it to out; the points x[i], y[i] are in order of y. */
void koksma__extreme_of_strip(size_t n, const double *x, const double *y, double left, double right, bool closed,
                              koksma_value *out);

#endif
