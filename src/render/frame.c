/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Data that all pixels of an image share, computed once: materials and lights in floats, the camera (how the
 * directions of rays, or the origins for an orthographic camera, change per step on the film), the sampler, the
 * filter's table and the geometry. The geometry (for meshes Embree's tree) is shared by all images of a scene: it is
 * stored in the scene (scene_cache), under a lock, until the scene is released.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/elementary.h"
#include "core/status.h"
#include "render/accel/accel.h"
#include "render/one_image.h"
#include "render/samples/samples.h"

/* ---- The scene in floats ------------------------------------------------------------------------------ */

double koksma__pixel_size(const koksma__camera *camera, int height)
{
    return (camera->height > 0 ? camera->height : 2 * koksma__tan(camera->fov_rad / 2)) / height;
}

static koksma__batch_camera make_camera(const koksma__camera *from, int width, int height, float origins[3][3])
{
    koksma__batch_camera c = {.radius = (float)from->lens_radius,
                              .focus = (float)from->focus_distance,
                              .open = (float)from->shutter[0],
                              .interval = (float)(from->shutter[1] - from->shutter[0])};
    const double step = koksma__pixel_size(from, height);
    for (int k = 0; k < 3; k++) {
        const double right = step * from->right[k], down = step * from->down[k];
        const double shift = from->shift[0] * from->right[k] + from->shift[1] * from->down[k];
        c.eye[k] = (float)from->eye[k];
        c.right[k] = (float)from->right[k];
        c.down[k] = (float)from->down[k];
        c.motion[k] = (float)from->motion[k];
        if (from->height > 0) {
            c.base[k] = (float)from->forward[k];
            origins[0][k] = (float)(shift - 0.5 * width * right - 0.5 * height * down);
            origins[1][k] = (float)right;
            origins[2][k] = (float)down;
            continue;
        }
        c.base[k] = (float)(from->forward[k] + shift - 0.5 * width * right - 0.5 * height * down);
        c.step_x[k] = (float)right;
        c.step_y[k] = (float)down;
    }
    return c;
}

void koksma__move_origins(const koksma__frame *f, const float *film, int n, koksma__rays *rays)
{
    for (int k = 0; k < 3 && f->scene->camera.height > 0; k++) {
        for (int i = 0; i < n; i++) {
            rays->o[k][i] += f->origins[0][k] + film[2 * i] * f->origins[1][k] + film[2 * i + 1] * f->origins[2][k];
        }
    }
}

static koksma__batch_material make_material(const koksma__material *from)
{
    koksma__batch_material m = {.checker = from->checker,
                                .albedo = {(float)from->albedo[0][0], (float)from->albedo[1][0]}};
    if (from->checker) {
        const double c = koksma__cos(from->angle_rad) / from->period, s = koksma__sin(from->angle_rad) / from->period;
        m.su = (float)c;
        m.sv = (float)s;
        m.tu = (float)-s;
        m.tv = (float)c;
        m.s0 = (float)from->phase[0];
        m.t0 = (float)from->phase[1];
    }
    if (from->checker && from->mapping.moved) {
        const float *by = from->mapping.matrix, scale = 1 / (float)from->period;
        m.su = by[0] * scale, m.sv = by[1] * scale, m.s0 = by[2] * scale;
        m.tu = by[3] * scale, m.tv = by[4] * scale, m.t0 = by[5] * scale;
    }
    return m;
}

static koksma_status make_materials(koksma__frame *f)
{
    const size_t n = f->scene->n_materials + f->scene->medium.is_there;
    f->materials = calloc(n + 1, sizeof *f->materials);
    f->shading_materials = calloc(n + 1, sizeof *f->shading_materials);
    KOKSMA__REQUIRE_MEMORY(f->shading_materials && f->materials, (n + 1) * sizeof *f->shading_materials);
    for (size_t i = 0; i < n; i++) {
        const koksma__material *from = i < f->scene->n_materials ? &f->scene->materials[i] : &f->scene->medium.phase;
        f->materials[i] = make_material(from);
        f->shading_materials[i] = koksma__shading_material_of(from);
    }
    for (size_t i = 0; i < f->scene->n_placements; i++) {
        const koksma__placement *p = &f->scene->placements[i];
        if (p->light >= 0 && p->material >= 0) {
            f->shading_materials[p->material].glows = true;
        }
    }
    return KOKSMA_OK;
}

