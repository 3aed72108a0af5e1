/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The wavefront path tracer, which renders any scene with any integrator (Laine, Karras & Aila 2013 describe the idea
 * for GPUs). The file is long because all stages of a vertex work on the same block of lanes. For each sample of the
 * film it estimates the rendering equation (Kajiya 1986)
 *
 *     L(x, out) = E(x, out) + integral of f(w, out) L(y, -w) cos dw
 *
 * Here y is the point that the ray from x along w hits. The tracer estimates the integral by random paths. A path is
 * a ray and a weight beta, the product of f cos / pdf over all directions so far. The light that the path finds is
 * multiplied by beta and added to the sample. All paths of a group advance by one vertex together, so that rays and
 * shadow rays are intersected in blocks of lanes (batch.h):
 *
 *     queue of paths, bounce b
 *       | closest          intersects rays, a block at once: primitive, position, normal; a medium may scatter a ray first
 *       | emission         a ray that hits a light, or hits nothing, adds light:    sum += beta L m
 *       | lights           each vertex samples every light, or a chosen one; a block of shadow rays at once
 *       | scatter          each vertex samples a direction (or takes both of glass) from its material
 *     queue of paths, bounce b + 1
 *
 * The two queues alternate until one is empty. Paths only end or branch, and their order does not depend on the
 * threads, so that the light of a sample is summed in a fixed order and the bits are equal for any number of threads.
 *
 * Light that both strategies can find, by sampling the light and by a reflected ray that hits it, is weighted by the
 * power heuristic (Veach 1997, section 9.2): m = p^2 / (p^2 + q^2), where p is the density of the strategy that found
 * the light and q that of the other strategy; the two weights m of one direction add up to 1. For this a path carries
 * the density of its last direction (0 after a mirror, because light sampling finds no light in a mirror: m = 1).
 * Integrators may use other weights: the balance heuristic, 1 or 0. If only rays along lobes may find lights, each
 * path traces one ray past the depth limit; it replaces the light samples of the last vertex, so that the images of
 * all weightings have the same mean at any depth.
 *
 * All random numbers come from the uses, the purposes of sample dimensions (samples/uses.def). The uses lobe, lobe
 * choice, light and roulette have different keys at each vertex b, so that the pattern under study, not the tracer,
 * decides how the samples of vertices are stratified.
 */
#include "render/pipelines/pipelines.h"

#include <math.h>
#include <string.h>

#include <koksma/image.h>

#include "core/status.h"
#include "render/one_image.h"
#include "render/samples/samples.h"
#include "render/scene_images.h"
#include "render/vector3.h"

/* largest number of samples that are traced together; it bounds the length of the queues, which branching paths
   increase */
enum { TOGETHER = 1024 };

/* ---- The camera ------------------------------------------------------------------------------------------- */

/* Moves the origins of rays from the camera, whose directions have length 1 along `forward`, to a plane in front of it. */
static void advance(koksma__rays *rays, float distance, int n)
{
    for (int i = 0; distance > 0 && i < n; i++) {
        for (int k = 0; k < 3; k++) {
            rays->o[k][i] += distance * rays->d[k][i];
        }
    }
}

/* Starts paths at the eye. The positions, lens points and times are padded with copies up to a multiple of
   KOKSMA__LANE_STEP. */
