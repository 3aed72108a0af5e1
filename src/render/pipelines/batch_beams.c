/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Samples lights for blocks of points, and looks up the environment for blocks of rays. Each form of light
 * (rectangle, disk, cone, parallel, environment) has one loop, which handles either one light that all lanes share or
 * a different light in each lane; kinds of light without a form are sampled point by point. Texels of an environment
 * are looked up between loops over lanes, so that the cache misses of a block overlap.
 */
#include <math.h>
#include <string.h>

#include "render/lights/beams.h"
#include "render/pipelines/batch_kernel.h"
#include "render/pipelines/vertices.h"

/* The properties of a light that the loops read. */
typedef struct emitter {
    koksma__v3 centre, u, v, normal, radiance;
    float area, radius;
} emitter;

/* The emitters of all lanes, as arrays. */
typedef struct emitters {
    _Alignas(64) koksma__lanes centre[3];
    _Alignas(64) koksma__lanes u[3];
    _Alignas(64) koksma__lanes v[3];
    _Alignas(64) koksma__lanes normal[3];
    _Alignas(64) koksma__lanes radiance[3];
    _Alignas(64) koksma__lanes area;
    _Alignas(64) koksma__lanes radius;
    KOKSMA__LANES(int32_t, form);
} emitters;

static emitter emitter_of(const koksma__shading_light *l)
{
    return (emitter){.centre = koksma__v3_of(l->centre),
                     .u = koksma__v3_scale(koksma__v3_of(l->axis_u), l->half[0]),
                     .v = koksma__v3_scale(koksma__v3_of(l->axis_v),
                                           l->kind->form == KOKSMA__BEAMS_DISK ? l->half[0] : l->half[1]),
                     .normal = koksma__v3_of(l->normal),
                     .radiance = koksma__v3_of(l->radiance),
                     .area = l->area,
                     .radius = l->half[0]};
}

/* Returns the emitter of lane i, which is `one` if all lanes share it. */
INLINE emitter pick(const emitter *one, const emitters *restrict each, int i)
{
    return one ? *one : (emitter){AT(each->centre, i),   AT(each->u, i), AT(each->v, i), AT(each->normal, i),
                                  AT(each->radiance, i), each->area[i],  each->radius[i]};
}

INLINE void set_beam(koksma__beams *restrict out, int i, int mine, koksma__v3 d, koksma__v3 w, koksma__v3 value,
                     float pdf, int lit)
{
    koksma__put(out->d, i, mine, d);
    koksma__put(out->w, i, mine, w);
    koksma__put(out->value, i, mine, value);
    out->pdf[i] = mine ? pdf : out->pdf[i];
    out->lit[i] = mine ? lit : out->lit[i];
}

#define MINE(form_, i) (one ? l->light[i] >= 0 : each->form[i] == (form_))

INLINE void flat_beams(const emitter *one, const emitters *restrict each, const koksma__light_lanes *restrict l,
                       const koksma__hits *restrict h, const koksma__lanes *restrict u, bool disk, int n,
                       koksma__beams *restrict out)
{
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const emitter e = pick(one, each, i);
        float x = 2 * u[0][i] - 1, y = 2 * u[1][i] - 1;
        if (disk) {
            koksma__concentric(u[0][i], u[1][i], &x, &y);
        }
        const koksma__v3 on =
            koksma__v3_add(e.centre, koksma__v3_add(koksma__v3_scale(e.u, x), koksma__v3_scale(e.v, y)));
        const koksma__v3 d = koksma__v3_subtract(on, AT(h->p, i));
        koksma__v3 w;
        const float pdf = koksma__flat_beam(d, e.normal, e.area, &w);
        set_beam(out, i, MINE(disk ? KOKSMA__BEAMS_DISK : KOKSMA__BEAMS_RECTANGLE, i), d, w,
                 koksma__v3_scale(e.radiance, 1 / pdf), pdf, pdf > 0);
    }
}

