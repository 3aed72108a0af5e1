/* SPDX-License-Identifier: Apache-2.0 */
/* The lobes that several materials have. */
#ifndef KOKSMA_RENDER_MATERIALS_LOBES_H
#define KOKSMA_RENDER_MATERIALS_LOBES_H

#include "render/materials/materials.h"
#include "render/vector3.h"

/* Lambert: albedo / pi; the density of koksma__cosine_direction. */
static inline float koksma__lambert_value(const koksma__surface *s, const float w[3], float value[3])
{
    const float cosine = koksma__dot3(s->n, w);
    if (!(cosine > 0)) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        value[k] += s->albedo[k] * cosine / KOKSMA__PI_F;
    }
    return cosine / KOKSMA__PI_F;
}

/* value and sample of a surface that is Lambert and nothing else; bsdf_lambert.c. */
float koksma__lambert_bsdf_value(const koksma__surface *s, const float w[3], unsigned lobes, float value[3]);
bool koksma__lambert_bsdf_sample(const koksma__surface *s, unsigned lobes, const float u[2], float choice,
                                 koksma__scatter *out);

/* The cosine lobe of Shirley (1991, section 5.5.6): directions about the mirror's with density (e + 1) / (2 pi)
   cos^e, each weighing `reflectance`; those under the surface are lost. Times the cosine the material is reflectance
   x density.
 */
static inline float koksma__cosine_lobe_pdf(const koksma__surface *s, float exponent, const float w[3])
{
    float mirror[3];
    koksma__mirror3(s->out, s->n, mirror);
    const float cosine = koksma__dot3(mirror, w), e = exponent;
    return cosine > 0 && koksma__dot3(s->n, w) > 0 ? (e + 1) / (2 * KOKSMA__PI_F) * powf(cosine, e) : 0;
}

/* False under the surface. */
static inline bool koksma__cosine_lobe_direction(const koksma__surface *s, float exponent, const float u[2],
                                                 float w[3])
{
    float mirror[3], a[3], b[3];
    koksma__mirror3(s->out, s->n, mirror);
    koksma__frame3(mirror, a, b);
    const float cosine = powf(1 - u[0], 1 / (exponent + 1)), turn = 2 * KOKSMA__PI_F * u[1];
    const float rest = 1 - cosine * cosine, sine = sqrtf(rest > 0 ? rest : 0);
    for (int k = 0; k < 3; k++) {
        w[k] = sine * cosf(turn) * a[k] + sine * sinf(turn) * b[k] + cosine * mirror[k];
    }
    return koksma__dot3(s->n, w) > 0;
}

#endif
