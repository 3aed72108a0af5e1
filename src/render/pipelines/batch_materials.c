/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Evaluates and samples materials on blocks of surfaces. Each form of material (Lambert, lobes, facets) has one loop
 * over the lanes, which stores results only in the lanes of its form; a block that has no lane of a form skips its
 * loop. Materials without a form are evaluated one ray at a time.
 */
#include <math.h>
#include <string.h>

#include "render/materials/lobes.h"
#include "render/pipelines/batch_kernel.h"
#include "render/pipelines/vertices.h"

/* ---- Surfaces ----------------------------------------------------------------------------------------------- */

/* Finds in which square of a checker each lane lies: odd[i] is 1 in every other square, which has the second
   albedo. */
static void find_squares(const koksma__lane_materials *t, const koksma__hits *restrict h, const int32_t *restrict at,
                         int n, int32_t *restrict odd)
{
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const int32_t m = at[i];
        const float u = t->u[0][m] * h->u[i] + t->u[1][m] * h->v[i] + t->u[2][m];
        const float v = t->v[0][m] * h->u[i] + t->v[1][m] * h->v[i] + t->v[2][m];
        const float half = 0.5f * (floorf(u) + floorf(v));
        odd[i] = half != floorf(half);
    }
}

/* Looks 32-bit numbers up in a column of `size`, which can be read up to a multiple of 16. */
INLINE void look_up(const void *restrict column, int32_t size, const int32_t *restrict at, int n, void *restrict to)
{
    const uint32_t *restrict x = column;
    uint32_t *restrict y = to;
#ifdef __AVX512F__
    if (size <= 16) {
        const __m512i all = _mm512_loadu_si512(x);
        for (int i = 0; i < STEP(n); i += 16) {
            _mm512_store_si512(y + i, _mm512_permutexvar_epi32(_mm512_load_si512(at + i), all));
        }
        return;
    }
#endif
    (void)size;
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        y[i] = x[at[i]];
    }
}

/* The forms that read parameters, and `derived` */
#define DERIVED (1 << KOKSMA__FORM_LOBES | 1 << KOKSMA__FORM_COATED)
#define NUMBERED (DERIVED | 1 << KOKSMA__FORM_FACETS)

void BATCH_NAME(surfaces)(const koksma__rays *restrict rays, int lanes, int n, struct koksma__surfaces *restrict s)
{
    const koksma__lane_materials *t = s->table;
    const koksma__hits *restrict h = s->hits;
    KOKSMA__LANES(int32_t, at);
    KOKSMA__LANES(int32_t, odd);
    int32_t traits = 0, lights = 0;
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        koksma__put(s->out, i, 1, koksma__v3_unit((koksma__v3){-rays->d[0][i], -rays->d[1][i], -rays->d[2][i]}));
        const int there = (h->primitive[i] >= 0) & (i < lanes);
        at[i] = there ? h->material[i] + 1 : 0;
        lights |= there & (h->material[i] < 0);
        odd[i] = 0;
    }
    look_up(t->form, t->n, at, n, s->form);
    look_up(t->traits, t->n, at, n, s->trait);
    for (int i = 0; i < STEP(n); i++) {
        traits |= s->trait[i];
    }
    s->traits = (unsigned)traits;
    s->met_lights = lights;
    if (traits & KOKSMA__IS_CHECKER) {
        find_squares(t, h, at, n, odd);
    }
    const int32_t second = (int32_t)(t->albedo[1][0] - t->albedo[0][0]); /* all are columns of one table */
    for (int i = 0; i < STEP(n); i++) {
        odd[i] = at[i] + odd[i] * second;
    }
    for (int k = 0; k < 3; k++) {
        /* the numbers of checkers reach into later columns */
        look_up(t->albedo[0][k], traits & KOKSMA__IS_CHECKER ? INT32_MAX : t->n, odd, n, s->albedo[k]);
    }
    for (int k = 0; traits & NUMBERED && k < 4; k++) {
        look_up(t->parameters[k], t->n, at, n, s->parameters[k]);
    }
    if (traits & DERIVED) {
        look_up(t->derived, t->n, at, n, s->derived);
    }
}