/* Copies the materials to arrays for blocks of rays. */
static koksma_status make_lane_materials(koksma__frame *f)
{
    const size_t n = f->scene->n_materials + f->scene->medium.is_there + 1;
    koksma__lane_materials *t = &f->lane_materials;
    float **const columns[] = {&t->albedo[0][0],  &t->albedo[0][1],  &t->albedo[0][2],  &t->albedo[1][0],
                               &t->albedo[1][1],  &t->albedo[1][2],  &t->parameters[0], &t->parameters[1],
                               &t->parameters[2], &t->parameters[3], &t->derived,       &t->u[0],
                               &t->u[1],          &t->u[2],          &t->v[0],          &t->v[1],
                               &t->v[2]};
    const size_t n_columns = sizeof columns / sizeof *columns;
    float *room = calloc(n * n_columns + 16, sizeof *room);
    t->form = calloc(2 * n + 16, sizeof *t->form);
    t->n = (int32_t)n;
    t->albedo[0][0] = room;
    KOKSMA__REQUIRE_MEMORY(room && t->form, n * n_columns * sizeof *room);
    t->traits = t->form + n;
    t->form[0] = KOKSMA__UNLIT;
    for (size_t k = 0; k < n_columns; k++) {
        *columns[k] = room + k * n;
    }
    for (size_t i = 1; i < n; i++) {
        const koksma__shading_material *m = &f->shading_materials[i - 1];
        const koksma__batch_material *b = &f->materials[i - 1];
        const float numbers[] = {m->albedo[0][0],
                                 m->albedo[0][1],
                                 m->albedo[0][2],
                                 m->albedo[1][0],
                                 m->albedo[1][1],
                                 m->albedo[1][2],
                                 m->values[0],
                                 m->values[1],
                                 m->values[2],
                                 m->values[3],
                                 m->derived,
                                 b->su,
                                 b->sv,
                                 b->s0,
                                 b->tu,
                                 b->tv,
                                 b->t0};
        t->form[i] = (int32_t)m->bsdf->form;
        t->traits[i] = 1 << m->bsdf->form | (int32_t)m->bsdf->lobes << KOKSMA__LOBES_AT |
                       (m->bsdf->takes_choice ? KOKSMA__TAKES_CHOICE : 0) |
                       (koksma__is_textured(m) ? KOKSMA__HAS_IMAGE : 0) | (m->glows ? KOKSMA__GLOWS : 0) |
                       (b->checker ? KOKSMA__IS_CHECKER : 0);
        for (size_t k = 0; k < n_columns; k++) {
            (*columns[k])[i] = numbers[k];
        }
    }
    return KOKSMA_OK;
}

/* ---- Names of options that are enumerations ---------------------------------------------------------- */

#define NAME_AT(names, i) ((unsigned)(i) < sizeof(names) / sizeof *(names) ? (names)[i] : NULL)

const char *koksma_pairing_name(koksma_pairing pairing)
{
    static const char *const names[] = {[KOKSMA_PAIRING_SHUFFLED] = "shuffled",
                                        [KOKSMA_PAIRING_ALIGNED] = "aligned",
                                        [KOKSMA_PAIRING_NATIVE] = "native"};
    return NAME_AT(names, pairing);
}

const char *koksma_scope_name(koksma_scope scope)
{
    static const char *const names[] = {[KOKSMA_SCOPE_PIXEL] = "pixel", [KOKSMA_SCOPE_IMAGE] = "image"};
    return NAME_AT(names, scope);
}

const char *koksma_light_selection_name(koksma_light_selection selection)
{
    static const char *const names[] = {[KOKSMA_LIGHTS_ALL] = "all",
                                        [KOKSMA_LIGHTS_ONE] = "one",
                                        [KOKSMA_LIGHTS_POWER] = "power",
                                        [KOKSMA_LIGHTS_UNIFORM] = "uniform",
                                        [KOKSMA_LIGHTS_AUTO] = "auto"};
    return NAME_AT(names, selection);
}

/* ---- The frame ------------------------------------------------------------------------------------------- */

