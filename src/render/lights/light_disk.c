/* SPDX-License-Identifier: Apache-2.0 */
/*
 * disk: a Lambert emitter that shines on the side of its normal. The concentric map (Shirley & Chiu 1997) maps the
 * unit square to the disk and preserves relative areas, so that positions are uniform and stratification is kept.
 */
#include "render/lights/surface_lights.h"

static koksma_status parse(const char *name, const field *f, koksma_scene *scene, koksma__light *light)
{
    (void)name;
    return koksma__flat_light_parse(f, scene, light, M_PI * light->half[0] * light->half[0], &KOKSMA__SHAPE(disk));
}

static koksma_status open_light(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *light)
{
    (void)scene;
    koksma__emitter_open(light, M_PI * from->half[0] * from->half[0], light->half[0]);
    return KOKSMA_OK;
}

static bool sample(const koksma__shading_light *light, const float p[3], const float u[2], koksma__beam *out)
{
    float x, y;
    koksma__concentric(u[0], u[1], &x, &y);
    return koksma__flat_light_sample(light, p, x * light->half[0], y * light->half[0], out);
}

static const koksma__parameter parameters[] = {
    {"centre", KOKSMA__POINT, .at = offsetof(koksma__light, centre)},
    {"radius", KOKSMA__RADIUS, .at = offsetof(koksma__light, half)},
    {"visible", KOKSMA__FLAG, .optional = true, .at = offsetof(koksma__light, visible)},
    {0}};

const koksma__light_kind koksma__light_disk = {
    .kind = {.name = "disk",
             .title = "a disk that shines to the side of its normal",
             .cite = "shirley1997",
             .parameters = parameters,
             .keys = KOKSMA__FLAT_KEYS,
             .example = KOKSMA__FLAT_EXAMPLE},
    .is_flat = true,
    .form = KOKSMA__BEAMS_DISK,
    .parse = parse,
    .open = open_light,
    .sample = sample,
    .centre = koksma__flat_light_centre,
    .pdf = koksma__area_pdf,
};