/* ---- Values --------------------------------------------------------------------------------------------------- */

/* Adds the value and the density of lane i where `mine`. */
INLINE void give(koksma__bsdf_values *restrict out, int i, int mine, koksma__v3 value, float pdf)
{
    koksma__put(out->value, i, 1,
                koksma__v3_add(AT(out->value, i), koksma__either(mine, value, (koksma__v3){0, 0, 0})));
    out->pdf[i] += mine ? pdf : 0;
}

static void lambert_values(const koksma__surfaces *restrict s, const koksma__lanes *restrict w, int n,
                           koksma__bsdf_values *restrict out)
{
    const koksma__hits *restrict h = s->hits;
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const float pdf = koksma__lambert_pdf(koksma__v3_dot(AT(h->n, i), AT(w, i)));
        give(out, i, s->form[i] == KOKSMA__FORM_LAMBERT, koksma__v3_scale(AT(s->albedo, i), pdf), pdf);
    }
}

/* The requested lobes as factors 0 or 1, and the coefficients of the probability of sampling Lambert's lobe: fixed +
   shared * koksma__surfaces.derived. */
typedef struct lobe_shares {
    float diffuse, glossy, fixed, shared;
} lobe_shares;

static lobe_shares shares_of(unsigned lobes)
{
    const float diffuse = lobes & KOKSMA__LOBE_DIFFUSE ? 1 : 0, glossy = lobes & KOKSMA__LOBE_GLOSSY ? 1 : 0;
    return (lobe_shares){diffuse, glossy, diffuse * (1 - glossy), diffuse * glossy};
}

INLINE koksma__v3 both_lobes(const koksma__surfaces *restrict s, int i, float lambert, float lobe)
{
    return koksma__v3_add(koksma__v3_scale(AT(s->albedo, i), lambert), koksma__v3_scale(AT(s->parameters, i), lobe));
}

static void lobe_values(const koksma__surfaces *restrict s, const koksma__lanes *restrict w, unsigned lobes, int n,
                        koksma__bsdf_values *restrict out)
{
    const koksma__hits *restrict h = s->hits;
    const lobe_shares shares = shares_of(lobes);
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const koksma__v3 normal = AT(h->n, i), direction = AT(w, i);
        const float lambert = shares.diffuse * koksma__lambert_pdf(koksma__v3_dot(normal, direction));
        const float lobe = shares.glossy * koksma__lobe_pdf(normal, AT(s->out, i), s->parameters[3][i], direction);
        const float part = shares.fixed + shares.shared * s->derived[i];
        give(out, i, s->form[i] == KOKSMA__FORM_LOBES, both_lobes(s, i, lambert, lobe),
             part * lambert + (1 - part) * lobe);
    }
}

static void facet_values(const koksma__surfaces *restrict s, const koksma__lanes *restrict w, int n,
                         koksma__bsdf_values *restrict out)
{
    const koksma__hits *restrict h = s->hits;
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const koksma__facets facets = koksma__facets_of(AT(h->n, i), AT(s->out, i), s->parameters[3][i]);
        const koksma__facet_terms t = koksma__facet_terms_of(&facets, AT(w, i));
        give(out, i, s->form[i] == KOKSMA__FORM_FACETS,
             koksma__v3_scale(koksma__schlick3(AT(s->parameters, i), t.at_facet), t.pdf * t.ratio), t.pdf);
    }
}

INLINE koksma__coat coat_at(const koksma__surfaces *restrict s, lobe_shares shares, int i)
{
    return koksma__coat_of((koksma__coat){.n = AT(s->hits->n, i),
                                          .out = AT(s->out, i),
                                          .albedo = AT(s->albedo, i),
                                          .reflectance = AT(s->parameters, i),
                                          .roughness = s->parameters[3][i],
                                          .coat = s->derived[i],
                                          .diffuse = shares.diffuse,
                                          .glossy = shares.glossy});
}