static koksma_status start_paths(const koksma__trace *trace, const koksma__values *values, size_t first, size_t end)
{
    const koksma__frame *frame = trace->frame;
    const koksma__camera *camera = &frame->scene->camera;
    koksma__queue *queue = &trace->scratch->queues[0];
    const float *points = NULL, *times = NULL;
    if (camera->lens_radius > 0) {
        KOKSMA__TRY(koksma__wavefront_draw(trace, KOKSMA__USE_LENS, &points));
    }
    if (frame->scene->moves) {
        KOKSMA__TRY(koksma__wavefront_draw(trace, KOKSMA__USE_TIME, &times));
    }
    for (size_t start = first; start < end; start += KOKSMA__BLOCK) {
        const int n = (int)(end - start < KOKSMA__BLOCK ? end - start : KOKSMA__BLOCK);
        const int whole = (int)koksma__whole_lanes((size_t)n);
        _Alignas(64) koksma__lanes x, y, u;
        KOKSMA__TRY(koksma__wavefront_reserve(queue));
        koksma__paths *to = &queue->blocks[queue->n / KOKSMA__BLOCK];
        if (points) {
            koksma__lens_points(camera, frame->batch, points + 2 * start, whole, x, y);
        }
        for (int i = 0; times && i < whole; i++) {
            u[i] = times[2 * (start + (size_t)i)];
        }
        frame->batch->start(&frame->camera, values->film + 2 * start, points ? x : NULL, y, times ? u : NULL, whole,
                            to);
        koksma__move_origins(frame, values->film + 2 * start, whole, &to->rays);
        advance(&to->rays, (float)camera->near_clip, whole);
        for (int i = 0; i < whole; i++) {
            to->sample[i] = (uint32_t)(start + (size_t)(i < n ? i : n - 1));
        }
        queue->n += (size_t)n;
    }
    return KOKSMA_OK;
}

/* ---- What rays meet ------------------------------------------------------------------------------------- */

static koksma__v3 direction_at(const koksma__paths *p, int i)
{
    return koksma__v3_unit((koksma__v3){p->rays.d[0][i], p->rays.d[1][i], p->rays.d[2][i]});
}

/* Takes lane i, whose ray from the camera hits a light that the camera does not see, to the light's other side; passed: how
   far it has come. */
static void pass_light(koksma__paths *p, const koksma__hits *hits, int i, float *passed)
{
    for (int k = 0; k < 3; k++) {
        p->rays.o[k][i] += hits->t[i] * p->rays.d[k][i];
    }
    p->from[i] = hits->primitive[i];
    *passed += hits->t[i];
}

/* Takes rays from the camera, which sees no lights, on through the lights that they hit, one after the other; hits are then
   counted from the rays' own origins. */
static void pass_lights(const koksma__geometry *g, koksma__paths *p, int n, koksma__hits *hits)
{
    const koksma__rays start = p->rays;
    _Alignas(64) koksma__lanes passed = {0};
    for (bool again = true; again;) {
        again = false;
        for (int i = 0; i < n; i++) {
            if (hits->primitive[i] >= 0 && g->light(g, hits->primitive[i]) >= 0) {
                pass_light(p, hits, i, &passed[i]);
                again = true;
            }
        }
        if (again) {
            g->closest(g, &p->rays, p->from, n, hits);
        }
    }
    for (int i = 0; i < n; i++) {
        hits->t[i] += passed[i];
    }
    p->rays = start;
}

/* Finds what rays from the camera meet. What is beyond the far plane is not met. */
static void meet_first(const koksma__frame *frame, koksma__paths *p, int n, koksma__hits *hits)
{
    const koksma__geometry *g = &frame->geometry;
    const koksma__camera *camera = &frame->scene->camera;
    const float end = (float)(camera->far_clip - camera->near_clip);
    g->closest(g, &p->rays, NULL, n, hits);
    if (frame->scene->hides_lights) {
        pass_lights(g, p, n, hits);
    }
    for (int i = 0; camera->far_clip > 0 && i < n; i++) {
        if (hits->t[i] > end) {
            hits->primitive[i] = hits->material[i] = -1;
        }
    }
}

/* Returns the multiple-importance weight of the light that ray i found by hitting the light with index `light`. pdf:
   the density with which sampling of that light chooses the ray's direction. */
