/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The reflectance of a smooth conductor of the index of refraction n + i k in air (Fresnel's equations with a complex
 * index; Born & Wolf 1999, section 14.2), for unpolarised light at the cosine c from the normal. With
 *
 *     a^2 + b^2 = sqrt((n^2 - k^2 - s^2)^2 + 4 n^2 k^2),  2 a^2 = a^2 + b^2 + n^2 - k^2 - s^2,  s^2 = 1 - c^2
 *
 * the polarised reflectances are
 *
 *     Rs = (a^2 + b^2 - 2 a c + c^2) / (a^2 + b^2 + 2 a c + c^2)
 *     Rp = Rs (c^2 (a^2 + b^2) - 2 a c s^2 + s^4) / (c^2 (a^2 + b^2) + 2 a c s^2 + s^4)
 *
 * and the result is their mean: ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2) at c = 1, and 1 at c = 0.
 */
#ifndef KOKSMA_RENDER_MATERIALS_CONDUCTOR_H
#define KOKSMA_RENDER_MATERIALS_CONDUCTOR_H

#include <math.h>

#include "render/materials/lobes.h"

/* Where the kinds of conductors have their values. */
enum {
    KOKSMA__CONDUCTOR_ETA = 0,
    KOKSMA__CONDUCTOR_K = 3,
    KOKSMA__CONDUCTOR_TINT = 6,
    KOKSMA__CONDUCTOR_ROUGHNESS = 9
};

#define KOKSMA__CONDUCTOR_PARAMETERS                                                                                 \
    {"eta", KOKSMA__COLOUR, .high = 100, .at = KOKSMA__VALUE(KOKSMA__CONDUCTOR_ETA)},                                \
        {"k", KOKSMA__COLOUR, .high = 100, .at = KOKSMA__VALUE(KOKSMA__CONDUCTOR_K)},                                \
    {                                                                                                                \
        "tint", KOKSMA__COLOUR, .high = 1, .optional = true, .fallback = 1,                                          \
                                .at = KOKSMA__VALUE(KOKSMA__CONDUCTOR_TINT)                                          \
    }

static inline float koksma__conductor_reflectance(float eta, float k, float cosine)
{
    const float c2 = cosine * cosine, s2 = 1 - c2, part = eta * eta - k * k - s2;
    const float sum = sqrtf(part * part + 4 * eta * eta * k * k), a2 = 0.5f * (sum + part);
    const float twice = 2 * cosine * sqrtf(a2 > 0 ? a2 : 0);
    const float rs = (sum + c2 - twice) / (sum + c2 + twice);
    const float even = c2 * sum + s2 * s2, odd = twice * s2;
    const float rp = even + odd > 0 ? rs * (even - odd) / (even + odd) : rs;
    return 0.5f * (rs + rp);
}

/* The tinted reflectance of channel k. */
static inline float koksma__conductor_colour(const koksma__shading_material *m, int channel, float cosine)
{
    const float *values = m->values + channel;
    return values[KOKSMA__CONDUCTOR_TINT] *
           koksma__conductor_reflectance(values[KOKSMA__CONDUCTOR_ETA], values[KOKSMA__CONDUCTOR_K], cosine);
}

#endif
