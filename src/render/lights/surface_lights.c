/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions that several kinds of lights share: they read the fields of flat lights ("facing" or "normal"; "radiance"
 * or "strength"), add the surface that rays see, and sample emitting surfaces. Uniform sampling over the area A has
 * the density t^2 / (cos' A) over solid angle, with the cosine cos' at the light and the distance t.
 */
#include "render/lights/surface_lights.h"

#include <string.h>

#include "core/vector.h"
#include "render/description_build.h"

static double luminance(const double rgb[3])
{
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/* Reads "radiance" of the surface, or "strength": the radiance that a surface of albedo 1 would reflect at the point
   that the light faces, if the surface faced the light and the light were small. towards: from the light to that
   point; NULL if the file has a "normal" instead. */
static koksma_status parse_power(const field *f, const double *towards, double area, koksma__light *light)
{
    const bool by_radiance = koksma__json_has(f, "radiance");
    KOKSMA__JSON_FAIL_IF(by_radiance == koksma__json_has(f, "strength"), f,
                         "it takes one of 'radiance' and 'strength'");
    KOKSMA__JSON_FAIL_IF(!by_radiance && !towards, f, "'strength' needs 'facing'");
    const koksma_status status =
        koksma__parse_colour(f, by_radiance ? "radiance" : "strength", true, BRIGHT, light->radiance);
    const double square = by_radiance ? 0 : koksma__dot(towards, towards);
    /* the power of grey light is computed by one product, so that strengths in files are not rounded twice */
    light->power = by_radiance ? luminance(light->radiance) * area / M_PI : light->radiance[1] * square;
    for (int k = 0; !by_radiance && k < 3; k++) {
        light->radiance[k] *= square * M_PI / area;
    }
    return status;
}

/* Reads "normal", or "facing", the point at which the light is aimed; towards is the vector from the light to that
   point. */
static koksma_status parse_aim(const field *f, bool has_target, double towards[3], koksma__light *light)
{
    double target[3];
    KOKSMA__JSON_FAIL_IF(has_target == koksma__json_has(f, "normal"), f, "it takes one of 'facing' and 'normal'");
    koksma_status status =
        has_target ? koksma__parse_point(f, "facing", target) : koksma__parse_direction(f, "normal", light->normal);
    if (!status && has_target) {
        koksma__subtract(target, light->centre, towards);
        memcpy(light->normal, towards, sizeof light->normal);
        KOKSMA__JSON_FAIL_IF(!koksma__normalise(light->normal), f, "it faces its own centre");
    }
    return status ? status : koksma__parse_axes(f, light->normal, light->axis_u, light->axis_v);
}

koksma_status koksma__light_add_surface(const field *f, koksma_scene *scene, const koksma__light *light,
                                        const koksma__shape_type *type)
{
    koksma__shape shape = {.type = type, .material = -1, .light = (int)(light - scene->lights)}, *added;
    memcpy(shape.centre, light->centre, sizeof shape.centre);
    memcpy(shape.normal, light->normal, sizeof shape.normal);
    memcpy(shape.axis_u, light->axis_u, sizeof shape.axis_u);
    memcpy(shape.axis_v, light->axis_v, sizeof shape.axis_v);
    memcpy(shape.half, light->half, sizeof shape.half);
    const koksma_status status = koksma__scene_add_shape(scene, &shape, &added);
    return status ? koksma__json_fail_in(f, status) : KOKSMA_OK;
}

koksma_status koksma__flat_light_parse(const field *f, koksma_scene *scene, koksma__light *light, double area,
                                       const koksma__shape_type *shape)
{
    const bool has_target = koksma__json_has(f, "facing");
    double towards[3] = {0};
    koksma_status status = parse_aim(f, has_target, towards, light);
    status = status ? status : parse_power(f, has_target ? towards : NULL, area, light);
    return !status && light->visible ? koksma__light_add_surface(f, scene, light, shape) : status;
}

void koksma__emitter_open(koksma__shading_light *light, double area, float reach)
{
    light->area = (float)area;
    light->reach = reach;
    light->power = koksma__luminance3(light->radiance) * light->area / KOKSMA__PI_F;
}

bool koksma__flat_light_sample(const koksma__shading_light *light, const float p[3], float u, float v,
                               koksma__beam *out)
{
    koksma__v3 d, w;
    for (int k = 0; k < 3; k++) {
        out->d[k] = light->centre[k] + u * light->axis_u[k] + v * light->axis_v[k] - p[k];
    }
    d = koksma__v3_of(out->d);
    out->pdf = koksma__flat_beam(d, koksma__v3_of(light->normal), light->area, &w);
    if (!(out->pdf > 0)) {
        return false;
    }
    koksma__v3_to(w, out->w);
    koksma__set_value(light, 1 / out->pdf, out);
    return true;
}

bool koksma__flat_light_centre(const koksma__shading_light *light, const float p[3], koksma__beam *out)
{
    const bool lit = koksma__flat_light_sample(light, p, 0, 0, out);
    out->pdf = 0;
    return lit;
}

float koksma__area_pdf(const koksma__shading_light *light, const float p[3], const float w[3], float t,
                       const float n[3])
{
    (void)p;
    const float cosine = -koksma__dot3(n, w);
    return cosine > 0 ? t * t / (cosine * light->area) : 0;
}

bool koksma__point_sample(const koksma__shading_light *light, const float p[3], const float u[2], koksma__beam *out)
{
    (void)u;
    return light->kind->centre(light, p, out);
}

bool koksma__point_beam(const koksma__shading_light *light, const float p[3], float strength, koksma__beam *out)
{
    for (int k = 0; k < 3; k++) {
        out->d[k] = light->centre[k] - p[k];
    }
    const float square = koksma__dot3(out->d, out->d), length = sqrtf(square);
    if (!(length > 0)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        out->w[k] = out->d[k] / length;
    }
    out->pdf = 0;
    koksma__set_value(light, strength / square, out);
    return true;
}
