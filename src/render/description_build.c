/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Builds the description of a scene: the readers of files (src/render/scene) and the parsers of lights and shapes
 * append to the description by these functions. Arrays double when they are full. koksma__scene_finish() derives what
 * depends on all parts: whether pictures have one channel, whether anything moves, and the part of the scene's hash
 * that depends on images in other files.
 */
#include "render/description_build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/hash.h"
#include "core/status.h"
#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "render/scene_images.h"

int koksma__find_material(const koksma_scene *scene, const char *name)
{
    for (size_t i = 0; i < scene->n_materials; i++) {
        if (!strcmp(scene->materials[i].name, name)) {
            return (int)i;
        }
    }
    return -1;
}

koksma_status koksma__scene_add_shape(koksma_scene *scene, const koksma__shape *from, koksma__shape **out)
{
    KOKSMA__FAIL_IF(scene->n_shapes == KOKSMA__MAX_SHAPES, KOKSMA_MALFORMED, "more than %d shapes",
                    KOKSMA__MAX_SHAPES);
    *out = koksma__add_one(&scene->shapes, &scene->n_shapes, sizeof **out);
    KOKSMA__TRY(*out ? KOKSMA_OK : KOKSMA_MEMORY);
    **out = *from;
    return KOKSMA_OK;
}

koksma_status koksma__scene_begin(koksma_scene *scene, const char *title)
{
    const char *slash = strrchr(title, '/');
    scene->lights = calloc(KOKSMA__MAX_LIGHTS, sizeof *scene->lights);
    scene->materials = calloc(KOKSMA__MAX_MATERIALS, sizeof *scene->materials);
    KOKSMA__REQUIRE_MEMORY(scene->lights && scene->materials, KOKSMA__MAX_MATERIALS * sizeof *scene->materials);
    snprintf(scene->title, sizeof scene->title, "%s", slash ? slash + 1 : title);
    scene->clamp = INFINITY;
    return KOKSMA_OK;
}

koksma_status koksma__scene_add_light(koksma_scene *scene, koksma__light **out)
{
    KOKSMA__FAIL_IF(scene->n_lights == KOKSMA__MAX_LIGHTS, KOKSMA_MALFORMED, "more than %d lights",
                    KOKSMA__MAX_LIGHTS);
    *out = &scene->lights[scene->n_lights++];
    return KOKSMA_OK;
}

koksma_status koksma__scene_note(koksma_scene *scene, const char *text)
{
    char(*note)[256] = koksma__add_one(&scene->notes, &scene->n_notes, sizeof *note);
    KOKSMA__TRY(note ? KOKSMA_OK : KOKSMA_MEMORY);
    snprintf(*note, sizeof *note, "%s", text);
    return KOKSMA_OK;
}

void koksma__material_mean(const koksma_scene *scene, koksma__material *m)
{
    koksma__scene_image_mean(scene, m->image, true, m->albedo[0]);
    memcpy(m->albedo[1], m->albedo[0], sizeof m->albedo[0]);
}

static bool is_grey(const double rgb[3])
{
    return rgb[0] == rgb[1] && rgb[1] == rgb[2];
}

static bool has_grey_values(const koksma__material *m)
{
    bool grey = true;
    for (const koksma__parameter *p = m->bsdf->kind.parameters; p && p->name; p++) {
        grey &= p->type != KOKSMA__COLOUR || is_grey((const double *)(const void *)((const char *)m + p->at));
    }
    return grey;
}

/* Computes the members of a scene that follow from others, such as whether it has colours. A second call changes
   nothing. */
void koksma__scene_finish(koksma_scene *scene)
{
    scene->grey = is_grey(scene->background) && is_grey(scene->ambient) && is_grey(scene->medium.absorption) &&
                  is_grey(scene->medium.scattering);
    for (size_t i = 0; i < scene->n_materials; i++) {
        const koksma__material *m = &scene->materials[i];
        scene->grey &= is_grey(m->albedo[0]) && is_grey(m->albedo[1]) && has_grey_values(m) &&
                       !(m->image && m->image->channels == 3) && !m->tinted &&
                       !(m->maps[KOKSMA__MAP_EMISSION].image && m->maps[KOKSMA__MAP_EMISSION].image->channels == 3);
    }
    for (size_t i = 0; i < scene->n_lights; i++) {
        const koksma__light *l = &scene->lights[i];
        scene->grey &= is_grey(l->radiance) && !(l->image && l->image->channels == 3);
    }
    scene->files_hash = koksma__scene_images_hash(scene) ^ (scene->n_mesh_files > 1 ? scene->mesh_order : 0);
    const double *m = scene->camera.motion;
    scene->moves = m[0] != 0 || m[1] != 0 || m[2] != 0;
    for (size_t i = 0; i < scene->n_shapes; i++) {
        m = scene->shapes[i].motion;
        scene->moves |= scene->shapes[i].turn.turns || m[0] != 0 || m[1] != 0 || m[2] != 0;
    }
    for (size_t i = 0; i < scene->n_placements; i++) {
        scene->moves |= koksma__placement_moves(&scene->placements[i]);
    }
}

