/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The wavefront path tracer: any scene by any integrator (Laine, Karras & Aila 2013 have the idea for GPUs). It
 * estimates, for each sample of the film, the rendering equation (Kajiya 1986)
 *
 *     L(x, out) = E(x, out) + integral of f(w, out) L(y, -w) cos dw,        y: what the ray from x along w meets
 *
 * by paths. A path is a ray with the weight beta that its light has for the sample: the product of f cos / pdf of all
 * directions so far. Instead of following one path to its end, all paths of a group take one step together, so that
 * rays are intersected in blocks of 64 lanes (batch.h) and shadow rays too:
 *
 *     queue of paths, bounce b
 *       | closest          64 rays at once: which primitive, where, which normal
 *       | emission         a ray that meets a light, or misses all, adds its light:    sum += beta L m
 *       | lights           at each vertex one sample of each light, or of a chosen one; 64 shadow rays at once
 *       | scatter          each vertex draws a direction (or both of glass) from its material
 *     queue of paths, bounce b + 1
 *
 * Two queues take turns until one is empty. Paths only end or branch, and their order never depends on threads, so a
 * sample's light is summed in the order of its vertices and bits are equal for any number of threads.
 *
 * Light that both steps could find, by sampling the light and by a reflected ray that meets it, is shared by the
 * power heuristic (Veach 1997, section 9.2): each is weighed by m = p^2 / (p^2 + q^2), with p the density by which it
 * was found and q that of the other way; the two m of one direction add to 1. A path carries the density of its last
 * direction for this (0 after a mirror, whose light no sampling finds: m = 1).
 *
 * What is random comes from uses (samples/uses.def): lobe, lobe choice, lights and roulette of vertex b have keys of
 * their own, so that the patterns under study, not the tracer, decide how vertices are stratified.
 */
#include "render/pipelines/wavefront.h"

#include <math.h>
#include <string.h>

#include <koksma/image.h>

#include "core/status.h"
#include "render/pipelines/pipelines.h"
#include "render/vector3.h"

/* ---- Textures ------------------------------------------------------------------------------------------- */

/*
 * Colours of an image at texture coordinates: bilinear between the four nearest pixels, whose centres are at half
 * numbers; repeated or, beyond the edge, the edge's own.
 */

/* x - 0.5 as a pixel, the one after it (both round the edge, or held at it), and the weight of the second. */
static float split(float x, int n, bool repeated, size_t pair[2])
{
    const float turns = repeated ? x - floorf(x)
                        : x > 0  ? fminf(x, 1)
                                 : 0,
                place = turns * (float)n - 0.5f, down = floorf(place);
    const int first = (int)down;
    pair[0] = (size_t)(repeated ? (first + n) % n : first < 0 ? 0 : first < n ? first : n - 1);
    pair[1] = (size_t)(repeated ? (first + 1 + n) % n : first + 1 < n ? first + 1 : n - 1);
    return place - down;
}

/* An image over the plane, repeated or ending at its edges: (0, 0) is the lower left corner of its lower left pixel,
   (1, 1) the upper right corner; bilinear between the middles of pixels. rgb: within [0, 1]. */
