/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The double exponential rule (Takahasi & Mori 1974): x = tanh((pi/2) sinh t) and the trapezoid rule in t with step
 * 1/16. Complete elliptic integrals by the arithmetic-geometric mean, which converges quadratically, so that 16 steps
 * are more than enough.
 */
#include "core/elementary.h"
#include "measures/shared/shared.h"

#include <math.h>

double koksma__integral(double (*f)(double x, const void *context), const void *context, double a, double b)
{
    enum { STEPS = 56 };
    const double step = 1.0 / 16, half = (b - a) / 2;
    if (!(a < b)) {
        return 0;
    }
    double sum = M_PI / 2 * f(a + half, context);
    for (int k = 1; k <= STEPS; k++) {
        const double t = k * step,
                     e = koksma__exp(M_PI * koksma__sinh(t)); /* tanh((pi/2) sinh t) = (e - 1) / (e + 1) */
        const double gap =
            2 * half / (1 + e); /* distance from the end of the interval, computed without cancellation */
        const double weight = M_PI / 2 * koksma__cosh(t) * 4 * e / ((1 + e) * (1 + e));
        sum += weight * (f(a + gap, context) + f(b - gap, context));
    }
    return half * step * sum;
}

void koksma__elliptic(double complement, double *first, double *second)
{
    if (complement < 1e-150) {
        *first = 0;
        *second = 1;
        return;
    }
    double a = 1, b = complement, c2 = (1 - complement) * (1 + complement), power = 0.5, sum = 0;
    for (int i = 0; i < 16; i++) {
        sum += power * c2;
        const double mean = (a + b) / 2, difference = (a - b) / 2;
        b = sqrt(a * b);
        a = mean;
        c2 = difference * difference;
        power *= 2;
        if (fabs(difference) < 1e-17 * a) {
            break;
        }
    }
    *first = M_PI / (2 * a);
    *second = *first * (1 - sum);
}