INLINE void cone_beams(const emitter *one, const emitters *restrict each, const koksma__light_lanes *restrict l,
                       const koksma__hits *restrict h, const koksma__lanes *restrict u, int n,
                       koksma__beams *restrict out)
{
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const emitter e = pick(one, each, i);
        koksma__v3 d, w;
        const float pdf =
            koksma__cone_beam(koksma__v3_subtract(e.centre, AT(h->p, i)), e.radius, u[0][i], u[1][i], &d, &w);
        set_beam(out, i, MINE(KOKSMA__BEAMS_CONE, i), d, w, koksma__v3_scale(e.radiance, 1 / pdf), pdf, pdf > 0);
    }
}

INLINE void parallel_beams(const emitter *one, const emitters *restrict each, const koksma__light_lanes *restrict l,
                           int n, koksma__beams *restrict out)
{
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const emitter e = pick(one, each, i);
        const koksma__v3 w = koksma__v3_scale(e.normal, -1);
        set_beam(out, i, MINE(KOKSMA__BEAMS_PARALLEL, i), koksma__v3_scale(w, KOKSMA__AWAY), w, e.radiance, 0, 1);
    }
}

/* ---- Meshes ----------------------------------------------------------------------------------------------------- */

enum { FEW = 8 }; /* triangles of a light that all lanes try */

/* The triangles that the lanes sample: `root` is 1 minus the weight of corner 2; `mine` is 0 where the light is no mesh. */
typedef struct mesh_samples {
    _Alignas(64) koksma__lanes corners[9];
    _Alignas(64) koksma__lanes normal[3];
    _Alignas(64) koksma__lanes radiance[3];
    _Alignas(64) koksma__lanes largest;
    _Alignas(64) koksma__lanes density; /* over area */
    _Alignas(64) koksma__lanes root;
    KOKSMA__LANES(int32_t, mine);
    KOKSMA__LANES(int32_t, two_sided);
    KOKSMA__LANES(uint32_t, triangle);
} mesh_samples;

/* Chooses the triangle of lane i; returns whether it has an image. */
static bool choose_face(const koksma__shading_light *light, float u, int i, mesh_samples *to)
{
    const koksma__mesh_light *m = light->data;
    const double target = (double)u * m->cdf[m->n];
    size_t low = 0, high = m->n;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        const bool up = m->cdf[middle] <= target;
        low = up ? middle : low;
        high = up ? high : middle;
    }
    const koksma__mesh_light_face *face = &m->faces[low];
    const double size = m->cdf[low + 1] - m->cdf[low];
    for (int k = 0; k < 9; k++) {
        to->corners[k][i] = face->corners[k];
    }
    koksma__put(to->normal, i, 1, koksma__v3_of(face->normal));
    koksma__put(to->radiance, i, 1, koksma__v3_of(light->radiance));
    to->largest[i] = face->largest;
    to->density[i] = m->map ? m->densities[low] : 1 / light->area;
    to->root[i] = (float)(size > 0 ? (target - m->cdf[low]) / size : 0);
    to->two_sided[i] = light->two_sided;
    to->triangle[i] = (uint32_t)low;
    return m->map != NULL;
}

/* Sets the lanes that are `at` k, and all if k is 0. */
INLINE void spread(float x, const int32_t *restrict at, size_t k, int n, float *restrict to)
{
    const int32_t here = (int32_t)k;
    for (int i = 0; !k && i < STEP(n); i++) {
        to[i] = x;
    }
    for (int i = 0; k && i < STEP(n); i++) {
        to[i] = at[i] == here ? x : to[i];
    }
}

/* Chooses like choose_face for all lanes, which share a light of few triangles without an image. */
static void choose_faces(const koksma__shading_light *light, const koksma__light_lanes *l, const float *restrict u,
                         int n, mesh_samples *restrict to)
{
    const koksma__mesh_light *m = light->data;
    KOKSMA__LANES(int32_t, at);
    for (int i = 0; i < STEP(n); i++) {
        const double target = (double)u[i] * m->cdf[m->n];
        int32_t low = 0;
        for (size_t k = 1; k < m->n; k++) {
            low += m->cdf[k] <= target;
        }
        const double size = m->cdf[low + 1] - m->cdf[low];
        at[i] = low;
        to->root[i] = (float)(size > 0 ? (target - m->cdf[low]) / size : 0);
    }
    for (int i = 0; i < STEP(n); i++) {
        to->radiance[0][i] = light->radiance[0];
        to->radiance[1][i] = light->radiance[1];
        to->radiance[2][i] = light->radiance[2];
        to->density[i] = 1 / light->area;
        to->two_sided[i] = light->two_sided;
        to->mine[i] = l->light[i] >= 0;
    }
    for (size_t k = 0; k < m->n; k++) {
        const koksma__mesh_light_face *face = &m->faces[k];
        for (int c = 0; c < 9; c++) {
            spread(face->corners[c], at, k, n, to->corners[c]);
        }
        for (int c = 0; c < 3; c++) {
            spread(face->normal[c], at, k, n, to->normal[c]);
        }
        spread(face->largest, at, k, n, to->largest);
    }
}

