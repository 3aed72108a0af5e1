/* SPDX-License-Identifier: Apache-2.0 */
#include <string.h>

#include "scene/parse.h"

/* "albedo", or "albedos" of a checker and how its squares lie. */
static koksma_status parse_diffuse(const field *f, koksma__material *m)
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
    if (!status && n != 2) {
        return koksma__json_fail(&pair, "it takes 2 albedos");
    }
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

static koksma_status parse_lambert(const field *f, koksma__material *m)
{
    const koksma_status status = koksma__json_only(f, KEYS("name", "kind", "albedo"));
    return status || m->image ? status : parse_diffuse(f, m);
}

/* "albedo": {"image": FILE} of a Lambert surface; its mean colour stands where one number must do. */
static koksma_status parse_texture(const char *name, const field *f, koksma__material *m)
{
    field albedo;
    const char *path = "";
    koksma_status status = koksma__json_member(f, "albedo", &albedo);
    status = status ? status : koksma__json_only(&albedo, KEYS("image"));
    status = status ? status : koksma__json_get_text(&albedo, "image", true, &path);
    status = status ? status : koksma__parse_image(name, &albedo, path, &m->image);
    if (!status) {
        koksma__material_mean(m);
    }
    return status;
}

void koksma__material_mean(koksma__material *m)
{
    const size_t n = (size_t)m->image->width * (size_t)m->image->height, channels = (size_t)m->image->channels;
    for (size_t k = 0; k < 3; k++) {
        double sum = 0;
        for (size_t i = 0; i < n; i++) {
            const double value = (double)m->image->pixels[i * channels + k % channels];
            sum += value > 0 ? fmin(value, 1) : 0;
        }
        m->albedo[0][k] = m->albedo[1][k] = sum / (double)n;
    }
}

static koksma_status parse_checker(const field *f, koksma__material *m)
{
    const koksma_status status =
        koksma__json_only(f, KEYS("name", "kind", "albedos", "period", "phase", "angle_deg"));
    m->checker = true;
    return status ? status : parse_diffuse(f, m);
}

static koksma_status parse_mirror(const field *f, koksma__material *m)
{
    const koksma_status status = koksma__json_only(f, KEYS("name", "kind", "reflectance"));
    m->kind = KOKSMA__MATERIAL_MIRROR;
    return status ? status : koksma__parse_colour(f, "reflectance", true, 1, m->reflectance);
}

static koksma_status parse_phong(const field *f, koksma__material *m)
{
    koksma_status status = koksma__json_only(f, KEYS("name", "kind", "reflectance", "exponent"));
    m->kind = KOKSMA__MATERIAL_PHONG;
    status = status ? status : koksma__parse_colour(f, "reflectance", true, 1, m->reflectance);
    return status ? status : koksma__json_get_number(f, "exponent", true, 0, 1e6, &m->exponent);
}

static koksma_status parse_ggx(const field *f, koksma__material *m)
{
    koksma_status status = koksma__json_only(f, KEYS("name", "kind", "reflectance", "roughness"));
    m->kind = KOKSMA__MATERIAL_GGX;
    status = status ? status : koksma__parse_colour(f, "reflectance", true, 1, m->reflectance);
    return status ? status : koksma__json_get_number(f, "roughness", true, 1e-3, 1, &m->roughness);
}

static koksma_status parse_dielectric(const field *f, koksma__material *m)
{
    koksma_status status = koksma__json_only(f, KEYS("name", "kind", "ior", "tint"));
    m->kind = KOKSMA__MATERIAL_DIELECTRIC;
    m->reflectance[0] = m->reflectance[1] = m->reflectance[2] = 1;
    status = status ? status : koksma__parse_colour(f, "tint", false, 1, m->reflectance);
    return status ? status : koksma__json_get_number(f, "ior", true, 1.0001, 10, &m->ior);
}

static koksma_status parse_utah(const field *f, koksma__material *m)
{
    koksma_status status = koksma__json_only(
        f, KEYS("name", "kind", "albedo", "albedos", "period", "phase", "angle_deg", "reflectance", "exponent"));
    m->kind = KOKSMA__MATERIAL_UTAH;
    m->checker = koksma__json_has(f, "albedos");
    status = status ? status : parse_diffuse(f, m);
    status = status ? status : koksma__parse_colour(f, "reflectance", true, 1, m->reflectance);
    status = status ? status : koksma__json_get_number(f, "exponent", true, 0, 1e6, &m->exponent);
    for (int i = 0; !status && i < 6; i++) {
        if (m->albedo[i / 3][i % 3] + m->reflectance[i % 3] > 1) {
            return koksma__json_fail(f, "albedo + reflectance is above 1: it would reflect more than it gets");
        }
    }
    return status;
}

static const struct {
    const char *name;
    koksma_status (*parse)(const field *f, koksma__material *m);
} kinds[] = {{"lambert", parse_lambert}, {"checker", parse_checker}, {"mirror", parse_mirror},
             {"phong", parse_phong},     {"ggx", parse_ggx},         {"dielectric", parse_dielectric},
             {"utah", parse_utah}};

koksma_status koksma__parse_material(const char *scene_name, const field *f, koksma_scene *scene)
{
    const char *kind = "", *name = "";
    koksma__material *material = &scene->materials[scene->n_materials];
    koksma_status status = koksma__json_get_text(f, "name", true, &name);
    if (!status && (!*name || strlen(name) >= sizeof material->name)) {
        return koksma__json_fail(f, "a name has 1 to %zu letters", sizeof material->name - 1);
    }
    if (!status && koksma__find_material(scene, name) >= 0) {
        return koksma__json_fail(f, "a second material '%s'", name);
    }
    status = status ? status : koksma__parse_kind(f, "lambert checker mirror phong ggx dielectric utah", &kind);
    if (status) {
        return status;
    }
    strcpy(material->name, name);
    scene->n_materials++;
    if (!strcmp(kind, "lambert") && koksma__json_is_object_at(f, "albedo")) {
        status = parse_texture(scene_name, f, material);
    }
    if (status) {
        return status;
    }
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (!strcmp(kinds[i].name, kind)) {
            return kinds[i].parse(f, material);
        }
    }
    return koksma__json_fail(f, "no kind '%s'", kind);
}
