/* SPDX-License-Identifier: Apache-2.0 */
/*
 * dielectric: smooth glass. The fraction R of the light, Fresnel's reflectance for unpolarised light, is reflected,
 * and the rest is refracted by Snell's law. The random number `choice` selects reflection with probability R, so that
 * the weight of a sample is 1 (times the tint). Refraction multiplies the radiance by the squared ratio of indices on
 * entering and divides it by the same number on leaving. Every path from the eye that enters also leaves, so this
 * factor is omitted (Veach 1997, section 5.2, keeps it for lights inside).
 */
#include "render/materials/lobes.h"

enum { TINT, IOR = 3 };

static void set(const koksma__surface *s, float share, koksma__scatter *out)
{
    out->pdf = 0;
    out->lobe = KOKSMA__LOBE_SPECULAR;
    for (int k = 0; k < 3; k++) {
        out->weight[k] = share * s->material->values[TINT + k];
    }
}

static void refract(const koksma__surface *s, float cosine, float ratio, float inner, float w[3])
{
    for (int k = 0; k < 3; k++) {
        w[k] = (ratio * cosine - inner) * s->n[k] - ratio * s->out[k];
    }
}

static void split(const koksma__surface *s, koksma__scatter *reflected, koksma__scatter *refracted)
{
    /* index of refraction on the other side divided by that on this side */
    const float ior = s->material->values[IOR], ratio = s->inside ? ior : 1 / ior;
    const float cosine = koksma__dot3(s->n, s->out);
    float inner;
    const float share = koksma__reflected_share(cosine, ratio, &inner);
    set(s, share, reflected);
    set(s, 1 - share, refracted);
    koksma__mirror3(s->out, s->n, reflected->w);
    refract(s, cosine, ratio, inner, refracted->w);
}

static bool sample(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out)
{
    koksma__scatter reflected, refracted;
    (void)u;
    if (!(lobes & KOKSMA__LOBE_SPECULAR)) {
        return false;
    }
    split(s, &reflected, &refracted);
    const float ior = s->material->values[IOR], ratio = s->inside ? ior : 1 / ior;
    float inner;
    const float share = koksma__reflected_share(koksma__dot3(s->n, s->out), ratio, &inner);
    *out = choice < share ? reflected : refracted;
    set(s, 1, out);
    return true;
}

static const koksma__parameter parameters[] = {
    {"tint", KOKSMA__COLOUR, .high = 1, .optional = true, .fallback = 1, .at = KOKSMA__VALUE(TINT)},
    {"ior", KOKSMA__NUMBER, .low = 1.0001, .high = 10, .at = KOKSMA__VALUE(IOR)},
    {0}};

const koksma__bsdf koksma__bsdf_dielectric = {
    .kind = {.name = "dielectric",
             .title = "smooth glass in air",
             .cite = "whitted1980 veach1997",
             .parameters = parameters},
    .lobes = KOKSMA__LOBE_SPECULAR,
    .takes_choice = true,
    .value = koksma__specular_bsdf_value,
    .sample = sample,
    .split = split,
};
