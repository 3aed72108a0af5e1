/* SPDX-License-Identifier: Apache-2.0 */
/*
 * point: the same intensity in all directions from one point, so that the irradiance of a surface that faces it is
 * intensity / distance^2. `radiance` holds the intensity. No ray can hit this light; its density is 0.
 */
#include "render/lights/surface_lights.h"

static koksma_status open_light(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *light)
{
    (void)scene, (void)from;
    light->power = 4 * koksma__luminance3(light->radiance) / KOKSMA__PI_F;
    return KOKSMA_OK;
}

static bool centre(const koksma__shading_light *light, const float p[3], koksma__beam *out)
{
    return koksma__point_beam(light, p, 1, out);
}

static const koksma__parameter parameters[] = {
    {"centre", KOKSMA__POINT, .at = offsetof(koksma__light, centre)},
    {"intensity", KOKSMA__COLOUR, .high = BRIGHT, .at = offsetof(koksma__light, radiance)},
    {0}};

const koksma__light_kind koksma__light_point = {
    .kind = {.name = "point",
             .title = "the same intensity in all directions from a point",
             .cite = "-",
             .parameters = parameters},
    .open = open_light,
    .sample = koksma__point_sample,
    .centre = centre,
};