/* ---- Meshes and placements -------------------------------------------------------------------------------------- */

enum { MAX_PLACEMENTS = 1 << 16, MESH_RATIO = 64, MESHES_MIB = 1024 };

koksma_status koksma__scene_add_mesh(koksma_scene *scene, koksma__mesh **out)
{
    *out = koksma__add_one(&scene->meshes, &scene->n_meshes, sizeof **out);
    return *out ? KOKSMA_OK : KOKSMA_MEMORY;
}

uint64_t koksma__mesh_bytes(const koksma__mesh *mesh)
{
    const uint64_t each = 6 + (mesh->uvs ? 2 : 0) + (mesh->colours ? 3 : 0);
    return sizeof(float) * (each * mesh->n_vertices + 3 * mesh->n_triangles);
}

koksma_status koksma__scene_limit_mesh(koksma_scene *scene, const koksma__mesh *mesh, const char *path)
{
    const uint64_t files = scene->mesh_files.bytes;
    scene->mesh_bytes += koksma__mesh_bytes(mesh);
    if (scene->mesh_bytes > (uint64_t)MESHES_MIB << 20 && scene->mesh_bytes / MESH_RATIO > files) {
        return koksma__refused(koksma__fail(KOKSMA_MALFORMED,
                                            "%s: with it the meshes of the scene take more than %d MiB and more than "
                                            "%d times their files: use fewer or smaller ones",
                                            path, MESHES_MIB, MESH_RATIO));
    }
    return KOKSMA_OK;
}

/* The XOR of sums alone would often stay the same when two meshes are exchanged or change alike: (a + 1) ^ (a + 2) is 1
   for every odd a. It is kept for scenes with one mesh, whose hash stays what it was. */
void koksma__scene_hash_mesh(koksma_scene *scene, bool in_file)
{
    const uint64_t hash = koksma__mesh_hash(&scene->meshes[scene->n_meshes - 1]),
                   parts[2] = {scene->mesh_order, hash};
    scene->hash ^= hash + scene->n_meshes;
    scene->mesh_order = in_file ? koksma__hash(parts, sizeof parts) : scene->mesh_order;
    scene->n_mesh_files += in_file;
}

koksma_status koksma__scene_add_placement(koksma_scene *scene, koksma__placement **out)
{
    KOKSMA__FAIL_IF(scene->n_placements == MAX_PLACEMENTS, KOKSMA_MALFORMED, "more than %d meshes and instances",
                    MAX_PLACEMENTS);
    *out = koksma__add_one(&scene->placements, &scene->n_placements, sizeof **out);
    KOKSMA__TRY(*out ? KOKSMA_OK : KOKSMA_MEMORY);
    (*out)->light = (*out)->material = -1;
    for (int k = 0; k < 3; k++) {
        (*out)->before[5 * k] = (*out)->after[5 * k] = 1;
    }
    return KOKSMA_OK;
}

static bool has_area(const koksma__mesh *mesh, const koksma__placement *p)
{
    double area = 0;
    for (size_t t = 0; t < mesh->n_triangles; t++) {
        float corners[9];
        area += koksma__placed_triangle(mesh, p->matrix, t, corners);
    }
    return (float)area > 0;
}

koksma_status koksma__scene_add_glow(koksma_scene *scene, koksma__placement *p, const double radiance[3])
{
    koksma__light *light = NULL;
    KOKSMA__FAIL_IF(!has_area(&scene->meshes[p->mesh], p), KOKSMA_MALFORMED,
                    "a mesh that emits light has no area after its placement");
    const koksma_status status = koksma__scene_add_light(scene, &light);
    if (!status) {
        light->kind = &koksma__light_mesh;
        light->placement = (int)(p - scene->placements);
        light->visible = true;
        memcpy(light->radiance, radiance, sizeof light->radiance);
        p->light = (int)(light - scene->lights);
    }
    return status;
}
