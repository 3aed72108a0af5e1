/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Makes a scene from the contents of a mesh file (meshes/mesh_file.h): its materials with their textures, its
 * meshes where its nodes place them, its camera and lights. A mesh is added to the scene when it is first placed.
 * If some placements mirror a mesh and others do not, the scene contains it twice, once turned inside out (glTF
 * 2.0, section 3.7.4).
 */
#include "scene/model_build.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "core/vector.h"
#include "image/formats.h"
#include "image/image.h"
#include "meshes/mesh_file.h"
#include "render/description_build.h"
#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "render/scene_images.h"
#include "scene/camera.h"
#include "scene/import.h"

typedef struct builder {
    koksma_scene *scene;
    koksma__mesh_file *file;
    int (*meshes)[2];     /* for each mesh of the file: the scene's mesh and its mirrored copy; -1: not made yet */
    double (*glows)[3];   /* emitted radiance of each material */
    size_t n_dark;        /* number of emissive meshes that remain dark because the list of lights is full */
    koksma_status status; /* first error among the materials */
} builder;

/* ---- Materials --------------------------------------------------------------------------------------------- */

static double clamp01(float x)
{
    return x > 0 ? fmin((double)x, 1) : 0;
}

/* Reads one part (such as colours or alpha) of an image that is embedded in the model file (glb) or is a file beside
   it. Errors: MALFORMED (there is no such file, or it is not an image that Koksma reads, or it is refused), MISSING (the
   file exists and can't be opened), MEMORY. */
static koksma_status read_texture(const builder *build, const koksma__file_texture *from,
                                  const koksma__image_use *use, koksma_image **image)
{
    char full[KOKSMA__MAX_PATH];
    *image = NULL;
    KOKSMA__FAIL_IF(from->within && !from->bytes, KOKSMA_MALFORMED, "%s: no bytes", from->name);
    if (from->bytes) {
        return koksma__scene_image_within(build->scene, from->name, from->bytes, from->size, use, image);
    }
    KOKSMA__FAIL_IF(!koksma__find_named(build->file->path, from->name, full), KOKSMA_MALFORMED,
                    "%s: there is no such file", from->name);
    return koksma__scene_image(build->scene, full, use, image);
}

/* Scales radiance down to the maximum that scenes allow, and keeps its colour. */
static void dim(builder *build, double rgb[3])
{
    const double largest = fmax(fmax(rgb[0], rgb[1]), rgb[2]);
    build->scene->unread.too_bright += largest > BRIGHT;
    for (int k = 0; largest > BRIGHT && k < 3; k++) {
        rgb[k] = isfinite(largest) ? fmax(rgb[k], 0) * (BRIGHT / largest) : rgb[k] > BRIGHT ? BRIGHT : 0;
    }
}

/* Handles the error of a texture: one that is missing or malformed becomes a warning in `text`, any other error, such
   as that of a folder or a limit, becomes build->status. */
static void note(builder *build, koksma_status status, char text[256])
{
    if (status == KOKSMA_MISSING || koksma__is_refused() ||
        koksma_status_exit_code(status) == koksma_status_exit_code(KOKSMA_SYSTEM)) {
        build->status = status;
    } else {
        snprintf(text, 256, "%s", koksma_error_text());
    }
}

/* Reads a texture into *out, as `use` says. *out stays NULL if the texture has no such part or can't be read; if it can't
   be read, `text` has the reason. */
static void take_map(builder *build, const koksma__file_texture *from, const koksma__image_use *use,
                     koksma_image **out, koksma__mapping *mapping, char text[256])
{
    static const int wraps[] = {[KOKSMA__WRAP_CLAMP] = 33071, [KOKSMA__WRAP_MIRROR] = 33648};
    *text = '\0';
    if (!from->name || build->status) {
        return;
    }
    koksma_image *image;
    const koksma_status status = read_texture(build, from, use, &image);
    if (status) {
        note(build, status, text);
    }
    if (status || !image->pixels) {
        return;
    }
    *out = image;
    *mapping = (koksma__mapping){.moved = from->moved, .nearest = from->nearest};
    memcpy(mapping->matrix, from->matrix, sizeof mapping->matrix);
    for (int k = 0; k < 2; k++) {
        for (int w = KOKSMA__WRAP_CLAMP; w <= KOKSMA__WRAP_MIRROR; w++) {
            mapping->wrap[k] = from->wrap[k] == wraps[w] ? (koksma__wrap)w : mapping->wrap[k];
        }
    }
}

