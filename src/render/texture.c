/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Colours of an image at texture coordinates: bilinear between the four nearest pixels, whose centres are at half
 * numbers; repeated or, beyond the edge, the edge's own.
 */
#include "render/texture.h"

#include <math.h>

/* x - 0.5 as a pixel, the one after it (both round the edge, or held at it), and the weight of the second. */
static float split(float x, int n, bool repeated, size_t pair[2])
{
    const float turns = repeated ? x - floorf(x)
                        : x > 0  ? fminf(x, 1)
                                 : 0,
                place = turns * (float)n - 0.5f, down = floorf(place);
    const int first = (int)down;
    pair[0] = (size_t)(repeated ? (first + n) % n : first < 0 ? 0 : first < n ? first : n - 1);
    pair[1] = (size_t)(repeated ? (first + 1 + n) % n : first + 1 < n ? first + 1 : n - 1);
    return place - down;
}

void koksma__texture(const koksma_image *image, float u, float v, bool repeated, float rgb[3])
{
    size_t xs[2], ys[2];
    const size_t channels = (size_t)image->channels, width = (size_t)image->width;
    const float x = split(u, image->width, repeated, xs), y = split(1 - v, image->height, repeated, ys);
    const float weights[4] = {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    for (size_t k = 0; k < 3; k++) {
        rgb[k] = 0;
        for (size_t i = 0; i < 4; i++) {
            const float value = image->pixels[(ys[i / 2] * width + xs[i % 2]) * channels + k % channels];
            rgb[k] += value > 0 ? weights[i] * (value < 1 ? value : 1) : 0; /* a NaN is dark */
        }
    }
}
