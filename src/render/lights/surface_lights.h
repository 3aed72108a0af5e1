/* SPDX-License-Identifier: Apache-2.0 */
/* Functions that several kinds of lights share: lights with an emitting surface, and lights treated as points. */
#ifndef KOKSMA_RENDER_LIGHTS_SURFACE_LIGHTS_H
#define KOKSMA_RENDER_LIGHTS_SURFACE_LIGHTS_H

#include "render/lights/lights.h"
#include "render/shapes/shapes.h"
#include "render/vector3.h"

/* A distance larger than any in a scene. */
#define KOKSMA__AWAY 4e6f

/* The fields of a flat light that are not parameters: "facing" or "normal", "up", "radiance" or "strength". */
#define KOKSMA__FLAT_KEYS ((const char *const[]){"normal", "facing", "up", "radiance", "strength", NULL})
#define KOKSMA__FLAT_EXAMPLE "\"facing\": [0.1, -0.2, 0.3], \"radiance\": [3, 2, 1]"

/* Reads the fields KOKSMA__FLAT_KEYS; adds the surface of a visible light to the scene. */
koksma_status koksma__flat_light_parse(const field *f, koksma_scene *scene, koksma__light *light, double area,
                                       const koksma__shape_type *shape);

/* Adds the surface of a visible light: a shape of this kind in the light's coordinate frame. */
koksma_status koksma__light_add_surface(const field *f, koksma_scene *scene, const koksma__light *light,
                                        const koksma__shape_type *type);

/* Sets area, reach and power of a Lambert emitter. */
void koksma__emitter_open(koksma__shading_light *light, double area, float reach);

/* For any surface that is sampled by area. koksma__flat_light_sample computes a sample at coordinates u, v of the
   surface, with density 1 / area. koksma__flat_light_centre treats the light as a point at its centre.
   koksma__area_pdf returns the density of samples over solid angle. */
bool koksma__flat_light_sample(const koksma__shading_light *light, const float p[3], float u, float v,
                               koksma__beam *out);
bool koksma__flat_light_centre(const koksma__shading_light *light, const float p[3], koksma__beam *out);
float koksma__area_pdf(const koksma__shading_light *light, const float p[3], const float w[3], float t,
                       const float n[3]);

/* For a sampled position at the vector d from the point, on a surface that is sampled by area: sets *w to the
   direction, of length 1, and returns the density over solid angle, which is 0 behind the surface. */
KOKSMA__INLINE float koksma__flat_beam(koksma__v3 d, koksma__v3 normal, float area, koksma__v3 *w)
{
    const float square = koksma__v3_dot(d, d), length = sqrtf(square), at_light = -koksma__v3_dot(normal, d);
    *w = koksma__v3_scale(d, 1 / length);
    const float pdf = square * length / (at_light * area);
    return at_light > 0 ? pdf : 0;
}

/* Samples the cone that a sphere subtends (light_sphere.c); `axis` is the vector to its centre. Sets *d to the vector
   to the sampled position on the sphere, and *w to its direction; returns the density, which is 0 if the point is
   inside the sphere. */
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

/* Treats the light as a point at its centre: the intensity is `strength` times the radiance, and the light decreases
   with the squared distance. */
bool koksma__point_beam(const koksma__shading_light *light, const float p[3], float strength, koksma__beam *out);

/* sample() of a light without extent. */
bool koksma__point_sample(const koksma__shading_light *light, const float p[3], const float u[2], koksma__beam *out);

/* value = scale times the light's radiance */
static inline void koksma__set_value(const koksma__shading_light *light, float scale, koksma__beam *out)
{
    for (int k = 0; k < 3; k++) {
        out->value[k] = scale * light->radiance[k];
    }
}

#endif
