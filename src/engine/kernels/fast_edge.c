/* SPDX-License-Identifier: Apache-2.0 */
/* Computes sums of distances, and counts points on one side of lines, with one point or line in each vector lane. */
#include <math.h>

#include "kernels/kernels.h"
#include "kernels/lanes64.h"

enum { LANES = 16 };

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

/* Handles two vectors of lines at a time, so that their coefficients and counts stay in registers. */
void KERNEL_NAME(count_below)(size_t n, const double *x, const double *y, const double a[16], const double b[16],
                              const double c[16], double counts[16])
{
    for (int first = 0; first < LANES; first += 2 * LANES64) {
        lanes64_d of[3][2];
        lanes64_u found[2] = {{0}, {0}};
        for (int v = 0; v < 2; v++) {
            of[0][v] = lanes64_load_d(a + first + v * LANES64);
            of[1][v] = lanes64_load_d(b + first + v * LANES64);
            of[2][v] = lanes64_load_d(c + first + v * LANES64);
        }
        for (size_t i = 0; i < n; i++) {
            for (int v = 0; v < 2; v++) {
                found[v] -= (lanes64_u)(of[0][v] * x[i] + of[1][v] * y[i] <= of[2][v]);
            }
        }
        for (int v = 0; v < 2; v++) {
            const lanes64_d count = lanes64_whole(found[v]);
            memcpy(counts + first + v * LANES64, &count, sizeof count);
        }
    }
}
