/* SPDX-License-Identifier: Apache-2.0 */
#include "scene/model_build.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "core/vector.h"
#include "image/formats.h"
#include "meshes/mesh_file.h"
#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "scene/model.h"
#include "scene/parse.h"

koksma_status koksma__build_init(koksma__build *build, size_t n_materials, size_t n_meshes)
{
    if (n_materials > KOKSMA__MAX_MATERIALS - 1) {
        return koksma__fail(KOKSMA_MALFORMED, "more than %d materials", KOKSMA__MAX_MATERIALS - 1);
    }
    build->meshes = malloc((n_meshes + 1) * sizeof *build->meshes);
    build->glows = calloc(n_materials + 1, sizeof *build->glows);
    if (!build->meshes || !build->glows) {
        return koksma__fail_memory((n_meshes + 1) * sizeof *build->meshes);
    }
    for (size_t i = 0; i < n_meshes; i++) {
        build->meshes[i][0] = build->meshes[i][1] = -1;
    }
    return KOKSMA_OK;
}

void koksma__build_fini(koksma__build *build)
{
    free(build->meshes);
    free(build->glows);
}

/* ---- Materials --------------------------------------------------------------------------------------------- */

static double clamp01(float x)
{
    return x > 0 ? fmin((double)x, 1) : 0;
}

/* An image of the file's own (glb), or a file beside it. Errors: MALFORMED (it isn't there, or we can't make it out),
   MISSING (it is there and can't be read), MEMORY. */
static koksma_status read_texture(const koksma__build *build, const koksma__file_texture *from, koksma_image *image)
{
    char full[KOKSMA__MAX_PATH];
    *image = (koksma_image){0};
    if (from->bytes) {
        koksma_status status = koksma__image_read_bytes(from->bytes, from->size, image);
        status = status ? koksma__fail_in(status, from->name) : koksma__image_check(image, from->name);
        return status;
    }
    if (from->within) {
        return koksma__fail(KOKSMA_MALFORMED, "%s: bare texels", from->name);
    }
    if (!koksma__find_named(build->path, from->name, full)) {
        return koksma__fail(KOKSMA_MALFORMED, "%s: there is no such file", from->name);
    }
    const koksma_status status = koksma_image_read(full, image);
    return status ? status : koksma__image_check(image, from->name);
}

/* Radiance beyond what scenes take is dimmed, in its own colour. */
static void dim(koksma__build *build, double rgb[3])
{
    const double largest = fmax(fmax(rgb[0], rgb[1]), rgb[2]);
    build->scene->unread.too_bright += largest > BRIGHT;
    for (int k = 0; largest > BRIGHT && k < 3; k++) {
        rgb[k] = isfinite(largest) ? fmax(rgb[k], 0) * (BRIGHT / largest) : rgb[k] > BRIGHT ? BRIGHT : 0;
    }
}

/* What isn't there or can't be made out is a warning; what fails otherwise is build->status. */
static void note(koksma__build *build, koksma_status status, char text[256])
{
    if (status == KOKSMA_MISSING || koksma_status_exit_code(status) == koksma_status_exit_code(KOKSMA_SYSTEM)) {
        build->status = status;
    } else {
        snprintf(text, 256, "%s", koksma_error_text());
    }
}

/* Multiplies the pixels with a colour; a grey image becomes a coloured one where it must. */
static koksma_status tint(koksma_image *image, const double colour[3])
{
    const size_t n = (size_t)image->width * (size_t)image->height;
    koksma_image grey = *image;
    if (grey.channels == 1 && (colour[0] != colour[1] || colour[0] != colour[2])) {
        const koksma_status status = koksma_image_init(image, grey.width, grey.height, 3);
        for (size_t i = 0; !status && i < 3 * n; i++) {
            image->pixels[i] = grey.pixels[i / 3];
        }
        koksma_image_fini(&grey);
        if (status) {
            return status;
        }
    }
    const size_t channels = (size_t)image->channels;
    for (size_t i = 0; i < n * channels; i++) {
        image->pixels[i] = (float)((double)image->pixels[i] * colour[i % channels]);
    }
    return KOKSMA_OK;
}

