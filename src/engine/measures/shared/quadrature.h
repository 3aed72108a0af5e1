/* SPDX-License-Identifier: Apache-2.0 */
/* Integrals and complete elliptic integrals for the constants and potentials of measures that are sums over pairs. */
#ifndef KOKSMA_MEASURES_SHARED_QUADRATURE_H
#define KOKSMA_MEASURES_SHARED_QUADRATURE_H

/* Returns the integral of f from a to b by the double exponential rule (Takahasi & Mori 1974). The relative error is
   about 1e-15 if f is analytic between a and b; at the ends f may behave like a root or a logarithm. The result is 0
   unless a < b. */
double koksma__integral(double (*f)(double x, const void *context), const void *context, double a, double b);

/* Computes the complete elliptic integrals K (first) and E (second) for the complementary modulus k' = sqrt(1 - k^2)
   in [0,1], by the arithmetic-geometric mean. For k' = 0, where K is infinite, it sets K = 0 and E = 1. */
void koksma__elliptic(double complement, double *first, double *second);

#endif
