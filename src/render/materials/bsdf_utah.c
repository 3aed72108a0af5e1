/* SPDX-License-Identifier: Apache-2.0 */
/*
 * utah: the local model of Phong (1975) as the sum of a Lambert part and a cosine lobe, which together reflect no
 * more than albedo + reflectance <= 1. Directions are sampled from either lobe in proportion to its luminance; the
 * weight of a direction is the material's value divided by the density of the mixture of both lobes.
 *
 *     f cos = albedo cos / pi + reflectance (e + 1) / (2 pi) cos^e(angle to the mirrored direction)
 */
#include "render/materials/lobes.h"

enum { REFLECTANCE, EXPONENT = 3 };

static float share(const koksma__surface *s, unsigned lobes)
{
    const bool diffuse = lobes & KOKSMA__LOBE_DIFFUSE, glossy = lobes & KOKSMA__LOBE_GLOSSY;
    return diffuse && glossy ? s->material->derived : diffuse ? 1 : 0;
}

static float value(const koksma__surface *s, const float w[3], unsigned lobes, float value_out[3])
{
    const float diffuse = lobes & KOKSMA__LOBE_DIFFUSE ? koksma__lambert_value(s, w, value_out) : 0;
    const float glossy =
        lobes & KOKSMA__LOBE_GLOSSY ? koksma__cosine_lobe_pdf(s, s->material->values[EXPONENT], w) : 0;
    for (int k = 0; k < 3; k++) {
        value_out[k] += s->material->values[REFLECTANCE + k] * glossy;
    }
    const float part = share(s, lobes);
    return part * diffuse + (1 - part) * glossy;
}

static bool sample(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out)
{
    lobes &= KOKSMA__LOBE_DIFFUSE | KOKSMA__LOBE_GLOSSY;
    float all[3] = {0, 0, 0};
    if (!lobes) {
        return false;
    }
    if (choice < share(s, lobes)) {
        koksma__cosine_direction(s->n, u, out->w);
        out->lobe = KOKSMA__LOBE_DIFFUSE;
    } else {
        out->lobe = KOKSMA__LOBE_GLOSSY;
        if (!koksma__cosine_lobe_direction(s, s->material->values[EXPONENT], u, out->w)) {
            return false;
        }
    }
    out->pdf = value(s, out->w, lobes, all);
    for (int k = 0; k < 3; k++) {
        out->weight[k] = out->pdf > 0 ? all[k] / out->pdf : 0;
    }
    return out->pdf > 0;
}

/* Sets the probability of the diffuse lobe, which is its share of the luminance. */
static void prepare(koksma__shading_material *m)
{
    const float diffuse = koksma__luminance3(m->albedo[0]) + koksma__luminance3(m->albedo[1]);
    const float all = diffuse + 2 * koksma__luminance3(m->values + REFLECTANCE);
    m->derived = all > 0 ? diffuse / all : 1;
}

static const char *check(const koksma__material *m)
{
    for (int i = 0; i < 6; i++) {
        if (m->albedo[i / 3][i % 3] + m->values[REFLECTANCE + i % 3] > 1) {
            return "albedo + reflectance is above 1: it would reflect more light than arrives";
        }
    }
    return NULL;
}

static const koksma__parameter parameters[] = {
    {"reflectance", KOKSMA__COLOUR, .high = 1, .at = KOKSMA__VALUE(REFLECTANCE)},
    {"exponent", KOKSMA__NUMBER, .high = 1e6, .at = KOKSMA__VALUE(EXPONENT)},
    {0}};

const koksma__bsdf koksma__bsdf_utah = {
    .kind = {.name = "utah",
             .title = "Lambert and a Phong lobe; albedo + reflectance is at most 1",
             .cite = "phong1975",
             .parameters = parameters},
    .lobes = KOKSMA__LOBE_DIFFUSE | KOKSMA__LOBE_GLOSSY,
    .diffuse = KOKSMA__ALBEDO | KOKSMA__CHECKER,
    .check = check,
    .prepare = prepare,
    .form = KOKSMA__FORM_LOBES,
    .takes_choice = true,
    .value = value,
    .sample = sample,
};
