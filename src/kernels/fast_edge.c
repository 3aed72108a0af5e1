/* SPDX-License-Identifier: Apache-2.0 */
/* Distances and side tests in lanes. */
#include <math.h>

#include "kernels/kernels.h"

enum { LANES = 16 };

double KERNEL_NAME(distances)(size_t n, const double *x, const double *y, double x0, double y0);
void KERNEL_NAME(count_below)(size_t n, const double *x, const double *y, const double a[16], const double b[16],
                              const double c[16], double counts[16]);

double KERNEL_NAME(distances)(size_t n, const double *x, const double *y, double x0, double y0)
{
    double lanes[LANES] = {0};
    size_t i = 0;
    for (; i + LANES <= n; i += LANES) {
        for (size_t l = 0; l < LANES; l++) {
            const double dx = x[i + l] - x0, dy = y[i + l] - y0;
            lanes[l] += sqrt(dx * dx + dy * dy);
        }
    }
    for (; i < n; i++) {
        const double dx = x[i] - x0, dy = y[i] - y0;
        lanes[i % LANES] += sqrt(dx * dx + dy * dy);
    }
    for (size_t half = LANES / 2; half > 0; half /= 2) {
        for (size_t l = 0; l < half; l++) {
            lanes[l] += lanes[l + half];
        }
    }
    return lanes[0];
}

void KERNEL_NAME(count_below)(size_t n, const double *x, const double *y, const double a[16], const double b[16],
                              const double c[16], double counts[16])
{
    double a_l[LANES], b_l[LANES], c_l[LANES], lanes[LANES] = {0};
    for (int l = 0; l < LANES; l++) {
        a_l[l] = a[l];
        b_l[l] = b[l];
        c_l[l] = c[l];
    }
    for (size_t i = 0; i < n; i++) {
        const double at_x = x[i], at_y = y[i];
        for (int l = 0; l < LANES; l++) {
            lanes[l] += a_l[l] * at_x + b_l[l] * at_y <= c_l[l] ? 1.0 : 0.0;
        }
    }
    for (int l = 0; l < LANES; l++) {
        counts[l] = lanes[l];
    }
}
