/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Shapes of a scene file: the kinds, their fields and what they refuse come from the table of render/shapes. Here is
 * the field that all have: "material", or for some kinds "emission" in its place.
 */
#include <stdio.h>
#include <string.h>

#include "render/shapes/shapes.h"
#include "scene/parse.h"

static koksma_status refuse_image(const field *f)
{
    char known[256] = "";
    for (size_t i = 0; koksma__shape_types[i]; i++) {
        const size_t used = strlen(known);
        if (koksma__shape_types[i]->takes_image) {
            snprintf(known + used, sizeof known - used, " %s", koksma__shape_types[i]->kind.name);
        }
    }
    return koksma__json_fail(f, "it takes no material with an image; these do:%s", known);
}

/* The number of the material; -1 for emission. */
static koksma_status parse_material(const field *f, const koksma_scene *scene, koksma__shape *shape)
{
    const char *name = "";
    KOKSMA__JSON_FAIL_IF(shape->type->may_emit && koksma__json_has(f, "emission") == koksma__json_has(f, "material"),
                         f, "it takes one of 'material' and 'emission'");
    if (shape->type->may_emit && koksma__json_has(f, "emission")) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__json_get_text(f, "material", true, &name);
    shape->material = status ? -1 : koksma__find_material(scene, name);
    if (status || shape->material < 0) {
        return status ? status : koksma__json_fail(f, "no material '%s'", name);
    }
    const koksma__material *m = &scene->materials[shape->material];
    KOKSMA__JSON_FAIL_IF(m->checker && !shape->type->takes_checker, f, "a %s takes no checker",
                         shape->type->kind.name);
    return m->image && !shape->type->takes_image ? refuse_image(f) : KOKSMA_OK;
}

koksma_status koksma__parse_shape(const char *scene_name, const field *f, koksma_scene *scene)
{
    size_t kind = 0;
    koksma_status status = koksma__parse_kind(f, koksma__shape_kinds, &kind);
    koksma__shape shape = {.type = koksma__shape_types[kind], .material = -1, .light = -1}, *added;
    status = status ? status : koksma__parse_fields(f, &shape.type->kind, KEYS("kind", "material"), &shape);
    status = status ? status : parse_material(f, scene, &shape);
    if (!status && shape.type->parse) {
        status = shape.type->parse(scene_name, f, scene, &shape);
    }
    if (!status && shape.type->hit && (status = koksma__scene_add_shape(scene, &shape, &added))) {
        status = koksma__json_fail_in(f, status);
    }
    return status;
}
