/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The materials that consist of a Lambert part, a cosine lobe about the mirrored direction, or both:
 *
 *     f cos = albedo cos / pi + reflectance (e + 1) / (2 pi) cos^e(angle to the mirrored direction)
 *
 *     lambert   the first term: reflects the fraction `albedo`, with equal radiance in all directions
 *     checker   the same with two albedos, in squares of a flat shape's own coordinates or of a mesh's texture
 *               coordinates (render/description.h has the formula); the caller selects the square's albedo before it
 *               evaluates the material
 *     phong     the second term: the glossy mirror of Shirley (1991), which reflects less than `reflectance` where a
 *               part of the lobe is below the surface
 *     utah      both: the local model of Phong (1975), with albedo + reflectance <= 1
 *
 * Each term has a lobe with that density, and directions are sampled from either in proportion to its luminance; the
 * weight of a direction is the value divided by the density of the mixture. Images are shaded in blocks by
 * batch_materials.c; the functions below say for one ray what is right.
 */
#include "render/materials/lobes.h"

enum { REFLECTANCE, EXPONENT = 3 };

/* The probability of sampling the Lambert part, of the requested lobes that the material has. */
static float share(const koksma__surface *s, unsigned lobes)
{
    const bool diffuse = lobes & KOKSMA__LOBE_DIFFUSE, glossy = lobes & KOKSMA__LOBE_GLOSSY;
    return diffuse && glossy ? s->material->derived : diffuse ? 1 : 0;
}

static float value(const koksma__surface *s, const float w[3], unsigned lobes, float value_out[3])
{
    const koksma__v3 n = koksma__v3_of(s->n), out = koksma__v3_of(s->out);
    lobes &= s->material->bsdf->lobes;
    const float diffuse = lobes & KOKSMA__LOBE_DIFFUSE ? koksma__lambert_pdf(koksma__dot3(s->n, w)) : 0;
    const float glossy =
        lobes & KOKSMA__LOBE_GLOSSY ? koksma__lobe_pdf(n, out, s->material->values[EXPONENT], koksma__v3_of(w)) : 0;
    for (int k = 0; k < 3; k++) {
        value_out[k] += s->albedo[k] * diffuse + s->material->values[REFLECTANCE + k] * glossy;
    }
    const float part = share(s, lobes);
    return part * diffuse + (1 - part) * glossy;
}

static bool sample(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out)
{
    float all[3] = {0, 0, 0};
    lobes &= s->material->bsdf->lobes;
    if (choice < share(s, lobes)) {
        koksma__cosine_direction(s->n, u, out->w);
        out->lobe = KOKSMA__LOBE_DIFFUSE;
    } else {
        koksma__v3_to(koksma__lobe_direction(koksma__v3_of(s->n), koksma__v3_of(s->out),
                                             s->material->values[EXPONENT], u[0], u[1]),
                      out->w);
        out->lobe = KOKSMA__LOBE_GLOSSY;
    }
    out->pdf = value(s, out->w, lobes, all);
    for (int k = 0; k < 3; k++) {
        out->weight[k] = out->pdf > 0 ? all[k] / out->pdf : 0;
    }
    return out->pdf > 0 && koksma__dot3(s->n, out->w) > 0; /* a direction below the surface is lost */
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

const koksma__bsdf koksma__bsdf_lambert = {
    .kind = {.name = "lambert", .title = "diffuse: equally bright from every side", .cite = "pharr2016"},
    .lobes = KOKSMA__LOBE_DIFFUSE,
    .diffuse = KOKSMA__ALBEDO | KOKSMA__IMAGE,
    .is_lambert = true,
    .reciprocal = true,
    .form = KOKSMA__FORM_LAMBERT,
    .value = value,
    .sample = sample,
};

const koksma__bsdf koksma__bsdf_checker = {
    .kind = {.name = "checker", .title = "diffuse, in squares of two albedos", .cite = "pharr2016"},
    .lobes = KOKSMA__LOBE_DIFFUSE,
    .diffuse = KOKSMA__CHECKER,
    .is_lambert = true,
    .reciprocal = true,
    .form = KOKSMA__FORM_LAMBERT,
    .value = value,
    .sample = sample,
};

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
