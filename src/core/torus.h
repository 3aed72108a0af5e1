/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_TORUS_H
#define KOKSMA_CORE_TORUS_H

/* b - a on the torus: the difference modulo 1 that is in [-1/2, 1/2]. */
static inline double koksma__torus_difference(double a, double b)
{
    const double t = b - a;
    return t > 0.5 ? t - 1 : t < -0.5 ? t + 1 : t;
}

#endif