static float met_weight(const koksma__frame *frame, const koksma__paths *p, int i, size_t light, float pdf)
{
    if (!(p->pdf[i] > 0)) {
        /* 1 for a ray from the eye or a mirror, because light sampling cannot find that light */
        return p->pdf[i] < 0 ? 0 : 1;
    }
    const float o[3] = {p->rays.o[0][i], p->rays.o[1][i], p->rays.o[2][i]},
                n[3] = {p->n[0][i], p->n[1][i], p->n[2][i]};
    const float sampled = pdf * koksma__light_probability(frame, o, n, (int)light);
    switch (frame->flags->weight) {
    case KOKSMA__WEIGHT_BALANCE:
        return p->pdf[i] / (p->pdf[i] + sampled);
    case KOKSMA__WEIGHT_ONE:
        return sampled > 0 ? 0 : 1;
    case KOKSMA__WEIGHT_ZERO:
        return 1;
    default:
        return p->pdf[i] * p->pdf[i] / (p->pdf[i] * p->pdf[i] + sampled * sampled);
    }
}

static void add_scaled(koksma__vertices *v, int i, const float value[3], float scale)
{
    for (int k = 0; k < 3; k++) {
        v->light[k][i] += v->paths->beta[k][i] * value[k] * scale;
    }
}

/* Adds the light of environments to the paths whose rays hit nothing. */
static void add_misses(const koksma__frame *frame, koksma__vertices *v)
{
    const koksma__lights *lights = &frame->lights;
    for (size_t l = lights->first_around; l < lights->n; l++) {
        const koksma__shading_light *light = &lights->lights[l];
        _Alignas(64) koksma__lanes radiance[3], pdf;
        if (!light->kind->radiance || !light->visible) {
            continue;
        }
        if (light->kind->form == KOKSMA__BEAMS_AROUND) {
            frame->batch->around(light->data, &v->paths->rays, v->hits.primitive, v->whole, radiance, pdf);
        }
        for (int i = 0; i < v->n; i++) {
            if (v->hits.primitive[i] < 0) {
                float w[3], value[3] = {radiance[0][i], radiance[1][i], radiance[2][i]}, density = pdf[i];
                if (light->kind->form != KOKSMA__BEAMS_AROUND) {
                    koksma__v3_to(direction_at(v->paths, i), w);
                    light->kind->radiance(light, w, value);
                    density = light->kind->pdf ? light->kind->pdf(light, w, w, 0, w) : 0;
                }
                add_scaled(v, i, value, met_weight(frame, v->paths, i, l, density));
            }
        }
    }
}

static void add_emission(const koksma__frame *frame, koksma__vertices *v, int i)
{
    const koksma__hits *hits = &v->hits;
    const koksma__rays *rays = &v->paths->rays;
    const size_t light = (size_t)frame->geometry.light(&frame->geometry, hits->primitive[i]);
    const koksma__shading_light *l = &frame->lights.lights[light];
    if (!hits->back[i] || l->two_sided) {
        const float o[3] = {rays->o[0][i], rays->o[1][i], rays->o[2][i]},
                    n[3] = {hits->n[0][i], hits->n[1][i], hits->n[2][i]};
        const float d[3] = {rays->d[0][i], rays->d[1][i], rays->d[2][i]}, length = sqrtf(koksma__dot3(d, d));
        float w[3];
        koksma__v3_to(direction_at(v->paths, i), w);
        const float pdf = l->kind->pdf ? l->kind->pdf(l, o, w, hits->t[i] * length, n) : 0;
        add_scaled(v, i, l->radiance, met_weight(frame, v->paths, i, light, pdf));
    }
}

/* Adds the emission of a light whose surface also reflects. Such a surface may have interpolated normals, and a
   texture may reduce its emission. */
