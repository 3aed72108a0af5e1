/* SPDX-License-Identifier: Apache-2.0 */
/* Compensated summation (Neumaier 1974): the error does not grow with the number of terms. */
#ifndef KOKSMA_CORE_SUM_H
#define KOKSMA_CORE_SUM_H

#include <math.h>

typedef struct koksma__sum {
    double total, lost;
} koksma__sum;

static inline void koksma__sum_add(koksma__sum *sum, double x)
{
    const double total = sum->total + x;
    sum->lost += fabs(sum->total) >= fabs(x) ? (sum->total - total) + x : (x - total) + sum->total;
    sum->total = total;
}

static inline double koksma__sum_value(const koksma__sum *sum)
{
    return sum->total + sum->lost;
}

/* Returns the value, or 0 if it is negative, which rounding can cause for a square. Unlike fmax(x, 0) it returns NaN
   for NaN. */
static inline double koksma__not_below_0(double square)
{
    return square < 0 ? 0 : square;
}

#endif
