/* SPDX-License-Identifier: Apache-2.0 */
/*
 * principled: one material for rough metals and coated diffuse surfaces, with the parameters of glTF 2.0 (appendix
 * B): base colour c (the albedo), metallic value m, roughness, index of refraction. It has GGX facets with a =
 * roughness^2, as in bsdf_metals.c, above a diffuse part; the facets' reflectance reduces the light of the diffuse part
 * both on entering and on leaving (Ashikhmin & Shirley 2000):
 *
 *     f cos = D F G2 / (4 n.out) + (1 - m) c / pi (1 - S(n.out)) (1 - S(n.w)) cos
 *     F = S with F0 = (1 - m) s + m c at the facet;   S(x) = F0 + (1 - F0) (1 - x)^5,   s = ((ior - 1) / (ior + 1))^2
 *
 * glTF's sample implementation uses the one factor 1 - F at the facet instead of these two factors, and so reflects
 * more light than arrives at grazing angles. The model here never reflects more than arrives and is reciprocal. It
 * reflects up to an eighth of c less than real surfaces, because light that bounces between facets and the diffuse
 * part is lost. A direction is sampled from the facets with a probability that is estimated from their reflectance,
 * and otherwise from the diffuse lobe; if both lobes exist, each has a probability of at least .1.
 */
#include "render/materials/lobes.h"

/* The reflectance F0 at normal incidence has three numbers (red, green, blue). prepare() sets these derived numbers;
   images can change them and the roughness. batch_materials.c samples koksma__coat of lobes.h. */
enum { F0, ROUGHNESS = 3, METALLIC, IOR };

static float specular(const koksma__shading_material *m)
{
    const float part = (m->values[IOR] - 1) / (m->values[IOR] + 1);
    return part * part;
}

/* Splits a base colour into F0 and the albedo of the diffuse part. */
static void divide(const koksma__shading_material *m, float metallic, float albedo[3], float f0[3])
{
    for (int k = 0; k < 3; k++) {
        f0[k] = (1 - metallic) * specular(m) + metallic * albedo[k];
        albedo[k] *= 1 - metallic;
    }
}

static void texture(const koksma__shading_material *m, const float factors[2], float albedo[3], float *local)
{
    divide(m, m->values[METALLIC] * factors[1], albedo, local);
    local[ROUGHNESS] = fmaxf(m->values[ROUGHNESS] * factors[0], 0.03f);
}

static void prepare(koksma__shading_material *m)
{
    float again[3];
    m->derived = specular(m);
    divide(m, m->values[METALLIC], m->albedo[0], m->values + F0);
    divide(m, m->values[METALLIC], m->albedo[1], again);
}

static const koksma__parameter parameters[] = {
    {"roughness", KOKSMA__NUMBER, .low = 1e-3, .high = 1, .at = KOKSMA__VALUE(ROUGHNESS)},
    {"metallic", KOKSMA__NUMBER, .high = 1, .optional = true, .fallback = 0, .at = KOKSMA__VALUE(METALLIC)},
    {"ior", KOKSMA__NUMBER, .low = 1, .high = 4, .optional = true, .fallback = 1.5, .at = KOKSMA__VALUE(IOR)},
    {0}};

const koksma__bsdf koksma__bsdf_principled = {
    .kind = {.name = "principled",
             .title = "rough metal or a coated diffuse surface, with glTF's parameters",
             .cite = "gltf2021 ashikhmin2000 walter2007 heitz2018",
             .parameters = parameters},
    .lobes = KOKSMA__LOBE_DIFFUSE | KOKSMA__LOBE_GLOSSY,
    .diffuse = KOKSMA__ALBEDO | KOKSMA__IMAGE,
    .takes_choice = true,
    .form = KOKSMA__FORM_COATED,
    .reciprocal = true,
    .prepare = prepare,
    .texture = texture,
};
