/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A fast pipeline for direct light on grey Lambert surfaces from rectangular lights that no ray can see, through a
 * pinhole camera, entirely in SIMD lanes (Cook, Porter & Carpenter 1984). The value of a sample is
 *
 *     background                                                             where the ray hits nothing,
 *     min(clamp, albedo (ambient + sum over lights of their light))          elsewhere,
 *
 * Each sample takes one shadow ray per light. The pipeline of wavefront.c gives the same values for such scenes up to
 * rounding, but takes several times as long.
 */
#include <math.h>
#include <stdlib.h>

#include "core/capacity.h"
#include "core/status.h"
#include "render/one_image.h"
#include "render/pipelines/pipelines.h"
#include "render/samples/samples.h"

typedef struct scratch {
    koksma__sample_scratch draw;
    float *positions; /* sampled positions on lights, one array per light */
    size_t capacity;
    /* The shapes that pixels first .. end - 1 may see (`shapes`, copied to `list`), their indices (`seen`), and, for
       each light, the shapes that may block shadow rays to it from what these pixels see. */
    koksma__batch_shapes shapes, *blockers;
    koksma__batch_shape *list;
    size_t *seen, first, end, mixed; /* `mixed` is the end of the last tile that was found to see several shapes */
} scratch;

/* Which shapes may be seen is decided for tiles of this many pixels of a row. */
enum { TILE = 16 };

static bool takes(const koksma__frame *frame)
{
    const koksma_scene *scene = frame->scene;
    bool can = scene->grey && !scene->moves && !(scene->camera.lens_radius > 0) && !(scene->camera.height > 0) &&
               !(scene->camera.near_clip > 0) && !(scene->camera.far_clip > 0) && !scene->hides_lights &&
               frame->flags->areas && frame->flags->ambient && frame->light_selection == KOKSMA_LIGHTS_ALL;
    for (size_t i = 0; can && i < scene->n_lights; i++) {
        can = scene->lights[i].kind->lanes && !scene->lights[i].visible;
    }
    for (size_t i = 0; can && i < scene->n_materials; i++) {
        can = scene->materials[i].bsdf->is_lambert && !scene->materials[i].image;
    }
    return can;
}

static void close_scratch(void *opened)
{
    scratch *r = opened;
    if (r) {
        koksma__sample_scratch_fini(&r->draw);
        KOKSMA__FREE(r->positions, r->list, r->blockers, r->seen, r);
    }
}

static koksma_status open_scratch(const koksma__frame *frame, size_t capacity, void **out)
{
    scratch *r = calloc(1, sizeof *r);
    *out = r;
    KOKSMA__REQUIRE_MEMORY(r, sizeof *r);
    r->capacity = capacity;
    r->positions = malloc(2 * capacity * (frame->lights.n + 1) * sizeof *r->positions);
    koksma_status status = koksma__sample_scratch_init(&r->draw, &frame->sampler);
    if (!status && !r->positions) {
        status = koksma__fail_memory(2 * capacity * (frame->lights.n + 1) * sizeof *r->positions);
    }
    if (!status && frame->frustum_cull) {
        const size_t n = frame->geometry.shapes->n + 1, lights = frame->lights.n;
        r->list = malloc(n * (lights + 1) * sizeof *r->list);
        r->seen = malloc(n * sizeof *r->seen);
        r->blockers = malloc((lights + 1) * sizeof *r->blockers);
        status =
            r->list && r->seen && r->blockers ? KOKSMA_OK : koksma__fail_memory(n * (lights + 1) * sizeof *r->list);
    }
    if (status) {
        close_scratch(r);
        *out = NULL;
    }
    return status;
}

/* ---- What a group sees ------------------------------------------------------------------------------------ */