static void coated_values(const koksma__surfaces *restrict s, const koksma__lanes *restrict w, unsigned lobes, int n,
                          koksma__bsdf_values *restrict out)
{
    const lobe_shares shares = shares_of(lobes);
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const koksma__coat c = coat_at(s, shares, i);
        koksma__v3 value;
        const float pdf = koksma__coat_value(&c, AT(w, i), &value);
        give(out, i, s->form[i] == KOKSMA__FORM_COATED, value, pdf);
    }
}

static void ray_values(const koksma__surfaces *s, const koksma__lanes *w, unsigned lobes, int n,
                       koksma__bsdf_values *out)
{
    for (int i = 0; i < n; i++) {
        if (s->form[i] == KOKSMA__FORM_RAYS) {
            const koksma__surface surface = koksma__surface_at(s, i);
            const koksma__bsdf *bsdf = surface.material->bsdf;
            const float direction[3] = {w[0][i], w[1][i], w[2][i]};
            float value[3] = {0, 0, 0};
            out->pdf[i] += bsdf->value(&surface, direction, lobes & bsdf->lobes, value);
            for (int k = 0; k < 3; k++) {
                out->value[k][i] += value[k];
            }
        }
    }
}

static void values(const koksma__surfaces *s, const koksma__lanes *w, unsigned lobes, int n, koksma__bsdf_values *out)
{
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        out->value[0][i] = out->value[1][i] = out->value[2][i] = out->pdf[i] = 0;
    }
    if (s->traits & 1u << KOKSMA__FORM_LAMBERT && lobes & KOKSMA__LOBE_DIFFUSE) {
        lambert_values(s, w, n, out);
    }
    if (s->traits & 1u << KOKSMA__FORM_LOBES) {
        lobe_values(s, w, lobes, n, out);
    }
    if (s->traits & 1u << KOKSMA__FORM_FACETS && lobes & KOKSMA__LOBE_GLOSSY) {
        facet_values(s, w, n, out);
    }
    if (s->traits & 1u << KOKSMA__FORM_COATED) {
        coated_values(s, w, lobes, n, out);
    }
    if (s->traits & 1u << KOKSMA__FORM_RAYS) {
        ray_values(s, w, lobes, n, out);
    }
}

/* ---- Light that is reflected ---------------------------------------------------------------------------------- */

/* Adds the weighted light of the beams to `reflected`. Light from a visible light source is weighted by multiple
   importance sampling; `values` has the density with which a reflected ray would hit that source. */
INLINE void weigh(const koksma__light_lanes *restrict l, const koksma__beams *restrict b,
                  const koksma__bsdf_values *restrict values, koksma__light_weight weight, int n,
                  koksma__lanes *restrict reflected)
{
    const int weighed = weight != KOKSMA__WEIGHT_ONE, squared = weight == KOKSMA__WEIGHT_POWER;
    const float most = weight == KOKSMA__WEIGHT_ZERO ? 0 : 1;
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const float probability = l->probability[i], sampled = b->pdf[i] * probability, met = values->pdf[i];
        const float ours = sampled * (squared ? sampled : 1),
                    shared = most * (ours / (ours + met * (squared ? met : 1)));
        const int shares = weighed & (b->visible[i] != 0) & (sampled > 0);
        const float scale = (shares ? shared : 1) / probability;
        koksma__put(reflected, i, 1,
                    koksma__v3_add(AT(reflected, i),
                                   koksma__v3_scale(koksma__v3_times(AT(values->value, i), AT(b->value, i)), scale)));
    }
}

