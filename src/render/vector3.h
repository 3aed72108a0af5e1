/* SPDX-License-Identifier: Apache-2.0 */
/* Vectors of three floats, for code that handles one ray at a time. */
#ifndef KOKSMA_RENDER_VECTOR3_H
#define KOKSMA_RENDER_VECTOR3_H

#include <math.h>
#include <stdbool.h>

#include "render/lanes3.h"

#define KOKSMA__PI_F 3.14159265358979f

static inline float koksma__dot3(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void koksma__unit3(float v[3])
{
    const float scale = 1 / sqrtf(koksma__dot3(v, v));
    for (int k = 0; k < 3; k++) {
        v[k] *= scale;
    }
}

static inline float koksma__max3(const float v[3])
{
    const float m = v[0] > v[1] ? v[0] : v[1];
    return m > v[2] ? m : v[2];
}

static inline float koksma__luminance3(const float v[3])
{
    return 0.2126f * v[0] + 0.7152f * v[1] + 0.0722f * v[2];
}

/* The mirror image of the direction w (towards the eye) at the unit normal n. */
static inline void koksma__mirror3(const float w[3], const float n[3], float out[3])
{
    const float twice = 2 * koksma__dot3(w, n);
    for (int k = 0; k < 3; k++) {
        out[k] = twice * n[k] - w[k];
    }
}

/* A direction about n with density cosine / pi. */
static inline void koksma__cosine_direction(const float n[3], const float u[2], float w[3])
{
    koksma__v3_to(koksma__v3_cosine_direction(koksma__v3_of(n), u[0], u[1]), w);
}

#endif
