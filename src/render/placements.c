/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Adds meshes and their placements to a scene, for scene files (shapes/shape_compound.c) and model files
 * (src/render/scene/model_build.c). The arrays double when they are full.
 */
#include "render/placements.h"

#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/hash.h"
#include "core/status.h"
#include "render/description_build.h"
#include "render/lights/lights.h"

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
        scene->glows |= p->material >= 0;
    }
    return status;
}
