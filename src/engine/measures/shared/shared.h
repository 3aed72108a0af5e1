/* SPDX-License-Identifier: Apache-2.0 */
/* What measures of several families use. Each section is the interface of the file of its name. */
#ifndef KOKSMA_MEASURES_SHARED_SHARED_H
#define KOKSMA_MEASURES_SHARED_SHARED_H

#include <koksma/koksma.h>

#include <math.h>

#include "core/clock.h"
#include "core/visibility.h"

/* ---- Deadline -------------------------------------------------------------------------------------------- */

/* Deadlines for measures that run for a share of the time limit. */

/* Returns the time on the clock koksma__now_s at which the fraction `share` of run's time limit will have passed from
   now; infinite without a limit. */
static inline double koksma__deadline_s(const koksma_run *run, double share)
{
    return run && run->time_limit_s > 0 ? koksma__now_s() + share * run->time_limit_s : (double)INFINITY;
}

/* ---- Order ----------------------------------------------------------------------------------------------- */

/* Sorts n < 2^32 numbers xs[0], xs[stride], .. >= 0 stably by a radix sort: order[r] receives the index of the number
   of rank r. The result does not depend on the number of threads. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__order(const koksma_run *run, size_t n, const double *xs, size_t stride, uint32_t *order);

/* ---- Orientation ----------------------------------------------------------------------------------------- */

/* Returns the exact sign (1, 0 or -1) of (a[0] - a[1]) (b[0] - b[1]) - (c[0] - c[1]) (d[0] - d[1]) for numbers in
   [0,1]. (Parts of products below 2^-2074 are lost, but only if one of the numbers is above 2^-300.) */
int koksma__sign_of_cross(const double a[2], const double b[2], const double c[2], const double d[2]);

/* ---- Quadrature ------------------------------------------------------------------------------------------ */

/* Integrals and complete elliptic integrals for the constants and potentials of measures that are sums over pairs. */

/* Returns the integral of f from a to b by the double exponential rule (Takahasi & Mori 1974). The relative error is
   about 1e-15 if f is analytic between a and b; at the ends f may behave like a root or a logarithm. The result is 0
   unless a < b. */
double koksma__integral(double (*f)(double x, const void *context), const void *context, double a, double b);

/* Computes the complete elliptic integrals K (first) and E (second) for the complementary modulus k' = sqrt(1 - k^2)
   in [0,1], by the arithmetic-geometric mean. For k' = 0, where K is infinite, it sets K = 0 and E = 1. */
void koksma__elliptic(double complement, double *first, double *second);

/* ---- Sampled --------------------------------------------------------------------------------------------- */

/* Writes to out the mean of `count` sampled squares, its root, and the standard error of the root, which is the
   standard error of the mean divided by twice the root (NaN for one sample). */
void koksma__sampled_root(const double *squares, size_t count, koksma_value *out);

/* ---- Lower bounds ---------------------------------------------------------------------------------------- */

/* Theoretical lower bounds of discrepancies, which no set of points can beat. */

/* A bound: no sets of n points have a measure that falls faster than n^-power (log n)^logs. */
typedef struct koksma__bound {
    double power, logs;
    const char *source; /* for example "Schmidt 1972" */
} koksma__bound;

/* Writes the bound of a measure in dim dimensions; returns false if none is known. */
KOKSMA__LAB bool koksma__lower_bound(const koksma_measure *measure, int dim, koksma__bound *bound);

#endif
