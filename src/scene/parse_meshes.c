/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Shapes of kind "mesh" and "instance": which file, where it stands, what it is made of. A mesh is read once; its
 * instances are placements of the same triangles.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/vector.h"
#include "meshes/mesh_read.h"
#include "render/lights/lights.h"
#include "scene/parse.h"

enum { MAX_PLACEMENTS = 1 << 16 };

/* One more item of size bytes at the end of a list that grows; NULL when memory runs out. */
static void *grow(void *list, size_t n, size_t size)
{
    const bool full = !(n & (n - 1)); /* at powers of two, and at 0 */
    return full ? realloc(list, (n ? 2 * n : 1) * size) : list;
}

koksma_status koksma__scene_add_mesh(koksma_scene *scene, koksma__mesh **out)
{
    koksma__mesh *meshes = grow(scene->meshes, scene->n_meshes, sizeof *meshes);
    if (!meshes) {
        return koksma__fail_memory(2 * scene->n_meshes * sizeof *meshes);
    }
    scene->meshes = meshes;
    *out = &meshes[scene->n_meshes++];
    memset(*out, 0, sizeof **out);
    return KOKSMA_OK;
}

koksma_status koksma__scene_add_placement(koksma_scene *scene, koksma__placement **out)
{
    if (scene->n_placements == MAX_PLACEMENTS) {
        return koksma__fail(KOKSMA_MALFORMED, "more than %d meshes and instances", MAX_PLACEMENTS);
    }
    koksma__placement *placements = grow(scene->placements, scene->n_placements, sizeof *placements);
    if (!placements) {
        return koksma__fail_memory(2 * scene->n_placements * sizeof *placements);
    }
    scene->placements = placements;
    *out = &placements[scene->n_placements++];
    memset(*out, 0, sizeof **out);
    (*out)->light = (*out)->material = -1;
    return KOKSMA_OK;
}

/* A positive number, or three. */
static koksma_status parse_scale(const field *f, double scale[3])
{
    field node;
    if (!koksma__json_has(f, "scale")) {
        return KOKSMA_OK;
    }
    koksma_status status = koksma__json_member(f, "scale", &node);
    if (!status && koksma__json_is_array(&node)) {
        return koksma__json_numbers(&node, TINY, FAR, 3, scale);
    }
    status = status ? status : koksma__json_number(&node, TINY, FAR, &scale[0]);
    scale[1] = scale[2] = scale[0];
    return status;
}

static koksma_status parse_place(const field *f, const koksma__mesh *mesh, koksma__placement *p)
{
    double translate[3] = {0}, rotate_deg[3] = {0}, scale[3] = {1, 1, 1};
    koksma_status status = koksma__json_get_numbers(f, "translate", false, -FAR, FAR, 3, translate);
    status = status ? status : koksma__json_get_numbers(f, "rotate_deg", false, -360, 360, 3, rotate_deg);
    status = status ? status : parse_scale(f, scale);
    status = status ? status : koksma__json_get_numbers(f, "motion", false, -FAR, FAR, 3, p->motion);
    if (status) {
        return status;
    }
    koksma__placement_matrix(translate, rotate_deg, scale, p->matrix);
    koksma__placement_box(mesh, p);
    for (int k = 0; k < 3; k++) {
        if (!(p->low[k] >= -FAR && p->high[k] <= FAR)) {
            return koksma__json_fail(f, "it reaches beyond 1e6");
        }
    }
    return KOKSMA_OK;
}

static koksma_status parse_emission(const field *f, koksma_scene *scene, koksma__placement *p)
{
    double radiance[3];
    const koksma_status status = koksma__parse_colour(f, "emission", true, BRIGHT, radiance);
    if (status) {
        return status;
    }
    if (p->motion[0] != 0 || p->motion[1] != 0 || p->motion[2] != 0 || p->smooth) {
        return koksma__json_fail(f, "a light is neither smooth nor does it move");
    }
    const koksma_status added = koksma__scene_add_glow(scene, p, radiance);
    return added ? koksma__json_fail_in(f, added) : KOKSMA_OK;
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
    if (!has_area(&scene->meshes[p->mesh], p)) {
        return koksma__fail(KOKSMA_MALFORMED, "a luminous mesh has no area where it stands");
    }
    const koksma_status status = koksma__scene_add_light(scene, &light);
    if (!status) {
        light->kind = &koksma__light_mesh;
        light->placement = (int)(p - scene->placements);
        light->visible = true;
        memcpy(light->radiance, radiance, sizeof light->radiance);
        p->light = (int)(light - scene->lights);
        p->material = -1;
    }
    return status;
}

