/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The table of materials, and the conversion of materials from the scene's doubles to the renderer's floats. A kind
 * is identified by the address of its entry, never by a number, so that the order of the lines of materials.def
 * affects only the order of lists.
 */
#include "render/materials/materials.h"

#include <string.h>

const koksma__bsdf *const koksma__bsdfs[] = {
#define MATERIAL(name) &koksma__bsdf_##name,
#include "render/materials/materials.def"
#undef MATERIAL
    NULL};

const koksma__kind *const koksma__material_kinds[] = {
#define MATERIAL(name) &koksma__bsdf_##name.kind,
#include "render/materials/materials.def"
#undef MATERIAL
    NULL};

const char *const *koksma__material_keys(const koksma__bsdf *bsdf)
{
    static const char *const keys[4][8] = {
        {"name", "kind"},
        {"name", "kind", "albedo"},
        {"name", "kind", "albedos", "period", "phase", "angle_deg"},
        {"name", "kind", "albedo", "albedos", "period", "phase", "angle_deg"},
    };
    return keys[(bsdf->diffuse & (KOKSMA__ALBEDO | KOKSMA__IMAGE) ? 1 : 0) +
                (bsdf->diffuse & KOKSMA__CHECKER ? 2 : 0)];
}

double *koksma__material_value(koksma__material *material, const char *name)
{
    const koksma__parameter *p = material->bsdf->kind.parameters;
    while (strcmp(p->name, name) != 0) {
        p++;
    }
    return (double *)(void *)((char *)material + p->at);
}

koksma__shading_material koksma__shading_material_of(const koksma__material *from)
{
    koksma__shading_material m = {.bsdf = from->bsdf, .image = from->image, .from = from};
    for (int k = 0; k < 3; k++) {
        m.albedo[0][k] = (float)from->albedo[0][k];
        m.albedo[1][k] = (float)from->albedo[1][k];
    }
    for (int i = 0; i < KOKSMA__MAX_VALUES; i++) {
        m.values[i] = (float)from->values[i];
    }
    if (m.bsdf->prepare) {
        m.bsdf->prepare(&m);
    }
    return m;
}