INLINE void mesh_lanes(const mesh_samples *restrict s, const koksma__hits *restrict h, const float *restrict u, int n,
                       koksma__beams *restrict out)
{
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const koksma__v3 normal = AT(s->normal, i), radiance = AT(s->radiance, i);
        const float root = sqrtf(s->root[i]), b = 1 - root, a = u[i] * root, rest = 1 - a - b;
        const koksma__v3 on = koksma__v3_add(
            koksma__v3_scale(AT(s->corners, i), rest),
            koksma__v3_add(koksma__v3_scale(AT(s->corners + 3, i), a), koksma__v3_scale(AT(s->corners + 6, i), b)));
        const koksma__v3 d = koksma__v3_subtract(on, AT(h->p, i));
        const float square = koksma__v3_dot(d, d), length = sqrtf(square), facing = -koksma__v3_dot(normal, d);
        const float side = (float)(1 - 2 * (s->two_sided[i] & (facing < 0))), at_light = side * facing;
        const float pdf = square * length * s->density[i] / at_light;
        /* the light is 0 behind a triangle, and on one without area */
        set_beam(out, i, s->mine[i], koksma__v3_add(d, koksma__v3_scale(normal, side * 0x1p-20f * s->largest[i])),
                 koksma__v3_scale(d, 1 / length), koksma__v3_scale(radiance, 1 / pdf), pdf, at_light > 0);
    }
}

static void mesh_beams(const koksma__light_lanes *l, const koksma__hits *h, const koksma__lanes *u, int n,
                       koksma__beams *out)
{
    mesh_samples s;
    bool images = false;
    for (int i = 0; i < n; i++) {
        const koksma__shading_light *light = l->light[i] < 0 ? NULL : &l->lights[l->light[i]];
        s.mine[i] = light && light->kind->form == KOKSMA__BEAMS_MESH;
        images |= s.mine[i] && choose_face(light, u[0][i], i, &s);
    }
    mesh_lanes(&s, h, u[1], n, out);
    for (int i = 0; images && i < n; i++) {
        const koksma__mesh_light *m = s.mine[i] ? l->lights[l->light[i]].data : NULL;
        if (m && m->map && out->lit[i]) {
            const float root = sqrtf(s.root[i]);
            float glow[3];
            koksma__mesh_glow(m, s.triangle[i], u[1][i] * root, 1 - root, glow);
            for (int k = 0; k < 3; k++) {
                out->value[k][i] *= glow[k];
            }
        }
    }
}

static void shared_mesh_beams(const koksma__shading_light *light, const koksma__light_lanes *l, const koksma__hits *h,
                              const koksma__lanes *u, int n, koksma__beams *out)
{
    const koksma__mesh_light *m = light->data;
    if (m->map || m->n > FEW) {
        mesh_beams(l, h, u, n, out);
    } else {
        mesh_samples s;
        choose_faces(light, l, u[0], n, &s);
        mesh_lanes(&s, h, u[1], n, out);
    }
}

/* ---- Environments --------------------------------------------------------------------------------------------- */

