/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Glass in air, which reflects the fraction F of the light, Fresnel's reflectance for unpolarised light, and refracts
 * the rest by Snell's law.
 *
 * dielectric: smooth glass. The random number `choice` selects reflection with probability F, so that the weight of a
 * sample is 1 (times the tint). Refraction multiplies the radiance by the squared ratio of indices on entering and
 * divides it by the same number on leaving. Every path from the eye that enters also leaves, so this factor is omitted
 * (Veach 1997, section 5.2, keeps it for lights inside).
 *
 * rough-dielectric: ground glass. Its facets h have the GGX distribution, as in bsdf_metals.c, and each reflects and
 * refracts like smooth glass (Walter et al. 2007): with F at the facet, and m the index on the side of w divided by the
 * index on the side of out,
 *
 *     reflection:  f cos = F D G2 / (4 n.out)
 *     refraction:  f |cos| = (1 - F) G1(w) Dv(h) J,   Dv(h) = D G1(out) (h.out) / (n.out),
 *                  J = m^2 |w.h| / (h.out + m w.h)^2,   h along -(out + m w)
 *
 * A visible facet is sampled (Heitz 2018), then a reflection with probability F and otherwise a refraction; the
 * weight of a direction is G2 / G1(out) for a reflection and G1(w) for a refraction. The squared ratio of indices is
 * omitted here, too; light scattered between facets is lost. When one light is chosen for a path vertex, lights behind
 * the surface are not candidates: only sampled rays that hit them find their light.
 */
#include "render/materials/lobes.h"

enum { TINT, IOR = 3, ROUGHNESS = 3, ROUGH_IOR };

/* Fresnel's reflectance for unpolarised light. ratio: the index on this side divided by the index on the other side;
   *inner: the cosine of the refracted ray, 0 for total reflection. */
static float reflected_share(float cosine, float ratio, float *inner)
{
    const float square = 1 - (1 - cosine * cosine) * ratio * ratio;
    *inner = square > 0 ? sqrtf(square) : 0;
    if (!(square > 0)) {
        return 1;
    }
    const float across = (ratio * cosine - *inner) / (ratio * cosine + *inner);
    const float along = (cosine - ratio * *inner) / (cosine + ratio * *inner);
    return 0.5f * (across * across + along * along);
}

/* ---- Smooth glass ---------------------------------------------------------------------------------------------- */

static void set(const koksma__surface *s, float share, koksma__scatter *out)
{
    out->pdf = 0;
    out->lobe = KOKSMA__LOBE_SPECULAR;
    for (int k = 0; k < 3; k++) {
        out->weight[k] = share * s->material->values[TINT + k];
    }
}

/* Sets both directions, with the weights R and 1 - R; returns R. */
static float divide(const koksma__surface *s, koksma__scatter *reflected, koksma__scatter *refracted)
{
    /* index of refraction on the other side divided by that on this side */
    const float ior = s->material->values[IOR], ratio = s->inside ? ior : 1 / ior;
    const float cosine = koksma__dot3(s->n, s->out);
    float inner;
    const float share = reflected_share(cosine, ratio, &inner);
    set(s, share, reflected);
    set(s, 1 - share, refracted);
    koksma__mirror3(s->out, s->n, reflected->w);
    for (int k = 0; k < 3; k++) {
        refracted->w[k] = (ratio * cosine - inner) * s->n[k] - ratio * s->out[k];
    }
    return share;
}

static void split(const koksma__surface *s, koksma__scatter *reflected, koksma__scatter *refracted)
{
    divide(s, reflected, refracted);
}

static bool choose(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out)
{
    koksma__scatter reflected, refracted;
    (void)u;
    if (!(lobes & KOKSMA__LOBE_SPECULAR)) {
        return false;
    }
    *out = choice < divide(s, &reflected, &refracted) ? reflected : refracted;
    set(s, 1, out);
    return true;
}

static const koksma__parameter of_dielectric[] = {
    {"tint", KOKSMA__COLOUR, .high = 1, .optional = true, .fallback = 1, .at = KOKSMA__VALUE(TINT)},
    {"ior", KOKSMA__NUMBER, .low = 1.0001, .high = 10, .at = KOKSMA__VALUE(IOR)},
    {0}};

const koksma__bsdf koksma__bsdf_dielectric = {
    .kind = {.name = "dielectric",
             .title = "smooth glass in air",
             .cite = "whitted1980 veach1997",
             .parameters = of_dielectric},
    .lobes = KOKSMA__LOBE_SPECULAR,
    .takes_choice = true,
    .value = koksma__specular_value,
    .sample = choose,
    .split = split,
};

/* ---- Ground glass ---------------------------------------------------------------------------------------------- */

/* The data that all directions share: a surface seen from `out`, and the index on this side divided by the index on
   the other side. */