int koksma_render_depth(const koksma_scene *scene, const koksma_render_options *options)
{
    KOKSMA__REQUIRE_OR(0, scene, options);
    KOKSMA__REQUIRE_OR(0, options->integrator);
    KOKSMA__REQUIRE_OR(0, options->integrator->flags);
    const koksma__integrator_flags *flags = options->integrator->flags;
    const bool follows = flags->roulette && scene->path_vertices > 0;
    return options->depth >= 0 ? options->depth : follows ? scene->path_vertices - 1 : options->integrator->depth;
}

koksma_light_selection koksma__light_selection(const koksma_scene *scene, const koksma_render_options *options)
{
    const koksma__integrator_flags *flags = options->integrator->flags;
    const bool many = scene->n_lights > KOKSMA__FEW_LIGHTS && flags->followed & KOKSMA__LOBE_DIFFUSE;
    if (flags->replace_scene) { /* the integrator renders its own scene, whose lights are black */
        return KOKSMA_LIGHTS_ALL;
    }
    return options->lights != KOKSMA_LIGHTS_AUTO ? options->lights : many ? KOKSMA_LIGHTS_ONE : KOKSMA_LIGHTS_ALL;
}

koksma__use_list koksma__frame_uses(const koksma_scene *scene, const koksma_render_options *options)
{
    const koksma__integrator_flags *flags = options->integrator->flags;
    const bool medium = scene->medium.is_there && flags->media;
    unsigned lobes = medium ? scene->medium.phase.bsdf->lobes : 0;
    for (size_t i = 0; i < scene->n_materials; i++) {
        lobes |= scene->materials[i].bsdf->lobes;
    }
    if (flags->replace_scene) {
        lobes = KOKSMA__LOBE_DIFFUSE;
    }
    const bool one = koksma__light_selection(scene, options) != KOKSMA_LIGHTS_ALL && scene->n_lights > 0;
    const int lights = one ? 1 : (int)scene->n_lights, past = flags->weight == KOKSMA__WEIGHT_ZERO;
    return (koksma__use_list){.lens = scene->camera.lens_radius > 0,
                              .time = scene->moves,
                              .lights = flags->areas ? lights : 0,
                              .light_choice = one,
                              .distance = medium,
                              .vertices =
                                  lobes & flags->followed ? koksma_render_depth(scene, options) + 1 + past : 1};
}

bool koksma_use_is_spent(const koksma_scene *scene, const koksma_render_options *options, size_t i)
{
    KOKSMA__REQUIRE_OR(false, scene, options);
    KOKSMA__REQUIRE_OR(false, options->integrator);
    KOKSMA__REQUIRE_OR(false, options->integrator->flags);
    const koksma__use_list uses = koksma__frame_uses(scene, options);
    return i < KOKSMA_N_USES && koksma__use_is_there(&uses, (int)i);
}

static void release_geometry(void *made)
{
    koksma__geometry *geometry = made;
    geometry->release(geometry);
    free(geometry);
}

/* The scene's geometry, which all its images share, because a study may render a mesh a thousand times. It is made of
   the scene itself, not of one that an integrator puts in its place: that one ends with its image, and may lack a
   medium in which shadow rays begin. */
static koksma_status find_geometry(const koksma_scene *scene, koksma__geometry *out)
{
    koksma__scene_cache *cache = scene->cache;
    koksma_status status = KOKSMA_OK;
    pthread_mutex_lock(&cache->lock);
    if (!cache->made) {
        koksma__geometry *geometry = malloc(sizeof *geometry);
        status = !geometry             ? koksma__fail_memory(sizeof *geometry)
                 : scene->n_placements ? koksma__accel_meshes(scene, geometry)
                                       : koksma__accel_shapes(scene, geometry);
        if (status) {
            free(geometry);
        } else {
            cache->made = geometry;
            cache->release = release_geometry;
        }
    }
    if (!status) {
        *out = *(koksma__geometry *)cache->made;
    }
    pthread_mutex_unlock(&cache->lock);
    return status;
}

