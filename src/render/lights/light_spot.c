/* SPDX-License-Identifier: Apache-2.0 */
/*
 * spot: a point light with full intensity inside a cone, which falls to 0 at the edge of a wider cone, quadratically
 * in the cosine of the angle (KHR_lights_punctual):
 *
 *     I(w) = intensity a^2,   a = (cos angle(w) - cos outer) / (cos inner - cos outer), at least 0 and at most 1,
 *
 * with inner = (1 - edge) outer. The total power is intensity 2 pi (1 - cos inner + (cos inner - cos outer) / 3).
 */
#include "render/lights/surface_lights.h"

enum { ANGLE, EDGE, OUTER, INNER }; /* OUTER and INNER are cosines, which open_light() sets */

static koksma_status open_light(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *light)
{
    const double outer = from->values[ANGLE] * TURN / 360, inner = (1 - from->values[EDGE]) * outer;
    (void)scene;
    light->values[OUTER] = (float)cos(outer);
    light->values[INNER] = (float)cos(inner);
    const double part = 1 - cos(inner) + (cos(inner) - cos(outer)) / 3;
    light->power = koksma__luminance3(light->radiance) * (float)(2 * part) / KOKSMA__PI_F;
    return KOKSMA_OK;
}

static bool centre(const koksma__shading_light *light, const float p[3], koksma__beam *out)
{
    if (!koksma__point_beam(light, p, 1, out)) {
        return false;
    }
    const float above = -koksma__dot3(out->w, light->normal) - light->values[OUTER];
    const float range = light->values[INNER] - light->values[OUTER];
    const float part = above < range ? above / range : 1;
    for (int k = 0; k < 3; k++) {
        out->value[k] *= part * part;
    }
    return above > 0;
}

static bool sample(const koksma__shading_light *light, const float p[3], const float u[2], koksma__beam *out)
{
    (void)u;
    return centre(light, p, out);
}

static const koksma__parameter parameters[] = {
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
             .parameters = parameters},
    .open = open_light,
    .sample = sample,
    .centre = centre,
};
