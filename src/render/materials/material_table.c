/* SPDX-License-Identifier: Apache-2.0 */
/* The table of materials, by kind; the order of the lines of materials.def means nothing. */
#include "render/materials/materials.h"
#include "render/vector3.h"

static const koksma__material_rules *const table[] = {
#define MATERIAL(name, kind) [KOKSMA__MATERIAL_##kind] = &koksma__material_##name,
#include "render/materials/materials.def"
#undef MATERIAL
};

enum {
    LINES = 0
#define MATERIAL(name, kind) +1
#include "render/materials/materials.def"
#undef MATERIAL
};

_Static_assert((int)LINES == (int)KOKSMA__N_MATERIAL_KINDS &&
                   sizeof table / sizeof *table == KOKSMA__N_MATERIAL_KINDS,
               "materials.def has one line a kind");

const koksma__material_rules *koksma__material_rules_of(koksma__material_kind kind)
{
    return table[kind];
}

koksma__substance koksma__substance_of(const koksma__material *from)
{
    koksma__substance s = {.kind = from->kind,
                           .image = from->image,
                           .lobes = table[from->kind]->lobes,
                           .exponent = (float)from->exponent,
                           .roughness = (float)from->roughness,
                           .ior = (float)from->ior};
    for (int k = 0; k < 3; k++) {
        s.albedo[0][k] = (float)from->albedo[0][k];
        s.albedo[1][k] = (float)from->albedo[1][k];
        s.reflectance[k] = (float)from->reflectance[k];
    }
    const float diffuse = koksma__luminance3(s.albedo[0]) + koksma__luminance3(s.albedo[1]);
    const float all = diffuse + 2 * koksma__luminance3(s.reflectance);
    s.diffuse_share = all > 0 ? diffuse / all : 1;
    return s;
}
