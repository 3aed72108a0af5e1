/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Makes a scene from nothing but a mesh file (meshes/mesh_file.h): its materials with their textures, its meshes where
 * its nodes place them, its camera and lights. A mesh is added to the scene when it is first placed. If some placements
 * mirror a mesh and others do not, the scene contains it twice, once turned inside out (glTF 2.0, section 3.7.4).
 *
 * The scene gets an image size; a camera if the file has none; and, if no mesh emits light and the file has no other
 * lights, a studio: a key light, a dim sky and, if the camera was added, a ground. This file also replaces the sky of a
 * scene by one that the user chooses (koksma_scene_set_sky). Long because reading a model and completing it share the
 * scene.
 */
#include "scene/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/hash.h"
#include "core/status.h"
#include "core/vector.h"
#include "image/formats.h"
#include "image/image.h"
#include "meshes/mesh_file.h"
#include "render/description_build.h"
#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "render/medium.h"
#include "render/scene_images.h"
#include "render/shapes/shapes.h"
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
    koksma__import_apply(matrix, origin, 1, eye);
    koksma__import_apply(matrix, ahead, 0, forward);
    koksma__import_apply(matrix, over, 0, up);
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
    koksma__import_apply(from->matrix, origin, 1, to->centre);
    koksma__import_apply(from->matrix, ahead, 0, to->normal);
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

static koksma_status read_model(const char *path, koksma__named by, koksma_scene *scene, bool *has_camera)
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

/* A version number in the hash of scenes from mesh files; it is raised when a change of the code alters their
   images. */
#define MODEL_REVISION 3

/* Finds the sphere around the bounding box of all meshes; returns its radius. *low_y is the lowest height of the
   box. */
static double surround(const koksma_scene *scene, double centre[3], double *low_y)
{
    double low[3], high[3], square = 0;
    for (int k = 0; k < 3; k++) {
        low[k] = scene->placements[0].low[k];
        high[k] = scene->placements[0].high[k];
        for (size_t i = 1; i < scene->n_placements; i++) {
            low[k] = fmin(low[k], scene->placements[i].low[k]);
            high[k] = fmax(high[k], scene->placements[i].high[k]);
        }
        centre[k] = (low[k] + high[k]) / 2;
        square += (high[k] - low[k]) * (high[k] - low[k]) / 4;
    }
    *low_y = low[1];
    return sqrt(square);
}

/* Sets a camera that looks from the front, a little from above and from the right, at a distance where a sphere
   around everything fills the image's height. */
static void frame_all(koksma_scene *scene, const double centre[3], double radius)
{
    static const double up[3] = {0, 1, 0};
    const double fov = 40 * M_PI / 180;
    double eye[3], forward[3] = {-0.5, -0.4, -1};
    koksma__normalise(forward);
    for (int k = 0; k < 3; k++) {
        eye[k] = centre[k] - forward[k] * radius / koksma__sin(fov / 2);
    }
    koksma__camera_aim(eye, forward, up, fov, &scene->camera);
}

/* Adds a grey plane just below everything. */
static koksma_status add_ground(koksma_scene *scene, const double centre[3], double low_y, double radius)
{
    koksma__material *grey = &scene->materials[scene->n_materials];
    koksma__shape plane = {.type = koksma__own_shape_type("plane"),
                           .centre = {centre[0], low_y - 1e-4 * radius, centre[2]},
                           .normal = {0, 1, 0},
                           .axis_u = {1, 0, 0},
                           .axis_v = {0, 0, -1},
                           .half = {INFINITY, INFINITY},
                           .material = (int)scene->n_materials++,
                           .light = -1},
                  *added;
    snprintf(grey->name, sizeof grey->name, "ground");
    grey->bsdf = &koksma__bsdf_lambert;
    for (int k = 0; k < 6; k++) {
        grey->albedo[k / 3][k % 3] = 0.4;
    }
    scene->studio.shapes = 1;
    return koksma__scene_add_shape(scene, &plane, &added);
}

/* Adds the key light: a square, invisible to rays, with sides as long as the model's diameter, to the upper left
   in front of the model and five radii away. A surface in the model's centre that faces the square has an
   irradiance of 2. */
static koksma_status add_key(koksma_scene *scene, const double centre[3], double radius)
{
    static const double up[3] = {0, 1, 0};
    double from[3] = {-0.5, 0.9, 0.6};
    koksma__light *key = NULL;
    KOKSMA__TRY(koksma__scene_add_light(scene, &key));
    koksma__normalise(from);
    key->kind = &koksma__light_rectangle;
    key->half[0] = key->half[1] = radius;
    for (int k = 0; k < 3; k++) {
        key->centre[k] = centre[k] + 5 * radius * from[k];
        key->normal[k] = -from[k];
        key->radiance[k] = 2 * 25.0 / 4;
    }
    koksma__cross(up, key->normal, key->axis_u);
    koksma__normalise(key->axis_u);
    koksma__cross(key->normal, key->axis_u, key->axis_v);
    key->power = key->radiance[0] * 4 * radius * radius / M_PI;
    return KOKSMA_OK;
}

