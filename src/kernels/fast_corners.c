/* SPDX-License-Identifier: Apache-2.0 */
/* Corners whose count and volume differ too much: most blocks have none, and are left after one comparison. */
#include "kernels/kernels.h"

enum { BLOCK = 32 };

size_t KERNEL_NAME(far_corners)(size_t count, const int16_t *counts, const double *xs, double y, double sign,
                                double limit, uint32_t *out);

size_t KERNEL_NAME(far_corners)(size_t count, const int16_t *counts, const double *xs, double y, double sign,
                                double limit, uint32_t *out)
{
    size_t found = 0, k = 0;
    for (; k + BLOCK <= count; k += BLOCK) {
        double most = 0;
        for (size_t l = 0; l < BLOCK; l++) {
            const double d = sign * (counts[k + l] - xs[k + l] * y);
            most = d > most ? d : most;
        }
        for (size_t l = 0; most > limit && l < BLOCK; l++) {
            out[found] = (uint32_t)(k + l);
            found += sign * (counts[k + l] - xs[k + l] * y) > limit;
        }
    }
    for (; k < count; k++) {
        if (sign * (counts[k] - xs[k] * y) > limit) {
            out[found++] = (uint32_t)k;
        }
    }
    return found;
}