static koksma_status make_frame(koksma__frame *f, const koksma_scene *scene, const koksma_run *run)
{
    const koksma_render_options *options = f->options;
    KOKSMA__TRY(make_materials(f));
    KOKSMA__TRY(make_lane_materials(f));
    for (int k = 0; k < 3; k++) {
        f->background[k] = (float)f->scene->background[k];
    }
    KOKSMA__TRY(koksma__lights_init(f->scene, &f->lights));
    f->camera = make_camera(&f->scene->camera, options->width, options->height, f->origins);
    f->uses = koksma__frame_uses(f->scene, options);
    koksma_status status = options->scope == KOKSMA_SCOPE_IMAGE
                               ? koksma__image_samples(options, &f->uses, run, &f->sampler)
                               : koksma__pixel_samples(options, &f->uses, run, &f->sampler);
    status = status ? status : find_geometry(scene, &f->geometry);
    if (!status && (options->splat || strcmp(options->filter->name, "box") != 0)) {
        status = koksma__filter_open(options->filter, &f->filter);
    }
    return status;
}

void koksma__frame_close(koksma__frame *f)
{
    if (f->sampler.release) {
        f->sampler.release(&f->sampler);
    }
    koksma__frustum_cull_close(f->frustum_cull);
    koksma__filter_close(f->filter);
    koksma__lights_fini(&f->lights);
    KOKSMA__FREE(f->materials, f->shading_materials, f->lane_materials.form, f->lane_materials.albedo[0][0]);
    if (f->replaced) {
        f->flags->release_scene(f->replaced);
    }
}

static koksma_status check(const koksma_render_options *o)
{
    if (o->width < 1 || o->height < 1 || o->width > KOKSMA_MAX_IMAGE_SIDE || o->height > KOKSMA_MAX_IMAGE_SIDE ||
        (size_t)o->width * (size_t)o->height > KOKSMA_MAX_PIXELS) {
        koksma_image none;
        return koksma_image_init(&none, o->width, o->height, 1); /* fails, and its message names the wrong size */
    }
    KOKSMA__FAIL_IF(o->spp < 1 || o->spp > KOKSMA_MAX_SPP, KOKSMA_ARGUMENT,
                    "spp = %d: the number of samples a pixel must be 1 to %d", o->spp, KOKSMA_MAX_SPP);
    KOKSMA__FAIL_IF(!koksma_pairing_name(o->pairing) || !koksma_scope_name(o->scope) ||
                        !koksma_light_selection_name(o->lights) || !o->integrator || !o->filter,
                    KOKSMA_ARGUMENT, "the options lack a pairing, scope, light selection, integrator or filter");
    KOKSMA__FAIL_IF(!o->integrator->name || !o->integrator->flags, KOKSMA_ARGUMENT,
                    "the integrator has no %s: koksma_integrator_find has integrators",
                    o->integrator->name ? "flags" : "name");
    KOKSMA__TRY(koksma__filter_check(o->filter));
    KOKSMA__FAIL_IF(o->depth < -1 || o->depth > KOKSMA_MAX_DEPTH, KOKSMA_ARGUMENT,
                    "depth = %d: the number of bounces must be 0 to %d", o->depth, KOKSMA_MAX_DEPTH);
    KOKSMA__FAIL_IF(
        o->scope == KOKSMA_SCOPE_IMAGE && !o->splat && strcmp(o->filter->name, "box") != 0, KOKSMA_ARGUMENT,
        "filter %s with scope image needs splatting, because the pattern fixes the positions of the samples",
        o->filter->name);
    return koksma__check_use_patterns(o);
}

koksma_status koksma__frame_open(const koksma_scene *scene, const koksma_render_options *options,
                                 const koksma_run *run, koksma__frame *out)
{
    *out = (koksma__frame){.scene = scene, .options = options};
    KOKSMA__TRY(check(options));
    out->flags = options->integrator->flags;
    KOKSMA__FAIL_IF(scene->medium.is_there && !out->flags->media && !out->flags->replace_scene, KOKSMA_ARGUMENT,
                    "integrator %s leaves out the scene's medium; path and its variants render it",
                    options->integrator->name);
    out->depth = koksma_render_depth(scene, options);
    out->light_selection = koksma__light_selection(scene, options);
    out->together = KOKSMA__BLOCK;
    out->channels = scene->grey ? 1 : 3;
    out->batch = koksma__batch();
    if (out->flags->replace_scene) {
        KOKSMA__TRY(out->flags->replace_scene(scene, &out->replaced));
        out->scene = out->replaced;
    }
    return make_frame(out, scene, run);
}
