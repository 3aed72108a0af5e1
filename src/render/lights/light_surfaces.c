/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The lights that are shapes, Lambert emitters of one side: `rectangle` and `disk` shine on the side of their normal,
 * `sphere` outwards.
 *
 * rectangle, disk: positions are uniform over the area A, with the density t^2 / (cos' A) over solid angle, where cos'
 * is the cosine at the light and t the distance. The concentric map (Shirley & Chiu 1997) takes the unit square to the
 * disk and preserves relative areas, so that stratification is kept. Uniform sampling of a rectangle's solid angle has
 * less variance near the light (Urena, Fajardo & King 2013), but the published tables that scenes reproduce sample the
 * area.
 *
 * sphere: directions are uniform over the cone that the sphere subtends (Shirley, Wang & Zimmerman 1996): with sin and
 * cos of the cone's half-angle, where sin is the sphere's radius divided by the distance of its centre, the density is
 * 1 / (2 pi (1 - cos)). 1 - cos is computed as sin^2 / (1 + cos), which avoids cancellation for a small sphere far away.
 * A point inside the sphere gets no light.
 */
#include <string.h>

#include "core/elementary.h"
#include "core/vector.h"
#include "render/description_build.h"
#include "render/lights/beams.h"
#include "render/shapes/shapes.h"

/* The fields of a flat light that are not parameters: "facing" or "normal", "up", "radiance" or "strength". */
#define FLAT_KEYS KEYS("normal", "facing", "up", "radiance", "strength")
#define FLAT_EXAMPLE "\"facing\": [0.1, -0.2, 0.3], \"radiance\": [3, 2, 1]"

static double area_of(const koksma__light *light)
{
    const bool rectangle = light->kind == &koksma__light_rectangle;
    const double factor = rectangle ? 4 : light->kind == &koksma__light_disk ? M_PI : 4 * M_PI;
    return factor * light->half[0] * light->half[rectangle];
}

/* ---- Fields ----------------------------------------------------------------------------------------------------- */

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

/* Adds the surface of a visible light: a shape in the light's coordinate frame. */
static koksma_status add_surface(const field *f, koksma_scene *scene, const koksma__light *light)
{
    const koksma__shape_type *type = light->kind == &koksma__light_disk     ? &KOKSMA__SHAPE(disk)
                                     : light->kind == &koksma__light_sphere ? &KOKSMA__SHAPE(sphere)
                                                                            : &KOKSMA__SHAPE(rectangle);
    koksma__shape shape = {.type = type, .material = -1, .light = (int)(light - scene->lights)}, *added;
    memcpy(shape.centre, light->centre, sizeof shape.centre);
    memcpy(shape.normal, light->normal, sizeof shape.normal);
    memcpy(shape.axis_u, light->axis_u, sizeof shape.axis_u);
    memcpy(shape.axis_v, light->axis_v, sizeof shape.axis_v);
    memcpy(shape.half, light->half, sizeof shape.half);
    const koksma_status status = koksma__scene_add_shape(scene, &shape, &added);
    return status ? koksma__json_fail_in(f, status) : KOKSMA_OK;
}

/* Reads FLAT_KEYS; adds the surface of a visible light to the scene. */
static koksma_status parse_flat(const char *name, const field *f, koksma_scene *scene, koksma__light *light)
{
    const bool has_target = koksma__json_has(f, "facing");
    double towards[3] = {0};
    (void)name;
    KOKSMA__TRY(parse_aim(f, has_target, towards, light));
    KOKSMA__TRY(parse_power(f, has_target ? towards : NULL, area_of(light), light));
    return light->visible ? add_surface(f, scene, light) : KOKSMA_OK;
}

static koksma_status parse_sphere(const char *name, const field *f, koksma_scene *scene, koksma__light *light)
{
    (void)name;
    return light->visible ? add_surface(f, scene, light) : KOKSMA_OK;
}

/* ---- Light ------------------------------------------------------------------------------------------------------ */

static koksma_status open_light(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *light)
{
    const bool rectangle = from->kind == &koksma__light_rectangle;
    (void)scene;
    koksma__emitter_open(light, area_of(from),
                         rectangle ? (float)koksma__hypot((double)light->half[0], (double)light->half[1])
                                   : light->half[0]);
    return KOKSMA_OK;
}

static bool flat_centre(const koksma__shading_light *light, const float p[3], koksma__beam *out)
{
    koksma__v3 w;
    for (int k = 0; k < 3; k++) {
        out->d[k] = light->centre[k] - p[k];
    }
    const float pdf = koksma__flat_beam(koksma__v3_of(out->d), koksma__v3_of(light->normal), light->area, &w);
    if (!(pdf > 0)) {
        return false;
    }
    koksma__v3_to(w, out->w);
    koksma__set_value(light, 1 / pdf, out);
    out->pdf = 0;
    return true;
}

static void lanes(const koksma__light *from, koksma__batch_light *out)
{
    *out = (koksma__batch_light){.power = (float)from->power};
    for (int k = 0; k < 3; k++) {
        const double u = from->half[0] * from->axis_u[k], v = from->half[1] * from->axis_v[k];
        out->corner[k] = (float)(from->centre[k] - u - v);
        out->edge_x[k] = (float)(2 * u);
        out->edge_y[k] = (float)(2 * v);
        out->normal[k] = (float)from->normal[k];
    }
}

/* From far away the sphere looks like a disk of the same radius. */
static bool sphere_centre(const koksma__shading_light *light, const float p[3], koksma__beam *out)
{
    return koksma__point_beam(light, p, KOKSMA__PI_F * light->half[0] * light->half[0], out);
}

static float sphere_pdf(const koksma__shading_light *light, const float p[3], const float w[3], float t,
                        const float n[3])
{
    float axis[3];
    (void)w, (void)t, (void)n;
    for (int k = 0; k < 3; k++) {
        axis[k] = light->centre[k] - p[k];
    }
    const float part = light->half[0] * light->half[0] / koksma__dot3(axis, axis);
    return part < 1 ? (1 + sqrtf(1 - part)) / (2 * KOKSMA__PI_F * part) : 0;
}

static const koksma__parameter of_rectangle[] = {
    {"centre", KOKSMA__POINT, .at = offsetof(koksma__light, centre)},
    {"half", KOKSMA__HALF, .at = offsetof(koksma__light, half)},
    {"visible", KOKSMA__FLAG, .optional = true, .at = offsetof(koksma__light, visible)},
    {0}};
static const koksma__parameter of_disk[] = {
    {"centre", KOKSMA__POINT, .at = offsetof(koksma__light, centre)},
    {"radius", KOKSMA__RADIUS, .at = offsetof(koksma__light, half)},
    {"visible", KOKSMA__FLAG, .optional = true, .at = offsetof(koksma__light, visible)},
    {0}};
static const koksma__parameter of_sphere[] = {
    {"centre", KOKSMA__POINT, .at = offsetof(koksma__light, centre)},
    {"radius", KOKSMA__RADIUS, .at = offsetof(koksma__light, half)},
    {"visible", KOKSMA__FLAG, .optional = true, .at = offsetof(koksma__light, visible)},
    {"radiance", KOKSMA__COLOUR, .high = BRIGHT, .at = offsetof(koksma__light, radiance)},
    {0}};

const koksma__light_kind koksma__light_rectangle = {
    .kind = {.name = "rectangle",
             .title = "a rectangle that shines to the side of its normal",
             .cite = "shirley1996",
             .parameters = of_rectangle,
             .keys = FLAT_KEYS,
             .example = FLAT_EXAMPLE},
    .is_flat = true,
    .form = KOKSMA__BEAMS_RECTANGLE,
    .parse = parse_flat,
    .open = open_light,
    .centre = flat_centre,
    .pdf = koksma__area_pdf,
    .lanes = lanes,
};

const koksma__light_kind koksma__light_disk = {
    .kind = {.name = "disk",
             .title = "a disk that shines to the side of its normal",
             .cite = "shirley1997",
             .parameters = of_disk,
             .keys = FLAT_KEYS,
             .example = FLAT_EXAMPLE},
    .is_flat = true,
    .form = KOKSMA__BEAMS_DISK,
    .parse = parse_flat,
    .open = open_light,
    .centre = flat_centre,
    .pdf = koksma__area_pdf,
};

const koksma__light_kind koksma__light_sphere = {
    .kind = {.name = "sphere",
             .title = "a sphere that shines outwards",
             .cite = "shirley1996",
             .parameters = of_sphere},
    .form = KOKSMA__BEAMS_CONE,
    .parse = parse_sphere,
    .open = open_light,
    .centre = sphere_centre,
    .pdf = sphere_pdf,
};
