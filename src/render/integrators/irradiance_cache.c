/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The integrator `irradiance-cache` is distribution ray tracing that interpolates the light between diffuse surfaces
 * from cached positions (Ward, Rubinstein & Clear 1988) instead of using the scene's ambient light. A record has a
 * position p_i, the surface's normal n_i there, the irradiance E, computed from RAYS paths over the hemisphere, and
 * R_i, the harmonic mean of the lengths of the paths' first rays. A record may be used at p with normal n if 1/w = |p
 * - p_i| / R_i + sqrt(1 - n.n_i) < ACCURACY, and E(p) is the mean of these records weighted by w. R_i is clamped so
 * that the largest such distance, ACCURACY R_i, is between LEAST and MOST pixels.
 *
 * Records are made before the image, on successively finer grids of pixels. For the positions of a grid that no
 * record covers, the threads compute new records in parallel; these are then inserted one after the other, so that
 * the result does not depend on the number of threads. While the image is rendered, a position that no record covers
 * (for example one seen in a mirror) gets a temporary record. The interpolation is biased: in open scenes at 192 x
 * 144 pixels by up to a third of the indirect light. Light that mirrors or glass cast from a light on a diffuse
 * surface is left out: only few rays of a record find that light, so that some records would be far too bright and
 * the others too dark. At depth 0 there are no records, because there is no light between surfaces.
 */
#include "render/integrators/integrators.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "core/status.h"
#include "render/pipelines/pipelines.h"
#include "render/samples/samples.h"
#include "render/vector3.h"

enum { RAYS = 256, COARSEST = 16, FINEST = 2, LEVELS = 64, BUCKETS = 1 << 16, MAX_RECORDS = 1 << 22 };

#define ACCURACY 0.2f
#define LEAST 3.0f
#define MOST 150.0f

typedef struct record {
    float p[3], n[3], light[3], reach; /* `light` is the irradiance divided by pi, `reach` is R_i */
    /* level: the level of the cell that holds the record; next: the next record in the same bucket, or -1 */
    int32_t level, next;
} record;

typedef struct cache {
    koksma__frame paths; /* a copy of the frame that traces paths with its own samples */
    koksma_render_options options;
    record *records;
    size_t n, capacity;
    float smallest; /* the size of a cell at level 0; a cell at level k is 2^k times as large */
    bool used[LEVELS];
    int32_t buckets[BUCKETS]; /* the last record of each bucket, or -1 */
    float pixel;              /* the side of a pixel, at distance 1 for a perspective camera */
} cache;

static const koksma__integrator_flags path_rules = {.followed = KOKSMA__LOBE_SPECULAR | KOKSMA__LOBE_GLOSSY |
                                                                KOKSMA__LOBE_DIFFUSE,
                                                    .areas = true,
                                                    .shadows = true,
                                                    .roulette = true};

/* ---- Looking up ------------------------------------------------------------------------------------------- */

static uint32_t bucket_of(int level, const int64_t cell[3])
{
    uint64_t h = (uint64_t)level;
    for (int k = 0; k < 3; k++) {
        h = (h ^ (uint64_t)cell[k]) * 0x9e3779b97f4a7c15u;
        h ^= h >> 32;
    }
    return (uint32_t)(h % BUCKETS);
}

static float cell_size(const cache *c, int level)
{
    return ldexpf(c->smallest, level);
}

static void cell_of(const float p[3], float size, int64_t cell[3])
{
    for (int k = 0; k < 3; k++) {
        cell[k] = (int64_t)floorf(p[k] / size);
    }
}

/* Returns 1/w of a record at position p with normal n. */
static float distance(const record *r, const float p[3], const float n[3])
{
    const float d[3] = {p[0] - r->p[0], p[1] - r->p[1], p[2] - r->p[2]};
    const float cosine = koksma__dot3(n, r->n);
    /* Rejects a record that lies in front of the position, because its surroundings differ (test of Ward et al.). */
    const float mean[3] = {n[0] + r->n[0], n[1] + r->n[1], n[2] + r->n[2]};
    if (koksma__dot3(d, mean) < -0.1f * r->reach) {
        return INFINITY;
    }
    return sqrtf(koksma__dot3(d, d)) / r->reach + sqrtf(cosine < 1 ? 1 - cosine : 0);
}

