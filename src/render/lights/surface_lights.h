/* SPDX-License-Identifier: Apache-2.0 */
/* What several kinds of lights share: surfaces that emit, and lights taken as points. */
#ifndef KOKSMA_RENDER_LIGHTS_SURFACE_LIGHTS_H
#define KOKSMA_RENDER_LIGHTS_SURFACE_LIGHTS_H

#include "render/lights/lights.h"
#include "render/shapes/shapes.h"
#include "render/vector3.h"

/* Further than anything in a scene. */
#define KOKSMA__AWAY 4e6f

/* The fields of a flat light that are no parameters: "facing" or "normal", "up", "radiance" or "strength". */
#define KOKSMA__FLAT_KEYS ((const char *const[]){"normal", "facing", "up", "radiance", "strength", NULL})
#define KOKSMA__FLAT_EXAMPLE "\"facing\": [0.1, -0.2, 0.3], \"radiance\": [3, 2, 1]"

/* Reads the fields KOKSMA__FLAT_KEYS, and adds the surface of a visible light to the scene. */
koksma_status koksma__flat_light_parse(const field *f, koksma_scene *scene, koksma__light *light, double area,
                                       const koksma__shape_type *shape);

/* The surface of a light that rays see: a shape of this kind with the light's frame. */
koksma_status koksma__light_add_surface(const field *f, koksma_scene *scene, const koksma__light *light,
                                        const koksma__shape_type *type);

/* Sets area and the power of a Lambert emitter of that area. */
void koksma__emitter_open(koksma__shading_light *light, double area, float reach);

/* A sample at u, v of the surface's own coordinates, whose density over the area is 1 / area; the same as a point at
   the centre; the density of both over solid angle, for any surface that is sampled by area. */
bool koksma__flat_light_sample(const koksma__shading_light *light, const float p[3], float u, float v,
                               koksma__beam *out);
bool koksma__flat_light_centre(const koksma__shading_light *light, const float p[3], koksma__beam *out);
float koksma__area_pdf(const koksma__shading_light *light, const float p[3], const float w[3], float t,
                       const float n[3]);

/* The direction w of length 1, and its density, of a sample that lies d away on a surface that is sampled by area; 0:
   behind it. */
KOKSMA__INLINE float koksma__flat_beam(koksma__v3 d, koksma__v3 normal, float area, koksma__v3 *w)
{
    const float square = koksma__v3_dot(d, d), length = sqrtf(square), at_light = -koksma__v3_dot(normal, d);
    *w = koksma__v3_scale(d, 1 / length);
    const float pdf = square * length / (at_light * area);
    return at_light > 0 ? pdf : 0;
}

/* A sample of the cone in which a sphere is seen whose centre is `axis` away (light_sphere.c): the vector d to the
   sphere, its direction w and density; 0: from within. */
KOKSMA__INLINE float koksma__cone_beam(koksma__v3 axis, float radius, float u, float v, koksma__v3 *d, koksma__v3 *w)
{
    const float square = koksma__v3_dot(axis, axis), distance = sqrtf(square), part = radius * radius / square;
    const int outside = part < 1;
    const float rest = part / (1 + sqrtf(outside ? 1 - part : 0)), off = u * rest, sine2 = off * (2 - off);
    float x, y;
    koksma__sine_cosine_turns(v, &y, &x);
    const float sine = sqrtf(sine2 > 0 ? sine2 : 0), inside = radius * radius - square * sine2;
    const float t = distance * (1 - off) - sqrtf(inside > 0 ? inside : 0);
    *w = koksma__v3_about(koksma__v3_scale(axis, 1 / distance), sine * x, sine * y, 1 - off);
    *d = koksma__v3_scale(*w, t);
    const float pdf = 1 / (2 * KOKSMA__PI_F * rest);
    return outside ? pdf : 0;
}

/* All of it from the centre: intensity `strength` times radiance, falling with the square of the distance. */
bool koksma__point_beam(const koksma__shading_light *light, const float p[3], float strength, koksma__beam *out);

/* value = scale times the light's radiance */
static inline void koksma__set_value(const koksma__shading_light *light, float scale, koksma__beam *out)
{
    for (int k = 0; k < 3; k++) {
        out->value[k] = scale * light->radiance[k];
    }
}

#endif