/* Looks up the radiance of the environment and its sampling density along the directions w. */
static void look_around(const koksma__environment *e, const koksma__lanes *restrict w, int n,
                        koksma__lanes *restrict radiance, float *restrict pdf)
{
    KOKSMA__LANES(int32_t, rows);
    KOKSMA__LANES(int32_t, columns);
    _Alignas(64) koksma__lanes sines;
    if (!e->texels) {
        LANES_APART
        for (int i = 0; i < STEP(n); i++) {
            radiance[0][i] = e->radiance[0];
            radiance[1][i] = e->radiance[1];
            radiance[2][i] = e->radiance[2];
            pdf[i] = 0.25f / KOKSMA__PI_F;
        }
        return;
    }
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const koksma__texel t = koksma__environment_texel(e, AT(w, i));
        rows[i] = t.row;
        columns[i] = t.column;
        sines[i] = t.sine;
    }
    for (int i = 0; i < n; i++) {
        const size_t row = (size_t)rows[i], column = (size_t)columns[i];
        __builtin_prefetch(e->texels + (row * (size_t)e->width + column) * (size_t)e->channels);
        __builtin_prefetch(e->column_cdf + row * e->stride + column);
    }
    for (int i = 0; i < n; i++) {
        const koksma__texel t = {rows[i], columns[i], sines[i]};
        koksma__put(radiance, i, 1, koksma__environment_texel_radiance(e, t));
        pdf[i] = koksma__environment_texel_pdf(e, t);
    }
}

/* One cumulative distribution per lane, with its coarse table (every KOKSMA__ENVIRONMENT_STEP-th number). */
typedef struct tables {
    const float *cdf[KOKSMA__BLOCK], *coarse[KOKSMA__BLOCK];
} tables;

/* How many of KOKSMA__ENVIRONMENT_STEP ascending numbers are at most u; the first is. */
INLINE int32_t numbers_up_to(const float *step, float u)
{
#ifdef __AVX512F__
    return __builtin_popcount(_mm512_cmp_ps_mask(_mm512_loadu_ps(step), _mm512_set1_ps(u), _CMP_LE_OQ) | 1u);
#else
    int32_t count = 1;
    for (int k = 1; k < KOKSMA__ENVIRONMENT_STEP; k++) {
        count += step[k] <= u;
    }
    return count;
#endif
}

/* Finds, in each of n tables of `cells` cells, the cell that contains u and the position of u within it. All lanes
   search the coarse tables by bisection in step, so that their cache misses overlap; then each counts how many of
   the next 15 numbers of the full table are at most u. */
static void find(const tables *t, int32_t cells, const float *u, int n, int32_t *found, float *within)
{
    KOKSMA__LANES(int32_t, high);
    const int32_t steps = (cells + KOKSMA__ENVIRONMENT_STEP - 1) / KOKSMA__ENVIRONMENT_STEP;
    for (int i = 0; i < n; i++) {
        found[i] = 0;
        high[i] = steps;
    }
    for (int32_t left = steps; left > 1; left -= left / 2) {
        for (int i = 0; i < n; i++) {
            const int32_t middle = (found[i] + high[i]) / 2;
            const int32_t above = -(t->coarse[i][middle] <= u[i]); /* all bits, in place of a branch */
            found[i] = (middle & above) | (found[i] & ~above);
            high[i] = (high[i] & above) | (middle & ~above);
        }
    }
    for (int i = 0; i < n; i++) {
        const float *step = t->cdf[i] + (size_t)found[i] * KOKSMA__ENVIRONMENT_STEP;
        __builtin_prefetch(step);
        __builtin_prefetch(step + KOKSMA__ENVIRONMENT_STEP);
    }
    for (int i = 0; i < n; i++) {
        const float *step = t->cdf[i] + (size_t)found[i] * KOKSMA__ENVIRONMENT_STEP, at = u[i];
        const int32_t passed = numbers_up_to(step, at) - 1; /* step[0] is one of them */
        found[i] = found[i] * KOKSMA__ENVIRONMENT_STEP + passed;
        const float size = step[passed + 1] - step[passed], part = size > 0 ? (at - step[passed]) / size : 0.5f;
        within[i] = part < 1 ? part : 1 - 0x1p-24f;
    }
}

/* Samples positions in the environment image by importance; the results are not used in lanes that sample the sphere
   of directions uniformly. */
