/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Shapes of a scene file: kinds as rows with their parameters, and what makes shapes of the renderer of them. A box
 * becomes six rectangles; meshes and instances are parse_meshes.c.
 */
#include <stdlib.h>
#include <string.h>

#include "core/vector.h"
#include "scene/parse.h"

/* A row: the fields of a kind, and what they become. material: the number of the shape's material. */
typedef struct shape_row {
    koksma__kind kind;
    koksma__shape_kind shape;
    bool takes_image;
    koksma_status (*finish)(const field *f, koksma_scene *scene, koksma__shape *shape);
} shape_row;

static koksma_status finish_plane(const field *f, koksma_scene *scene, koksma__shape *shape)
{
    (void)scene;
    shape->half[0] = shape->half[1] = INFINITY;
    return koksma__parse_axes(f, shape->normal, shape->axis_u, shape->axis_v);
}

static koksma_status finish_flat(const field *f, koksma_scene *scene, koksma__shape *shape)
{
    (void)scene;
    return koksma__parse_axes(f, shape->normal, shape->axis_u, shape->axis_v);
}

static koksma_status finish_sphere(const field *f, koksma_scene *scene, koksma__shape *shape)
{
    return scene->materials[shape->material].checker ? koksma__json_fail(f, "a sphere takes no checker") : KOKSMA_OK;
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

/* `first` becomes the first side; five more are added. */
static koksma_status finish_box(const field *f, koksma_scene *scene, koksma__shape *first)
{
    double centre[3], half[3], angle_deg = 0;
    const int material = first->material;
    koksma_status status = koksma__json_get_numbers(f, "half", true, 0, FAR, 3, half);
    status = status ? status : koksma__json_get_number(f, "angle_deg", false, -360, 360, &angle_deg);
    if (!status && !(half[0] > TINY && half[1] > TINY && half[2] > TINY)) {
        return koksma__json_fail(f, "zero volume");
    }
    memcpy(centre, first->centre, sizeof centre);
    const double c = cos(angle_deg * TURN / 360), s = sin(angle_deg * TURN / 360);
    double axes[3][3] = {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
    for (int side = 0; !status && side < 6; side++) {
        koksma__shape *shape = first;
        status = side ? koksma__scene_add_shape(scene, &shape) : KOKSMA_OK;
        if (!status) {
            make_side(shape, centre, axes, half, side);
            shape->material = material;
        }
    }
    return status;
}

#define CENTRE                                                                                                       \
    {                                                                                                                \
        "centre", KOKSMA__POINT, .at = offsetof(koksma__shape, centre)                                               \
    }
#define NORMAL                                                                                                       \
    {                                                                                                                \
        "normal", KOKSMA__DIRECTION, .at = offsetof(koksma__shape, normal)                                           \
    }

static const char *const up[] = {"up", NULL};

static const shape_row rows[] = {
    {{.name = "plane",
      .title = "an endless plane",
      .parameters = (const koksma__parameter[]){CENTRE, NORMAL, {0}},
      .keys = up},
     KOKSMA__SHAPE_PLANE,
     .finish = finish_plane},
    {{.name = "rectangle",
      .title = "a rectangle of half sides `half` along u and v",
      .parameters =
          (const koksma__parameter[]){
              {"half", KOKSMA__HALF, .at = offsetof(koksma__shape, half)}, CENTRE, NORMAL, {0}},
      .keys = up},
     KOKSMA__SHAPE_RECTANGLE,
     .takes_image = true,
     .finish = finish_flat},
    {{.name = "disk",
      .title = "a disk",
      .parameters =
          (const koksma__parameter[]){
              {"radius", KOKSMA__RADIUS, .at = offsetof(koksma__shape, half)}, CENTRE, NORMAL, {0}},
      .keys = up},
     KOKSMA__SHAPE_DISK,
     .finish = finish_flat},
    {{.name = "sphere",
      .title = "a sphere, which may move",
      .parameters =
          (const koksma__parameter[]){{"radius", KOKSMA__RADIUS, .at = offsetof(koksma__shape, half)},
                                      CENTRE,
                                      {"motion", KOKSMA__POINT, true, .at = offsetof(koksma__shape, motion)},
                                      {0}}},
     KOKSMA__SHAPE_SPHERE,
     .finish = finish_sphere},
    {{.name = "box",
      .title = "six rectangles, turned about y",
      .parameters = (const koksma__parameter[]){CENTRE, {0}},
      .keys = (const char *const[]){"half", "angle_deg", NULL}},
     KOKSMA__SHAPE_RECTANGLE,
     .takes_image = true,
     .finish = finish_box},
};

static const koksma__kind mesh = {.name = "mesh", .title = "the triangles of a file"};
static const koksma__kind instance = {.name = "instance", .title = "the mesh of that name once more"};
static const koksma__kind *const kinds[] = {&rows[0].kind, &rows[1].kind, &rows[2].kind, &rows[3].kind,
                                            &rows[4].kind, &mesh,         &instance,     NULL};

static koksma_status parse_row(const field *f, const shape_row *row, int material, koksma_scene *scene)
{
    koksma__shape *shape = NULL;
    koksma_status status = koksma__scene_add_shape(scene, &shape);
    if (status) {
        return koksma__json_fail_in(f, status);
    }
    shape->kind = row->shape;
    shape->material = material;
    status = koksma__parse_fields(f, &row->kind, KEYS("kind", "material"), shape);
    return status ? status : row->finish(f, scene, shape);
}

koksma_status koksma__parse_shape(const char *scene_name, const field *f, koksma_scene *scene)
{
    size_t kind = 0;
    const char *name = "";
    koksma_status status = koksma__parse_kind(f, kinds, &kind);
    if (!status && kinds[kind] == &mesh) {
        return koksma__parse_mesh(scene_name, f, scene);
    }
    if (!status && kinds[kind] == &instance) {
        return koksma__parse_instance(f, scene);
    }
    status = status ? status : koksma__json_get_text(f, "material", true, &name);
    const int material = status ? -1 : koksma__find_material(scene, name);
    if (!status && material < 0) {
        return koksma__json_fail(f, "no material '%s'", name);
    }
    if (!status && scene->materials[material].image && !rows[kind].takes_image) {
        return koksma__json_fail(f, "only rectangles, boxes and meshes take an image");
    }
    return status ? status : parse_row(f, &rows[kind], material, scene);
}