/* Finds, for each light, the shapes that may block rays to it from shape i, which is the only shape in sight. */
static void find_blockers(const koksma__frame *f, scratch *r, size_t i, const double x[2], const double y[2])
{
    const koksma__batch_shapes *all = f->geometry.occluders;
    koksma__batch_shape *list = r->list + f->geometry.shapes->n;
    koksma__footprint part;
    const bool bounded = koksma__frustum_cull_footprint(f->frustum_cull, i, x, y, &part);
    for (size_t l = 0; l < f->lights.n; l++, list += f->geometry.shapes->n) {
        r->blockers[l] = (koksma__batch_shapes){.shapes = list};
        for (size_t k = 0; k < all->n; k++) {
            const koksma__batch_shape *s = &all->shapes[k];
            const bool own = (size_t)s->id == i;
            if (own ? !s->is_flat : !bounded || !koksma__shadow_cull_clear(&part, &f->lights.rectangles[l], s)) {
                list[r->blockers[l].n++] = *s;
            }
        }
    }
}

/* Finds the shapes that pixels first .. end - 1 may see, including the margin by which the filter moves samples. */
static void look_at(const koksma__frame *f, scratch *r, size_t first, size_t end)
{
    const double reach = f->filter && !f->options->splat ? f->options->filter->radius : 0;
    const size_t width = (size_t)f->options->width, last = end - 1;
    const size_t row = first / width, end_row = last / width + 1;
    const size_t column = row + 1 == end_row ? first % width : 0;
    const size_t end_column = row + 1 == end_row ? last % width + 1 : width;
    const double x[2] = {(double)column - reach, (double)end_column + reach};
    const double y[2] = {(double)row - reach, (double)end_row + reach};
    r->shapes =
        (koksma__batch_shapes){.n = koksma__frustum_cull_shapes(f->frustum_cull, x, y, r->seen), .shapes = r->list};
    for (size_t i = 0; i < r->shapes.n; i++) {
        r->list[i] = f->geometry.shapes->shapes[r->seen[i]];
    }
    r->first = first;
    r->end = end;
    if (r->shapes.n == 1) {
        find_blockers(f, r, r->seen[0], x, y);
    }
    for (size_t l = 0; r->shapes.n > 1 && l < f->lights.n; l++) {
        r->blockers[l] = *f->geometry.occluders;
    }
}

/* Finds the shapes that the tile which contains a group may see; if these are several, finds only those that the
   group may see. */
static void look(const koksma__frame *f, scratch *r, const koksma__group *group)
{
    const size_t first = group->first, end = first + group->count, width = (size_t)f->options->width;
    const size_t column = first % width / TILE * TILE, tile = first - first % width + column;
    const size_t end_tile = tile + (width - column < TILE ? width - column : TILE);
    if (first >= r->first && end <= r->end) {
        return;
    }
    if (end <= end_tile && r->mixed != end_tile) {
        look_at(f, r, tile, end_tile);
        if (r->shapes.n < 2) {
            return;
        }
        r->mixed = end_tile;
    }
    look_at(f, r, first, end);
}

static float colour_of_nothing(const koksma__frame *f)
{
    const float background = (float)f->scene->background[0], clamp = (float)f->scene->clamp;
    return background < clamp ? background : clamp;
}

static bool is_empty(const koksma__frame *f, void *opened, const koksma__group *group, koksma__values *values)
{
    scratch *r = opened;
    if (!f->frustum_cull || f->filter || values->albedo) {
        return false;
    }
    look(f, r, group);
    values->rgb[0] = colour_of_nothing(f);
    return !r->shapes.n;
}

/* ---- Samples ------------------------------------------------------------------------------------------------ */

/* Draws the samples of all lights; called when the first ray of a group hits something. */
static koksma_status draw_lights(const koksma__frame *f, const koksma__group *group, scratch *r)
{
    koksma_status status = KOKSMA_OK;
    for (size_t l = 0; !status && l < f->lights.n; l++) {
        status = koksma__group_draw(f, group, KOKSMA__USE_LIGHT + (uint32_t)l, false, &r->draw,
                                    r->positions + 2 * l * r->capacity);
    }
    return status;
}