static void place(const koksma__environment *e, const koksma__lanes *restrict u, int n, float *restrict x,
                  float *restrict y)
{
    tables t = {0};
    KOKSMA__LANES(int32_t, rows);
    KOKSMA__LANES(int32_t, columns);
    _Alignas(64) koksma__lanes part = {0}, in_row, in_column;
    for (int i = 0; i < n; i++) {
        const float v = (u[1][i] - KOKSMA__ENVIRONMENT_FLOOR) / (1 - KOKSMA__ENVIRONMENT_FLOOR);
        part[i] = v > 0 ? v : 0;
        t.cdf[i] = e->row_cdf;
        t.coarse[i] = e->row_coarse;
    }
    find(&t, e->height, part, n, rows, in_row);
    for (int i = 0; i < n; i++) {
        t.cdf[i] = e->column_cdf + (size_t)rows[i] * e->stride;
        t.coarse[i] = e->column_coarse + (size_t)rows[i] * e->stride / KOKSMA__ENVIRONMENT_STEP;
    }
    find(&t, e->width, u[0], n, columns, in_column);
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        x[i] = ((float)columns[i] + in_column[i]) / (float)e->width;
        y[i] = ((float)rows[i] + in_row[i]) / (float)e->height;
    }
}

static void around_beams(const koksma__environment *e, const emitters *each, const koksma__light_lanes *restrict l,
                         const koksma__lanes *restrict u, int n, koksma__beams *restrict out)
{
    _Alignas(64) koksma__lanes x, y, w[3], radiance[3], pdf;
    if (e->texels) {
        place(e, u, n, x, y);
    }
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const int alike = !e->texels | (u[1][i] < KOKSMA__ENVIRONMENT_FLOOR);
        const float height = e->texels ? u[1][i] * (1 / KOKSMA__ENVIRONMENT_FLOOR) : u[1][i], up = 1 - 2 * height;
        const float rest = 1 - up * up, polar = 2 * koksma__arc_turns(sqrtf(rest > 0 ? rest : 0), up);
        float sine;
        const koksma__v3 direction =
            koksma__environment_direction(e, alike ? u[0][i] : x[i], alike ? polar : y[i], &sine);
        koksma__put(w, i, 1, direction);
    }
    look_around(e, w, n, radiance, pdf);
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const int mine = each ? each->form[i] == KOKSMA__BEAMS_AROUND : l->light[i] >= 0;
        const koksma__v3 direction = AT(w, i), value = koksma__v3_scale(AT(radiance, i), 1 / pdf[i]);
        set_beam(out, i, mine, koksma__v3_scale(direction, KOKSMA__AWAY), direction, value, pdf[i],
                 (value.x > 0) | (value.y > 0) | (value.z > 0));
    }
}

void BATCH_NAME(around)(const struct koksma__environment *e, const koksma__rays *rays, const int32_t *hit, int n,
                        float (*radiance)[KOKSMA__BLOCK], float *pdf)
{
    _Alignas(64) koksma__lanes w[3];
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const int missed = hit[i] < 0; /* the lanes of rays that hit something all look up one texel; their results
                                          are not used */
        koksma__put(w, i, 1, koksma__either(missed, koksma__v3_unit(AT(rays->d, i)), (koksma__v3){0, 1, 0}));
    }
    look_around(e, w, n, radiance, pdf);
}

/* ---- All kinds -------------------------------------------------------------------------------------------------- */

static void ray_beams(const koksma__light_lanes *l, const koksma__hits *h, const koksma__lanes *u, int n,
                      koksma__beams *out)
{
    for (int i = 0; i < n; i++) {
        const koksma__shading_light *light = l->light[i] < 0 ? NULL : &l->lights[l->light[i]];
        if (light && (l->centres || light->kind->form == KOKSMA__BEAMS_RAYS)) {
            const float p[3] = {h->p[0][i], h->p[1][i], h->p[2][i]}, pair[2] = {u[0][i], u[1][i]};
            koksma__beam beam;
            out->lit[i] = l->centres ? light->kind->centre && light->kind->centre(light, p, &beam)
                                     : light->kind->sample(light, p, pair, &beam);
            if (out->lit[i]) {
                koksma__put(out->d, i, 1, koksma__v3_of(beam.d));
                koksma__put(out->w, i, 1, koksma__v3_of(beam.w));
                koksma__put(out->value, i, 1, koksma__v3_of(beam.value));
                out->pdf[i] = beam.pdf;
            }
        }
    }
}

