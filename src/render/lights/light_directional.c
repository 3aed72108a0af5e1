/* SPDX-License-Identifier: Apache-2.0 */
/*
 * directional: parallel light from far away. `normal` is the direction in which the light travels, `radiance` the
 * irradiance of a surface that faces the light. No ray can hit this light; its density is 0.
 */
#include "render/lights/surface_lights.h"

static koksma_status open_light(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *light)
{
    (void)scene, (void)from;
    light->power = koksma__luminance3(light->radiance) / KOKSMA__PI_F;
    return KOKSMA_OK;
}

static bool centre(const koksma__shading_light *light, const float p[3], koksma__beam *out)
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

static const koksma__parameter parameters[] = {
    {"direction", KOKSMA__DIRECTION, .at = offsetof(koksma__light, normal)},
    {"irradiance", KOKSMA__COLOUR, .high = BRIGHT, .at = offsetof(koksma__light, radiance)},
    {0}};

const koksma__light_kind koksma__light_directional = {
    .kind = {.name = "directional", .title = "parallel light from far away", .cite = "-", .parameters = parameters},
    .distance = KOKSMA__LIGHT_PARALLEL,
    .form = KOKSMA__BEAMS_PARALLEL,
    .open = open_light,
    .sample = koksma__point_sample,
    .centre = centre,
};