/* Makes the scene's sky, if it has one already, or else adds one. */
static koksma_status set_sky(koksma_scene *scene, double radiance, koksma_image *image)
{
    koksma__light *sky = NULL;
    for (size_t i = 0; i < scene->n_lights; i++) {
        sky = scene->lights[i].kind == &koksma__light_environment ? &scene->lights[i] : sky;
    }
    KOKSMA__TRY(sky ? KOKSMA_OK : koksma__scene_add_light(scene, &sky));
    const koksma_image *old = sky->image;
    *sky = (koksma__light){.kind = &koksma__light_environment,
                           .visible = true,
                           .radiance = {radiance, radiance, radiance},
                           .image = image};
    koksma__scene_image_drop(scene, old);
    return KOKSMA_OK;
}

/* Limits the brightness of lights from a file. glTF gives lights in lux and candela and leaves the exposure to the
   viewer. If the lights make a white surface in the centre brighter than radiance 10, all are dimmed by the same
   factor, so that this surface gets radiance 1, with a warning. */
static koksma_status expose(koksma_scene *scene, const double centre[3])
{
    double sum = 0;
    char text[128];
    for (size_t i = 0; i < scene->n_lights; i++) {
        const koksma__light *l = &scene->lights[i];
        double d[3];
        koksma__subtract(l->centre, centre, d);
        const bool near = l->kind->distance == KOKSMA__LIGHT_NEAR;
        const double largest = fmax(fmax(l->radiance[0], l->radiance[1]), l->radiance[2]);
        sum += l->kind == &koksma__light_mesh ? 0 : largest / (near ? fmax(koksma__dot(d, d), TINY) : 1) / M_PI;
    }
    if (!(sum > 10)) {
        return KOKSMA_OK;
    }
    for (size_t i = 0; i < scene->n_lights; i++) {
        for (int k = 0; k < 3 && scene->lights[i].kind != &koksma__light_mesh; k++) {
            scene->lights[i].radiance[k] /= sum;
        }
    }
    snprintf(text, sizeof text, "the lights at nodes are too bright: all are divided by %llu",
             (unsigned long long)sum);
    return koksma__scene_note(scene, text);
}

/* Adds the camera and the studio, where the model lacks them. The studio's lights and ground come last in their
   lists, so that koksma_scene_set_sky() can remove them. */
static koksma_status complete(koksma_scene *scene, bool has_camera)
{
    double centre[3], low_y;
    const double radius = surround(scene, centre, &low_y);
    bool lit = false;
    for (size_t i = 0; i < scene->n_lights; i++) {
        lit |= scene->lights[i].kind != &koksma__light_mesh;
    }
    if (!has_camera) {
        frame_all(scene, centre, radius);
    }
    if (lit) {
        return expose(scene, centre);
    }
    scene->studio.lights = 2;
    KOKSMA__TRY(add_key(scene, centre, radius));
    KOKSMA__TRY(set_sky(scene, 0.4, NULL));
    return has_camera ? KOKSMA_OK : add_ground(scene, centre, low_y, radius);
}

/* Removes the studio, whose lights and shapes are the last in their lists. */
static void take_down(koksma_scene *scene)
{
    scene->n_lights -= scene->studio.lights;
    scene->n_shapes -= scene->studio.shapes;
    scene->n_materials -= scene->studio.shapes;
    memset(&scene->studio, 0, sizeof scene->studio);
}

koksma_status koksma_scene_set_sky(koksma_scene *scene, const char *image, double radiance)
{
    KOKSMA__REQUIRE(scene);
    koksma_image *pixels = NULL, read = {0};
    KOKSMA__FAIL_IF(!(radiance >= 0 && radiance <= BRIGHT), KOKSMA_ARGUMENT,
                    "a sky of radiance %g: it must be 0 to %g", radiance, BRIGHT);
    KOKSMA__FAIL_IF(scene->cache->made, KOKSMA_ARGUMENT, "the scene was rendered already; set its sky before that");
    if (image) {
        koksma_status status = koksma__image_read(image, KOKSMA__FILE_TEXTURE, KOKSMA__BY_USER, &read);
        status = status ? status : koksma__image_check(&read, image);
        if (!status && *koksma_image_remark()) {
            status = koksma__unknown_put(&scene->unknown, &scene->n_unknown, image, 1, koksma_image_remark());
        }
        status = status ? status : koksma__scene_image_keep(scene, &read, &pixels);
        if (status) {
            koksma_image_fini(&read);
            return status;
        }
    }
    take_down(scene);
    KOKSMA__TRY(set_sky(scene, radiance, pixels));
    const uint64_t parts[2] = {koksma__scene_hash(scene), koksma__hash(&radiance, sizeof radiance)};
    scene->hash = koksma__hash(parts, sizeof parts);
    koksma__scene_finish(scene);
    return koksma__medium_check(scene);
}

koksma_status koksma__model_parse(const char *path, koksma__named by, koksma_scene *scene)
{
    bool has_camera = false;
    KOKSMA__TRY(koksma__scene_begin(scene, path));
    scene->is_model = true;
    scene->width = 512;
    scene->height = 384;
    KOKSMA__TRY(read_model(path, by, scene, &has_camera));
    scene->hash += MODEL_REVISION;
    KOKSMA__TRY(complete(scene, has_camera));
    koksma__scene_finish(scene);
    for (size_t i = 0; i < scene->n_materials; i++) { /* the materials of glTF are those of path tracers */
        scene->paths |= scene->materials[i].bsdf == &koksma__bsdf_principled;
    }
    return KOKSMA_OK;
}
