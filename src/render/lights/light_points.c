/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The lights without extent. No ray can hit them; their density is 0.
 *
 * point: the same intensity in all directions from one point, so that the irradiance of a surface that faces it is
 * intensity / distance^2. `radiance` holds the intensity.
 *
 * directional: parallel light from far away. `normal` is the direction in which the light travels, `radiance` the
 * irradiance of a surface that faces the light.
 *
 * spot: a point light with full intensity inside a cone of half-angle `inner`; outside it the intensity falls to 0 at
 * the edge of a cone of half-angle `outer`. With a = (cos angle(w) - cos outer) / (cos inner - cos outer), clamped to
 * [0,1], and inner = (1 - edge) outer,
 *
 *     falloff    I(w) / intensity                               power / (2 pi intensity)
 *     square     a^2 (KHR_lights_punctual)                      1 - cos inner + (cos inner - cos outer) / 3
 *     smooth     a^2 (3 - 2 a) (pbrt-v4)                        1 - cos inner + (cos inner - cos outer) / 2
 *     angle      (outer - angle(w)) / (outer - inner),          1 - (sin outer - sin inner) / (outer - inner)
 *                at most 1 (Mitsuba 3)
 */
#include <string.h>

#include "core/elementary.h"
#include "core/status.h"
#include "render/lights/beams.h"

/* sample() of all. */
static bool sample(const koksma__shading_light *light, const float p[3], const float u[2], koksma__beam *out)
{
    (void)u;
    return light->kind->centre(light, p, out);
}

/* ---- Points ----------------------------------------------------------------------------------------------------- */

static koksma_status open_point(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *light)
{
    (void)scene, (void)from;
    light->power = 4 * koksma__luminance3(light->radiance) / KOKSMA__PI_F;
    return KOKSMA_OK;
}

static bool point_centre(const koksma__shading_light *light, const float p[3], koksma__beam *out)
{
    return koksma__point_beam(light, p, 1, out);
}

static const koksma__parameter of_point[] = {
    {"centre", KOKSMA__POINT, .at = offsetof(koksma__light, centre)},
    {"intensity", KOKSMA__COLOUR, .high = BRIGHT, .at = offsetof(koksma__light, radiance)},
    {0}};

const koksma__light_kind koksma__light_point = {
    .kind = {.name = "point",
             .title = "the same intensity in all directions from a point",
             .cite = "-",
             .parameters = of_point},
    .open = open_point,
    .sample = sample,
    .centre = point_centre,
};

/* ---- Parallel light --------------------------------------------------------------------------------------------- */

static koksma_status open_directional(const koksma_scene *scene, const koksma__light *from,
                                      koksma__shading_light *light)
{
    (void)scene, (void)from;
    light->power = koksma__luminance3(light->radiance) / KOKSMA__PI_F;
    return KOKSMA_OK;
}

static bool directional_centre(const koksma__shading_light *light, const float p[3], koksma__beam *out)
{
    (void)p;
    for (int k = 0; k < 3; k++) {
        out->w[k] = -light->normal[k];
        out->d[k] = KOKSMA__AWAY * out->w[k];
    }
    out->pdf = 0;
    koksma__set_value(light, 1, out);
    return true;
}

static const koksma__parameter of_directional[] = {
    {"direction", KOKSMA__DIRECTION, .at = offsetof(koksma__light, normal)},
    {"irradiance", KOKSMA__COLOUR, .high = BRIGHT, .at = offsetof(koksma__light, radiance)},
    {0}};

const koksma__light_kind koksma__light_directional = {
    .kind = {.name = "directional",
             .title = "parallel light from far away",
             .cite = "-",
             .parameters = of_directional},
    .distance = KOKSMA__LIGHT_PARALLEL,
    .form = KOKSMA__BEAMS_PARALLEL,
    .open = open_directional,
    .centre = directional_centre,
};

/* ---- Spots ------------------------------------------------------------------------------------------------------ */

/* Indices of the values of a spot. open_spot() sets the last four: OUTER and INNER are cosines, SLOPE is 1 / (outer
   - inner) with the angles in turns, EDGE_TURNS is the angle `outer` in turns. */
enum { ANGLE, EDGE, FALLOFF, OUTER, INNER, SLOPE, EDGE_TURNS };

