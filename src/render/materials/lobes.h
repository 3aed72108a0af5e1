/* SPDX-License-Identifier: Apache-2.0 */
/* The reflection lobes that several materials share. */
#ifndef KOKSMA_RENDER_MATERIALS_LOBES_H
#define KOKSMA_RENDER_MATERIALS_LOBES_H

#include "render/lanes3.h"
#include "render/materials/materials.h"
#include "render/vector3.h"

/* The density of koksma__cosine_direction for a direction with this cosine; multiplied by the albedo it is the value
   of a Lambert surface times the cosine. */
KOKSMA__INLINE float koksma__lambert_pdf(float cosine)
{
    return cosine > 0 ? cosine * (1 / KOKSMA__PI_F) : 0;
}

static inline float koksma__lambert_value(const koksma__surface *s, const float w[3], float value[3])
{
    const float pdf = koksma__lambert_pdf(koksma__dot3(s->n, w));
    for (int k = 0; k < 3; k++) {
        value[k] += s->albedo[k] * pdf;
    }
    return pdf;
}

/* value() and sample() of a purely Lambert surface. */
static inline float koksma__lambert_bsdf_value(const koksma__surface *s, const float w[3], unsigned lobes,
                                               float value_out[3])
{
    return lobes & KOKSMA__LOBE_DIFFUSE ? koksma__lambert_value(s, w, value_out) : 0;
}

static inline bool koksma__lambert_bsdf_sample(const koksma__surface *s, unsigned lobes, const float u[2],
                                               float choice, koksma__scatter *out)
{
    (void)choice;
    if (!(lobes & KOKSMA__LOBE_DIFFUSE)) {
        return false;
    }
    koksma__cosine_direction(s->n, u, out->w);
    out->pdf = koksma__lambert_pdf(koksma__dot3(s->n, out->w));
    out->lobe = KOKSMA__LOBE_DIFFUSE;
    for (int k = 0; k < 3; k++) {
        out->weight[k] = s->albedo[k];
    }
    return out->pdf > 0;
}

/* value() of a purely specular surface. */
static inline float koksma__specular_bsdf_value(const koksma__surface *s, const float w[3], unsigned lobes,
                                                float value_out[3])
{
    (void)s, (void)w, (void)lobes, (void)value_out;
    return 0;
}

/* Fresnel's reflectance for unpolarised light. ratio: the index on this side divided by the index on the other side;
   *inner: the cosine of the refracted ray, 0 for total reflection. */
static inline float koksma__reflected_share(float cosine, float ratio, float *inner)
{
    const float square = 1 - (1 - cosine * cosine) * ratio * ratio;
    *inner = square > 0 ? sqrtf(square) : 0;
    if (!(square > 0)) {
        return 1;
    }
    const float across = (ratio * cosine - *inner) / (ratio * cosine + *inner);
    const float along = (cosine - ratio * *inner) / (cosine + ratio * *inner);
    return 0.5f * (across * across + along * along);
}

/* The cosine lobe of Shirley (1991, section 5.5.6): directions about the mirrored one with density (e + 1) / (2 pi)
   cos^e, each with the weight `reflectance`; directions below the surface are lost. The material's value times the
   cosine is reflectance times density. */
KOKSMA__INLINE float koksma__lobe_pdf(koksma__v3 n, koksma__v3 out, float exponent, koksma__v3 w)
{
    const float cosine = koksma__v3_dot(koksma__v3_mirror(out, n), w), above = koksma__v3_dot(n, w);
    const float least = cosine > 0 ? cosine : 0, inside = least < 1 ? least : 1;
    const float pdf = (exponent + 1) * (0.5f / KOKSMA__PI_F) * koksma__power(inside, exponent);
    const int seen = (cosine > 0) & (above > 0);
    return seen ? pdf : 0;
}

KOKSMA__INLINE koksma__v3 koksma__lobe_direction(koksma__v3 n, koksma__v3 out, float exponent, float u, float v)
{
    const float cosine = koksma__power(1 - u, 1 / (exponent + 1)), rest = 1 - cosine * cosine;
    const float sine = sqrtf(rest > 0 ? rest : 0);
    float x, y;
    koksma__sine_cosine_turns(v, &y, &x);
    return koksma__v3_about(koksma__v3_mirror(out, n), sine * x, sine * y, cosine);
}

static inline float koksma__cosine_lobe_pdf(const koksma__surface *s, float exponent, const float w[3])
{
    return koksma__lobe_pdf(koksma__v3_of(s->n), koksma__v3_of(s->out), exponent, koksma__v3_of(w));
}

/* Returns false if the direction is below the surface. */
static inline bool koksma__cosine_lobe_direction(const koksma__surface *s, float exponent, const float u[2],
                                                 float w[3])
{
    koksma__v3_to(koksma__lobe_direction(koksma__v3_of(s->n), koksma__v3_of(s->out), exponent, u[0], u[1]), w);
    return koksma__dot3(s->n, w) > 0;
}

#endif
