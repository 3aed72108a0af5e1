/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Metals: each kind reflects the fraction F of the light, in each channel, and is smooth or rough.
 *
 *     kind              F                                                       surface
 *     mirror            `reflectance`, at all angles                            smooth
 *     conductor         Fresnel's equations for the index eta + i k, tinted     smooth
 *     ggx               Schlick's approximation, `reflectance` at the normal    rough
 *     rough-conductor   as conductor                                            rough
 *
 * A smooth surface has L(out) = F(n.out) L(2 (n.out) n - out) (Whitted 1980). A rough one consists of such facets with
 * slopes of the GGX law (Walter et al. 2007), a = roughness^2, and Smith's height-correlated shadowing:
 *
 *     value cos = F D G2 / (4 n.out)
 *
 * Directions are sampled by visible facets (Heitz 2018), with density D G1(out) / (4 n.out), so that the weight of a
 * direction is F G2 / G1. Light scattered between facets is lost: a white metal reflects less than all light, at
 * roughness 1 only 0.307 of it at normal incidence (1 - ln 2) and 0.379 at n.out = 0.7.
 */
#include "render/materials/lobes.h"

/* The values of the kinds: mirror and ggx have a reflectance in place of an index. */
enum { REFLECTANCE, ROUGHNESS = 3, ETA = 0, K = 3, CONDUCTOR_TINT = 6, CONDUCTOR_ROUGHNESS = 9 };

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
static float fresnel(float eta, float k, float cosine)
{
    const float c2 = cosine * cosine, s2 = 1 - c2, part = eta * eta - k * k - s2;
    const float sum = sqrtf(part * part + 4 * eta * eta * k * k), a2 = 0.5f * (sum + part);
    const float twice = 2 * cosine * sqrtf(a2 > 0 ? a2 : 0);
    const float rs = (sum + c2 - twice) / (sum + c2 + twice);
    const float even = c2 * sum + s2 * s2, odd = twice * s2;
    const float rp = even + odd > 0 ? rs * (even - odd) / (even + odd) : rs;
    return 0.5f * (rs + rp);
}

/* F of channel k. */
static float reflectance(const koksma__shading_material *m, int k, float cosine)
{
    const float *values = m->values + k;
    return m->bsdf == &koksma__bsdf_mirror ? values[REFLECTANCE]
           : m->bsdf == &koksma__bsdf_ggx  ? koksma__schlick(values[REFLECTANCE], cosine)
                                           : values[CONDUCTOR_TINT] * fresnel(values[ETA], values[K], cosine);
}

/* ---- Smooth metals --------------------------------------------------------------------------------------------- */

static bool mirror(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out)
{
    (void)u, (void)choice;
    if (!(lobes & KOKSMA__LOBE_SPECULAR)) {
        return false;
    }
    koksma__mirror3(s->out, s->n, out->w);
    out->pdf = 0;
    out->lobe = KOKSMA__LOBE_SPECULAR;
    for (int k = 0; k < 3; k++) {
        out->weight[k] = reflectance(s->material, k, koksma__dot3(s->n, s->out));
    }
    return true;
}

#define CONDUCTOR_PARAMETERS                                                                                         \
    {"eta", KOKSMA__COLOUR, .high = 100, .at = KOKSMA__VALUE(ETA)},                                                  \
        {"k", KOKSMA__COLOUR, .high = 100, .at = KOKSMA__VALUE(K)},                                                  \
    {                                                                                                                \
        "tint", KOKSMA__COLOUR, .high = 1, .optional = true, .fallback = 1, .at = KOKSMA__VALUE(CONDUCTOR_TINT)      \
    }

static const koksma__parameter of_mirror[] = {
    {"reflectance", KOKSMA__COLOUR, .high = 1, .at = KOKSMA__VALUE(REFLECTANCE)}, {0}};
static const koksma__parameter of_conductor[] = {CONDUCTOR_PARAMETERS, {0}};

const koksma__bsdf koksma__bsdf_mirror = {
    .kind = {.name = "mirror", .title = "a smooth mirror", .cite = "whitted1980", .parameters = of_mirror},
    .lobes = KOKSMA__LOBE_SPECULAR,
    .value = koksma__specular_value,
    .sample = mirror,
};

const koksma__bsdf koksma__bsdf_conductor = {
    .kind = {.name = "conductor",
             .title = "a smooth metal with Fresnel's reflectance for the index eta + i k",
             .cite = "whitted1980 born1999",
             .parameters = of_conductor},
    .lobes = KOKSMA__LOBE_SPECULAR,
    .value = koksma__specular_value,
    .sample = mirror,
};

/* ---- Rough metals ---------------------------------------------------------------------------------------------- */

static koksma__facets facets_of(const koksma__surface *s)
{
    const int roughness = s->material->bsdf == &koksma__bsdf_ggx ? ROUGHNESS : CONDUCTOR_ROUGHNESS;
    return koksma__facets_of(koksma__v3_of(s->n), koksma__v3_of(s->out), s->material->values[roughness]);
}

static float value(const koksma__surface *s, const float w[3], unsigned lobes, float value_out[3])
{
    const koksma__facets facets = facets_of(s);
    const koksma__facet_terms t = koksma__facet_terms_of(&facets, koksma__v3_of(w));
    if (!(lobes & KOKSMA__LOBE_GLOSSY)) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        value_out[k] += t.pdf * t.ratio * reflectance(s->material, k, t.at_facet);
    }
    return t.pdf;
}

static bool sample(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out)
{
    (void)choice;
    if (!(lobes & KOKSMA__LOBE_GLOSSY)) {
        return false;
    }
    const koksma__facets facets = facets_of(s);
    const koksma__v3 w = koksma__facet_direction(&facets, u[0], u[1]);
    const koksma__facet_terms t = koksma__facet_terms_of(&facets, w);
    koksma__v3_to(w, out->w);
    out->pdf = t.pdf;
    out->lobe = KOKSMA__LOBE_GLOSSY;
    for (int k = 0; k < 3; k++) {
        out->weight[k] = t.ratio * reflectance(s->material, k, t.at_facet);
    }
    return out->pdf > 0;
}

static const koksma__parameter of_ggx[] = {
    {"reflectance", KOKSMA__COLOUR, .high = 1, .at = KOKSMA__VALUE(REFLECTANCE)},
    {"roughness", KOKSMA__NUMBER, .low = 1e-3, .high = 1, .at = KOKSMA__VALUE(ROUGHNESS)},
    {0}};
static const koksma__parameter of_rough_conductor[] = {
    CONDUCTOR_PARAMETERS,
    {"roughness", KOKSMA__NUMBER, .low = 1e-3, .high = 1, .at = KOKSMA__VALUE(CONDUCTOR_ROUGHNESS)},
    {0}};

const koksma__bsdf koksma__bsdf_ggx = {
    .kind = {.name = "ggx",
             .title = "a rough metal: GGX facets with a = roughness^2, Schlick's reflectance",
             .cite = "walter2007 heitz2018",
             .parameters = of_ggx},
    .lobes = KOKSMA__LOBE_GLOSSY,
    .reciprocal = true,
    .form = KOKSMA__FORM_FACETS,
    .value = value,
    .sample = sample,
};

const koksma__bsdf koksma__bsdf_rough_conductor = {
    .kind = {.name = "rough-conductor",
             .title = "a rough metal: GGX facets with Fresnel's reflectance for the index eta + i k",
             .cite = "walter2007 heitz2018 born1999",
             .parameters = of_rough_conductor},
    .lobes = KOKSMA__LOBE_GLOSSY,
    .reciprocal = true,
    .value = value,
    .sample = sample,
};
