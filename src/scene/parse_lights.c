/* SPDX-License-Identifier: Apache-2.0 */
/* Lights of a scene file: the kinds, their fields and what they refuse come from the table of render/lights. */
#include "render/lights/lights.h"
#include "scene/parse.h"

koksma_status koksma__parse_light(const char *name, const field *f, koksma_scene *scene)
{
    size_t kind = 0;
    koksma__light *light = NULL;
    koksma_status status = koksma__parse_kind(f, koksma__light_kinds, &kind);
    if (!status && (status = koksma__scene_add_light(scene, &light))) {
        status = koksma__json_fail_in(f, status);
    }
    if (status) {
        return status;
    }
    light->kind = koksma__light_types[kind];
    status = koksma__parse_fields(f, &light->kind->kind, KEYS("kind"), light);
    return !status && light->kind->parse ? light->kind->parse(name, f, scene, light) : status;
}