static void add_glow(const koksma__frame *frame, koksma__vertices *v, int i)
{
    const koksma__hits *hits = &v->hits;
    const koksma__rays *rays = &v->paths->rays;
    const int light = frame->geometry.light(&frame->geometry, hits->primitive[i]);
    const float p[3] = {hits->p[0][i], hits->p[1][i], hits->p[2][i]}, uv[2] = {hits->u[i], hits->v[i]};
    const float d[3] = {rays->d[0][i], rays->d[1][i], rays->d[2][i]};
    koksma__triangle triangle;
    if (light < 0 || (hits->back[i] && !frame->lights.lights[light].two_sided) ||
        !frame->geometry.triangle(&frame->geometry, hits->primitive[i], p, rays->time[i], &triangle)) {
        return;
    }
    const koksma__shading_light *l = &frame->lights.lights[light];
    const float length = sqrtf(koksma__dot3(d, d)), t = hits->t[i] * length;
    float radiance[3];
    const float cosine = -koksma__dot3(triangle.normal, d) / (l->two_sided && hits->back[i] ? -length : length);
    const float density = l->kind->met(l, triangle.number, uv, radiance);
    const float pdf = cosine > 0 ? t * t * density / cosine : 0;
    add_scaled(v, i, radiance, met_weight(frame, v->paths, i, (size_t)light, pdf));
}

/* Replaces the normal of a hit by that of a normal map, whose x is along u, whose y is perpendicular to u on the
   surface, and whose z points outwards. The surface's normal is kept where the ray would see the back of the new
   normal. */
static void bend(const koksma__map *map, const koksma__triangle *triangle, koksma__vertices *v, int i)
{
    koksma__hits *h = &v->hits;
    const float side = h->back[i] ? -1.0f : 1.0f,
                out[3] = {v->surfaces.out[0][i], v->surfaces.out[1][i], v->surfaces.out[2][i]};
    const float n[3] = {side * h->n[0][i], side * h->n[1][i], side * h->n[2][i]};
    const float along = koksma__dot3(triangle->along_u, n);
    float rgb[3], u[3], bent[3];
    for (int k = 0; k < 3; k++) {
        u[k] = triangle->along_u[k] - along * n[k];
    }
    if (!(koksma__dot3(u, u) > 0)) {
        return;
    }
    koksma__unit3(u);
    float w[3] = {n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]};
    const float turn = koksma__dot3(w, triangle->along_v) < 0 ? -1.0f : 1.0f;
    koksma__texture(map->image, &map->mapping, h->u[i], h->v[i], 1, rgb);
    const float x = map->scale * (2 * rgb[0] - 1), y = map->scale * turn * (2 * rgb[1] - 1), z = 2 * rgb[2] - 1;
    for (int k = 0; k < 3; k++) {
        bent[k] = side * (x * u[k] + y * w[k] + z * n[k]);
    }
    const float square = koksma__dot3(bent, bent);
    if (square > 1e-12f && koksma__dot3(bent, out) > 0.01f * sqrtf(square)) {
        koksma__unit3(bent);
        h->n[0][i] = bent[0];
        h->n[1][i] = bent[1];
        h->n[2][i] = bent[2];
    }
}

