/* SPDX-License-Identifier: Apache-2.0 */
/*
 * dielectric: smooth glass. Light is reflected by Fresnel's share R of unpolarised light, and the rest refracted by
 * Snell's law; `choice` says which, with the weight 1 (times the tint). Radiance is followed from the eye, so that
 * the refracted ray would gain a factor of the squared ratio of indices going in and lose it coming out; as every
 * path that comes in goes out again, it is left away (Veach 1997, section 5.2, keeps it for lights inside).
 */
#include "render/materials/lobes.h"

static float value(const koksma__surface *s, const float w[3], unsigned lobes, float value_out[3])
{
    (void)s, (void)w, (void)lobes, (void)value_out;
    return 0;
}

/* Fresnel's reflected share; the cosine of the refracted ray in *inner, 0 with total reflection. */
static float reflected_share(float cosine, float ratio, float *inner)
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

static void set(const koksma__surface *s, float share, koksma__scatter *out)
{
    out->density = 0;
    out->lobe = KOKSMA__LOBE_SPECULAR;
    for (int k = 0; k < 3; k++) {
        out->weight[k] = share * s->substance->reflectance[k];
    }
}

static void refract(const koksma__surface *s, float cosine, float ratio, float inner, float w[3])
{
    for (int k = 0; k < 3; k++) {
        w[k] = (ratio * cosine - inner) * s->n[k] - ratio * s->out[k];
    }
}

bool koksma__dielectric_split(const koksma__surface *s, koksma__scatter *reflected, koksma__scatter *refracted)
{
    if (s->substance->kind != KOKSMA__MATERIAL_DIELECTRIC) {
        return false;
    }
    const float ratio = s->inside ? s->substance->ior : 1 / s->substance->ior; /* from this side to the other */
    const float cosine = koksma__dot3(s->n, s->out);
    float inner;
    const float share = reflected_share(cosine, ratio, &inner);
    set(s, share, reflected);
    set(s, 1 - share, refracted);
    koksma__mirror3(s->out, s->n, reflected->w);
    refract(s, cosine, ratio, inner, refracted->w);
    return true;
}

static bool sample(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out)
{
    koksma__scatter reflected, refracted;
    (void)u;
    if (!(lobes & KOKSMA__LOBE_SPECULAR)) {
        return false;
    }
    koksma__dielectric_split(s, &reflected, &refracted);
    const float ratio = s->inside ? s->substance->ior : 1 / s->substance->ior;
    float inner;
    const float share = reflected_share(koksma__dot3(s->n, s->out), ratio, &inner);
    *out = choice < share ? reflected : refracted;
    set(s, 1, out);
    return true;
}

const koksma__material_rules koksma__material_dielectric = {
    .cite = "whitted1980 veach1997",
    .lobes = KOKSMA__LOBE_SPECULAR,
    .value = value,
    .sample = sample,
};