/* A texture that isn't there leaves the colour alone. */
static void take_colour_map(koksma__build *build, const koksma__file_texture *from, koksma__material *m)
{
    if (m->bsdf != &koksma__bsdf_lambert) {
        snprintf(m->lost, sizeof m->lost, "%s: metals have one colour here", from->name);
        return;
    }
    m->image = calloc(1, sizeof *m->image);
    koksma_status status = m->image ? read_texture(build, from, m->image) : koksma__fail_memory(sizeof *m->image);
    status = status ? status : tint(m->image, m->albedo[0]);
    if (!status) {
        koksma__material_mean(m);
        return;
    }
    koksma_image_fini(m->image);
    free(m->image);
    m->image = NULL;
    note(build, status, m->lost);
}

/* Luminaires shine evenly: with the texture's mean. One that isn't there leaves the surface dark, as most of such a
   texture is. */
static void take_glow_map(koksma__build *build, const koksma__file_texture *from, double glow[3], koksma__material *m)
{
    koksma_image image;
    const koksma_status status = read_texture(build, from, &image);
    const size_t n = status ? 0 : (size_t)image.width * (size_t)image.height;
    const size_t channels = (size_t)image.channels;
    bool even = true;
    for (size_t k = 0; k < 3; k++) {
        double sum = 0;
        for (size_t i = 0; i < n; i++) {
            const double value = (double)image.pixels[i * channels + k % channels];
            sum += value > 0 ? fmin(value, BRIGHT) : 0;
            even &= value == (double)image.pixels[k % channels];
        }
        glow[k] = n ? glow[k] * sum / (double)n : 0;
    }
    koksma_image_fini(&image);
    if (status) {
        note(build, status, m->dark);
    } else if (!even) {
        snprintf(m->evened, sizeof m->evened, "%s", from->name);
    }
}

void koksma__build_material(koksma__build *build, const koksma__file_material *from)
{
    const size_t i = build->scene->n_materials++;
    koksma__material *m = &build->scene->materials[i];
    const double strength = i < KOKSMA__GLTF_MATERIALS ? build->gltf.strengths[i] : 1;
    double *glow = build->glows[i];
    snprintf(m->name, sizeof m->name, "%zu", i);
    double *to = m->albedo[0];
    m->bsdf = from->metallic > 0.5f ? &koksma__bsdf_ggx : &koksma__bsdf_lambert;
    if (m->bsdf == &koksma__bsdf_ggx) {
        *koksma__material_value(m, "roughness") = fmin(fmax((double)from->roughness, 0.03), 1);
        to = koksma__material_value(m, "reflectance");
    }
    for (int k = 0; k < 3; k++) {
        to[k] = clamp01(from->colour[k]);
        glow[k] = from->glow[k] > 0 ? (double)from->glow[k] * strength : 0;
    }
    memcpy(m->albedo[1], m->albedo[0], sizeof m->albedo[0]);
    build->scene->unread.see_through += from->see_through;
    if (from->colour_map.name && !build->status) {
        take_colour_map(build, &from->colour_map, m);
    }
    if (from->glow_map.name && !build->status && (glow[0] > 0 || glow[1] > 0 || glow[2] > 0)) {
        take_glow_map(build, &from->glow_map, glow, m);
    }
    dim(build, glow);
}

void koksma__build_grey(koksma__build *build)
{
    build->scene->n_materials = 1;
    build->scene->materials[0].bsdf = &koksma__bsdf_lambert;
    for (int i = 0; i < 6; i++) {
        build->scene->materials[0].albedo[i / 3][i % 3] = 0.8;
    }
}

/* ---- Placements, camera, lights -------------------------------------------------------------------------- */

/* The scene's mesh for one of the file's, made where it is first placed. */
static koksma_status find_mesh(koksma__build *build, const koksma__file_mesh *mesh, bool mirrored, int *out)
{
    int *known = &build->meshes[mesh->number][mirrored];
    koksma_status status = KOKSMA_OK;
    if (*known < 0) {
        koksma__mesh *to = NULL;
        status = koksma__scene_add_mesh(build->scene, &to);
        status = status ? status : koksma__file_mesh_take(mesh, mirrored, to);
        *known = (int)build->scene->n_meshes - 1;
    }
    *out = *known;
    return status;
}

