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
 * weight of a direction is the value divided by the density of the mixture (batch_materials.c).
 */
#include "render/materials/lobes.h"

enum { REFLECTANCE, EXPONENT = 3 };

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
};

const koksma__bsdf koksma__bsdf_checker = {
    .kind = {.name = "checker", .title = "diffuse, in squares of two albedos", .cite = "pharr2016"},
    .lobes = KOKSMA__LOBE_DIFFUSE,
    .diffuse = KOKSMA__CHECKER,
    .is_lambert = true,
    .reciprocal = true,
    .form = KOKSMA__FORM_LAMBERT,
};

const koksma__bsdf koksma__bsdf_phong = {
    .kind = {.name = "phong",
             .title = "Shirley's glossy mirror (1991): cos^exponent about the mirrored direction",
             .cite = "shirley1991",
             .parameters = parameters},
    .lobes = KOKSMA__LOBE_GLOSSY,
    .form = KOKSMA__FORM_LOBES,
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
};
