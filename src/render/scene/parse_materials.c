/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads the materials of a scene file. The kinds of materials, their parameters and the allowed values come from
 * the table in render/materials. This file reads the fields that several kinds share: the name, and the diffuse
 * albedo, which is one colour, two colours in the squares of a checkerboard, or an image.
 */
#include "scene/parse_materials.h"

#include <string.h>

#include "render/description_build.h"
#include "render/materials/materials.h"

/* Reads "albedo", or for a checkerboard "albedos" and the size and position of its squares. */
static koksma_status parse_albedo(const field *f, koksma__material *m)
{
    field pair, item;
    size_t n = 0;
    double angle_deg = 0;
    if (!m->checker) {
        const koksma_status status = koksma__parse_colour(f, "albedo", true, 1, m->albedo[0]);
        memcpy(m->albedo[1], m->albedo[0], sizeof m->albedo[0]);
        return status;
    }
    koksma_status status = koksma__json_member(f, "albedos", &pair);
    status = status ? status : koksma__json_length(&pair, 2, &n);
    KOKSMA__JSON_FAIL_IF(!status && n != 2, &pair, "it takes 2 albedos");
    for (size_t i = 0; !status && i < 2; i++) {
        item = koksma__json_item(&pair, i);
        status = koksma__parse_colour_value(&item, 1, m->albedo[i]);
    }
    m->period = 1;
    status = status ? status : koksma__json_get_number(f, "period", false, TINY, FAR, &m->period);
    status = status ? status : koksma__json_get_numbers(f, "phase", false, -FAR, FAR, 2, m->phase);
    status = status ? status : koksma__json_get_number(f, "angle_deg", false, -360, 360, &angle_deg);
    m->angle_rad = angle_deg * TURN / 360;
    return status;
}

/* Reads "albedo": {"image": FILE} of a Lambert surface; the image's mean colour is used where a single colour is
   needed. */
static koksma_status parse_texture(koksma_scene *scene, const char *name, const field *f, koksma__material *m)
{
    field albedo;
    const char *path = "";
    koksma_status status = koksma__json_member(f, "albedo", &albedo);
    status = status ? status : koksma__json_only(&albedo, KEYS("image"));
    status = status ? status : koksma__json_get_text(&albedo, "image", true, &path);
    status = status ? status : koksma__parse_image(scene, name, &albedo, path, &m->image);
    if (!status) {
        koksma__material_mean(scene, m);
    }
    return status;
}

/* Reads the diffuse albedo, in one of the forms that the kind of material allows. */
static koksma_status parse_diffuse(koksma_scene *scene, const char *scene_name, const field *f, koksma__material *m)
{
    const unsigned forms = m->bsdf->diffuse;
    if (!forms) {
        return KOKSMA_OK;
    }
    if (forms & KOKSMA__IMAGE && koksma__json_is_object_at(f, "albedo")) {
        return parse_texture(scene, scene_name, f, m);
    }
    m->checker = forms & KOKSMA__CHECKER && (!(forms & KOKSMA__ALBEDO) || koksma__json_has(f, "albedos"));
    return parse_albedo(f, m);
}

koksma_status koksma__parse_material(const char *scene_name, const field *f, koksma_scene *scene)
{
    const char *name = "", *problem;
    size_t kind = 0;
    koksma__material *m = &scene->materials[scene->n_materials];
    KOKSMA__TRY(koksma__json_get_text(f, "name", true, &name));
    KOKSMA__JSON_FAIL_IF((!*name || strlen(name) >= sizeof m->name), f, "a name has 1 to %zu letters",
                         sizeof m->name - 1);
    KOKSMA__JSON_FAIL_IF(koksma__find_material(scene, name) >= 0, f, "a second material '%s'", name);
    KOKSMA__TRY(koksma__parse_kind(f, koksma__material_kinds, &kind));
    strcpy(m->name, name);
    m->bsdf = koksma__bsdfs[kind];
    scene->n_materials++;
    KOKSMA__TRY(koksma__parse_fields(f, &m->bsdf->kind, koksma__material_keys(m->bsdf), m));
    KOKSMA__TRY(parse_diffuse(scene, scene_name, f, m));
    KOKSMA__JSON_FAIL_IF(m->bsdf->check && (problem = m->bsdf->check(m)), f, "%s", problem);
    return KOKSMA_OK;
}
