/* SPDX-License-Identifier: Apache-2.0 */
/*
 * mesh and instance: they have a file, a placement and a material. A mesh is read once; its instances are placements
 * of the same triangles. Embree intersects them (accel/accel_embree.c).
 */
#include <string.h>

#include "core/status.h"
#include "meshes/mesh_read.h"
#include "render/placements.h"
#include "render/shapes/shapes.h"

/* Reads a positive number, or three. */
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

static koksma_status parse_placement(const field *f, const koksma__mesh *mesh, koksma__placement *p)
{
    double translate[3] = {0}, rotate_deg[3] = {0}, scale[3] = {1, 1, 1};
    KOKSMA__TRY(koksma__json_get_numbers(f, "translate", false, -FAR, FAR, 3, translate));
    KOKSMA__TRY(koksma__json_get_numbers(f, "rotate_deg", false, -360, 360, 3, rotate_deg));
    KOKSMA__TRY(parse_scale(f, scale));
    KOKSMA__TRY(koksma__json_get_numbers(f, "motion", false, -FAR, FAR, 3, p->motion));
    koksma__placement_matrix(translate, rotate_deg, scale, p->matrix);
    koksma__placement_box(mesh, p);
    for (int k = 0; k < 3; k++) {
        KOKSMA__JSON_FAIL_IF(!(p->low[k] >= -FAR && p->high[k] <= FAR), f, "it reaches beyond 1e6");
    }
    return KOKSMA_OK;
}

static koksma_status parse_emission(const field *f, koksma_scene *scene, koksma__placement *p)
{
    double radiance[3];
    KOKSMA__TRY(koksma__parse_colour(f, "emission", true, BRIGHT, radiance));
    KOKSMA__JSON_FAIL_IF(p->motion[0] != 0 || p->motion[1] != 0 || p->motion[2] != 0 || p->smooth, f,
                         "a mesh that is a light can be neither smooth nor moving");
    const koksma_status added = koksma__scene_add_glow(scene, p, radiance);
    return added ? koksma__json_fail_in(f, added) : KOKSMA_OK;
}

static koksma_status add_placement(const field *f, koksma_scene *scene, int mesh, int material)
{
    koksma__placement *p = NULL;
    koksma_status status = koksma__scene_add_placement(scene, &p);
    if (status) {
        return koksma__json_fail_in(f, status);
    }
    p->mesh = mesh;
    p->material = material;
    status = parse_placement(f, &scene->meshes[mesh], p);
    status = status ? status : koksma__json_get_flag(f, "smooth", false, &p->smooth);
    if (!status && material < 0) {
        status = parse_emission(f, scene, p);
    } else if (!status && !scene->meshes[mesh].uvs &&
               (scene->materials[material].checker || scene->materials[material].image)) {
        status = koksma__json_fail(f, "a mesh without texture coordinates takes no checker and no image");
    }
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

static koksma_status parse_mesh(const char *scene_name, const field *f, koksma_scene *scene, koksma__shape *shape)
{
    const char *file = "", *name = "";
    char path[KOKSMA__MAX_PATH];
    koksma__mesh *mesh = NULL;
    KOKSMA__TRY(koksma__json_get_text(f, "file", true, &file));
    KOKSMA__TRY(koksma__json_get_text(f, "name", false, &name));
    KOKSMA__JSON_FAIL_IF(strlen(name) >= sizeof mesh->name, f, "a name has at most %zu letters",
                         sizeof mesh->name - 1);
    KOKSMA__JSON_FAIL_IF(find_mesh(scene, name) >= 0, f, "a second mesh '%s'", name);
    KOKSMA__JSON_FAIL_IF(!koksma__path_beside(scene_name, file, path), f, "the path is too long");
    KOKSMA__TRY(koksma__scene_add_mesh(scene, &mesh));
    strcpy(mesh->name, name);
    koksma_status status = koksma__mesh_read(path, mesh);
    if (status) {
        koksma__json_fail(f, "%s%s", koksma_error_text(), status == KOKSMA_MISSING ? koksma__package_hint(path) : "");
        return status;
    }
    scene->hash ^= koksma__mesh_hash(mesh) + scene->n_meshes;
    return add_placement(f, scene, (int)scene->n_meshes - 1, shape->material);
}

static koksma_status parse_instance(const char *scene_name, const field *f, koksma_scene *scene, koksma__shape *shape)
{
    const char *of = "";
    const koksma_status status = koksma__json_get_text(f, "of", true, &of);
    (void)scene_name;
    if (status) {
        return status;
    }
    const int mesh = find_mesh(scene, of);
    return mesh < 0 ? koksma__json_fail(f, "no mesh named '%s' before it", of)
                    : add_placement(f, scene, mesh, shape->material);
}

#define PLACEMENT "emission", "translate", "rotate_deg", "scale", "motion", "smooth"

const koksma__shape_type koksma__shape_mesh = {
    .kind = {.name = "mesh",
             .title = "the triangles of a file",
             .cite = "-",
             .keys = KEYS("file", "name", PLACEMENT)},
    .takes_checker = true,
    .takes_image = true,
    .may_emit = true,
    .parse = parse_mesh,
};

const koksma__shape_type koksma__shape_instance = {
    .kind = {.name = "instance",
             .title = "the mesh of that name once more",
             .cite = "-",
             .keys = KEYS("of", PLACEMENT)},
    .takes_checker = true,
    .takes_image = true,
    .may_emit = true,
    .parse = parse_instance,
};
