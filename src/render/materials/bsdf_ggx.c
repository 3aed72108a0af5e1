/* SPDX-License-Identifier: Apache-2.0 */
/*
 * ggx: a rough metal. Microfacets with slopes of the GGX law (Walter et al. 2007), a = roughness^2, and Smith's
 * height-correlated shadowing; Schlick's reflectance from `reflectance` at normal incidence:
 *     value cos = F D G2 / (4 n.out)
 * Directions come from the facets that are seen (Heitz 2018): density D G1(out) / (4 n.out), so that a direction
 * weighs F G2 / G1. It loses what bounces between facets: a white one reflects less than 1, and at roughness 1 no
 * more than 0.307 straight on (1 - ln 2) and 0.379 at n.out = 0.7.
 *
 * D = a^2 / (pi t^2) with t = (n.h)^2 (a^2 - 1) + 1, which is (n.h)^2 a^2 + |n x h|^2: the first form is the
 * difference of numbers near 1 where a is small, the second has D to 3e-5 at roughness 0.03 and to 3 % at 0.001,
 * where directions in floats themselves are off by a tenth of a.
 */
#include "render/materials/lobes.h"

enum { REFLECTANCE, ROUGHNESS = 3 };

static float lambda(float cosine, float a)
{
    const float square = cosine * cosine, tangent2 = (1 - square) / square;
    return 0.5f * (sqrtf(1 + a * a * tangent2) - 1);
}

/* D of the facet with the normal h. */
static float facets(const float n[3], const float h[3], float a)
{
    const float x = n[1] * h[2] - n[2] * h[1], y = n[2] * h[0] - n[0] * h[2], z = n[0] * h[1] - n[1] * h[0];
    const float cosine = koksma__dot3(n, h), part = (cosine * cosine + (x * x + y * y + z * z) / (a * a)) * a;
    return 1 / (KOKSMA__PI_F * part * part);
}

/* The terms for light from w: D G1 / (4 n.out) is returned, G2 / G1 and the facet's n.h-independent cosine come out.
 */
static float terms(const koksma__surface *s, const float w[3], float *ratio, float *at_facet)
{
    const float a = s->material->values[ROUGHNESS] * s->material->values[ROUGHNESS];
    const float from = koksma__dot3(s->n, w), to = koksma__dot3(s->n, s->out);
    float h[3];
    if (!(from > 0) || !(to > 0)) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        h[k] = w[k] + s->out[k];
    }
    koksma__unit3(h);
    const float l_to = lambda(to, a), l_from = lambda(from, a);
    *at_facet = koksma__dot3(h, w);
    *ratio = (1 + l_to) / (1 + l_to + l_from);
    return facets(s->n, h, a) / (1 + l_to) / (4 * to);
}

static void add(const koksma__surface *s, float scale, float at_facet, float out[3])
{
    const float rest = 1 - at_facet, fifth = rest * rest * rest * rest * rest;
    for (int k = 0; k < 3; k++) {
        out[k] += scale * (s->material->values[REFLECTANCE + k] + (1 - s->material->values[REFLECTANCE + k]) * fifth);
    }
}

static float value(const koksma__surface *s, const float w[3], unsigned lobes, float value_out[3])
{
    float ratio = 0, at_facet = 0;
    const float pdf = lobes & KOKSMA__LOBE_GLOSSY ? terms(s, w, &ratio, &at_facet) : 0;
    if (pdf > 0) {
        add(s, pdf * ratio, at_facet, value_out);
    }
    return pdf;
}

/* A facet's normal, seen from v in the surface's frame, v[2] > 0 (Heitz 2018, listing 1). */
static void visible_facet(const float v[3], float a, const float u[2], float h[3])
{
    float stretched[3] = {a * v[0], a * v[1], v[2]};
    koksma__unit3(stretched);
    const float square = stretched[0] * stretched[0] + stretched[1] * stretched[1], scale = 1 / sqrtf(square);
    const float t1[3] = {square > 0 ? -stretched[1] * scale : 1, square > 0 ? stretched[0] * scale : 0, 0};
    const float t2[3] = {stretched[1] * t1[2] - stretched[2] * t1[1], stretched[2] * t1[0] - stretched[0] * t1[2],
                         stretched[0] * t1[1] - stretched[1] * t1[0]};
    const float radius = sqrtf(u[0]), turn = 2 * KOKSMA__PI_F * u[1], part = 0.5f * (1 + stretched[2]);
    const float x = radius * cosf(turn), side = 1 - x * x;
    const float y = (1 - part) * sqrtf(side > 0 ? side : 0) + part * radius * sinf(turn);
    const float rest = 1 - x * x - y * y, z = sqrtf(rest > 0 ? rest : 0);
    for (int k = 0; k < 3; k++) {
        h[k] = x * t1[k] + y * t2[k] + z * stretched[k];
    }
    h[0] *= a;
    h[1] *= a;
    h[2] = h[2] > 1e-6f ? h[2] : 1e-6f;
    koksma__unit3(h);
}

static bool sample(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out)
{
    (void)choice;
    float x[3], y[3], h[3], ratio = 0, at_facet = 0;
    if (!(lobes & KOKSMA__LOBE_GLOSSY)) {
        return false;
    }
    koksma__frame3(s->n, x, y);
    const float local[3] = {koksma__dot3(x, s->out), koksma__dot3(y, s->out), koksma__dot3(s->n, s->out)};
    visible_facet(local, s->material->values[ROUGHNESS] * s->material->values[ROUGHNESS], u, h);
    const float facet[3] = {h[0] * x[0] + h[1] * y[0] + h[2] * s->n[0], h[0] * x[1] + h[1] * y[1] + h[2] * s->n[1],
                            h[0] * x[2] + h[1] * y[2] + h[2] * s->n[2]};
    koksma__mirror3(s->out, facet, out->w);
    out->pdf = terms(s, out->w, &ratio, &at_facet);
    out->lobe = KOKSMA__LOBE_GLOSSY;
    out->weight[0] = out->weight[1] = out->weight[2] = 0;
    if (!(out->pdf > 0)) {
        return false;
    }
    add(s, ratio, at_facet, out->weight);
    return true;
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
    .value = value,
    .sample = sample,
};
