/* SPDX-License-Identifier: Apache-2.0 */
/* Lists the kinds of materials, lights and shapes that scene files may contain, and the fields of each, from the
   tables in src/render. */
#include <stdio.h>
#include <string.h>

#include "core/status.h"
#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "render/shapes/shapes.h"

static void add_fields(koksma_entry *to, const char *const *names)
{
    for (size_t i = 0; names && names[i]; i++) {
        const size_t used = strlen(to->fields);
        snprintf(to->fields + used, sizeof to->fields - used, "%s%s", used ? " " : "", names[i]);
    }
}

bool koksma_scene_kind_at(const char *member, size_t i, koksma_entry *out)
{
    KOKSMA__REQUIRE_OR(false, member, out);
    const bool materials = !strcmp(member, "materials"), lights = !strcmp(member, "lights");
    const koksma__kind *const *kinds = materials                   ? koksma__material_kinds
                                       : lights                    ? koksma__light_kinds
                                       : !strcmp(member, "shapes") ? koksma__shape_kinds
                                                                   : NULL;
    for (size_t k = 0, left = i; kinds && kinds[k]; k++) {
        if (kinds[k]->is_implied || left-- > 0) {
            continue;
        }
        *out = (koksma_entry){.name = kinds[k]->name, .title = kinds[k]->title, .cite = kinds[k]->cite};
        add_fields(out, materials ? koksma__material_keys(koksma__bsdfs[k])
                        : lights  ? KEYS("kind")
                                  : KEYS("kind", "material"));
        for (const koksma__parameter *p = kinds[k]->parameters; p && p->name; p++) {
            add_fields(out, KEYS(p->name));
        }
        add_fields(out, kinds[k]->keys);
        return true;
    }
    return false;
}