/* "material", or "emission": the radiance of a light. */
static koksma_status parse_surface(const field *f, koksma_scene *scene, const koksma__mesh *mesh,
                                   koksma__placement *p)
{
    const char *name = "";
    if (koksma__json_has(f, "emission") == koksma__json_has(f, "material")) {
        return koksma__json_fail(f, "it takes one of 'material' and 'emission'");
    }
    if (koksma__json_has(f, "emission")) {
        return parse_emission(f, scene, p);
    }
    const koksma_status status = koksma__json_get_text(f, "material", true, &name);
    if (status) {
        return status;
    }
    p->material = koksma__find_material(scene, name);
    if (p->material < 0) {
        return koksma__json_fail(f, "no material '%s'", name);
    }
    if ((scene->materials[p->material].checker || scene->materials[p->material].image) && !mesh->uvs) {
        return koksma__json_fail(f, "a mesh without texture coordinates takes no checker and no image");
    }
    return KOKSMA_OK;
}

static koksma_status place(const field *f, koksma_scene *scene, int mesh)
{
    koksma__placement *p = NULL;
    koksma_status status = koksma__scene_add_placement(scene, &p);
    if (status) {
        return koksma__json_fail_in(f, status);
    }
    p->mesh = mesh;
    status = parse_place(f, &scene->meshes[mesh], p);
    status = status ? status : koksma__json_get_flag(f, "smooth", false, &p->smooth);
    status = status ? status : parse_surface(f, scene, &scene->meshes[mesh], p);
    return status ? status : p->smooth ? koksma__mesh_smooth(&scene->meshes[mesh]) : KOKSMA_OK;
}

static int find_mesh(const koksma_scene *scene, const char *name)
{
    for (size_t i = 0; *name && i < scene->n_meshes; i++) {
        if (!strcmp(scene->meshes[i].name, name)) {
            return (int)i;
        }
    }
    return -1;
}

koksma_status koksma__parse_mesh(const char *scene_name, const field *f, koksma_scene *scene)
{
    const char *file = "", *name = "";
    char path[KOKSMA__MAX_PATH];
    koksma__mesh *mesh = NULL;
    koksma_status status = koksma__json_only(f, KEYS("kind", "file", "name", "material", "emission", "translate",
                                                     "rotate_deg", "scale", "motion", "smooth"));
    status = status ? status : koksma__json_get_text(f, "file", true, &file);
    status = status ? status : koksma__json_get_text(f, "name", false, &name);
    if (status) {
        return status;
    }
    if (strlen(name) >= sizeof mesh->name) {
        return koksma__json_fail(f, "a name has at most %zu letters", sizeof mesh->name - 1);
    }
    if (find_mesh(scene, name) >= 0) {
        return koksma__json_fail(f, "a second mesh '%s'", name);
    }
    if (!koksma__path_beside(scene_name, file, path)) {
        return koksma__json_fail(f, "the path is too long");
    }
    status = koksma__scene_add_mesh(scene, &mesh);
    if (status) {
        return status;
    }
    strcpy(mesh->name, name);
    status = koksma__mesh_read(path, mesh);
    if (status) {
        koksma__json_fail(f, "%s%s", koksma_error_text(), status == KOKSMA_MISSING ? koksma__package_hint(path) : "");
        return status;
    }
    scene->hash ^= koksma__mesh_hash(mesh) + scene->n_meshes;
    return place(f, scene, (int)scene->n_meshes - 1);
}

koksma_status koksma__parse_instance(const field *f, koksma_scene *scene)
{
    const char *of = "";
    koksma_status status = koksma__json_only(
        f, KEYS("kind", "of", "material", "emission", "translate", "rotate_deg", "scale", "motion", "smooth"));
    status = status ? status : koksma__json_get_text(f, "of", true, &of);
    if (status) {
        return status;
    }
    const int mesh = find_mesh(scene, of);
    return mesh < 0 ? koksma__json_fail(f, "no mesh named '%s' before it", of) : place(f, scene, mesh);
}