typedef struct view {
    koksma__facets facets;
    float ratio;
} view;

static view view_of(const koksma__surface *s)
{
    const float *values = s->material->values;
    return (view){koksma__facets_of(koksma__v3_of(s->n), koksma__v3_of(s->out), values[ROUGHNESS]),
                  s->inside ? values[ROUGH_IOR] : 1 / values[ROUGH_IOR]};
}

static float masking(float cosine, float a)
{
    return 1 / (1 + koksma__facet_lambda(cosine, a));
}

/* The density of a reflected or refracted direction w; *weight is its weight as a sample. */
static float density(const view *v, koksma__v3 w, float *weight)
{
    const koksma__facets *f = &v->facets;
    const float to = koksma__v3_dot(f->n, w), from = koksma__v3_dot(f->n, f->out), m = 1 / v->ratio;
    float inner;
    *weight = 0;
    if (to > 0) {
        const koksma__facet_terms t = koksma__facet_terms_of(f, w);
        *weight = t.ratio;
        return t.pdf * reflected_share(t.at_facet, v->ratio, &inner);
    }
    koksma__v3 h = koksma__v3_add(f->out, koksma__v3_scale(w, m));
    const float length = sqrtf(koksma__v3_dot(h, h)), turn = koksma__v3_dot(f->n, h) < 0 ? -1.0f : 1.0f;
    if (!(length > 1e-6f) || !(to < 0)) {
        return 0;
    }
    h = koksma__v3_scale(h, turn / length);
    const float seen = koksma__v3_dot(h, f->out), left = koksma__v3_dot(h, w), across = seen + m * left;
    if (!(seen > 0) || !(left < 0)) {
        return 0;
    }
    const koksma__v3 side = koksma__v3_cross(f->n, h);
    const float cosine = koksma__v3_dot(f->n, h), a = f->a;
    const float part = (cosine * cosine + koksma__v3_dot(side, side) / (a * a)) * a;
    const float visible = masking(from, a) * seen / (from * KOKSMA__PI_F * part * part);
    *weight = masking(-to, a);
    return (1 - reflected_share(seen, v->ratio, &inner)) * visible * m * m * -left / (across * across);
}

static float value(const koksma__surface *s, const float w[3], unsigned lobes, float value_out[3])
{
    const view v = view_of(s);
    float weight;
    const float pdf = lobes & KOKSMA__LOBE_GLOSSY ? density(&v, koksma__v3_of(w), &weight) : 0;
    for (int k = 0; pdf > 0 && k < 3; k++) {
        value_out[k] += s->material->values[TINT + k] * weight * pdf;
    }
    return pdf > 0 ? pdf : 0;
}

static bool sample(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out)
{
    const view v = view_of(s);
    float weight, inner;
    if (!(lobes & KOKSMA__LOBE_GLOSSY)) {
        return false;
    }
    const koksma__v3 mirrored = koksma__facet_direction(&v.facets, u[0], u[1]);
    const koksma__v3 h = koksma__v3_unit(koksma__v3_add(mirrored, v.facets.out));
    const float cosine = koksma__v3_dot(h, v.facets.out);
    const bool reflects = choice < reflected_share(cosine, v.ratio, &inner);
    const koksma__v3 refracted =
        koksma__v3_subtract(koksma__v3_scale(h, v.ratio * cosine - inner), koksma__v3_scale(v.facets.out, v.ratio));
    koksma__v3_to(reflects ? mirrored : koksma__v3_unit(refracted), out->w);
    if ((koksma__dot3(s->n, out->w) > 0) != reflects) {
        return false;
    }
    out->pdf = density(&v, koksma__v3_of(out->w), &weight);
    out->lobe = KOKSMA__LOBE_GLOSSY;
    for (int k = 0; k < 3; k++) {
        out->weight[k] = s->material->values[TINT + k] * weight;
    }
    return out->pdf > 0;
}

static const koksma__parameter of_rough_dielectric[] = {
    {"tint", KOKSMA__COLOUR, .high = 1, .optional = true, .fallback = 1, .at = KOKSMA__VALUE(TINT)},
    {"roughness", KOKSMA__NUMBER, .low = 0.03, .high = 1, .at = KOKSMA__VALUE(ROUGHNESS)},
    {"ior", KOKSMA__NUMBER, .low = 1.05, .high = 10, .at = KOKSMA__VALUE(ROUGH_IOR)},
    {0}};

const koksma__bsdf koksma__bsdf_rough_dielectric = {
    .kind = {.name = "rough-dielectric",
             .title = "ground glass in air: GGX facets that reflect and refract",
             .cite = "walter2007 heitz2018",
             .parameters = of_rough_dielectric},
    .lobes = KOKSMA__LOBE_GLOSSY,
    .takes_choice = true,
    .value = value,
    .sample = sample,
};
