/* SPDX-License-Identifier: Apache-2.0 */
/*
 * rectangle: a Lambert emitter that shines on the side of its normal. Positions are sampled uniformly over the area.
 * Uniform sampling of solid angle has less variance near the light (Urena, Fajardo & King 2013), but the published
 * tables that scenes reproduce sample the area.
 */
#include "render/lights/surface_lights.h"

static koksma_status parse(const char *name, const field *f, koksma_scene *scene, koksma__light *light)
{
    (void)name;
    return koksma__flat_light_parse(f, scene, light, 4 * light->half[0] * light->half[1], &KOKSMA__SHAPE(rectangle));
}

static koksma_status open_light(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *light)
{
    (void)scene;
    koksma__emitter_open(light, 4 * from->half[0] * from->half[1], hypotf(light->half[0], light->half[1]));
    return KOKSMA_OK;
}

static bool sample(const koksma__shading_light *light, const float p[3], const float u[2], koksma__beam *out)
{
    return koksma__flat_light_sample(light, p, (2 * u[0] - 1) * light->half[0], (2 * u[1] - 1) * light->half[1], out);
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

static const koksma__parameter parameters[] = {
    {"centre", KOKSMA__POINT, .at = offsetof(koksma__light, centre)},
    {"half", KOKSMA__HALF, .at = offsetof(koksma__light, half)},
    {"visible", KOKSMA__FLAG, .optional = true, .at = offsetof(koksma__light, visible)},
    {0}};

const koksma__light_kind koksma__light_rectangle = {
    .kind = {.name = "rectangle",
             .title = "a rectangle that shines to the side of its normal",
             .cite = "shirley1996",
             .parameters = parameters,
             .keys = KOKSMA__FLAT_KEYS,
             .example = KOKSMA__FLAT_EXAMPLE},
    .is_flat = true,
    .form = KOKSMA__BEAMS_RECTANGLE,
    .parse = parse,
    .open = open_light,
    .sample = sample,
    .centre = koksma__flat_light_centre,
    .pdf = koksma__area_pdf,
    .lanes = lanes,
};
