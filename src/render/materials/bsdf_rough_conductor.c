/* SPDX-License-Identifier: Apache-2.0 */
/*
 * rough-conductor: the facets of ggx (bsdf_ggx.c), each of which reflects as a smooth conductor of the index eta + i k
 * (conductor.h) in place of Schlick's approximation:
 *     value cos = tint F D G2 / (4 n.out)
 */
#include "render/materials/conductor.h"
#include "render/materials/facets.h"

static koksma__facets facets_of(const koksma__surface *s)
{
    return koksma__facets_of(koksma__v3_of(s->n), koksma__v3_of(s->out),
                             s->material->values[KOKSMA__CONDUCTOR_ROUGHNESS]);
}

static float value(const koksma__surface *s, const float w[3], unsigned lobes, float value_out[3])
{
    const koksma__facets facets = facets_of(s);
    const koksma__facet_terms t = koksma__facet_terms_of(&facets, koksma__v3_of(w));
    if (!(lobes & KOKSMA__LOBE_GLOSSY)) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        value_out[k] += t.pdf * t.ratio * koksma__conductor_colour(s->material, k, t.at_facet);
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
        out->weight[k] = t.ratio * koksma__conductor_colour(s->material, k, t.at_facet);
    }
    return out->pdf > 0;
}

static const koksma__parameter parameters[] = {
    KOKSMA__CONDUCTOR_PARAMETERS,
    {"roughness", KOKSMA__NUMBER, .low = 1e-3, .high = 1, .at = KOKSMA__VALUE(KOKSMA__CONDUCTOR_ROUGHNESS)},
    {0}};

const koksma__bsdf koksma__bsdf_rough_conductor = {
    .kind = {.name = "rough-conductor",
             .title = "a rough metal: GGX facets with Fresnel's reflectance for the index eta + i k",
             .cite = "walter2007 heitz2018 born1999",
             .parameters = parameters},
    .lobes = KOKSMA__LOBE_GLOSSY,
    .reciprocal = true,
    .value = value,
    .sample = sample,
};