/* Applies the textures of the material and the colours of mesh vertices to lane i. */
static void add_texture(const koksma__frame *frame, koksma__vertices *v, int i)
{
    koksma__hits *h = &v->hits;
    const koksma__shading_material *m = &frame->shading_materials[h->material[i]];
    const koksma__map *surface = &m->from->maps[KOKSMA__MAP_SURFACE], *normal = &m->from->maps[KOKSMA__MAP_NORMAL];
    const size_t shape = (size_t)h->primitive[i];
    const double *half = shape < frame->scene->n_shapes ? frame->scene->shapes[shape].half : NULL;
    const float p[3] = {h->p[0][i], h->p[1][i], h->p[2][i]};
    const float at[2] = {half ? 0.5f * (h->u[i] / (float)half[0] + 1) : h->u[i],
                         half ? 0.5f * (h->v[i] / (float)half[1] + 1) : h->v[i]};
    const koksma__mapping whole = {.wrap = {KOKSMA__WRAP_CLAMP, KOKSMA__WRAP_CLAMP}};
    float albedo[3] = {(float)m->from->albedo[0][0], (float)m->from->albedo[0][1], (float)m->from->albedo[0][2]},
          factors[3] = {1, 1, 1}, local[KOKSMA__LOCAL];
    koksma__triangle triangle = {.colour = {1, 1, 1}};
    const bool found =
        !half && (m->from->tinted || normal->image) &&
        frame->geometry.triangle(&frame->geometry, h->primitive[i], p, v->paths->rays.time[i], &triangle);
    if (m->image) {
        koksma__texture(m->image, half ? &whole : &m->from->mapping, at[0], at[1], 1, albedo);
    }
    for (int k = 0; k < 3; k++) {
        albedo[k] *= triangle.colour[k];
    }
    if (m->bsdf->texture) {
        if (surface->image) {
            koksma__texture(surface->image, half ? &whole : &surface->mapping, at[0], at[1], 1, factors);
        }
        m->bsdf->texture(m, factors + 1, albedo, local);
        for (int k = 0; k < KOKSMA__LOCAL; k++) {
            v->surfaces.parameters[k][i] = local[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        v->surfaces.albedo[k][i] = albedo[k];
    }
    if (found && normal->image) {
        bend(normal, &triangle, v, i);
    }
}

/* Stores the albedo, normal and depth of the first hit for the layers. */
static void note_first(const koksma__frame *frame, koksma__values *values, const koksma__vertices *v, int i)
{
    const float near = (float)frame->scene->camera.near_clip;
    const koksma__hits *h = &v->hits;
    const koksma__rays *r = &v->paths->rays;
    const size_t sample = v->paths->sample[i];
    const bool hit = h->primitive[i] >= 0;
    const float n[3] = {h->n[0][i], h->n[1][i], h->n[2][i]}, d[3] = {r->d[0][i], r->d[1][i], r->d[2][i]};
    for (int k = 0; k < 3; k++) {
        values->albedo[3 * sample + (size_t)k] = v->surfaces.form[i] < 0 ? 0 : v->surfaces.albedo[k][i];
        values->normal[3 * sample + (size_t)k] = hit ? n[k] : 0;
    }
    values->depth[sample] = hit ? (h->t[i] + near) * sqrtf(koksma__dot3(d, d)) : 0;
}

/* ---- Going on --------------------------------------------------------------------------------------------- */

/* Follows both the reflected and the refracted direction at lane i, whose material has both. */
static koksma_status branch(const koksma__trace *trace, const koksma__vertices *v, int i)
{
    const koksma__surface s = koksma__surface_at(&v->surfaces, i);
    koksma__scatter directions[2];
    s.material->bsdf->split(&s, &directions[0], &directions[1]);
    for (int b = 0; b < 2; b++) {
        float beta[3];
        for (int k = 0; k < 3; k++) {
            beta[k] = v->paths->beta[k][i] * directions[b].weight[k];
        }
        if (!(koksma__max3(beta) > 0.001f)) {
            continue;
        }
        KOKSMA__TRY(koksma__wavefront_reserve(trace->next));
        koksma__paths *to = &trace->next->blocks[trace->next->n / KOKSMA__BLOCK];
        const size_t at = trace->next->n++ % KOKSMA__BLOCK;
        for (int k = 0; k < 3; k++) {
            to->rays.o[k][at] = s.p[k];
            to->rays.d[k][at] = directions[b].w[k];
            to->n[k][at] = s.n[k];
            to->beta[k][at] = beta[k];
        }
        to->rays.time[at] = v->paths->rays.time[i];
        to->pdf[at] = 0;
        to->from[at] = s.primitive;
        to->sample[at] = v->paths->sample[i];
    }
    return KOKSMA_OK;
}

/* Returns the lobes along which paths continue from this vertex. Specular lobes have no ray past the depth limit,
   because that ray replaces light samples, which specular lobes do not reflect. */
static unsigned followed_at(const koksma__trace *trace)
{
    const koksma__frame *frame = trace->frame;
    return trace->bounce < frame->depth ? frame->flags->followed
           : trace->bounce > frame->depth || frame->flags->weight != KOKSMA__WEIGHT_ZERO
               ? 0
               : frame->flags->followed & ~(unsigned)KOKSMA__LOBE_SPECULAR;
}

/* Draws the random numbers for the directions: (u[0], u[1]) for the direction, and u[2] for the choice of a lobe. */
static koksma_status draw_directions(const koksma__trace *trace, const koksma__vertices *v, koksma__lanes u[3])
{
    const unsigned lobes = koksma__lobes_of(&v->surfaces) & followed_at(trace);
    memset(u, 0, 3 * sizeof *u);
    if (lobes & ~(unsigned)KOKSMA__LOBE_SPECULAR) {
        KOKSMA__TRY(koksma__wavefront_pairs(trace, KOKSMA__USE_LOBE, v, u[0], u[1]));
    }
    if (v->surfaces.traits & KOKSMA__TAKES_CHOICE) {
        KOKSMA__TRY(koksma__wavefront_pairs(trace, KOKSMA__USE_LOBE_CHOICE, v, u[2], NULL));
    }
    return KOKSMA_OK;
}

/* From the fifth vertex on, Russian roulette ends some paths with weights below 1 and increases the weights of the
   survivors. A path with a weight of 1 or more continues, because ending it would only add variance. */
static koksma_status scatter(const koksma__trace *trace, koksma__vertices *v)
{
    const koksma__integrator_flags *flags = trace->frame->flags;
    const koksma__batch_table *batch = trace->frame->batch;
    koksma__queue *queue = trace->next;
    koksma__directions to;
    _Alignas(64) koksma__lanes u[3];
    const unsigned followed = followed_at(trace);
    if (!(followed & koksma__lobes_of(&v->surfaces))) {
        return KOKSMA_OK;
    }
    for (int i = 0; flags->branches && i < v->n; i++) {
        if (v->surfaces.form[i] >= 0 && trace->frame->shading_materials[v->hits.material[i]].bsdf->split) {
            KOKSMA__TRY(branch(trace, v, i));
            v->surfaces.form[i] = KOKSMA__UNLIT;
        }
    }
    KOKSMA__TRY(draw_directions(trace, v, u));
    batch->scatter(&v->surfaces, followed, u, v->whole, &to);
    if (batch->weigh(v->paths, v->whole, &to) && flags->roulette && trace->bounce >= 4) {
        KOKSMA__TRY(koksma__wavefront_pairs(trace, KOKSMA__USE_ROULETTE, v, u[0], NULL));
        batch->roulette(u[0], v->whole, &to);
    }
    KOKSMA__TRY(koksma__wavefront_reserve(queue));
    queue->n += (size_t)batch->close_up(v, &to, &queue->blocks[queue->n / KOKSMA__BLOCK], queue->n % KOKSMA__BLOCK);
    return KOKSMA_OK;
}

/* ---- One block -------------------------------------------------------------------------------------------- */

static void add_ambient(const koksma__frame *frame, koksma__vertices *v)
{
    for (int i = 0; frame->flags->ambient && i < v->n; i++) {
        float light[3];
        for (int k = 0; k < 3; k++) {
            light[k] = (float)frame->scene->ambient[k] * v->surfaces.albedo[k][i];
        }
        if (v->surfaces.form[i] >= 0) {
            add_scaled(v, i, light, 1);
        }
    }
}

/* Fills the unused lanes of all arrays with copies of the last path. */
static void fill_lanes(koksma__paths *p, int n, int whole)
{
    for (size_t at = 0; at < sizeof *p; at += sizeof p->pdf) {
        char *lanes = (char *)p + at;
        for (int i = n; i < whole; i++) {
            memcpy(lanes + sizeof(float) * (size_t)i, lanes + sizeof(float) * (size_t)(n - 1), sizeof(float));
        }
    }
}

/* Samples the medium along the rays, whose hits are known: a distance along each, which either reaches the surface that the
   ray hits, or is scattered before. Hits become points of the medium, surfaces whose material is the phase function, so
   that lights and directions are sampled there as on surfaces; their normal is 0, and their primitive is 0 until
   detach(). */
static koksma_status travel(const koksma__trace *trace, koksma__paths *paths, koksma__vertices *v)
{
    const koksma_scene *scene = trace->frame->scene;
    _Alignas(64) koksma__lanes u;
    if (scene->medium.is_there) {
        KOKSMA__TRY(koksma__wavefront_pairs(trace, KOKSMA__USE_DISTANCE, v, u, NULL));
        trace->frame->batch->travel(&scene->medium, u, (int32_t)scene->n_materials, v->whole, paths, &v->hits);
    }
    return KOKSMA_OK;
}

/* Sets the primitive of points in the medium to -1, because rays from there do not start on a primitive. */
static void detach(const koksma_scene *scene, koksma__vertices *v)
{
    for (int i = 0; scene->medium.is_there && i < v->n; i++) {
        v->hits.primitive[i] = v->hits.material[i] == (int32_t)scene->n_materials ? -1 : v->hits.primitive[i];
    }
}

static koksma_status trace_block(const koksma__trace *trace, koksma__paths *paths, int n, koksma__values *values)
{
    static const float black[3] = {0, 0, 0};
    const koksma__frame *frame = trace->frame;
    koksma__vertices *v = trace->scratch->vertices;
    koksma__hits *hits = &v->hits;
    v->paths = paths;
    v->n = n;
    v->whole = (int)koksma__whole_lanes((size_t)n);
    v->moves = frame->scene->moves;
    v->chooses = frame->light_selection != KOKSMA_LIGHTS_ALL;
    v->surfaces.hits = hits;
    v->surfaces.materials = frame->shading_materials;
    v->surfaces.table = &frame->lane_materials;
    fill_lanes(paths, n, v->whole);
    if (trace->bounce) {
        frame->geometry.closest(&frame->geometry, &paths->rays, paths->from, v->whole, hits);
    } else {
        meet_first(frame, paths, v->whole, hits);
    }
    KOKSMA__TRY(travel(trace, paths, v));
    if (frame->scene->moves) {
        memcpy(hits->time, paths->rays.time, sizeof hits->time);
    }
    values->rays += (uint64_t)n;
    frame->batch->surfaces(&paths->rays, n, v->whole, &v->surfaces);
    frame->batch->background(trace->bounce > frame->depth ? black : frame->background, v);
    for (int i = 0; v->surfaces.traits & KOKSMA__HAS_IMAGE && i < n; i++) {
        if (v->surfaces.form[i] >= 0 && koksma__is_textured(&frame->shading_materials[hits->material[i]])) {
            add_texture(frame, v, i);
        }
    }
    if (trace->bounce || !frame->scene->hides_lights) {
        add_misses(frame, v);
    }
    for (int i = 0; (v->surfaces.met_lights || v->surfaces.traits & KOKSMA__GLOWS) && i < n; i++) {
        if ((v->surfaces.form[i] < 0) & (hits->primitive[i] >= 0)) {
            add_emission(frame, v, i);
        } else if (v->surfaces.trait[i] & KOKSMA__GLOWS) {
            add_glow(frame, v, i);
        }
    }
    for (int i = 0; values->albedo && !trace->bounce && i < n; i++) {
        note_first(frame, values, v, i);
    }
    detach(frame->scene, v);
    add_ambient(frame, v);
    KOKSMA__TRY(koksma__wavefront_light(trace, v, values));
    KOKSMA__TRY(scatter(trace, v));
    for (int i = 0; i < n; i++) {
        float *sum = trace->scratch->sums + 3 * (size_t)paths->sample[i];
        sum[0] += v->light[0][i];
        sum[1] += v->light[1][i];
        sum[2] += v->light[2][i];
    }
    return KOKSMA_OK;
}

/* ---- One group -------------------------------------------------------------------------------------------- */

/* A NaN stays a NaN, because it is not above `clamp`. */
static float clamped(float value, float clamp)
{
    return value > clamp ? clamp : value;
}

static void hand_over(const koksma__frame *frame, const float *restrict sums, size_t n, float *restrict rgb)
{
    const float clamp = (float)frame->scene->clamp;
    for (size_t i = 0; frame->channels == 3 && i < 3 * n; i++) {
        rgb[i] = clamped(sums[i], clamp);
    }
    for (size_t i = 0; frame->channels == 1 && i < n; i++) {
        rgb[i] = clamped(sums[3 * i], clamp);
    }
}

/* Marks the pixels of the group that have a path left. */
static void mark_alive(const koksma__group *group, koksma__wavefront_scratch *scratch, const koksma__queue *queue)
{
    memset(scratch->is_alive, group->count == 1, sizeof scratch->is_alive);
    for (size_t i = 0; group->count > 1 && i < queue->n; i++) {
        scratch->is_alive[scratch->pixel_of[queue->blocks[i / KOKSMA__BLOCK].sample[i % KOKSMA__BLOCK]]] = true;
    }
}

/* Traces samples first .. end - 1 of the group through all their bounces. */
static koksma_status trace_samples(koksma__trace *trace, size_t first, size_t end, koksma__values *values)
{
    koksma__wavefront_scratch *scratch = trace->scratch;
    scratch->queues[0].n = 0;
    trace->bounce = 0;
    koksma_status status = start_paths(trace, values, first, end);
    for (int now = 0; !status && scratch->queues[now].n; now = 1 - now) {
        const koksma__queue *queue = &scratch->queues[now];
        trace->next = &scratch->queues[1 - now];
        trace->next->n = 0;
        mark_alive(trace->group, scratch, queue);
        for (size_t start = 0; !status && start < queue->n; start += KOKSMA__BLOCK) {
            const size_t left = queue->n - start;
            const int n = left < KOKSMA__BLOCK ? (int)left : KOKSMA__BLOCK;
            status = trace_block(trace, &queue->blocks[start / KOKSMA__BLOCK], n, values);
        }
        trace->bounce++;
    }
    return status;
}

static koksma_status trace_group(const koksma__frame *frame, void *opened, const koksma__group *group,
                                 koksma__values *values)
{
    koksma__wavefront_scratch *scratch = opened;
    koksma__trace trace = {.frame = frame, .scratch = scratch, .group = group};
    const size_t n = group->start[group->count];
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < scratch->n_drawn; i++) {
        scratch->drawn[i].done = false;
    }
    memset(scratch->sums, 0, 3 * n * sizeof *scratch->sums);
    for (size_t p = 0; group->count > 1 && p < group->count; p++) {
        memset(scratch->pixel_of + group->start[p], (int)p, group->start[p + 1] - group->start[p]);
    }
    /* the lens and time samples are drawn for all pixels */
    memset(scratch->is_alive, true, sizeof scratch->is_alive);
    for (size_t first = 0; !status && first < n; first += TOGETHER) {
        status = trace_samples(&trace, first, n - first < TOGETHER ? n : first + TOGETHER, values);
    }
    hand_over(frame, scratch->sums, n, values->rgb);
    return status;
}

static bool takes(const koksma__frame *frame)
{
    (void)frame;
    return true;
}

const koksma__pipeline koksma__pipeline_wavefront = {
    .name = "wavefront",
    .title = "all scenes and options; traces blocks of paths, one vertex at a time",
    .takes = takes,
    .together = TOGETHER,
    .open = koksma__wavefront_open,
    .close = koksma__wavefront_close,
    .trace = trace_group};