static void shared_beams(const koksma__shading_light *light, const koksma__light_lanes *l, const koksma__hits *h,
                         const koksma__lanes *u, int n, koksma__beams *out)
{
    const emitter one = emitter_of(light);
    switch (light->kind->form) {
    case KOKSMA__BEAMS_RECTANGLE:
        flat_beams(&one, NULL, l, h, u, false, n, out);
        break;
    case KOKSMA__BEAMS_DISK:
        flat_beams(&one, NULL, l, h, u, true, n, out);
        break;
    case KOKSMA__BEAMS_CONE:
        cone_beams(&one, NULL, l, h, u, n, out);
        break;
    case KOKSMA__BEAMS_PARALLEL:
        parallel_beams(&one, NULL, l, n, out);
        break;
    case KOKSMA__BEAMS_MESH:
        shared_mesh_beams(light, l, h, u, n, out);
        break;
    case KOKSMA__BEAMS_AROUND:
        around_beams(light->data, NULL, l, u, n, out);
        break;
    default:
        ray_beams(l, h, u, n, out);
    }
}

static void own_beams(const koksma__light_lanes *l, const koksma__hits *h, const koksma__lanes *u, int n,
                      koksma__beams *out)
{
    emitters each;
    unsigned forms = 0;
    const koksma__environment *around = NULL;
    for (int i = 0; i < n; i++) {
        const koksma__shading_light *light = &l->lights[l->light[i] < 0 ? 0 : l->light[i]];
        const emitter e = emitter_of(light);
        koksma__put(each.centre, i, 1, e.centre);
        koksma__put(each.u, i, 1, e.u);
        koksma__put(each.v, i, 1, e.v);
        koksma__put(each.normal, i, 1, e.normal);
        koksma__put(each.radiance, i, 1, e.radiance);
        each.area[i] = e.area;
        each.radius[i] = e.radius;
        each.form[i] = l->light[i] < 0 ? -1 : (int32_t)light->kind->form;
        forms |= l->light[i] < 0 ? 0 : 1u << light->kind->form;
        around = each.form[i] == KOKSMA__BEAMS_AROUND ? light->data : around;
    }
    if (forms & 1u << KOKSMA__BEAMS_RECTANGLE) {
        flat_beams(NULL, &each, l, h, u, false, n, out);
    }
    if (forms & 1u << KOKSMA__BEAMS_DISK) {
        flat_beams(NULL, &each, l, h, u, true, n, out);
    }
    if (forms & 1u << KOKSMA__BEAMS_CONE) {
        cone_beams(NULL, &each, l, h, u, n, out);
    }
    if (forms & 1u << KOKSMA__BEAMS_PARALLEL) {
        parallel_beams(NULL, &each, l, n, out);
    }
    if (forms & 1u << KOKSMA__BEAMS_MESH) {
        mesh_beams(l, h, u, n, out);
    }
    if (around) {
        around_beams(around, &each, l, u, n, out);
    }
    if (forms & 1u << KOKSMA__BEAMS_RAYS) {
        ray_beams(l, h, u, n, out);
    }
}

void BATCH_NAME(beams)(const struct koksma__light_lanes *l, const koksma__hits *hits, const float (*u)[KOKSMA__BLOCK],
                       int n, struct koksma__beams *out)
{
    memset(out->lit, 0, (size_t)n * sizeof *out->lit); /* nothing else is used of lanes that are not lit */
    if (l->same >= 0) {
        const int32_t visible = l->lights[l->same].visible;
        for (int i = 0; i < STEP(n); i++) {
            out->visible[i] = visible;
        }
    }
    for (int i = 0; l->same < 0 && i < n; i++) {
        out->visible[i] = l->light[i] >= 0 && l->lights[l->light[i]].visible;
    }
    if (l->centres) {
        ray_beams(l, hits, u, n, out);
    } else if (l->same >= 0) {
        shared_beams(&l->lights[l->same], l, hits, u, n, out);
    } else {
        own_beams(l, hits, u, n, out);
    }
}