int BATCH_NAME(reflect)(const struct koksma__surfaces *s, const struct koksma__light_lanes *l,
                        const struct koksma__beams *restrict b, unsigned followed, koksma__light_weight weight, int n,
                        koksma__shadows *restrict shadows, float (*restrict reflected)[KOKSMA__BLOCK])
{
    /* specular lobes cannot be evaluated for a given direction */
    const unsigned shown = KOKSMA__LOBE_DIFFUSE | KOKSMA__LOBE_GLOSSY;
    koksma__bsdf_values found;
    int lit = 0;
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        reflected[0][i] = reflected[1][i] = reflected[2][i] = 0;
    }
    if (shown & ~followed & koksma__lobes_of(s)) {
        values(s, b->w, shown & ~followed, n, &found);
        weigh(l, b, &found, KOKSMA__WEIGHT_ONE, n, reflected);
    }
    if (shown & followed & koksma__lobes_of(s)) {
        values(s, b->w, shown & followed, n, &found);
        weigh(l, b, &found, weight, n, reflected);
    }
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const int any = (reflected[0][i] > 0) | (reflected[1][i] > 0) | (reflected[2][i] > 0);
        const int all = any & (b->lit[i] != 0) & (s->form[i] >= 0);
        koksma__put(shadows->d, i, 1, koksma__either(all, AT(b->d, i), (koksma__v3){1, 1, 1}));
        shadows->light[i] = all ? 1.0f : 0.0f;
        lit += all;
    }
    return lit;
}

/* ---- Directions ------------------------------------------------------------------------------------------------- */

INLINE void keep(koksma__directions *restrict to, int i, int mine, koksma__v3 w, koksma__v3 weight, float pdf,
                 int kept)
{
    koksma__put(to->w, i, mine, w);
    koksma__put(to->weight, i, mine, weight);
    to->pdf[i] = mine ? pdf : to->pdf[i];
    to->kept[i] = mine ? kept : to->kept[i];
}

static void lambert_directions(const koksma__surfaces *restrict s, const koksma__lanes *restrict u, int n,
                               koksma__directions *restrict to)
{
    const koksma__hits *restrict h = s->hits;
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const koksma__v3 normal = AT(h->n, i), w = koksma__v3_cosine_direction(normal, u[0][i], u[1][i]);
        const float pdf = koksma__lambert_pdf(koksma__v3_dot(normal, w));
        keep(to, i, s->form[i] == KOKSMA__FORM_LAMBERT, w, AT(s->albedo, i), pdf, pdf > 0);
    }
}

static void lobe_directions(const koksma__surfaces *restrict s, unsigned lobes, const koksma__lanes *restrict u,
                            int n, koksma__directions *restrict to)
{
    const koksma__hits *restrict h = s->hits;
    const lobe_shares shares = shares_of(lobes);
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const float part = shares.fixed + shares.shared * s->derived[i], exponent = s->parameters[3][i];
        const koksma__v3 normal = AT(h->n, i), out = AT(s->out, i);
        const koksma__v3 lambert_w = koksma__v3_cosine_direction(normal, u[0][i], u[1][i]);
        const koksma__v3 lobe_w = koksma__lobe_direction(normal, out, exponent, u[0][i], u[1][i]);
        const int first = u[2][i] < part;
        const koksma__v3 w = koksma__either(first, lambert_w, lobe_w);
        const float above = koksma__v3_dot(normal, w), lambert = shares.diffuse * koksma__lambert_pdf(above);
        const float lobe = shares.glossy * koksma__lobe_pdf(normal, out, exponent, w);
        const float pdf = part * lambert + (1 - part) * lobe, scale = 1 / (pdf > 0 ? pdf : 1);
        const koksma__v3 weight = koksma__v3_scale(both_lobes(s, i, lambert, lobe), scale);
        keep(to, i, s->form[i] == KOKSMA__FORM_LOBES, w, weight, pdf, (pdf > 0) & (above > 0));
    }
}

