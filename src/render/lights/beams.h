/* SPDX-License-Identifier: Apache-2.0 */
/* The formulas by which lights are sampled, for single rays (light_*.c) and, by value, for loops over lanes
   (batch_beams.c): flat surfaces, the cone of a sphere, and the image of an environment; and what several kinds share. */
#ifndef KOKSMA_RENDER_LIGHTS_BEAMS_H
#define KOKSMA_RENDER_LIGHTS_BEAMS_H

#include "render/lights/lights.h"
#include "render/vector3.h"

/* A distance larger than any in a scene. */
#define KOKSMA__AWAY 4e6f

/* value = scale times the light's radiance */
static inline void koksma__set_value(const koksma__shading_light *light, float scale, koksma__beam *out)
{
    for (int k = 0; k < 3; k++) {
        out->value[k] = scale * light->radiance[k];
    }
}

/* For a sampled position at the vector d from the point, on a surface that is sampled by area: sets *w to the
   direction, of length 1, and returns the density over solid angle, which is 0 behind the surface. */
KOKSMA__INLINE float koksma__flat_beam(koksma__v3 d, koksma__v3 normal, float area, koksma__v3 *w)
{
    const float square = koksma__v3_dot(d, d), length = sqrtf(square), at_light = -koksma__v3_dot(normal, d);
    *w = koksma__v3_scale(d, 1 / length);
    const float pdf = square * length / (at_light * area);
    return at_light > 0 ? pdf : 0;
}

/* Samples the cone that a sphere subtends (light_surfaces.c); `axis` is the vector to its centre. Sets *d to the vector
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

/* Functions that several kinds share. koksma__emitter_open sets area, reach and power of a Lambert emitter.
   koksma__area_pdf is the pdf() of a surface that is sampled by area. koksma__point_beam treats the light as a point at
   its centre: the intensity is `strength` times the radiance, and the light decreases with the squared distance. */
void koksma__emitter_open(koksma__shading_light *light, double area, float reach);
float koksma__area_pdf(const koksma__shading_light *light, const float p[3], const float w[3], float t,
                       const float n[3]);
bool koksma__point_beam(const koksma__shading_light *light, const float p[3], float strength, koksma__beam *out);

/* ---- Meshes (light_mesh.c) --------------------------------------------------------------------------------------- */

#define KOKSMA__BRIGHTEST 1e6f /* pixels of an image of the emission are clamped to this */

/* A triangle of a luminous mesh, in world coordinates; `largest` is its largest coordinate, without sign. */
typedef struct koksma__mesh_light_face {
    float corners[9], normal[3], largest;
} koksma__mesh_light_face;

typedef struct koksma__mesh_light {
    size_t n;
    double *cdf; /* running sums of the triangles' areas, or of their emission; n + 1 numbers */
    const koksma__mesh *mesh;
    const koksma__map *map; /* the image of the emission, or NULL */
    /* if there is an image: the density over area of positions on each triangle; otherwise NULL */
    float *densities;
    koksma__mesh_light_face faces[];
} koksma__mesh_light;

/* The emission according to the image at the point of triangle t with the weights a and b of its corners 1 and 2. */
void koksma__mesh_glow(const koksma__mesh_light *m, size_t t, float a, float b, float rgb[3]);

/* ---- Environments ----------------------------------------------------------------------------------------------- */

enum { KOKSMA__ENVIRONMENT_STEP = 16 }; /* the coarse table of a cumulative table has every 16th entry */

/* The fraction of samples that are uniform over the sphere. */
#define KOKSMA__ENVIRONMENT_FLOOR 0.01f

typedef struct koksma__environment {
    float radiance[3];       /* multiplies the image */
    const float *texels;     /* the image, with `channels` numbers for each pixel; NULL: constant radiance */
    int32_t channels, green; /* green is the offset of the green number in a texel; blue is at 2 * green */
    int32_t width, height;
    float turn; /* rotation, as a fraction of a full turn */
    float mean;
    /* Cumulative tables, of `height` entries over the rows and of `width` over the columns of each row; row r's table
       begins at column_cdf + r stride. Each table is padded with values above 1 to a multiple of 16 numbers, and then
       by 16 more. row_coarse and column_coarse hold every 16th entry and are searched first. */
    float *row_cdf, *column_cdf, *row_coarse, *column_coarse;
    size_t stride;
} koksma__environment;

/* The texel of a direction, and the sine of the angle between the direction and the vertical. */
typedef struct koksma__texel {
    int32_t row, column;
    float sine;
} koksma__texel;

KOKSMA__INLINE koksma__v3 koksma__environment_direction(const koksma__environment *e, float x, float y, float *sine)
{
    float s, c, up;
    koksma__sine_cosine_turns(x - e->turn, &s, &c);
    koksma__sine_cosine_turns(0.5f * y, sine, &up);
    return (koksma__v3){-*sine * s, up, *sine * c};
}

KOKSMA__INLINE koksma__texel koksma__environment_texel(const koksma__environment *e, koksma__v3 w)
{
    const float sine = sqrtf(w.x * w.x + w.z * w.z);
    const float turns = koksma__arc_turns(-w.x, w.z) + e->turn + 2, x = turns - (float)(int32_t)turns;
    /* an arc cosine in floats cannot resolve angles below 2^-12 */
    const float y = 2 * koksma__arc_turns(sine, w.y);
    const int32_t column = (int32_t)(x * (float)e->width), row = (int32_t)(y * (float)e->height);
    return (koksma__texel){row < e->height ? row : e->height - 1, column < e->width ? column : e->width - 1, sine};
}

/* The density of sampling the directions in a texel. */
KOKSMA__INLINE float koksma__environment_texel_pdf(const koksma__environment *e, koksma__texel t)
{
    const float *columns = e->column_cdf + (size_t)t.row * e->stride + (size_t)t.column, *rows = e->row_cdf + t.row;
    const float cell = (rows[1] - rows[0]) * (columns[1] - columns[0]) * ((float)e->width * (float)e->height);
    const float image = cell / (2 * 3.14159265358979f * 3.14159265358979f * (t.sine > 1e-6f ? t.sine : 1e-6f));
    return KOKSMA__ENVIRONMENT_FLOOR * (0.25f / 3.14159265358979f) + (1 - KOKSMA__ENVIRONMENT_FLOOR) * image;
}

KOKSMA__INLINE koksma__v3 koksma__environment_texel_radiance(const koksma__environment *e, koksma__texel t)
{
    const float *texel = e->texels + ((size_t)t.row * (size_t)e->width + (size_t)t.column) * (size_t)e->channels;
    const float r = texel[0], g = texel[e->green], b = texel[2 * e->green];
    /* clamps negative values to 0 */
    return (koksma__v3){e->radiance[0] * (r > 0 ? r : 0), e->radiance[1] * (g > 0 ? g : 0),
                        e->radiance[2] * (b > 0 ? b : 0)};
}

#endif
