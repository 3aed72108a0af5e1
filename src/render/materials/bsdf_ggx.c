/* SPDX-License-Identifier: Apache-2.0 */
/*
 * ggx: a rough metal. Microfacets with slopes of the GGX law (Walter et al. 2007), a = roughness^2, and Smith's
 * height-correlated shadowing; Schlick's reflectance from `reflectance` at normal incidence:
 *     value cos = F D G2 / (4 n.out)
 * Directions are sampled by visible facets (Heitz 2018), with density D G1(out) / (4 n.out), so that the weight of a
 * direction is F G2 / G1. Light scattered between facets is lost: a white metal reflects less than all light, at
 * roughness 1 only 0.307 of it at normal incidence (1 - ln 2) and 0.379 at n.out = 0.7.
 */
#include "render/materials/facets.h"
#include "render/materials/lobes.h"

enum { REFLECTANCE, ROUGHNESS = 3 };

static koksma__facets facets_of(const koksma__surface *s)
{
    return koksma__facets_of(koksma__v3_of(s->n), koksma__v3_of(s->out), s->material->values[ROUGHNESS]);
}

static float value(const koksma__surface *s, const float w[3], unsigned lobes, float value_out[3])
{
    const koksma__facets facets = facets_of(s);
    const koksma__facet_terms t = koksma__facet_terms_of(&facets, koksma__v3_of(w));
    if (!(lobes & KOKSMA__LOBE_GLOSSY)) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        value_out[k] += t.pdf * t.ratio * koksma__schlick(s->material->values[REFLECTANCE + k], t.at_facet);
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
        out->weight[k] = t.ratio * koksma__schlick(s->material->values[REFLECTANCE + k], t.at_facet);
    }
    return out->pdf > 0;
}

static const koksma__parameter parameters[] = {
    {"reflectance", KOKSMA__COLOUR, .high = 1, .at = KOKSMA__VALUE(REFLECTANCE)},
    {"roughness", KOKSMA__NUMBER, .low = 1e-3, .high = 1, .at = KOKSMA__VALUE(ROUGHNESS)},
    {0}};

const koksma__bsdf koksma__bsdf_ggx = {
    .kind = {.name = "ggx",
             .title = "a rough metal: GGX facets with a = roughness^2, Schlick's reflectance",
             .cite = "walter2007 heitz2018",
             .parameters = parameters},
    .lobes = KOKSMA__LOBE_GLOSSY,
    .reciprocal = true,
    .form = KOKSMA__FORM_FACETS,
    .value = value,
    .sample = sample,
};
