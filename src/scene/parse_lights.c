/* SPDX-License-Identifier: Apache-2.0 */
#include <stdlib.h>
#include <string.h>

#include "core/vector.h"
#include "scene/parse.h"

static double luminance(const double rgb[3])
{
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/* "radiance" of the surface, or "strength": what a surface of albedo 1 reflects of it that faces it in the point that
   the light faces, were the light small. towards: from the light to that point; NULL with a "normal". */
static koksma_status parse_power(const field *f, const double *towards, double area, koksma__light *light)
{
    const bool by_radiance = koksma__json_has(f, "radiance");
    if (by_radiance == koksma__json_has(f, "strength")) {
        return koksma__json_fail(f, "it takes one of 'radiance' and 'strength'");
    }
    if (!by_radiance && !towards) {
        return koksma__json_fail(f, "'strength' needs 'facing'");
    }
    const koksma_status status =
        koksma__parse_colour(f, by_radiance ? "radiance" : "strength", true, BRIGHT, light->radiance);
    const double square = by_radiance ? 0 : koksma__dot(towards, towards);
    /* one product for the grey power, so that strengths in files keep their digits */
    light->power = by_radiance ? luminance(light->radiance) * area / M_PI : light->radiance[1] * square;
    for (int k = 0; !by_radiance && k < 3; k++) {
        light->radiance[k] *= square * M_PI / area;
    }
    return status;
}

/* "normal", or "facing": the point that the light looks at; towards is the way there. */
static koksma_status parse_aim(const field *f, bool has_target, double towards[3], koksma__light *light)
{
    double target[3];
    if (has_target == koksma__json_has(f, "normal")) {
        return koksma__json_fail(f, "it takes one of 'facing' and 'normal'");
    }
    koksma_status status =
        has_target ? koksma__parse_point(f, "facing", target) : koksma__parse_direction(f, "normal", light->normal);
    if (!status && has_target) {
        koksma__subtract(target, light->centre, towards);
        memcpy(light->normal, towards, sizeof light->normal);
        if (!koksma__normalise(light->normal)) {
            return koksma__json_fail(f, "it faces its own centre");
        }
    }
    return status ? status : koksma__parse_axes(f, light->normal, light->axis_u, light->axis_v);
}

/* The surface of a luminaire that rays see. */
static koksma_status add_surface(const field *f, koksma_scene *scene)
{
    const koksma__light *light = &scene->lights[scene->n_lights - 1];
    koksma__shape *shape = NULL;
    const koksma_status status = koksma__parse_room(f, scene, &shape);
    if (!status) {
        shape->kind = light->kind == KOKSMA__LIGHT_RECTANGLE ? KOKSMA__SHAPE_RECTANGLE
                      : light->kind == KOKSMA__LIGHT_DISK    ? KOKSMA__SHAPE_DISK
                                                             : KOKSMA__SHAPE_SPHERE;
        memcpy(shape->centre, light->centre, sizeof shape->centre);
        memcpy(shape->normal, light->normal, sizeof shape->normal);
        memcpy(shape->axis_u, light->axis_u, sizeof shape->axis_u);
        memcpy(shape->axis_v, light->axis_v, sizeof shape->axis_v);
        memcpy(shape->half, light->half, sizeof shape->half);
        shape->material = -1;
        shape->light = (int)scene->n_lights - 1;
    }
    return status;
}

static koksma_status parse_flat(const field *f, koksma_scene *scene, koksma__light *light)
{
    const bool round = light->kind == KOKSMA__LIGHT_DISK, has_target = koksma__json_has(f, "facing");
    double towards[3] = {0};
    koksma_status status = koksma__json_only(f, KEYS("kind", "centre", "normal", "facing", "up", "visible",
                                                     "radiance", "strength", round ? "radius" : "half"));
    status = status ? status : koksma__parse_point(f, "centre", light->centre);
    status = status ? status : round ? koksma__parse_radius(f, light->half) : koksma__parse_half(f, light->half);
    status = status ? status : koksma__json_get_flag(f, "visible", false, &light->visible);
    status = status ? status : parse_aim(f, has_target, towards, light);
    const double area = round ? M_PI * light->half[0] * light->half[0] : 4 * light->half[0] * light->half[1];
    status = status ? status : parse_power(f, has_target ? towards : NULL, area, light);
    return !status && light->visible ? add_surface(f, scene) : status;
}

static koksma_status parse_ball(const field *f, koksma_scene *scene, koksma__light *light)
{
    koksma_status status = koksma__json_only(f, KEYS("kind", "centre", "radius", "radiance", "visible"));
    status = status ? status : koksma__parse_point(f, "centre", light->centre);
    status = status ? status : koksma__parse_radius(f, light->half);
    status = status ? status : koksma__json_get_flag(f, "visible", false, &light->visible);
    status = status ? status : koksma__parse_colour(f, "radiance", true, BRIGHT, light->radiance);
    return !status && light->visible ? add_surface(f, scene) : status;
}

static koksma_status parse_point_light(const field *f, koksma__light *light)
{
    koksma_status status = koksma__json_only(f, KEYS("kind", "centre", "intensity"));
    status = status ? status : koksma__parse_point(f, "centre", light->centre);
    return status ? status : koksma__parse_colour(f, "intensity", true, BRIGHT, light->radiance);
}

static koksma_status parse_directional(const field *f, koksma__light *light)
{
    koksma_status status = koksma__json_only(f, KEYS("kind", "direction", "irradiance"));
    status = status ? status : koksma__parse_direction(f, "direction", light->normal);
    return status ? status : koksma__parse_colour(f, "irradiance", true, BRIGHT, light->radiance);
}

static koksma_status parse_environment(const char *name, const field *f, koksma_scene *scene, koksma__light *light)
{
    const char *path = NULL;
    double angle_deg = 0, scale = 1;
    koksma_status status = koksma__json_only(f, KEYS("kind", "image", "scale", "angle_deg", "radiance", "visible"));
    for (size_t i = 0; !status && i + 1 < scene->n_lights; i++) {
        if (scene->lights[i].kind == KOKSMA__LIGHT_ENVIRONMENT) {
            return koksma__json_fail(f, "a second environment");
        }
    }
    const bool image = koksma__json_has(f, "image");
    if (!status && image && koksma__json_has(f, "radiance")) {
        return koksma__json_fail(f, "it takes one of 'radiance' and 'image'");
    }
    if (!status && !image && (koksma__json_has(f, "scale") || koksma__json_has(f, "angle_deg"))) {
        return koksma__json_fail(f, "'scale' and 'angle_deg' need 'image'");
    }
    light->visible = true;
    status = status ? status : koksma__json_get_text(f, "image", false, &path);
    status = status ? status : koksma__json_get_flag(f, "visible", false, &light->visible);
    if (!status && !path) {
        return koksma__parse_colour(f, "radiance", true, BRIGHT, light->radiance);
    }
    status = status ? status : koksma__json_get_number(f, "angle_deg", false, -360, 360, &angle_deg);
    status = status ? status : koksma__json_get_number(f, "scale", false, 0, BRIGHT, &scale);
    light->angle_rad = angle_deg * TURN / 360;
    light->radiance[0] = light->radiance[1] = light->radiance[2] = scale;
    if (status) {
        return status;
    }
    return koksma__parse_image(name, f, path, &light->image);
}

koksma_status koksma__scene_add_light(koksma_scene *scene, koksma__light **out)
{
    if (scene->n_lights == KOKSMA__MAX_LIGHTS) {
        return koksma__fail(KOKSMA_MALFORMED, "more than %d luminaires", KOKSMA__MAX_LIGHTS);
    }
    *out = &scene->lights[scene->n_lights++];
    return KOKSMA_OK;
}

koksma_status koksma__parse_light(const char *name, const field *f, koksma_scene *scene)
{
    static const char *const kinds[] = {
        [KOKSMA__LIGHT_RECTANGLE] = "rectangle",     [KOKSMA__LIGHT_DISK] = "disk",
        [KOKSMA__LIGHT_SPHERE] = "sphere",           [KOKSMA__LIGHT_POINT] = "point",
        [KOKSMA__LIGHT_DIRECTIONAL] = "directional", [KOKSMA__LIGHT_ENVIRONMENT] = "environment"};
    const char *kind = "";
    koksma__light *light = NULL;
    koksma_status status = koksma__parse_kind(f, "rectangle disk sphere point directional environment", &kind);
    if (!status && (status = koksma__scene_add_light(scene, &light))) {
        status = koksma__json_fail_in(f, status);
    }
    if (status) {
        return status;
    }
    for (int k = 0; k <= KOKSMA__LIGHT_ENVIRONMENT; k++) {
        light->kind = !kinds[k] || strcmp(kinds[k], kind) ? light->kind : (koksma__light_kind)k;
    }
    switch (light->kind) {
    case KOKSMA__LIGHT_RECTANGLE:
    case KOKSMA__LIGHT_DISK:
        return parse_flat(f, scene, light);
    case KOKSMA__LIGHT_SPHERE:
        return parse_ball(f, scene, light);
    case KOKSMA__LIGHT_MESH: /* comes with its shape */
        return KOKSMA_OK;
    case KOKSMA__LIGHT_POINT:
        return parse_point_light(f, light);
    case KOKSMA__LIGHT_DIRECTIONAL:
        return parse_directional(f, light);
    case KOKSMA__LIGHT_ENVIRONMENT:
        return parse_environment(name, f, scene, light);
    }
    return KOKSMA_OK;
}