/* Adds the records of one cell that may be used at p to the weighted sum. */
static void look_in(const cache *c, int level, const int64_t cell[3], const float p[3], const float n[3],
                    float sum[4])
{
    for (int32_t k = c->buckets[bucket_of(level, cell)]; k >= 0; k = c->records[k].next) {
        const record *r = &c->records[k];
        int64_t home[3];
        cell_of(r->p, cell_size(c, level), home);
        /* `here` is false for a record of another cell in the same bucket */
        const bool here = r->level == level && !memcmp(home, cell, sizeof home);
        const float inverse = here ? distance(r, p, n) : INFINITY;
        if (inverse < ACCURACY) {
            const float w = 1 / (inverse > 1e-4f ? inverse : 1e-4f);
            sum[3] += w;
            for (int j = 0; j < 3; j++) {
                sum[j] += w * r->light[j];
            }
        }
    }
}

/* Interpolates the light at a position; returns false if no record covers the position. A cell is at least twice
   as wide as its records reach, so that the records that cover a position lie in its cell or, along each axis, in
   the nearer neighbour. */
static bool look_up(const cache *c, const float p[3], const float n[3], float out[3])
{
    float sum[4] = {0, 0, 0, 0};
    for (int level = 0; level < LEVELS; level++) {
        int64_t at[3], cell[3], side[3];
        if (!c->used[level]) {
            continue;
        }
        const float size = cell_size(c, level);
        cell_of(p, size, at);
        for (int k = 0; k < 3; k++) {
            side[k] = p[k] / size - (float)at[k] < 0.5f ? -1 : 1;
        }
        for (int i = 0; i < 8; i++) {
            for (int k = 0; k < 3; k++) {
                cell[k] = at[k] + (i >> k & 1 ? side[k] : 0);
            }
            look_in(c, level, cell, p, n, sum);
        }
    }
    for (int j = 0; j < 3; j++) {
        out[j] = sum[3] > 0 ? sum[j] / sum[3] : 0;
    }
    return sum[3] > 0;
}

static koksma_status enter(cache *c, const record *from)
{
    KOKSMA__REQUIRE_MEMORY(c->n < MAX_RECORDS, 2 * c->n * sizeof *c->records);
    KOKSMA__TRY(koksma__reserve(&c->records, &c->capacity, c->n + 1, sizeof *c->records));
    record *r = &c->records[c->n];
    int64_t cell[3];
    *r = *from;
    r->level = 0;
    while (r->level < LEVELS - 1 && cell_size(c, r->level) < 2 * ACCURACY * r->reach) {
        r->level++;
    }
    cell_of(r->p, cell_size(c, r->level), cell);
    const uint32_t bucket = bucket_of(r->level, cell);
    c->used[r->level] = true;
    r->next = c->buckets[bucket];
    c->buckets[bucket] = (int32_t)c->n++;
    return KOKSMA_OK;
}

/* ---- Computing a record --------------------------------------------------------------------------------- */

/* The scratch memory for the paths of one record. */
typedef struct record_scratch {
    void *scratch;
    koksma__values values;
} record_scratch;

static void close_scratch(record_scratch *d)
{
    koksma__wavefront_close(d->scratch);
    KOKSMA__FREE(d->values.albedo, d->values.normal, d->values.depth);
}

static koksma_status open_scratch(const cache *c, record_scratch *d)
{
    *d = (record_scratch){.values = {.albedo = malloc(3 * RAYS * sizeof(float)),
                                     .normal = malloc(3 * RAYS * sizeof(float)),
                                     .depth = malloc(RAYS * sizeof(float))}};
    if (!d->values.albedo || !d->values.normal || !d->values.depth) {
        close_scratch(d);
        return koksma__fail_memory(7 * RAYS * sizeof(float));
    }
    const koksma_status status = koksma__wavefront_open(&c->paths, RAYS, &d->scratch);
    if (status) {
        close_scratch(d);
    }
    return status;
}