static void note_layers(const koksma__hits *hits, const koksma__rays *rays, const float *albedo, int n,
                        koksma__values *values, size_t start)
{
    for (int i = 0; i < n; i++) {
        const size_t s = start + (size_t)i;
        const bool hit = hits->primitive[i] >= 0;
        const float square =
            rays->d[0][i] * rays->d[0][i] + rays->d[1][i] * rays->d[1][i] + rays->d[2][i] * rays->d[2][i];
        values->albedo[3 * s] = values->albedo[3 * s + 1] = values->albedo[3 * s + 2] = hit ? albedo[i] : 0;
        values->normal[3 * s] = hit ? hits->n[0][i] : 0;
        values->normal[3 * s + 1] = hit ? hits->n[1][i] : 0;
        values->normal[3 * s + 2] = hit ? hits->n[2][i] : 0;
        values->depth[s] = hit ? hits->t[i] * sqrtf(square) : 0;
    }
}

/* Shades samples start .. start + n - 1 of the group, whose rays hit `hits`; the last `copies` of these samples
   only fill lanes, and their values are not used. */
static void shade_block(const koksma__frame *f, const koksma__rays *rays, const koksma__hits *hits, size_t start,
                        int n, int copies, const scratch *r, koksma__values *values)
{
    KOKSMA__LANES(float, albedo);
    KOKSMA__LANES(float, sum);
    koksma__shadows shadows;
    for (int i = 0; i < n; i++) {
        sum[i] = (float)f->scene->ambient[0];
    }
    shadows.aimed = NULL; /* these lights have no surfaces that could block shadow rays */
    f->batch->albedo(f->materials, hits, n, albedo);
    for (size_t l = 0; l < f->lights.n; l++) {
        const float *positions = r->positions + 2 * (l * r->capacity + start);
        const koksma__batch_light *light = &f->lights.rectangles[l];
        const bool clear = f->frustum_cull && !r->blockers[l].n;
        const int lit = clear ? f->batch->light(light, hits, positions, n, &shadows, sum)
                              : f->batch->aim(light, hits, positions, n, &shadows);
        if (lit) {
            values->rays += (uint64_t)(lit - (shadows.light[n - 1] != 0 ? copies : 0));
        }
        if (lit && !clear) {
            if (f->frustum_cull) {
                f->batch->occlude(&r->blockers[l], hits, n, &shadows);
            } else {
                f->geometry.occlude(&f->geometry, hits, n, &shadows);
            }
            f->batch->add(&shadows, n, sum);
        }
    }
    f->batch->shade(hits, albedo, sum, (float)f->scene->background[0], (float)f->scene->clamp, n,
                    values->rgb + start);
    if (values->albedo) {
        note_layers(hits, rays, albedo, n, values, start);
    }
}

static koksma_status trace(const koksma__frame *f, void *opened, const koksma__group *group, koksma__values *values)
{
    scratch *r = opened;
    const size_t n_samples = group->start[group->count], total = koksma__whole_lanes(n_samples);
    bool drawn = false;
    koksma__rays rays;
    koksma__hits hits;
    koksma_status status = KOKSMA_OK;
    values->rays += n_samples;
    if (f->frustum_cull) {
        look(f, r, group);
    }
    for (size_t start = 0; !status && start < total; start += KOKSMA__BLOCK) {
        const int n = (int)(total - start < KOKSMA__BLOCK ? total - start : KOKSMA__BLOCK);
        f->batch->camera(&f->camera, values->film + 2 * start, n, &rays);
        const int hit = f->frustum_cull ? f->batch->closest(&r->shapes, &rays, NULL, n, &hits)
                                        : f->geometry.closest(&f->geometry, &rays, NULL, n, &hits);
        if (!hit && !values->albedo) {
            for (int i = 0; i < n; i++) {
                values->rgb[start + (size_t)i] = colour_of_nothing(f);
            }
            continue;
        }
        if (!drawn) {
            status = draw_lights(f, group, r);
            drawn = true;
        }
        if (!status) {
            const int copies = start + (size_t)n > n_samples ? (int)(start + (size_t)n - n_samples) : 0;
            shade_block(f, &rays, &hits, start, n, copies, r, values);
        }
    }
    return status;
}

const koksma__pipeline koksma__pipeline_lambert_lanes = {
    .name = "lambert-lanes",
    .title = "grey Lambert surfaces under invisible rectangular lights, in SIMD lanes",
    .preference = 1,
    .takes = takes,
    .culls = true,
    .together = KOKSMA__BLOCK,
    .open = open_scratch,
    .close = close_scratch,
    .is_empty = is_empty,
    .trace = trace};
