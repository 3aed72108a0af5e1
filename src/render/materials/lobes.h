/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The formulas of the lobes that materials share, for single rays (bsdf_*.c) and, by value, for loops over lanes
 * (batch_materials.c): Lambert's law, the cosine lobe, and microfacets.
 */
#ifndef KOKSMA_RENDER_MATERIALS_LOBES_H
#define KOKSMA_RENDER_MATERIALS_LOBES_H

#include "render/materials/materials.h"
#include "render/vector3.h"

/* The density of koksma__v3_cosine_direction for a direction with this cosine; multiplied by the albedo it is the value
   of a Lambert surface times the cosine. */
KOKSMA__INLINE float koksma__lambert_pdf(float cosine)
{
    return cosine > 0 ? cosine * (1 / KOKSMA__PI_F) : 0;
}

/* value() of a purely specular surface, whose lobes cannot be evaluated for a given direction. */
static inline float koksma__specular_value(const koksma__surface *s, const float w[3], unsigned lobes, float value[3])
{
    (void)s, (void)w, (void)lobes, (void)value;
    return 0;
}

/* The cosine lobe of Shirley (1991, section 5.5.6): directions about the mirrored one with density (e + 1) / (2 pi)
   cos^e, each with the weight `reflectance`; directions below the surface are lost. The material's value times the
   cosine is reflectance times density. */
KOKSMA__INLINE float koksma__lobe_pdf(koksma__v3 n, koksma__v3 out, float exponent, koksma__v3 w)
{
    const float cosine = koksma__v3_dot(koksma__v3_mirror(out, n), w), above = koksma__v3_dot(n, w);
    const float least = cosine > 0 ? cosine : 0, inside = least < 1 ? least : 1;
    const float pdf = (exponent + 1) * (0.5f / KOKSMA__PI_F) * koksma__power(inside, exponent);
    const int seen = (cosine > 0) & (above > 0);
    return seen ? pdf : 0;
}

KOKSMA__INLINE koksma__v3 koksma__lobe_direction(koksma__v3 n, koksma__v3 out, float exponent, float u, float v)
{
    const float cosine = koksma__power(1 - u, 1 / (exponent + 1)), rest = 1 - cosine * cosine;
    const float sine = sqrtf(rest > 0 ? rest : 0);
    float x, y;
    koksma__sine_cosine_turns(v, &y, &x);
    return koksma__v3_about(koksma__v3_mirror(out, n), sine * x, sine * y, cosine);
}

/* ---- Facets ------------------------------------------------------------------------------------------------- */

/*
 * GGX facets; bsdf_metals.c documents the model.
 *
 * D = a^2 / (pi t^2) with t = (n.h)^2 (a^2 - 1) + 1, which is (n.h)^2 a^2 + |n x h|^2: for small a the first form is
 * a difference of two numbers near 1. The second form gives D with a relative error of 3e-5 at roughness 0.03 and of
 * 3 % at roughness 0.001, where rounding to floats changes directions by a tenth of a.
 */

/* A surface of facets seen from `out`; a: the squared roughness. */
typedef struct koksma__facets {
    koksma__v3 n, out;
    float a;
} koksma__facets;

/* The terms for light from a direction: the direction's density D G1 / (4 n.out), the ratio G2 / G1, and the cosine
   at the facet. */
typedef struct koksma__facet_terms {
    float pdf, ratio, at_facet;
} koksma__facet_terms;

KOKSMA__INLINE koksma__facets koksma__facets_of(koksma__v3 n, koksma__v3 out, float roughness)
{
    return (koksma__facets){n, out, roughness * roughness};
}

/* Smith's lambda. */
KOKSMA__INLINE float koksma__facet_lambda(float cosine, float a)
{
    const float square = cosine * cosine;
    return 0.5f * (sqrtf(1 + a * a * ((1 - square) / square)) - 1);
}

KOKSMA__INLINE koksma__facet_terms koksma__facet_terms_of(const koksma__facets *f, koksma__v3 w)
{
    const float from = koksma__v3_dot(f->n, w), to = koksma__v3_dot(f->n, f->out), a = f->a;
    const koksma__v3 h = koksma__v3_unit(koksma__v3_add(w, f->out)), across = koksma__v3_cross(f->n, h);
    const float cosine = koksma__v3_dot(f->n, h);
    const float part = (cosine * cosine + koksma__v3_dot(across, across) / (a * a)) * a;
    const float l_to = koksma__facet_lambda(to, a), l_from = koksma__facet_lambda(from, a);
    const float pdf = 1 / (3.14159265358979f * part * part) / (1 + l_to) / (4 * to);
    const int above = (from > 0) & (to > 0);
    return (koksma__facet_terms){above ? pdf : 0, above ? (1 + l_to) / (1 + l_to + l_from) : 0,
                                 above ? koksma__v3_dot(h, w) : 0};
}

