/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_VECTOR_H
#define KOKSMA_CORE_VECTOR_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

static inline double koksma__dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The product of two vectors of n numbers. */
static inline double koksma__dot_of(size_t n, const double *a, const double *b)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

static inline void koksma__cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void koksma__subtract(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[k] - b[k];
    }
}

/* Scales v to length 1. Returns false, and leaves v unchanged, if its length is at most 1e-12. */
static inline bool koksma__normalise(double v[3])
{
    const double length = sqrt(koksma__dot(v, v));
    if (!(length > 1e-12)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        v[k] /= length;
    }
    return true;
}

#endif