/* Computes the record of surface s: irradiance / pi and R_i. key selects the random numbers of the position. */
static koksma_status compute(const cache *c, record_scratch *d, uint64_t key, const koksma__surface *s, float time,
                             record *out)
{
    koksma__wavefront_scratch *scratch = d->scratch;
    const koksma__group group = {.first = (size_t)key, .count = 1, .start = {0, RAYS}};
    koksma__trace trace = {.frame = &c->paths, .scratch = scratch, .group = &group, .bounce = 1};
    const float *us;
    memset(scratch->sums, 0, 3 * RAYS * sizeof *scratch->sums);
    for (size_t i = 0; i < scratch->n_drawn; i++) {
        scratch->drawn[i].done = false;
    }
    scratch->queues[0].n = 0;
    koksma_status status = koksma__wavefront_draw(&trace, KOKSMA__USE_LOBE, &us);
    for (uint32_t i = 0; !status && i < RAYS; i++) {
        koksma__path path = {.beta = {1, 1, 1}, .pdf = -1, .time = time, .from = s->primitive, .sample = i};
        memcpy(path.o, s->p, sizeof path.o);
        memcpy(path.n, s->n, sizeof path.n);
        koksma__cosine_direction(s->n, us + 2 * i, path.d);
        status = koksma__wavefront_push(&scratch->queues[0], &path);
    }
    status = status ? status : koksma__wavefront_follow(&trace, &d->values);
    double sums[3] = {0, 0, 0}, inverse = 0;
    for (size_t i = 0; !status && i < RAYS; i++) {
        for (size_t k = 0; k < 3; k++) {
            sums[k] += (double)scratch->sums[3 * i + k];
        }
        inverse += d->values.depth[i] > 0 ? 1 / (double)d->values.depth[i] : 0;
    }
    *out = (record){.reach = inverse > 0 ? (float)(RAYS / inverse) : INFINITY};
    memcpy(out->p, s->p, sizeof out->p);
    memcpy(out->n, s->n, sizeof out->n);
    for (int k = 0; k < 3; k++) {
        out->light[k] = (float)(sums[k] / RAYS);
    }
    return status;
}

koksma_status koksma__irradiance_cache_indirect(const koksma__frame *frame, const koksma__surface *s, float time,
                                                float out[3])
{
    const cache *c = frame->cache;
    float light[3] = {0, 0, 0};
    koksma_status status = KOKSMA_OK;
    if (c && !look_up(c, s->p, s->n, light)) {
        record_scratch d;
        record r;
        uint32_t bits[4];
        memcpy(bits, s->p, sizeof s->p);
        memcpy(bits + 3, &s->n[1], sizeof *bits);
        KOKSMA__TRY(open_scratch(c, &d));
        status = compute(c, &d, koksma__hash(bits, sizeof bits), s, time, &r);
        memcpy(light, r.light, sizeof light);
        close_scratch(&d);
    }
    for (int k = 0; k < 3; k++) {
        out[k] += light[k];
    }
    return status;
}

/* ---- Before the picture --------------------------------------------------------------------------------- */

typedef struct grid {
    cache *cache;
    int step, columns, rows;
    /* one record for each position of the grid, computed in one parallel task per row; reach 0: the position needs no
       new record */
    record *found;
    float time;
} grid;

/* Finds the surface behind a pixel's centre, as seen through a pinhole; returns false if that is not a diffuse
   surface. */
static bool look(const cache *c, int x, int y, float time, koksma__surface *s, float *far)
{
    const koksma__frame *f = &c->paths;
    koksma__rays rays;
    koksma__hits hits;
    const float film[2 * KOKSMA__LANE_STEP] = {(float)x + 0.5f, (float)y + 0.5f};
    f->batch->camera(&f->camera, film, KOKSMA__LANE_STEP, &rays);
    koksma__move_origins(f, film, 1, &rays);
    for (int i = 0; i < KOKSMA__LANE_STEP; i++) {
        rays.time[i] = time;
    }
    f->geometry.closest(&f->geometry, &rays, NULL, KOKSMA__LANE_STEP, &hits);
    if (hits.primitive[0] < 0 || hits.material[0] < 0) {
        return false;
    }
    *s = (koksma__surface){.material = &f->shading_materials[hits.material[0]],
                           .p = {hits.px[0], hits.py[0], hits.pz[0]},
                           .n = {hits.nx[0], hits.ny[0], hits.nz[0]},
                           .primitive = hits.primitive[0]};
    *far = hits.t[0];
    return (s->material->bsdf->lobes & KOKSMA__LOBE_DIFFUSE) != 0;
}

