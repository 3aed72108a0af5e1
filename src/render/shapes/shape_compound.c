/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The shapes that are made of others: a box is six rectangles that face outwards, rotated about y by angle_deg; a mesh
 * has a file, a placement and a material; an instance is another placement of
 * the same triangles. So is a mesh whose file was read before, under whatever name of it. Embree intersects them
 * (accel/accel_embree.c).
 */
#include <stdio.h>
#include <string.h>

#include "core/capacity.h"
#include "core/elementary.h"
#include "core/status.h"
#include "core/vector.h"
#include "meshes/mesh_file.h"
#include "render/description_build.h"
#include "render/shapes/shapes.h"

/* ---- Boxes ------------------------------------------------------------------------------------------------------ */

/* Makes the side with number `side` (0 to 5: -x +x -y +y -z +z of the box's axes), a rectangle with the axes that a
   rectangle with this normal has by default: v is the box's y, or -z for top and bottom; u = v x normal. */
static void make_side(koksma__shape *shape, double axes[3][3], const double half[3], int side)
{
    const int along = side / 2;
    const double sign = side % 2 ? 1 : -1;
    shape->type = &KOKSMA__SHAPE(rectangle);
    for (int k = 0; k < 3; k++) {
        shape->centre[k] += sign * half[along] * axes[along][k];
        shape->normal[k] = sign * axes[along][k];
        shape->axis_v[k] = along == 1 ? -axes[2][k] : axes[1][k];
    }
    koksma__cross(shape->axis_v, shape->normal, shape->axis_u);
    shape->half[0] = half[along == 0 ? 2 : 0];
    shape->half[1] = half[along == 1 ? 2 : 1];
}

static koksma_status parse_box(const char *name, const field *f, koksma_scene *scene, koksma__shape *box)
{
    double half[3], angle_deg = 0;
    koksma_status status = koksma__json_get_numbers(f, "half", true, 0, FAR, 3, half);
    (void)name;
    status = status ? status : koksma__json_get_number(f, "angle_deg", false, -360, 360, &angle_deg);
    KOKSMA__JSON_FAIL_IF(!status && !(half[0] > TINY && half[1] > TINY && half[2] > TINY), f, "zero volume");
    status = status ? status : koksma__shape_motion(f, true, box);
    const double c = koksma__cos(angle_deg * TURN / 360), s = koksma__sin(angle_deg * TURN / 360);
    double axes[3][3] = {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
    for (int side = 0; !status && side < 6; side++) {
        koksma__shape *shape = NULL;
        status = koksma__scene_add_shape(scene, box, &shape);
        if (status) {
            return koksma__json_fail_in(f, status);
        }
        make_side(shape, axes, half, side);
    }
    return status;
}

const koksma__shape_type koksma__shape_box = {
    .kind = {.name = "box",
             .title = "six rectangles, turned about y",
             .cite = "-",
             .parameters =
                 (const koksma__parameter[]){{"centre", KOKSMA__POINT, .at = offsetof(koksma__shape, centre)}, {0}},
             .keys = KEYS("half", "angle_deg", "motion", "to"),
             .example = "\"half\": [0.2, 0.3, 0.4], \"angle_deg\": 20"},
    .takes_checker = true,
    .takes_image = true,
    .parse = parse_box,
};

/* ---- Meshes ----------------------------------------------------------------------------------------------------- */

/* Reads the field "scale": a positive number, or three of them. */
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

typedef struct transform {
    double translate[3], rotate_deg[3], scale[3];
} transform;

static koksma_status parse_transform(const field *f, transform *t)
{
    KOKSMA__TRY(koksma__json_get_numbers(f, "translate", false, -FAR, FAR, 3, t->translate));
    KOKSMA__TRY(koksma__json_get_numbers(f, "rotate_deg", false, -360, 360, 3, t->rotate_deg));
    return parse_scale(f, t->scale);
}

/* Computes the box of the placed mesh, which must lie within the coordinates of scenes. */
static koksma_status set_box(const field *f, const koksma__mesh *mesh, koksma__placement *p)
{
    koksma__placement_box(mesh, p);
    for (int k = 0; k < 3; k++) {
        KOKSMA__JSON_FAIL_IF(!(p->low[k] >= -FAR && p->high[k] <= FAR), f, "it reaches beyond 1e6");
    }
    return KOKSMA_OK;
}

/* Reads the field "to": the transform at time 1, whose members default to those at time 0. */
static koksma_status parse_to(const field *f, const koksma__mesh *mesh, const transform *from, koksma__placement *p)
{
    field node;
    transform to = *from;
    koksma__placement end = *p;
    KOKSMA__JSON_FAIL_IF(koksma__json_has(f, "motion"), f, "it takes one of 'motion' and 'to'");
    KOKSMA__TRY(koksma__json_member(f, "to", &node));
    KOKSMA__TRY(koksma__json_only(&node, KEYS("translate", "rotate_deg", "scale")));
    KOKSMA__TRY(parse_transform(&node, &to));
    p->poses[0] = koksma__pose_of(from->translate, from->rotate_deg, from->scale);
    p->poses[1] = koksma__pose_of(to.translate, to.rotate_deg, to.scale);
    p->steps = koksma__pose_steps(p->poses);
    koksma__placement_matrix(to.translate, to.rotate_deg, to.scale, end.matrix);
    return set_box(&node, mesh, &end);
}

static koksma_status parse_placement(const field *f, const koksma__mesh *mesh, koksma__placement *p)
{
    transform t = {.scale = {1, 1, 1}};
    KOKSMA__TRY(parse_transform(f, &t));
    KOKSMA__TRY(koksma__json_get_numbers(f, "motion", false, -FAR, FAR, 3, p->motion));
    koksma__placement_matrix(t.translate, t.rotate_deg, t.scale, p->matrix);
    KOKSMA__TRY(set_box(f, mesh, p));
    return koksma__json_has(f, "to") ? parse_to(f, mesh, &t, p) : KOKSMA_OK;
}

static koksma_status parse_emission(const field *f, koksma_scene *scene, koksma__placement *p)
{
    double radiance[3];
    KOKSMA__TRY(koksma__parse_colour(f, "emission", true, BRIGHT, radiance));
    KOKSMA__JSON_FAIL_IF(koksma__placement_moves(p) || p->smooth, f,
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
        status = koksma__json_fail(f, "a mesh without texture coordinates can't have a checker or an image");
    }
    return status ? status : p->smooth ? koksma__mesh_smooth(&scene->meshes[mesh]) : KOKSMA_OK;
}

/* Finds a mesh by its `name` or by its `file`; returns -1 if there is none. */
static int find_mesh(const koksma_scene *scene, const char *what, const char *name)
{
    char key[128];
    size_t mesh;
    snprintf(key, sizeof key, "%s %s", what, name);
    return *name && koksma__names_find(&scene->mesh_names, key, strlen(key), &mesh) ? (int)mesh : -1;
}

/* Lets find_mesh find a mesh, unless name is empty. */
static koksma_status keep_name(koksma_scene *scene, const char *what, const char *name, int mesh)
{
    char key[128];
    snprintf(key, sizeof key, "%s %s", what, name);
    return *name ? koksma__names_put(&scene->mesh_names, key, strlen(key), (size_t)mesh) : KOKSMA_OK;
}

/* Reads the mesh in a file, or finds it. The ending of a file's name tells how it is read, and its folder has the buffers
   that it names. */
static koksma_status find_or_read(const field *f, koksma_scene *scene, const char *path, int *out)
{
    char key[KOKSMA__FILE_KEY], folder[KOKSMA__FILE_KEY], beside[KOKSMA__MAX_PATH],
        file[2 * KOKSMA__FILE_KEY + 16] = "";
    const char *ending = strrchr(path, '.'), *slash = strrchr(path, '/');
    koksma__mesh *mesh = NULL;
    koksma__file_key(path, key);
    snprintf(beside, sizeof beside, "%.*s", slash ? (int)(slash - path) + 1 : 1, slash ? path : ".");
    koksma__file_key(beside, folder);
    if (*key) {
        snprintf(file, sizeof file, "%s %s%.15s", key, folder, ending ? ending : "");
    }
    *out = find_mesh(scene, "file", file);
    if (*out >= 0) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__scene_add_mesh(scene, &mesh));
    koksma_status status = koksma__mesh_read(path, KOKSMA__BY_FILE, &scene->mesh_files, mesh);
    status = status ? status : koksma__scene_limit_mesh(scene, mesh, path);
    if (status) {
        koksma__json_fail(f, "%s%s", koksma_error_text(), status == KOKSMA_MISSING ? koksma__package_hint(path) : "");
        return status;
    }
    koksma__scene_hash_mesh(scene, true);
    *out = (int)scene->n_meshes - 1;
    return keep_name(scene, "file", file, *out);
}

