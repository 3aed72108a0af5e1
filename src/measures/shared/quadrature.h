/* SPDX-License-Identifier: Apache-2.0 */
/* Integrals and elliptic functions for the constants and potentials of the energy measures. */
#ifndef KOKSMA_MEASURES_SHARED_QUADRATURE_H
#define KOKSMA_MEASURES_SHARED_QUADRATURE_H

/* The integral of f from a to b by the double exponential rule (Takahasi & Mori 1974): to about 1e-15 of its size for
   an f that is analytic inside, whatever roots or logarithms it has at the ends. 0 unless a < b. */
double koksma__integral(double (*f)(double x, const void *context), const void *context, double a, double b);

/* The complete elliptic integrals K (first) and E (second) for the complementary modulus k' = sqrt(1 - k^2) in [0,1],
   by the arithmetic-geometric mean. At k' = 0 E is 1 and K, which is infinite, is given as 0. */
void koksma__elliptic(double complement, double *first, double *second);

#endif
