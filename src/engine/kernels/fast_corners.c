/* SPDX-License-Identifier: Apache-2.0 */
/* Finds the corners of boxes anchored at 0 whose number of points differs from n times their volume by more than a
   limit. Most blocks of corners have no such corner; comparing the block's largest difference with the limit shows
   this. */
#include "kernels/kernels.h"

enum { BLOCK = 128, LANES = 32 };

/* Returns the largest difference over `count` corners, or 0 if all are negative; count is a multiple of LANES. */
static float largest(size_t count, const int16_t *restrict counts, const float *restrict xs, float sign, float y)
{
    float most[LANES] = {0}, largest = 0;
    for (size_t k = 0; k < count; k += LANES) {
        for (size_t l = 0; l < LANES; l++) {
            const float d = sign * counts[k + l] - xs[k + l] * y;
            most[l] = d > most[l] ? d : most[l];
        }
    }
    for (size_t l = 0; l < LANES; l++) {
        largest = most[l] > largest ? most[l] : largest;
    }
    return largest;
}

size_t KERNEL_NAME(far_corners)(size_t count, const int16_t *counts, const float *xs, float sign, float y,
                                float limit, uint32_t *out)
{
    size_t found = 0;
    for (size_t k = 0; k < count;) {
        const size_t left = count - k, whole = left / LANES * LANES;
        const size_t some = left >= BLOCK ? BLOCK : whole ? whole : left, end = k + some;
        if (whole && largest(some, counts + k, xs + k, sign, y) <= limit) {
            k = end;
        }
        for (; k < end; k++) {
            out[found] = (uint32_t)k;
            found += sign * counts[k] - xs[k] * y > limit;
        }
    }
    return found;
}