/* glTF's colours are sRGB, whatever their files state (glTF 2.0, section 3.9.2, and "Images", 3.8.4). */
static koksma__image_part colours_of(const koksma__material *m)
{
    return m->bsdf == &koksma__bsdf_principled ? KOKSMA__IMAGE_SRGB : KOKSMA__IMAGE_COLOURS;
}

/* Reads the colour texture; if it is missing, the material keeps its colour. */
static void take_colour_map(builder *build, const koksma__file_texture *from, koksma__material *m)
{
    if (from->name && m->bsdf == &koksma__bsdf_ggx) {
        snprintf(m->lost, sizeof m->lost, "%s: the colour texture of a metal is ignored", from->name);
        return;
    }
    koksma__image_use use = {.part = colours_of(m)};
    memcpy(use.tint, m->albedo[0], sizeof use.tint);
    take_map(build, from, &use, &m->image, &m->mapping, m->lost);
    if (m->image) {
        koksma__material_mean(build->scene, m);
    }
}

/* Reads the emission texture. If it is missing, the surface emits nothing, because most of an emission texture is
   usually dark. */
static void take_glow_map(builder *build, const koksma__file_texture *from, double glow[3], koksma__material *m)
{
    koksma__map *map = &m->maps[KOKSMA__MAP_EMISSION];
    double mean[3] = {0};
    koksma__image_use use = KOKSMA__PLAIN_IMAGE;
    use.part = colours_of(m);
    take_map(build, from, &use, &map->image, &map->mapping, m->dark);
    if (map->image) {
        koksma__scene_image_mean(build->scene, map->image, false, mean);
    }
    for (int k = 0; k < 3 && !(mean[0] > 0 || mean[1] > 0 || mean[2] > 0); k++) {
        glow[k] = 0;
    }
}

/* Sets the properties that only glTF's materials have: metallic and roughness textures, normals, alpha, sides. */
static void take_principled(builder *build, const koksma__file_material *from, koksma__material *m)
{
    const struct {
        const koksma__file_texture *from;
        koksma__image_part part;
        koksma__map_use use;
        const char *what;
    } all[] = {{&from->surface_map, KOKSMA__IMAGE_NUMBERS, KOKSMA__MAP_SURFACE, "metal and roughness"},
               {&from->normal_map, KOKSMA__IMAGE_NUMBERS, KOKSMA__MAP_NORMAL, "normals"},
               {&from->colour_map, KOKSMA__IMAGE_ALPHA, KOKSMA__MAP_ALPHA, "alpha"}};
    char text[256];
    *koksma__material_value(m, "metallic") = clamp01(from->metallic);
    *koksma__material_value(m, "ior") = from->ior < 1 ? 1.5 : fmin(from->ior, 4);
    for (size_t i = 0; i < sizeof all / sizeof *all - (from->blends ? 0 : 1); i++) {
        koksma__map *map = &m->maps[all[i].use];
        koksma__image_use use = KOKSMA__PLAIN_IMAGE;
        use.part = all[i].part;
        take_map(build, all[i].from, &use, &map->image, &map->mapping, text);
        map->scale = all[i].from->scale;
        if (*text && all[i].part == KOKSMA__IMAGE_NUMBERS && !build->status) {
            char note_text[256];
            snprintf(note_text, sizeof note_text, "material %.8s loses its texture of %s: %.150s", m->name,
                     all[i].what, text);
            build->status = koksma__scene_note(build->scene, note_text);
        }
    }
    m->alpha = fmin(fmax(from->alpha, 0), 1);
    m->cutoff = from->cutoff;
    m->see_through = from->blends && (m->alpha < 1 || m->maps[KOKSMA__MAP_ALPHA].image);
    m->tinted = from->tinted;
    m->one_sided = !from->two_sided;
}

