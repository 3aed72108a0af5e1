/* SPDX-License-Identifier: Apache-2.0 */
/*
 * phong: the glossy mirror of Shirley (1991). It never reflects more than `reflectance`, and less where a part of the
 * lobe is below the surface.
 *
 *     f cos = reflectance (e + 1) / (2 pi) cos^e(angle to the mirrored direction);   directions with the same density
 */
#include "render/materials/lobes.h"

enum { REFLECTANCE, EXPONENT = 3 };

static float value(const koksma__surface *s, const float w[3], unsigned lobes, float value_out[3])
{
    const float pdf = lobes & KOKSMA__LOBE_GLOSSY ? koksma__cosine_lobe_pdf(s, s->material->values[EXPONENT], w) : 0;
    for (int k = 0; k < 3; k++) {
        value_out[k] += s->material->values[REFLECTANCE + k] * pdf;
    }
    return pdf;
}

static bool sample(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out)
{
    (void)choice;
    if (!(lobes & KOKSMA__LOBE_GLOSSY) ||
        !koksma__cosine_lobe_direction(s, s->material->values[EXPONENT], u, out->w)) {
        return false;
    }
    out->pdf = koksma__cosine_lobe_pdf(s, s->material->values[EXPONENT], out->w);
    out->lobe = KOKSMA__LOBE_GLOSSY;
    for (int k = 0; k < 3; k++) {
        out->weight[k] = s->material->values[REFLECTANCE + k];
    }
    return out->pdf > 0;
}

static const koksma__parameter parameters[] = {
    {"reflectance", KOKSMA__COLOUR, .high = 1, .at = KOKSMA__VALUE(REFLECTANCE)},
    {"exponent", KOKSMA__NUMBER, .high = 1e6, .at = KOKSMA__VALUE(EXPONENT)},
    {0}};

const koksma__bsdf koksma__bsdf_phong = {
    .kind = {.name = "phong",
             .title = "Shirley's glossy mirror (1991): cos^exponent about the mirrored direction",
             .cite = "shirley1991",
             .parameters = parameters},
    .lobes = KOKSMA__LOBE_GLOSSY,
    .form = KOKSMA__FORM_LOBES,
    .value = value,
    .sample = sample,
};
