/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Lights: the radiance that arrives at a point from a light, at a position sampled by two random numbers. A kind of
 * light is one line of lights.def, which names its file: its name and parameters in scene files, its power, its
 * sampling and its density. Densities are over solid angle as seen from the point; a light without extent (point,
 * directional) has density 0 and is never hit by rays, so that its samples count in full.
 *
 * tests/render/test_light_kinds.c checks every line of the table: samples match the density, the power is that of the
 * emitted light, and all ways of choosing among lights give the same pictures.
 */
#ifndef KOKSMA_RENDER_LIGHTS_LIGHTS_H
#define KOKSMA_RENDER_LIGHTS_LIGHTS_H

#include "render/description.h"
#include "render/fields.h"
#include "render/pipelines/batch.h"

/* A light in floats, as the renderer reads it. */
typedef struct koksma__shading_light {
    const struct koksma__light_kind *kind;
    bool visible, two_sided; /* two_sided: a mesh that emits from its back, too */
    float centre[3], axis_u[3], axis_v[3], normal[3], half[2];
    float radiance[3];
    float values[KOKSMA__MAX_VALUES]; /* values of the kind's parameters */
    float area;
    float reach; /* largest distance of a point of the light from its centre */
    /* for choosing among lights: luminous power divided by pi^2, or, for a light far away, irradiance divided by
       pi */
    float power;
    int shape;  /* index of the light's own surface, or -1 */
    void *data; /* the kind's data, released by the kind's close() */
} koksma__shading_light;

/* How a spot's intensity falls off at the edge of its cone (light_points.c): the value of its field `falloff`. */
enum { KOKSMA__FALLOFF_SQUARE, KOKSMA__FALLOFF_SMOOTH, KOKSMA__FALLOFF_ANGLE };

/* A sample of the light that arrives at a point. */
typedef struct koksma__beam {
    float d[3];     /* from the point to the position on the light, which is at t = 1 */
    float w[3];     /* direction from the point to the light, of length 1 */
    float value[3]; /* radiance divided by the pdf, before the cosine and the material are applied */
    float pdf;      /* of w, or 0 */
} koksma__beam;

/* How the estimate of a light's contribution at a point (koksma__batch_lights) depends on the point. */
typedef enum koksma__light_distance {
    KOKSMA__LIGHT_NEAR,     /* the light decreases with the distance from its centre */
    KOKSMA__LIGHT_PARALLEL, /* the light comes from one direction, -normal */
    KOKSMA__LIGHT_AROUND    /* the light comes from all directions in which rays hit nothing */
} koksma__light_distance;

/* The formula of batch_beams.c that samples a kind of light for blocks of points. */
typedef enum koksma__beam_form {
    KOKSMA__BEAMS_RAYS, /* no formula: sample() is called for each point */
    KOKSMA__BEAMS_RECTANGLE,
    KOKSMA__BEAMS_DISK,
    KOKSMA__BEAMS_CONE, /* a sphere */
    KOKSMA__BEAMS_PARALLEL,
    KOKSMA__BEAMS_MESH,
    KOKSMA__BEAMS_AROUND, /* an environment; a scene has at most one */
    KOKSMA__N_BEAM_FORMS
} koksma__beam_form;

typedef struct koksma__light_kind {
    koksma__kind
        kind; /* parameters are written to koksma__light; the kind's own parameters at KOKSMA__LIGHT_VALUE(i) */
    koksma__light_distance distance;
    koksma__beam_form form;
    /* the light shines only on the side of its normal, and extends along its axes u and v as far as `half` */
    bool is_flat;
    /* NULL, or reads the fields that are not parameters; `name` is the name of the scene file. */
    koksma_status (*parse)(const char *name, const field *f, koksma_scene *scene, koksma__light *light);
    /* Sets area, reach, power and data. Errors: MALFORMED (an image or a mesh can't be a light), MEMORY. */
    koksma_status (*open)(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *light);
    void (*close)(void *data); /* NULL if data is not used */
    /* Samples the light that arrives at p, by the random numbers u; returns false if no light arrives. NULL: the kind has
       a form. */
    bool (*sample)(const koksma__shading_light *light, const float p[3], const float u[2], koksma__beam *out);
    /* Treats the light as a point at its centre (as in Whitted's integrator), with pdf 0. For a light without a
       centre the pointer is NULL, or the function returns false. */
    bool (*centre)(const koksma__shading_light *light, const float p[3], koksma__beam *out);
    /* The density with which sample() chooses the direction w (of length 1) from p; w hits the light at distance t,
       where the light's normal is n (unused for lights far away). NULL: 0 everywhere. */
    float (*pdf)(const koksma__shading_light *light, const float p[3], const float w[3], float t, const float n[3]);
    /* NULL, or, for a mesh, sets its emission at (u, v) of a triangle; returns the density over area of sampling that
       position. */
    float (*met)(const koksma__shading_light *light, uint32_t triangle, const float uv[2], float radiance[3]);
    /* NULL, or, for an environment, computes its radiance along w. */
    void (*radiance)(const koksma__shading_light *light, const float w[3], float out[3]);
    /* NULL, or writes a light as the rectangle that lambert_lanes.c reads. That pipeline runs only if all kinds of
       the scene's lights have this function and rays meet none of the lights. */
    void (*lanes)(const koksma__light *from, koksma__batch_light *out);
} koksma__light_kind;

/* The offset at which number i of a kind's own parameters is stored. */
#define KOKSMA__LIGHT_VALUE(i) (offsetof(koksma__light, values) + (i) * sizeof(double))

/* All kinds of lights in the order of lights.def; ends with NULL. */
extern const koksma__light_kind *const koksma__light_types[];
extern const koksma__kind *const koksma__light_kinds[];

typedef struct koksma__lights {
    size_t n;
    koksma__shading_light *lights;
    float *cdf;                      /* cumulative powers, n + 1 numbers */
    koksma__batch_lights *estimates; /* data from which each light's contribution at a point is estimated */
    koksma__batch_light *rectangles; /* for lambert_lanes.c; entry i is set if the kind of light i has lanes() */
    size_t first_around;             /* index of the first environment, or n */
} koksma__lights;

/* Prepares the lights of a scene for sampling; the caller must call fini even after a failure. Errors: those of
   open(). */
koksma_status koksma__lights_init(const koksma_scene *scene, koksma__lights *out);
void koksma__lights_fini(koksma__lights *lights);

#define LIGHT(name) extern const koksma__light_kind koksma__light_##name;
#include "render/lights/lights.def"
#undef LIGHT

#endif
