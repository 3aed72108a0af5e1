/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Colours of an image at texture coordinates: interpolated bilinearly between the four nearest pixels, whose centres
 * are at half-integers, or taken from the nearest pixel. Beyond its edge an image is repeated, mirrored, or clamped
 * to the edge. The functions are inline because wavefront.c, the mesh lights and the module that traces meshes, which
 * needs the alpha of triangles, all use them.
 */
#ifndef KOKSMA_RENDER_TEXTURE_H
#define KOKSMA_RENDER_TEXTURE_H

#include <math.h>
#include <stddef.h>

#include "render/description.h"

/* Finds the two pixels around the coordinate x in an image n pixels wide: `pair` gets their indices, wrapped, and the
   weight of the second pixel is returned. */
static inline float koksma__texture_split(float x, int n, koksma__wrap wrap, size_t pair[2])
{
    /* mirrored coordinates go from 0 to 1 and back */
    const float half = 0.5f * x, turn = 2 * (half - floorf(half));
    const float turns = wrap == KOKSMA__WRAP_REPEAT   ? x - floorf(x)
                        : wrap == KOKSMA__WRAP_MIRROR ? (turn > 1 ? 2 - turn : turn)
                        : x > 0                       ? fminf(x, 1)
                                                      : 0;
    /* a coordinate that is not finite, as those of a mesh may be, has no place: it counts as 0 */
    const float place = (turns >= 0 ? turns : 0) * (float)n - 0.5f, down = floorf(place);
    const int first = (int)down;
    const bool repeated = wrap == KOKSMA__WRAP_REPEAT;
    pair[0] = (size_t)(repeated ? (first + n) % n : first < 0 ? 0 : first < n ? first : n - 1);
    pair[1] = (size_t)(repeated ? (first + 1 + n) % n : first + 1 < n ? first + 1 : n - 1);
    return place - down;
}

/* An image over the plane: (0, 0) is the lower left corner of its lower left pixel, (1, 1) the upper right corner of
   the upper right pixel. rgb gets the colour, clamped to `most`; pixels that are NaN count as 0. */
static inline void koksma__texture(const koksma_image *image, const koksma__mapping *m, float u, float v, float most,
                                   float rgb[3])
{
    size_t xs[2], ys[2];
    const size_t channels = (size_t)image->channels, width = (size_t)image->width;
    if (m->moved) {
        const float s = m->matrix[0] * u + m->matrix[1] * v + m->matrix[2];
        v = m->matrix[3] * u + m->matrix[4] * v + m->matrix[5];
        u = s;
    }
    float x = koksma__texture_split(u, image->width, m->wrap[0], xs);
    float y = koksma__texture_split(1 - v, image->height, m->wrap[1], ys);
    if (m->nearest) {
        x = x < 0.5f ? 0 : 1;
        y = y < 0.5f ? 0 : 1;
    }
    const float weights[4] = {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    for (size_t k = 0; k < 3; k++) {
        rgb[k] = 0;
        for (size_t i = 0; i < 4; i++) {
            const float value = image->pixels[(ys[i / 2] * width + xs[i % 2]) * channels + k % channels];
            rgb[k] += value > 0 ? weights[i] * (value < most ? value : most) : 0;
        }
    }
}

#endif
