/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The table of shapes, and the conversion of shapes from the scene's doubles to the floats that the loops use. A
 * converted shape stores its kind as an index in the table, by which the code for each instruction set finds its
 * loops (batch_shapes.c).
 */
#include "render/shapes/shapes.h"

const koksma__shape_type *const koksma__shape_types[] = {
#define SHAPE(name) &KOKSMA__SHAPE(name),
#define COMPOUND(name) &koksma__shape_##name,
#define COMPOUND_OF(name, file) COMPOUND(name)
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
    (void)name, (void)scene;
    return koksma__parse_axes(f, shape->normal, shape->axis_u, shape->axis_v);
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
        s.moves |= from->motion[k] != 0;
        s.normal[k] = (float)from->normal[k];
        s.axis_u[k] = (float)from->axis_u[k];
        s.axis_v[k] = (float)from->axis_v[k];
    }
    s.half_u = (float)from->half[0];
    s.half_v = (float)from->half[1];
    s.radius2 = (float)(radius * radius);
    s.inverse_radius = (float)(1 / radius);
    return s;
}