/* Schlick's approximation of the reflectance at the facet. */
KOKSMA__INLINE float koksma__schlick(float reflectance, float at_facet)
{
    const float rest = 1 - at_facet, square = rest * rest;
    return reflectance + (1 - reflectance) * (square * square * rest);
}

KOKSMA__INLINE koksma__v3 koksma__schlick3(koksma__v3 reflectance, float at_facet)
{
    return (koksma__v3){koksma__schlick(reflectance.x, at_facet), koksma__schlick(reflectance.y, at_facet),
                        koksma__schlick(reflectance.z, at_facet)};
}

/* Samples the direction mirrored at a visible facet (Heitz 2018, listing 1). */
KOKSMA__INLINE koksma__v3 koksma__facet_direction(const koksma__facets *f, float u, float v)
{
    const koksma__v3 n = f->n, x_axis = koksma__v3_about(n, 1, 0, 0), y_axis = koksma__v3_about(n, 0, 1, 0);
    const koksma__v3 s = koksma__v3_unit((koksma__v3){
        f->a * koksma__v3_dot(x_axis, f->out), f->a * koksma__v3_dot(y_axis, f->out), koksma__v3_dot(n, f->out)});
    const float square = s.x * s.x + s.y * s.y, scale = 1 / sqrtf(square > 0 ? square : 1);
    const koksma__v3 t1 = {square > 0 ? -s.y * scale : 1, square > 0 ? s.x * scale : 0, 0};
    const koksma__v3 t2 = koksma__v3_cross(s, t1);
    const float radius = sqrtf(u), part = 0.5f * (1 + s.z);
    float sine, cosine;
    koksma__sine_cosine_turns(v, &sine, &cosine);
    const float x = radius * cosine, side = 1 - x * x;
    const float y = (1 - part) * sqrtf(side > 0 ? side : 0) + part * radius * sine;
    const float rest = 1 - x * x - y * y, z = sqrtf(rest > 0 ? rest : 0);
    const float hz = x * t1.z + y * t2.z + z * s.z;
    const koksma__v3 h = koksma__v3_unit((koksma__v3){
        f->a * (x * t1.x + y * t2.x + z * s.x), f->a * (x * t1.y + y * t2.y + z * s.y), hz > 1e-6f ? hz : 1e-6f});
    return koksma__v3_mirror(f->out, koksma__v3_about(n, h.x, h.y, h.z));
}

/* ---- Facets over Lambert ------------------------------------------------------------------------------------- */

/* A surface of bsdf_principled.c seen from `out`; diffuse, glossy: 1 if the lobe is requested, otherwise 0. */
typedef struct koksma__coat {
    koksma__v3 n, out, albedo, reflectance; /* reflectance: F0 of the facets */
    float roughness, coat;                  /* coat: F0 of the coat of the diffuse part */
    float diffuse, glossy, share;           /* share: the probability of sampling the diffuse lobe */
} koksma__coat;

/* The fraction of the light that the facets transmit to the diffuse part, on entering or leaving. */
KOKSMA__INLINE float koksma__coat_passes(const koksma__coat *c, float cosine)
{
    return 1 - koksma__schlick(c->coat, cosine);
}

/* Sets the share. */
KOKSMA__INLINE koksma__coat koksma__coat_of(koksma__coat c)
{
    const float cosine = koksma__v3_dot(c.n, c.out), albedo = koksma__v3_luminance(c.albedo);
    const float below = albedo * koksma__coat_passes(&c, cosine);
    const float above = koksma__schlick(koksma__v3_luminance(c.reflectance), cosine);
    const float part = below / (below + above), least = part > 0.1f ? part : 0.1f, most = least < 0.9f ? least : 0.9f;
    c.share = c.glossy > 0 ? c.diffuse * (albedo > 0 ? most : 0) : c.diffuse;
    return c;
}

/* Returns the density of the direction w, and sets the value times the cosine. */
KOKSMA__INLINE float koksma__coat_value(const koksma__coat *c, koksma__v3 w, koksma__v3 *value)
{
    const koksma__facets facets = koksma__facets_of(c->n, c->out, c->roughness);
    const koksma__facet_terms t = koksma__facet_terms_of(&facets, w);
    const float to = koksma__v3_dot(c->n, w), lambert = c->diffuse * koksma__lambert_pdf(to);
    const float rest = koksma__coat_passes(c, koksma__v3_dot(c->n, c->out)) * koksma__coat_passes(c, to);
    const float pdf = c->glossy > 0 ? t.pdf : 0, scale = pdf * t.ratio;
    *value = koksma__v3_add(koksma__v3_scale(koksma__v3_scale(c->albedo, lambert), rest),
                            koksma__v3_scale(koksma__schlick3(c->reflectance, t.at_facet), scale));
    return c->share * lambert + (1 - c->share) * pdf;
}

#endif