static void build_material(builder *build, size_t i)
{
    const koksma__file_material *from = koksma__file_material_at(build->file, i);
    koksma__material *m = &build->scene->materials[build->scene->n_materials++];
    double *glow = build->glows[i];
    snprintf(m->name, sizeof m->name, "%zu", i);
    double *to = m->albedo[0];
    m->bsdf = from->principled        ? &koksma__bsdf_principled
              : from->metallic > 0.5f ? &koksma__bsdf_ggx
                                      : &koksma__bsdf_lambert;
    if (m->bsdf != &koksma__bsdf_lambert) {
        *koksma__material_value(m, "roughness") = fmin(fmax((double)from->roughness, 0.03), 1);
    }
    if (m->bsdf == &koksma__bsdf_ggx) {
        to = koksma__material_value(m, "reflectance");
    }
    for (int k = 0; k < 3; k++) {
        to[k] = clamp01(from->colour[k]);
        glow[k] = fmax(from->glow[k], 0);
    }
    memcpy(m->albedo[1], m->albedo[0], sizeof m->albedo[0]);
    build->scene->unread.see_through += from->see_through;
    take_colour_map(build, &from->colour_map, m);
    if (from->principled) {
        take_principled(build, from, m);
    }
    if (from->glow_map.name && (glow[0] > 0 || glow[1] > 0 || glow[2] > 0)) {
        take_glow_map(build, &from->glow_map, glow, m);
    }
    dim(build, glow);
}

/* ---- Placements, camera, lights -------------------------------------------------------------------------- */

/* Finds the scene's mesh for a mesh of the file, and makes it when it is first placed. */
static koksma_status find_mesh(builder *build, size_t number, bool mirrored, int *out)
{
    int *known = build->meshes[number];
    koksma_scene *scene = build->scene;
    koksma__mesh *to = NULL, *from = &koksma__file_mesh_at(build->file, number)->mesh;
    *out = known[mirrored];
    if (known[mirrored] >= 0) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__scene_add_mesh(scene, &to));
    koksma_status status = KOKSMA_OK;
    if (known[!mirrored] >= 0) {
        status = koksma__mesh_copy(&scene->meshes[known[!mirrored]], to);
    } else {
        *to = *from; /* move the mesh out of the file's data, which does not need it again */
        *from = (koksma__mesh){0};
    }
    if (!status && (mirrored || known[!mirrored] >= 0)) {
        koksma__mesh_flip(to);
    }
    *out = known[mirrored] = (int)scene->n_meshes - 1;
    return status ? status : koksma__mesh_check(to);
}

/* Makes a placed mesh a light that also reflects. Leaves space in the list of lights for the file's other lights and
   for the two that model.c may add. */
static koksma_status add_glow(builder *build, koksma__placement *p, const double glow[3], bool two_sided)
{
    koksma_scene *scene = build->scene;
    if (scene->n_lights + build->file->lights.n + 2 >= KOKSMA__MAX_LIGHTS) {
        return build->n_dark++
                   ? KOKSMA_OK
                   : koksma__scene_note(scene, "more meshes emit light than a scene can have lights: some are dark");
    }
    KOKSMA__TRY(koksma__scene_add_glow(scene, p, glow));
    scene->lights[p->light].two_sided = two_sided;
    return KOKSMA_OK;
}