static void texture(const koksma_image *image, float u, float v, bool repeated, float rgb[3])
{
    size_t xs[2], ys[2];
    const size_t channels = (size_t)image->channels, width = (size_t)image->width;
    const float x = split(u, image->width, repeated, xs), y = split(1 - v, image->height, repeated, ys);
    const float weights[4] = {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    for (size_t k = 0; k < 3; k++) {
        rgb[k] = 0;
        for (size_t i = 0; i < 4; i++) {
            const float value = image->pixels[(ys[i / 2] * width + xs[i % 2]) * channels + k % channels];
            rgb[k] += value > 0 ? weights[i] * (value < 1 ? value : 1) : 0; /* a NaN is dark */
        }
    }
}

enum { TOGETHER = 1024 }; /* samples that are followed together: bounds the queues, which branching makes long */

/* ---- The camera ------------------------------------------------------------------------------------------- */

static void aim(const koksma__frame *frame, const float film[2], const float lens[2], float time, koksma__path *path)
{
    const koksma__batch_camera *c = &frame->camera;
    const koksma__camera *camera = &frame->scene->camera;
    double offset[2] = {0, 0};
    if (lens) {
        const double square[2] = {(double)lens[0], (double)lens[1]};
        camera->lens_map->map(square, offset);
    }
    const float radius = (float)camera->lens_radius, focus = (float)camera->focus_distance;
    for (int k = 0; k < 3; k++) {
        const float d = c->base[k] + film[0] * c->step_x[k] + film[1] * c->step_y[k];
        const float shift =
            radius * ((float)offset[0] * (float)camera->right[k] + (float)offset[1] * (float)camera->down[k]);
        path->o[k] = c->eye[k] + time * (float)camera->motion[k] + shift;
        path->d[k] = lens ? d - shift / focus : d;
        path->beta[k] = 1;
    }
    path->time = time;
}

static koksma_status start_paths(const koksma__trace *trace, const koksma__values *values, size_t first, size_t end)
{
    const koksma__frame *frame = trace->frame;
    const koksma__camera *camera = &frame->scene->camera;
    const float *lens = NULL, *times = NULL;
    koksma_status status = KOKSMA_OK;
    if (camera->lens_radius > 0) {
        status = koksma__wavefront_draw(trace, KOKSMA__USE_LENS, &lens);
    }
    if (!status && frame->scene->moves) {
        status = koksma__wavefront_draw(trace, KOKSMA__USE_TIME, &times);
    }
    const float open = (float)camera->shutter[0], interval = (float)(camera->shutter[1] - camera->shutter[0]);
    for (size_t i = first; !status && i < end; i++) {
        koksma__path path = {.from = -1, .sample = (uint32_t)i};
        aim(frame, values->film + 2 * i, lens ? lens + 2 * i : NULL, times ? open + interval * times[2 * i] : open,
            &path);
        status = koksma__wavefront_push(&trace->scratch->queues[0], &path);
    }
    return status;
}

/* ---- What rays meet ------------------------------------------------------------------------------------- */

static void gather(const koksma__path *paths, int n, int whole, koksma__rays *rays, int32_t *from)
{
    for (int i = 0; i < whole; i++) {
        const koksma__path *p = &paths[i < n ? i : n - 1];
        rays->ox[i] = p->o[0];
        rays->oy[i] = p->o[1];
        rays->oz[i] = p->o[2];
        rays->dx[i] = p->d[0];
        rays->dy[i] = p->d[1];
        rays->dz[i] = p->d[2];
        rays->time[i] = p->time;
        from[i] = p->from;
    }
}

/* The part of the light that counts for a ray which met a light by its own direction: the power heuristic against
   sampling that light. */
static float met_weight(const koksma__frame *frame, const koksma__path *path, size_t light, const float w[3], float t,
                        const float n[3])
{
    if (!(path->pdf > 0)) {
        return path->pdf < 0 ? 0 : 1; /* 1: from the eye or a mirror, no other way to see it */
    }
    const koksma__shading_light *l = &frame->lights.lights[light];
    const float pdf = l->kind->pdf ? l->kind->pdf(l, path->o, w, t, n) : 0;
    const float sampled = pdf * koksma__light_probability(frame, path->o, path->n, (int)light);
    return path->pdf * path->pdf / (path->pdf * path->pdf + sampled * sampled);
}

static void add_scaled(const float beta[3], const float value[3], float scale, float *sum)
{
    for (int k = 0; k < 3; k++) {
        sum[k] += beta[k] * value[k] * scale;
    }
}

static void add_miss(const koksma__frame *frame, const koksma__path *path, float *sum)
{
    const float background[3] = {(float)frame->scene->background[0], (float)frame->scene->background[1],
                                 (float)frame->scene->background[2]};
    const koksma__lights *lights = &frame->lights;
    add_scaled(path->beta, background, 1, sum);
    for (size_t i = lights->first_around; i < lights->n; i++) {
        const koksma__shading_light *l = &lights->lights[i];
        if (l->kind->radiance && l->visible) {
            float w[3] = {path->d[0], path->d[1], path->d[2]}, radiance[3];
            koksma__unit3(w);
            l->kind->radiance(l, w, radiance);
            add_scaled(path->beta, radiance, met_weight(frame, path, i, w, 0, w), sum);
        }
    }
}

static void add_emission(const koksma__frame *frame, const koksma__path *path, const koksma__hits *hits, int i,
                         float *sum)
{
    const size_t light = (size_t)frame->geometry.light(&frame->geometry, hits->primitive[i]);
    if (!hits->back[i]) {
        float w[3] = {path->d[0], path->d[1], path->d[2]};
        const float n[3] = {hits->nx[i], hits->ny[i], hits->nz[i]};
        const float length = sqrtf(koksma__dot3(w, w));
        koksma__unit3(w);
        add_scaled(path->beta, frame->lights.lights[light].radiance,
                   met_weight(frame, path, light, w, hits->t[i] * length, n), sum);
    }
}

static void set_surface(const koksma__frame *frame, const koksma__path *path, const koksma__hits *h, int i,
                        koksma__surface *s)
{
    const koksma__shading_material *material = &frame->shading_materials[h->material[i]];
    const koksma__batch_material *m = &frame->materials[h->material[i]];
    int which = 0;
    if (m->checker) {
        const float u = h->u[i], v = h->v[i];
        const float half = 0.5f * (floorf(m->su * u + m->sv * v + m->s0) + floorf(m->tu * u + m->tv * v + m->t0));
        which = half != floorf(half);
    }
    *s = (koksma__surface){.material = material,
                           .p = {h->px[i], h->py[i], h->pz[i]},
                           .n = {h->nx[i], h->ny[i], h->nz[i]},
                           .out = {-path->d[0], -path->d[1], -path->d[2]},
                           .inside = h->back[i] != 0,
                           .primitive = h->primitive[i]};
    koksma__unit3(s->out);
    memcpy(s->albedo, material->albedo[which], sizeof s->albedo);
    if (material->image) {
        const size_t shape = (size_t)h->primitive[i];
        const double *half = shape < frame->scene->n_shapes ? frame->scene->shapes[shape].half : NULL;
        texture(material->image, half ? 0.5f * (h->u[i] / (float)half[0] + 1) : h->u[i],
                half ? 0.5f * (h->v[i] / (float)half[1] + 1) : h->v[i], !half, s->albedo);
    }
}

/* What the eye sees first, for the layers. */
static void note_first(koksma__values *values, size_t sample, const koksma__path *path, const koksma__hits *h, int i,
                       const koksma__surface *s)
{
    static const float none[3] = {0, 0, 0};
    const float n[3] = {h->nx[i], h->ny[i], h->nz[i]};
    const bool hit = h->primitive[i] >= 0;
    memcpy(values->albedo + 3 * sample, s ? s->albedo : none, sizeof none);
    memcpy(values->normal + 3 * sample, hit ? n : none, sizeof none);
    values->depth[sample] = hit ? h->t[i] * sqrtf(koksma__dot3(path->d, path->d)) : 0;
}

/* ---- Going on --------------------------------------------------------------------------------------------- */

/* Paths that start on a diffuse surface (of a record of the irradiance cache) see no lights in mirrors. */
static koksma_status go_on(const koksma__trace *trace, const koksma__path *path, const koksma__surface *s,
                           const koksma__scatter *chosen, float scale)
{
    const float pdf = trace->first > 0 && !(chosen->pdf > 0) ? -1 : chosen->pdf;
    koksma__path next = {.pdf = pdf, .time = path->time, .from = s->primitive, .sample = path->sample};
    for (int k = 0; k < 3; k++) {
        next.o[k] = s->p[k];
        next.d[k] = chosen->w[k];
        next.n[k] = s->n[k];
        next.beta[k] = path->beta[k] * chosen->weight[k] * scale;
    }
    return koksma__max3(next.beta) > 0 ? koksma__wavefront_push(trace->next, &next) : KOKSMA_OK;
}

static koksma_status branch(const koksma__trace *trace, const koksma__path *path, const koksma__surface *s,
                            const koksma__scatter directions[2])
{
    koksma_status status = KOKSMA_OK;
    for (int i = 0; !status && i < 2; i++) {
        if (koksma__max3(path->beta) * koksma__max3(directions[i].weight) > 0.001f) {
            status = go_on(trace, path, s, &directions[i], 1);
        }
    }
    return status;
}

static koksma_status scatter(const koksma__trace *trace, const koksma__path *path, const koksma__surface *s)
{
    const koksma__integrator_flags *flags = trace->frame->flags;
    const unsigned lobes = flags->followed & s->material->bsdf->lobes;
    const uint32_t base = (uint32_t)trace->bounce * KOKSMA__USES_A_BOUNCE;
    const float *us, *choices, *ends;
    koksma__scatter directions[2];
    if (!lobes || trace->bounce >= trace->frame->depth) {
        return KOKSMA_OK;
    }
    if (flags->branches && s->material->bsdf->split) {
        s->material->bsdf->split(s, &directions[0], &directions[1]);
        return branch(trace, path, s, directions);
    }
    koksma_status status = koksma__wavefront_draw(trace, base + KOKSMA__USE_LOBE, &us);
    status = status ? status : koksma__wavefront_draw(trace, base + KOKSMA__USE_LOBE_CHOICE, &choices);
    if (status ||
        !s->material->bsdf->sample(s, lobes, us + 2 * path->sample, choices[2 * path->sample], &directions[0])) {
        return status;
    }
    float survival_probability = 1;
    if (flags->roulette && trace->bounce >= 4) {
        float beta[3];
        for (int k = 0; k < 3; k++) {
            beta[k] = path->beta[k] * directions[0].weight[k];
        }
        const float weight = koksma__max3(beta);
        if (weight < 1) { /* a path that has lost nothing goes on: ending it would only add variance */
            survival_probability = weight;
            status = koksma__wavefront_draw(trace, base + KOKSMA__USE_ROULETTE, &ends);
            if (status || !(ends[2 * path->sample] < survival_probability)) {
                return status;
            }
        }
    }
    return go_on(trace, path, s, &directions[0], 1 / survival_probability);
}

/* ---- One block -------------------------------------------------------------------------------------------- */

static koksma_status add_local(const koksma__frame *frame, const koksma__path *path, const koksma__surface *s,
                               float *sum)
{
    float light[3] = {0, 0, 0};
    koksma_status status = KOKSMA_OK;
    if (frame->flags->ambient) {
        for (int k = 0; k < 3; k++) {
            light[k] = (float)frame->scene->ambient[k];
        }
    }
    if (frame->flags->indirect && s->material->bsdf->lobes & KOKSMA__LOBE_DIFFUSE) {
        status = frame->flags->indirect(frame, s, path->time, light);
    }
    for (int k = 0; k < 3; k++) {
        light[k] *= s->albedo[k];
    }
    add_scaled(path->beta, light, 1, sum);
    return status;
}

static koksma_status trace_block(const koksma__trace *trace, const koksma__path *paths, int n, koksma__values *values)
{
    const koksma__frame *frame = trace->frame;
    const int whole = (int)koksma__whole_lanes((size_t)n);
    koksma__rays rays;
    koksma__hits hits;
    koksma__vertices v = {.paths = paths, .hits = &hits, .n = n, .whole = whole};
    KOKSMA__LANES(int32_t, from);
    gather(paths, n, whole, &rays, from);
    frame->geometry.closest(&frame->geometry, &rays, paths->from >= 0 || trace->bounce ? from : NULL, whole, &hits);
    memcpy(hits.time, rays.time, sizeof hits.time);
    values->rays += (uint64_t)n;
    for (int i = 0; i < n; i++) {
        const koksma__path *path = &paths[i];
        float *sum = trace->scratch->sums + 3 * path->sample;
        v.lit[i] = hits.primitive[i] >= 0 && hits.material[i] >= 0;
        if (v.lit[i]) {
            set_surface(frame, path, &hits, i, &v.surfaces[i]);
            KOKSMA__TRY(add_local(frame, path, &v.surfaces[i], sum));
        } else if (hits.primitive[i] >= 0) {
            add_emission(frame, path, &hits, i, sum);
        } else {
            add_miss(frame, path, sum);
        }
        if (values->albedo && trace->bounce == trace->first) {
            note_first(values, path->sample, path, &hits, i, v.lit[i] ? &v.surfaces[i] : NULL);
        }
    }
    koksma_status status = koksma__wavefront_light(trace, &v, values);
    for (int i = 0; !status && i < n; i++) {
        if (v.lit[i]) {
            status = scatter(trace, &paths[i], &v.surfaces[i]);
        }
    }
    return status;
}

/* ---- One group -------------------------------------------------------------------------------------------- */

static void hand_over(const koksma__frame *frame, const float *sums, size_t n, koksma__values *values)
{
    const float clamp = (float)frame->scene->clamp;
    for (size_t i = 0; i < n; i++) {
        for (int k = 0; k < frame->channels; k++) {
            const float value = sums[3 * i + (size_t)k]; /* what is no number stays none */
            values->rgb[i * (size_t)frame->channels + (size_t)k] = value > clamp ? clamp : value;
        }
    }
}

koksma_status koksma__wavefront_follow(koksma__trace *trace, koksma__values *values)
{
    koksma__wavefront_scratch *scratch = trace->scratch;
    koksma_status status = KOKSMA_OK;
    trace->first = trace->bounce;
    for (int now = 0; !status && scratch->queues[now].n; now = 1 - now) {
        const koksma__queue *queue = &scratch->queues[now];
        trace->next = &scratch->queues[1 - now];
        trace->next->n = 0;
        for (size_t start = 0; !status && start < queue->n; start += KOKSMA__BLOCK) {
            const size_t left = queue->n - start;
            const int n = left < KOKSMA__BLOCK ? (int)left : KOKSMA__BLOCK;
            status = trace_block(trace, queue->paths + start, n, values);
        }
        trace->bounce++;
    }
    return status;
}

/* Samples first .. end - 1 of the group, through all their bounces. */
static koksma_status trace_samples(koksma__trace *trace, size_t first, size_t end, koksma__values *values)
{
    trace->scratch->queues[0].n = 0;
    trace->bounce = 0;
    const koksma_status status = start_paths(trace, values, first, end);
    return status ? status : koksma__wavefront_follow(trace, values);
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
    for (size_t first = 0; !status && first < n; first += TOGETHER) {
        status = trace_samples(&trace, first, n - first < TOGETHER ? n : first + TOGETHER, values);
    }
    hand_over(frame, scratch->sums, n, values);
    return status;
}

static bool takes(const koksma__frame *frame)
{
    (void)frame;
    return true;
}

const koksma__pipeline koksma__pipeline_wavefront = {
    .name = "wavefront",
    .title = "every scene and option: blocks of paths, one vertex at a time",
    .takes = takes,
    .open = koksma__wavefront_open,
    .close = koksma__wavefront_close,
    .trace = trace_group};