static void facet_directions(const koksma__surfaces *restrict s, const koksma__lanes *restrict u, int n,
                             koksma__directions *restrict to)
{
    const koksma__hits *restrict h = s->hits;
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const koksma__facets facets = koksma__facets_of(AT(h->n, i), AT(s->out, i), s->parameters[3][i]);
        const koksma__v3 w = koksma__facet_direction(&facets, u[0][i], u[1][i]);
        const koksma__facet_terms t = koksma__facet_terms_of(&facets, w);
        const koksma__v3 weight = koksma__v3_scale(koksma__schlick3(AT(s->parameters, i), t.at_facet), t.ratio);
        keep(to, i, s->form[i] == KOKSMA__FORM_FACETS, w, weight, t.pdf, t.pdf > 0);
    }
}

static void coated_directions(const koksma__surfaces *restrict s, unsigned lobes, const koksma__lanes *restrict u,
                              int n, koksma__directions *restrict to)
{
    const lobe_shares shares = shares_of(lobes);
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const koksma__coat c = coat_at(s, shares, i);
        const koksma__facets facets = koksma__facets_of(c.n, c.out, c.roughness);
        const koksma__v3 diffuse = koksma__v3_cosine_direction(c.n, u[0][i], u[1][i]);
        const koksma__v3 glossy = koksma__facet_direction(&facets, u[0][i], u[1][i]);
        const int first = u[2][i] < c.share;
        const koksma__v3 w = koksma__either(first, diffuse, glossy);
        koksma__v3 value;
        const float pdf = koksma__coat_value(&c, w, &value), by = pdf > 0 ? pdf : 1;
        keep(to, i, s->form[i] == KOKSMA__FORM_COATED, w, (koksma__v3){value.x / by, value.y / by, value.z / by}, pdf,
             pdf > 0);
    }
}

static void ray_directions(const koksma__surfaces *s, unsigned lobes, const koksma__lanes *u, int n,
                           koksma__directions *to)
{
    for (int i = 0; i < n; i++) {
        if (s->form[i] == KOKSMA__FORM_RAYS) {
            const koksma__surface surface = koksma__surface_at(s, i);
            const koksma__bsdf *bsdf = surface.material->bsdf;
            const float pair[2] = {u[0][i], u[1][i]};
            koksma__scatter out;
            to->kept[i] = lobes & bsdf->lobes && bsdf->sample(&surface, lobes & bsdf->lobes, pair, u[2][i], &out);
            for (int k = 0; to->kept[i] && k < 3; k++) {
                to->w[k][i] = out.w[k];
                to->weight[k][i] = out.weight[k];
            }
            to->pdf[i] = to->kept[i] ? out.pdf : 0;
        }
    }
}

void BATCH_NAME(scatter)(const struct koksma__surfaces *s, unsigned lobes, const float (*u)[KOKSMA__BLOCK], int n,
                         struct koksma__directions *to)
{
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        to->w[0][i] = to->w[1][i] = to->w[2][i] = to->pdf[i] = 0;
        to->weight[0][i] = to->weight[1][i] = to->weight[2][i] = 0;
        to->kept[i] = 0;
    }
    if (s->traits & 1u << KOKSMA__FORM_LAMBERT && lobes & KOKSMA__LOBE_DIFFUSE) {
        lambert_directions(s, u, n, to);
    }
    if (s->traits & 1u << KOKSMA__FORM_LOBES && lobes & (KOKSMA__LOBE_DIFFUSE | KOKSMA__LOBE_GLOSSY)) {
        lobe_directions(s, lobes, u, n, to);
    }
    if (s->traits & 1u << KOKSMA__FORM_FACETS && lobes & KOKSMA__LOBE_GLOSSY) {
        facet_directions(s, u, n, to);
    }
    if (s->traits & 1u << KOKSMA__FORM_COATED && lobes & (KOKSMA__LOBE_DIFFUSE | KOKSMA__LOBE_GLOSSY)) {
        coated_directions(s, lobes, u, n, to);
    }
    if (s->traits & 1u << KOKSMA__FORM_RAYS) {
        ray_directions(s, lobes, u, n, to);
    }
}
