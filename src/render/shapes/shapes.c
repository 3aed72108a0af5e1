/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The table of shapes, and the conversion of shapes from the scene's doubles to the floats that the loops use. A
 * converted shape stores its kind as an index in the table, by which the code for each instruction set finds its
 * loops (batch_shapes.c).
 */
#include "render/shapes/shapes.h"

#include <math.h>

#include "core/elementary.h"
#include "core/status.h"

const koksma__shape_type *const koksma__shape_types[] = {
#define SHAPE(name) &KOKSMA__SHAPE(name),
#define COMPOUND(name) &koksma__shape_##name,
#include "render/shapes/shapes.def"
#undef SHAPE
#undef COMPOUND
    NULL};

const koksma__kind *const koksma__shape_kinds[] = {
#define SHAPE(name) &KOKSMA__SHAPE(name).kind,
#define COMPOUND(name) &koksma__shape_##name.kind,
#include "render/shapes/shapes.def"
    NULL};

koksma_status koksma__shape_axes(const char *name, const field *f, koksma_scene *scene, koksma__shape *shape)
{
    const koksma_status status = koksma__parse_axes(f, shape->normal, shape->axis_u, shape->axis_v);
    (void)name, (void)scene;
    return status ? status : koksma__shape_motion(f, true, shape);
}

/* Sets the motion from time 0 to 1: the centre moves to `to`, and the shape turns by rotate_deg (defined as for
   meshes, in meshes/mesh.h) along the shorter arc and is scaled by `scale`. */
static void set_turn(koksma__shape *shape, const double to[3], const double rotate_deg[3], double scale)
{
    static const double none[3] = {0}, same[3] = {1, 1, 1};
    const koksma__pose pose = koksma__pose_of(none, rotate_deg, same);
    const double sign = pose.rotation[0] < 0 ? -1 : 1, *axis = pose.rotation + 1;
    const double sine = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    shape->turn.turns = true;
    shape->turn.scale = scale;
    shape->turn.angle_rad = 2 * koksma__atan2(sine, sign * pose.rotation[0]);
    for (int k = 0; k < 3; k++) {
        shape->motion[k] = to[k] - shape->centre[k];
        shape->turn.pivot[k] = shape->centre[k];
        shape->turn.axis[k] = sine > 0 ? sign * axis[k] / sine : k == 1;
    }
}

koksma_status koksma__shape_motion(const field *f, bool has_motion, koksma__shape *shape)
{
    field node;
    double motion[3] = {0}, rotate_deg[3] = {0}, to[3], scale = 1;
    if (has_motion) {
        KOKSMA__TRY(koksma__json_get_numbers(f, "motion", false, -FAR, FAR, 3, motion));
    }
    for (int k = 0; k < 3; k++) {
        to[k] = shape->centre[k] + motion[k];
    }
    if (koksma__json_has(f, "to")) {
        KOKSMA__JSON_FAIL_IF(koksma__json_has(f, "motion"), f, "it takes one of 'motion' and 'to'");
        KOKSMA__TRY(koksma__json_member(f, "to", &node));
        KOKSMA__TRY(koksma__json_only(&node, KEYS("centre", "rotate_deg", "scale")));
        KOKSMA__TRY(koksma__json_get_numbers(&node, "centre", false, -FAR, FAR, 3, to));
        KOKSMA__TRY(koksma__json_get_numbers(&node, "rotate_deg", false, -360, 360, 3, rotate_deg));
        KOKSMA__TRY(koksma__json_get_number(&node, "scale", false, TINY, FAR, &scale));
    }
    if (koksma__json_has(f, "to") || motion[0] != 0 || motion[1] != 0 || motion[2] != 0) {
        set_turn(shape, to, rotate_deg, scale);
    }
    return KOKSMA_OK;
}

koksma__batch_shape koksma__batch_shape_of(const koksma__shape *from, int32_t id)
{
    const double radius = from->type->radius ? from->type->radius(from) : from->half[0];
    koksma__batch_shape s = {.is_flat = from->type->is_flat, .id = id, .material = from->material};
    while (koksma__shape_types[s.kind] != from->type) {
        s.kind++;
    }
    for (int k = 0; k < 3; k++) {
        s.centre[k] = (float)from->centre[k];
        s.motion[k] = (float)from->motion[k];
        s.moves |= !from->turn.turns && from->motion[k] != 0;
        s.pivot[k] = (float)from->turn.pivot[k];
        s.axis[k] = (float)from->turn.axis[k];
        s.normal[k] = (float)from->normal[k];
        s.axis_u[k] = (float)from->axis_u[k];
        s.axis_v[k] = (float)from->axis_v[k];
    }
    s.turns = from->turn.turns;
    s.angle = (float)(from->turn.angle_rad / TURN);
    s.growth = (float)(from->turn.scale - 1);
    s.half_u = (float)from->half[0];
    s.half_v = (float)from->half[1];
    s.radius2 = (float)(radius * radius);
    s.inverse_radius = (float)(1 / radius);
    return s;
}
