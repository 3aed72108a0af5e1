/* SPDX-License-Identifier: Apache-2.0 */
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/vector.h"
#include "scene/parse.h"

koksma_status koksma__parse_room(const field *f, koksma_scene *scene, koksma__shape **out)
{
    if (scene->n_shapes == KOKSMA__MAX_SHAPES) {
        return koksma__json_fail(f, "more than %d shapes", KOKSMA__MAX_SHAPES);
    }
    koksma__shape *shapes =
        koksma__room_for_one(scene->shapes, scene->n_shapes, &scene->shape_room, 16, sizeof *shapes);
    if (!shapes) {
        return KOKSMA_MEMORY;
    }
    scene->shapes = shapes;
    *out = &scene->shapes[scene->n_shapes++];
    memset(*out, 0, sizeof **out);
    (*out)->light = -1;
    return KOKSMA_OK;
}

static koksma_status parse_flat_frame(const field *f, koksma__shape *shape)
{
    koksma_status status = koksma__parse_point(f, "centre", shape->centre);
    status = status ? status : koksma__parse_direction(f, "normal", shape->normal);
    return status ? status : koksma__parse_axes(f, shape->normal, shape->axis_u, shape->axis_v);
}

/* A new shape from an object with no other fields than `keys`. */
static koksma_status begin(const field *f, const char *const *keys, koksma__shape_kind kind, int material,
                           koksma_scene *scene, koksma__shape **out)
{
    koksma_status status = koksma__json_only(f, keys);
    status = status ? status : koksma__parse_room(f, scene, out);
    if (!status) {
        (*out)->kind = kind;
        (*out)->material = material;
    }
    return status;
}

static koksma_status parse_plane(const field *f, int material, koksma_scene *scene)
{
    koksma__shape *shape = NULL;
    const koksma_status status =
        begin(f, KEYS("kind", "material", "centre", "normal", "up"), KOKSMA__SHAPE_PLANE, material, scene, &shape);
    if (status) {
        return status;
    }
    shape->half[0] = shape->half[1] = INFINITY;
    return parse_flat_frame(f, shape);
}

static koksma_status parse_rectangle(const field *f, int material, koksma_scene *scene)
{
    koksma__shape *shape = NULL;
    koksma_status status = begin(f, KEYS("kind", "material", "centre", "normal", "up", "half"),
                                 KOKSMA__SHAPE_RECTANGLE, material, scene, &shape);
    status = status ? status : koksma__parse_half(f, shape->half);
    return status ? status : parse_flat_frame(f, shape);
}

static koksma_status parse_disk(const field *f, int material, koksma_scene *scene)
{
    koksma__shape *shape = NULL;
    koksma_status status = begin(f, KEYS("kind", "material", "centre", "normal", "up", "radius"), KOKSMA__SHAPE_DISK,
                                 material, scene, &shape);
    status = status ? status : koksma__parse_radius(f, shape->half);
    return status ? status : parse_flat_frame(f, shape);
}

static koksma_status parse_sphere(const field *f, int material, koksma_scene *scene)
{
    koksma__shape *shape = NULL;
    koksma_status status = begin(f, KEYS("kind", "material", "centre", "radius", "motion"), KOKSMA__SHAPE_SPHERE,
                                 material, scene, &shape);
    if (!status && scene->materials[material].checker) {
        return koksma__json_fail(f, "a sphere takes no checker");
    }
    status = status ? status : koksma__parse_radius(f, shape->half);
    status = status ? status : koksma__parse_point(f, "centre", shape->centre);
    return !status && koksma__json_has(f, "motion") ? koksma__parse_point(f, "motion", shape->motion) : status;
}

/* Side `side` (0 to 5: -x +x -y +y -z +z of its own axes) of a box: a rectangle that faces outwards, in the frame
   that a rectangle with this normal has: v is y, and -z for top and bottom, the box's own; u = v x normal. */
static void make_side(koksma__shape *shape, const double centre[3], double axes[3][3], const double half[3], int side)
{
    const int along = side / 2;
    const double sign = side % 2 ? 1 : -1;
    shape->kind = KOKSMA__SHAPE_RECTANGLE;
    for (int k = 0; k < 3; k++) {
        shape->centre[k] = centre[k] + sign * half[along] * axes[along][k];
        shape->normal[k] = sign * axes[along][k];
        shape->axis_v[k] = along == 1 ? -axes[2][k] : axes[1][k];
    }
    koksma__cross(shape->axis_v, shape->normal, shape->axis_u);
    shape->half[0] = half[along == 0 ? 2 : 0];
    shape->half[1] = half[along == 1 ? 2 : 1];
}

static koksma_status parse_box(const field *f, int material, koksma_scene *scene)
{
    double centre[3], half[3], angle_deg = 0;
    koksma_status status = koksma__json_only(f, KEYS("kind", "material", "centre", "half", "angle_deg"));
    status = status ? status : koksma__parse_point(f, "centre", centre);
    status = status ? status : koksma__json_get_numbers(f, "half", true, 0, FAR, 3, half);
    status = status ? status : koksma__json_get_number(f, "angle_deg", false, -360, 360, &angle_deg);
    if (!status && !(half[0] > TINY && half[1] > TINY && half[2] > TINY)) {
        return koksma__json_fail(f, "zero volume");
    }
    const double c = cos(angle_deg * TURN / 360), s = sin(angle_deg * TURN / 360);
    double axes[3][3] = {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
    for (int side = 0; !status && side < 6; side++) {
        koksma__shape *shape = NULL;
        status = koksma__parse_room(f, scene, &shape);
        if (!status) {
            make_side(shape, centre, axes, half, side);
            shape->material = material;
        }
    }
    return status;
}

static const struct {
    const char *name;
    koksma_status (*parse)(const field *f, int material, koksma_scene *scene);
} kinds[] = {{"plane", parse_plane},
             {"rectangle", parse_rectangle},
             {"disk", parse_disk},
             {"sphere", parse_sphere},
             {"box", parse_box}};

koksma_status koksma__parse_shape(const char *scene_name, const field *f, koksma_scene *scene)
{
    const char *kind = "", *name = "";
    koksma_status status = koksma__parse_kind(f, "plane rectangle disk sphere box mesh instance", &kind);
    if (!status && !strcmp(kind, "mesh")) {
        return koksma__parse_mesh(scene_name, f, scene);
    }
    if (!status && !strcmp(kind, "instance")) {
        return koksma__parse_instance(f, scene);
    }
    status = status ? status : koksma__json_get_text(f, "material", true, &name);
    const int material = status ? -1 : koksma__find_material(scene, name);
    if (!status && material < 0) {
        return koksma__json_fail(f, "no material '%s'", name);
    }
    if (!status && scene->materials[material].image && strcmp(kind, "rectangle") && strcmp(kind, "box")) {
        return koksma__json_fail(f, "only rectangles, boxes and meshes take an image");
    }
    for (size_t i = 0; !status && i < sizeof kinds / sizeof *kinds; i++) {
        if (!strcmp(kinds[i].name, kind)) {
            return kinds[i].parse(f, material, scene);
        }
    }
    return status;
}