static const char *const falloffs[] = {
    [KOKSMA__FALLOFF_SQUARE] = "square", [KOKSMA__FALLOFF_SMOOTH] = "smooth", [KOKSMA__FALLOFF_ANGLE] = "angle"};

/* The integral of the falloff over the cosine, from cos(outer) to 1. */
static double power_of(int falloff, double inner, double outer)
{
    if (falloff == KOKSMA__FALLOFF_ANGLE) {
        return outer > inner ? 1 - (koksma__sin(outer) - koksma__sin(inner)) / (outer - inner)
                             : 1 - koksma__cos(outer);
    }
    return 1 - koksma__cos(inner) +
           (koksma__cos(inner) - koksma__cos(outer)) / (falloff == KOKSMA__FALLOFF_SMOOTH ? 2 : 3);
}

static koksma_status open_spot(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *light)
{
    const double outer = from->values[ANGLE] * TURN / 360, inner = (1 - from->values[EDGE]) * outer;
    (void)scene;
    light->values[OUTER] = (float)koksma__cos(outer);
    light->values[INNER] = (float)koksma__cos(inner);
    light->values[SLOPE] = (float)(outer > inner ? TURN / (outer - inner) : 0);
    light->values[EDGE_TURNS] = (float)(outer / TURN);
    const double part = power_of((int)from->values[FALLOFF], inner, outer);
    light->power = koksma__luminance3(light->radiance) * (float)(2 * part) / KOKSMA__PI_F;
    return KOKSMA_OK;
}

static bool spot_centre(const koksma__shading_light *light, const float p[3], koksma__beam *out)
{
    if (!koksma__point_beam(light, p, 1, out)) {
        return false;
    }
    const float cosine = -koksma__dot3(out->w, light->normal), above = cosine - light->values[OUTER];
    const float range = light->values[INNER] - light->values[OUTER];
    const float part = above < range ? above / range : 1;
    const int falloff = (int)light->values[FALLOFF];
    float shade = falloff == KOKSMA__FALLOFF_SMOOTH ? part * part * (3 - 2 * part) : part * part;
    if (falloff == KOKSMA__FALLOFF_ANGLE && above < range) {
        const float sine = sqrtf(cosine < 1 ? 1 - cosine * cosine : 0);
        const float left = (light->values[EDGE_TURNS] - koksma__arc_turns(sine, cosine)) * light->values[SLOPE];
        shade = left > 0 ? left : 0;
    }
    for (int k = 0; k < 3; k++) {
        out->value[k] *= shade;
    }
    return above > 0;
}

static koksma_status parse(const char *name, const field *f, koksma_scene *scene, koksma__light *light)
{
    const char *text = falloffs[0];
    int falloff = 0;
    (void)name, (void)scene;
    KOKSMA__TRY(koksma__json_get_text(f, "falloff", false, &text));
    while (falloff <= KOKSMA__FALLOFF_ANGLE && strcmp(falloffs[falloff], text) != 0) {
        falloff++;
    }
    KOKSMA__JSON_FAIL_IF(falloff > KOKSMA__FALLOFF_ANGLE, f, "falloff '%.20s'; it takes square, smooth or angle",
                         text);
    light->values[FALLOFF] = falloff;
    return KOKSMA_OK;
}

static const koksma__parameter of_spot[] = {
    {"centre", KOKSMA__POINT, .at = offsetof(koksma__light, centre)},
    {"direction", KOKSMA__DIRECTION, .at = offsetof(koksma__light, normal)},
    {"intensity", KOKSMA__COLOUR, .high = BRIGHT, .at = offsetof(koksma__light, radiance)},
    {"angle_deg", KOKSMA__NUMBER, .low = 10, .high = 90, .at = KOKSMA__LIGHT_VALUE(ANGLE)},
    {"edge", KOKSMA__NUMBER, .high = 1, .optional = true, .fallback = 0, .at = KOKSMA__LIGHT_VALUE(EDGE)},
    {0}};

const koksma__light_kind koksma__light_spot = {
    .kind = {.name = "spot",
             .title = "a point light that shines into a cone about a direction",
             .cite = "-",
             .parameters = of_spot,
             .keys = KEYS("falloff")},
    .parse = parse,
    .open = open_spot,
    .sample = sample,
    .centre = spot_centre,
};