static koksma_status compute_row(void *context, size_t row)
{
    const grid *g = context;
    cache *c = g->cache;
    record_scratch d;
    KOKSMA__TRY(open_scratch(c, &d));
    koksma_status status = KOKSMA_OK;
    for (int column = 0; !status && column < g->columns; column++) {
        record *r = &g->found[row * (size_t)g->columns + (size_t)column];
        const int x = column * g->step, y = (int)row * g->step;
        koksma__surface s;
        float far, light[3];
        if (look(c, x, y, g->time, &s, &far) && !look_up(c, s.p, s.n, light)) {
            const uint64_t key = (uint64_t)y * (uint64_t)c->options.width + (uint64_t)x;
            status = compute(c, &d, key, &s, g->time, r);
            const float pixel = c->paths.scene->camera.height > 0 ? c->pixel : far * c->pixel;
            r->reach = fminf(fmaxf(r->reach, LEAST * pixel / ACCURACY), MOST * pixel / ACCURACY);
        }
    }
    close_scratch(&d);
    return status;
}

static koksma_status fill_grid(cache *c, int step, float time, const koksma_run *run)
{
    const int width = c->options.width, height = c->options.height;
    grid g = {.cache = c,
              .step = step,
              .columns = (width + step - 1) / step,
              .rows = (height + step - 1) / step,
              .time = time};
    const size_t n = (size_t)g.columns * (size_t)g.rows;
    g.found = calloc(n, sizeof *g.found);
    KOKSMA__REQUIRE_MEMORY(g.found, n * sizeof *g.found);
    koksma_status status = koksma__parallel(run, (size_t)g.rows, compute_row, &g);
    for (size_t i = 0; !status && i < n; i++) {
        float light[3];
        if (g.found[i].reach > 0 && !look_up(c, g.found[i].p, g.found[i].n, light)) {
            status = enter(c, &g.found[i]);
        }
    }
    free(g.found);
    return status;
}

void koksma__irradiance_cache_close(koksma__frame *frame)
{
    cache *c = frame->cache;
    if (c) {
        if (c->paths.sampler.release) {
            c->paths.sampler.release(&c->paths.sampler);
        }
        free(c->records);
        free(c);
    }
    frame->cache = NULL;
}

koksma_status koksma__irradiance_cache_open(koksma__frame *frame, const koksma_run *run)
{
    cache *c = frame->depth ? calloc(1, sizeof *c) : NULL;
    if (!c) {
        return frame->depth ? koksma__fail_memory(sizeof *c) : KOKSMA_OK;
    }
    frame->cache = c;
    c->paths = *frame;
    c->paths.cache = NULL;
    c->paths.flags = &path_rules;
    c->paths.sampler = (koksma__sampler){0};
    c->options = *frame->options;
    c->paths.options = &c->options;
    memset(c->options.patterns, 0, sizeof c->options.patterns);
    memset(c->options.groups, 0, sizeof c->options.groups);
    c->options.spp = RAYS;
    c->options.pairing = KOKSMA_PAIRING_SHUFFLED;
    c->pixel = (float)koksma__pixel_size(&frame->scene->camera, c->options.height);
    c->smallest = c->pixel * LEAST * 0.01f;
    memset(c->buckets, -1, sizeof c->buckets);
    const koksma__use_list uses = {.lights = frame->light_selection == KOKSMA_LIGHTS_ALL ? (int)frame->lights.n : 1,
                                   .light_choice = frame->light_selection != KOKSMA_LIGHTS_ALL,
                                   .vertices = frame->depth + 1};
    koksma_status status = koksma_pattern_spec("sobol:scramble=owen", &c->options.pattern);
    status = status ? status : koksma__pixel_samples(&c->options, &uses, run, &c->paths.sampler);
    const double *shutter = frame->scene->camera.shutter;
    const float time = (float)fmin(fmax(0.5 * (shutter[0] + shutter[1]), 0), 1);
    for (int step = COARSEST; !status && step >= FINEST; step /= 2) {
        status = fill_grid(c, step, time, run);
    }
    return status;
}
