/* SPDX-License-Identifier: Apache-2.0 */
/*
 * sphere: a Lambert emitter that shines outwards. Directions are uniform over the cone that the sphere subtends
 * (Shirley, Wang & Zimmerman 1996): with sin and cos of the cone's half-angle, where sin is the sphere's radius
 * divided by the distance of its centre, the density is 1 / (2 pi (1 - cos)). 1 - cos is computed as sin^2 / (1 +
 * cos), which avoids cancellation for a small sphere far away. A point inside the sphere gets no light.
 */
#include "render/lights/surface_lights.h"

static koksma_status parse(const char *name, const field *f, koksma_scene *scene, koksma__light *light)
{
    (void)name;
    return light->visible ? koksma__light_add_surface(f, scene, light, &KOKSMA__SHAPE(sphere)) : KOKSMA_OK;
}

static koksma_status open_light(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *light)
{
    (void)scene;
    koksma__emitter_open(light, 4 * M_PI * from->half[0] * from->half[0], light->half[0]);
    return KOKSMA_OK;
}

static bool sample(const koksma__shading_light *light, const float p[3], const float u[2], koksma__beam *out)
{
    koksma__v3 d, w;
    const koksma__v3 axis = koksma__v3_subtract(koksma__v3_of(light->centre), koksma__v3_of(p));
    out->pdf = koksma__cone_beam(axis, light->half[0], u[0], u[1], &d, &w);
    if (!(out->pdf > 0)) {
        return false; /* inside */
    }
    koksma__v3_to(d, out->d);
    koksma__v3_to(w, out->w);
    koksma__set_value(light, 1 / out->pdf, out);
    return true;
}

/* From far away the sphere looks like a disk of the same radius. */
static bool centre(const koksma__shading_light *light, const float p[3], koksma__beam *out)
{
    return koksma__point_beam(light, p, KOKSMA__PI_F * light->half[0] * light->half[0], out);
}

static float pdf(const koksma__shading_light *light, const float p[3], const float w[3], float t, const float n[3])
{
    float axis[3];
    (void)w, (void)t, (void)n;
    for (int k = 0; k < 3; k++) {
        axis[k] = light->centre[k] - p[k];
    }
    const float part = light->half[0] * light->half[0] / koksma__dot3(axis, axis);
    return part < 1 ? (1 + sqrtf(1 - part)) / (2 * KOKSMA__PI_F * part) : 0;
}

static const koksma__parameter parameters[] = {
    {"centre", KOKSMA__POINT, .at = offsetof(koksma__light, centre)},
    {"radius", KOKSMA__RADIUS, .at = offsetof(koksma__light, half)},
    {"visible", KOKSMA__FLAG, .optional = true, .at = offsetof(koksma__light, visible)},
    {"radiance", KOKSMA__COLOUR, .high = BRIGHT, .at = offsetof(koksma__light, radiance)},
    {0}};

const koksma__light_kind koksma__light_sphere = {
    .kind = {.name = "sphere",
             .title = "a sphere that shines outwards",
             .cite = "shirley1996",
             .parameters = parameters},
    .form = KOKSMA__BEAMS_CONE,
    .parse = parse,
    .open = open_light,
    .sample = sample,
    .centre = centre,
    .pdf = pdf,
};
