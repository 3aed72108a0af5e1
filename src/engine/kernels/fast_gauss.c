/* SPDX-License-Identifier: Apache-2.0 */
/* The Gaussian forces of the pattern gaussian-blue-noise. Sums run in eight lanes for every vector width, so that all
   instruction sets give the same bits. */
#include "kernels/kernels.h"
#include "kernels/lanes64.h"

enum { LANES = 8, PARTS = LANES / LANES64 };

/* Returns exp(z) for -50 <= z <= 0 with a relative error of 1e-11, as 2^k exp(r) with z = k ln 2 + r and |r| <= ln 2
   / 2. exp(r) is its Taylor series up to r^9 (in Estrin's scheme, which shortens the chain of dependent steps).
   Adding 3 * 2^51 rounds to the nearest whole number k and leaves k in the low bits of the sum. */
static inline lanes64_d fall(lanes64_d z)
{
    const lanes64_d shifted = z * 0x1.71547652b82fep+0 + 0x1.8p52, k = shifted - 0x1.8p52;
    const lanes64_d r = (z - k * 0x1.62e42feep-1) - k * 0x1.a39ef35793c76p-33, r2 = r * r, r4 = r2 * r2;
    const lanes64_d low = (1 + r) + (1.0 / 2 + r * (1.0 / 6)) * r2;
    const lanes64_d middle = (1.0 / 24 + r * (1.0 / 120)) + (1.0 / 720 + r * (1.0 / 5040)) * r2;
    const lanes64_d sum = (low + middle * r4) + (1.0 / 40320 + r * (1.0 / 362880)) * (r4 * r4);
    return sum * (lanes64_d)(((lanes64_u)shifted + 1023) << 52);
}

static inline lanes64_d short_way(lanes64_d t)
{
    const lanes64_d one = lanes64_splat_d(1);
    return t - lanes64_masked((lanes64_i)(t > 0.5), one) + lanes64_masked((lanes64_i)(t < -0.5), one);
}

void KERNEL_NAME(gauss_force)(size_t runs, const uint32_t *run, const double *xs, const double *ys, double x,
                              double y, double scale, double cut2, double force[2])
{
    lanes64_d sum[2][PARTS] = {{{0}}, {{0}}};
    for (size_t r = 0; r < runs; r++) {
        for (uint32_t i = run[2 * r], end = run[2 * r + 1]; i < end; i += LANES) {
            for (int p = 0; p < PARTS; p++) {
                const lanes64_i inside = (lanes64_i)(lanes64_count() + (uint64_t)(p * LANES64) < (uint64_t)(end - i));
                const lanes64_d a = short_way(lanes64_load_d(xs + i + p * LANES64) - x);
                const lanes64_d b = short_way(lanes64_load_d(ys + i + p * LANES64) - y);
                const lanes64_d square = a * a + b * b;
                const lanes64_d w = lanes64_masked(inside & (lanes64_i)(square <= cut2), fall(square * scale));
                sum[0][p] -= w * a;
                sum[1][p] -= w * b;
            }
        }
    }
    for (int k = 0; k < 2; k++) {
        double s[LANES];
        memcpy(s, sum[k], sizeof s);
        force[k] = ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
    }
}