static koksma_status parse_mesh(const char *scene_name, const field *f, koksma_scene *scene, koksma__shape *shape)
{
    const char *file = "", *name = "";
    char path[KOKSMA__MAX_PATH];
    int mesh = -1;
    KOKSMA__TRY(koksma__json_get_text(f, "file", true, &file));
    KOKSMA__TRY(koksma__json_get_text(f, "name", false, &name));
    KOKSMA__JSON_FAIL_IF(strlen(name) >= sizeof scene->meshes->name, f, "a name has at most %zu letters",
                         sizeof scene->meshes->name - 1);
    KOKSMA__JSON_FAIL_IF(find_mesh(scene, "name", name) >= 0, f, "a second mesh '%s'", name);
    KOKSMA__JSON_FAIL_IF(!koksma__path_beside(scene_name, file, path), f, "the path is too long");
    const size_t before = scene->n_meshes;
    KOKSMA__TRY(find_or_read(f, scene, path, &mesh));
    KOKSMA__TRY(keep_name(scene, "name", name, mesh));
    if (scene->n_meshes > before) { /* the mesh has the name of the first shape of its file */
        strcpy(scene->meshes[mesh].name, name);
    }
    return add_placement(f, scene, mesh, shape->material);
}

static koksma_status parse_instance(const char *scene_name, const field *f, koksma_scene *scene, koksma__shape *shape)
{
    const char *of = "";
    const koksma_status status = koksma__json_get_text(f, "of", true, &of);
    (void)scene_name;
    if (status) {
        return status;
    }
    const int mesh = find_mesh(scene, "name", of);
    return mesh < 0 ? koksma__json_fail(f, "no mesh named '%s' before it", of)
                    : add_placement(f, scene, mesh, shape->material);
}

#define PLACEMENT "emission", "translate", "rotate_deg", "scale", "motion", "to", "smooth"

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
             .title = "another placement of the mesh that the field `of` names",
             .cite = "-",
             .keys = KEYS("of", PLACEMENT)},
    .takes_checker = true,
    .takes_image = true,
    .may_emit = true,
    .parse = parse_instance,
};