static koksma_status place(koksma__build *build, int mesh, unsigned material, const double matrix[12])
{
    koksma_scene *scene = build->scene;
    koksma__placement *p = NULL;
    koksma_status status = koksma__scene_add_placement(scene, &p);
    if (status) {
        return status;
    }
    material = material < scene->n_materials ? material : 0;
    p->mesh = mesh;
    p->material = (int)material;
    p->smooth = scene->meshes[mesh].normals != NULL;
    memcpy(p->matrix, matrix, sizeof p->matrix);
    koksma__placement_box(&scene->meshes[mesh], p);
    for (int k = 0; k < 3; k++) {
        if (!(p->low[k] >= -FAR && p->high[k] <= FAR)) {
            return koksma__fail(KOKSMA_MALFORMED, "a node places a mesh beyond 1e6");
        }
    }
    const double *glow = build->glows[material];
    if (glow[0] > 0 || glow[1] > 0 || glow[2] > 0) {
        p->smooth = false;
        status = koksma__scene_add_glow(scene, p, glow);
    }
    if (!status && scene->materials[material].image && !scene->meshes[mesh].uvs) {
        status = koksma__fail(KOKSMA_MALFORMED, "a mesh with a texture has no texture coordinates");
    }
    return status;
}

void koksma__build_placement(void *context, const koksma__file_mesh *mesh, const double matrix[12])
{
    koksma__build *build = context;
    int ours;
    if (!build->status && koksma__file_triangles(mesh)) {
        build->status = find_mesh(build, mesh, koksma__matrix_mirrors(matrix), &ours);
        build->status = build->status ? build->status : place(build, ours, mesh->material, matrix);
    }
}

static void transform(const double m[12], const double v[3], double w, double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = m[4 * k] * v[0] + m[4 * k + 1] * v[1] + m[4 * k + 2] * v[2] + w * m[4 * k + 3];
    }
}

static bool within(const double v[3], double bound)
{
    return fabs(v[0]) <= bound && fabs(v[1]) <= bound && fabs(v[2]) <= bound;
}

/* At the origin of its node, looking down its -z. */
bool koksma__build_camera(koksma__build *build)
{
    static const double origin[3] = {0, 0, 0}, ahead[3] = {0, 0, -1}, over[3] = {0, 1, 0};
    const double fov = build->gltf.yfov_rad, *matrix = build->gltf.camera;
    double eye[3], forward[3], up[3];
    transform(matrix, origin, 1, eye);
    transform(matrix, ahead, 0, forward);
    transform(matrix, over, 0, up);
    return within(eye, FAR) && within(forward, FAR) && within(up, FAR) && fov > 2e-4 && fov < 3.1 &&
           koksma__camera_aim(eye, forward, up, fov, &build->scene->camera);
}

/* Likewise. */
static koksma_status build_light(koksma__build *build, size_t i)
{
    static const double origin[3] = {0, 0, 0}, ahead[3] = {0, 0, -1};
    const koksma__gltf_light *from = &build->gltf.lights[i];
    koksma__light *to = NULL;
    const koksma_status status = koksma__scene_add_light(build->scene, &to);
    if (status) {
        return status;
    }
    to->kind = from->far_away ? &koksma__light_directional : &koksma__light_point;
    transform(from->matrix, origin, 1, to->centre);
    transform(from->matrix, ahead, 0, to->normal);
    for (int k = 0; k < 3; k++) {
        to->radiance[k] = from->colour[k];
    }
    dim(build, to->radiance);
    if (!within(to->centre, FAR) || (from->far_away && !koksma__normalise(to->normal))) {
        return koksma__fail(KOKSMA_MALFORMED, "light %zu is beyond 1e6 or leads nowhere", i);
    }
    return KOKSMA_OK;
}

koksma_status koksma__build_lights(koksma__build *build)
{
    koksma_status status = build->gltf.n_lights <= KOKSMA__GLTF_LIGHTS
                               ? KOKSMA_OK
                               : koksma__fail(KOKSMA_MALFORMED, "more than %d luminaires", KOKSMA__MAX_LIGHTS);
    for (size_t i = 0; !status && i < build->gltf.n_lights; i++) {
        status = build_light(build, i);
    }
    return status;
}