static koksma_status place(builder *build, const koksma__file_placement *from)
{
    koksma_scene *scene = build->scene;
    const size_t material = koksma__file_mesh_at(build->file, from->mesh)->material;
    const double *matrix = from->matrix;
    int mesh = -1;
    koksma__placement *p = NULL;
    koksma_status status = find_mesh(build, from->mesh, koksma__matrix_mirrors(matrix), &mesh);
    status = status ? status : koksma__scene_add_placement(scene, &p);
    if (status) {
        return status;
    }
    p->mesh = mesh;
    p->material = (int)material;
    p->smooth = scene->meshes[mesh].normals != NULL;
    memcpy(p->matrix, matrix, sizeof p->matrix);
    koksma__placement_box(&scene->meshes[mesh], p);
    for (int k = 0; k < 3; k++) {
        KOKSMA__FAIL_IF(!(p->low[k] >= -FAR && p->high[k] <= FAR), KOKSMA_MALFORMED,
                        "a node places a mesh beyond 1e6");
    }
    const double *glow = build->glows[material];
    if (scene->materials[material].image && !scene->meshes[mesh].uvs) {
        return koksma__fail(KOKSMA_MALFORMED, "a mesh with a texture has no texture coordinates");
    }
    return glow[0] > 0 || glow[1] > 0 || glow[2] > 0
               ? add_glow(build, p, glow, koksma__file_material_at(build->file, material)->two_sided)
               : KOKSMA_OK;
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

/* Sets the camera: it is at the origin of its node and looks in the direction -z of the node. */
static bool build_camera(builder *build)
{
    static const double origin[3] = {0, 0, 0}, ahead[3] = {0, 0, -1}, over[3] = {0, 1, 0};
    const double fov = build->file->yfov_rad, *matrix = build->file->camera;
    double eye[3], forward[3], up[3];
    transform(matrix, origin, 1, eye);
    transform(matrix, ahead, 0, forward);
    transform(matrix, over, 0, up);
    return within(eye, FAR) && within(forward, FAR) && within(up, FAR) && fov > 2e-4 && fov < 3.1 &&
           koksma__camera_aim(eye, forward, up, fov, &build->scene->camera);
}

/* Adds a light: it is at the origin of its node and points in the direction -z of the node. */
static koksma_status build_light(builder *build, size_t i)
{
    static const double origin[3] = {0, 0, 0}, ahead[3] = {0, 0, -1};
    const koksma__file_light *from = (koksma__file_light *)build->file->lights.items + i;
    koksma__light *to = NULL;
    KOKSMA__TRY(koksma__scene_add_light(build->scene, &to));
    to->kind = from->far_away  ? &koksma__light_directional
               : from->is_spot ? &koksma__light_spot
                               : &koksma__light_point;
    if (from->is_spot) {
        to->values[0] = from->outer * 360 / TURN;
        to->values[1] = 1 - from->inner / from->outer;
    }
    transform(from->matrix, origin, 1, to->centre);
    transform(from->matrix, ahead, 0, to->normal);
    for (int k = 0; k < 3; k++) {
        to->radiance[k] = from->colour[k];
    }
    dim(build, to->radiance);
    KOKSMA__FAIL_IF(!within(to->centre, FAR) ||
                        ((from->far_away || from->is_spot) && !koksma__import_normalise(to->normal)),
                    KOKSMA_MALFORMED, "light %zu has a coordinate beyond 1e6 or a direction of length 0", i);
    return KOKSMA_OK;
}

/* ---- The whole scene --------------------------------------------------------------------------------------- */

static koksma_status build_all(builder *build, bool *has_camera)
{
    const koksma__mesh_file *f = build->file;
    KOKSMA__FAIL_IF(f->materials.n > KOKSMA__MAX_MATERIALS - 1, KOKSMA_MALFORMED, "more than %d materials",
                    KOKSMA__MAX_MATERIALS - 1);
    KOKSMA__FAIL_IF(f->lights.n > KOKSMA__MAX_LIGHTS, KOKSMA_MALFORMED, "more than %d lights", KOKSMA__MAX_LIGHTS);
    build->meshes = malloc((f->meshes.n + 1) * sizeof *build->meshes);
    build->glows = calloc(f->materials.n + 1, sizeof *build->glows);
    if (!build->meshes || !build->glows) {
        return koksma__fail_memory((f->meshes.n + 1) * sizeof *build->meshes);
    }
    for (size_t i = 0; i < f->meshes.n; i++) {
        build->meshes[i][0] = build->meshes[i][1] = -1;
    }
    for (size_t i = 0; !build->status && i < f->materials.n; i++) {
        build_material(build, i);
    }
    koksma_status status = build->status;
    for (size_t i = 0; !status && i < f->placements.n; i++) {
        status = place(build, koksma__file_placement_at(f, i));
    }
    KOKSMA__FAIL_IF(!status && !build->scene->n_placements, KOKSMA_MALFORMED, "no triangles");
    *has_camera = !status && build_camera(build);
    for (size_t i = 0; !status && i < f->lights.n; i++) {
        status = build_light(build, i);
    }
    return status;
}

koksma_status koksma__model_read(const char *path, koksma__named by, koksma_scene *scene, bool *has_camera)
{
    koksma__mesh_file file;
    builder build = {.scene = scene, .file = &file};
    koksma_status status = koksma__mesh_file_read(path, by, &file);
    if (!status) {
        scene->hash = file.hash;
        scene->unread = file.unread;
        scene->unknown = file.unknown;
        scene->n_unknown = file.n_unknown;
        file.unknown = NULL;
        status = build_all(&build, has_camera);
        status = status ? koksma__fail_in(status, path) : KOKSMA_OK;
    }
    status = koksma__unknown_explain(status, scene->unknown ? scene->unknown : file.unknown,
                                     scene->unknown ? scene->n_unknown : file.n_unknown);
    free(build.meshes);
    free(build.glows);
    koksma__mesh_file_fini(&file);
    return status;
}
