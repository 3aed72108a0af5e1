/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_TORUS_H
#define KOKSMA_CORE_TORUS_H

/* From a to b on the torus: b - a the short way around, in [-1/2, 1/2]. */
static inline double koksma__way(double a, double b)
{
    const double t = b - a;
    return t > 0.5 ? t - 1 : t < -0.5 ? t + 1 : t;
}

#endif
