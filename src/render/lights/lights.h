/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Lights: what comes from one of them to a point, from a position that two numbers choose. A kind of light is one
 * file, light_<name>.c, and one line of lights.def: its name and parameters in scene files, its power, its sampling
 * and its density. Densities are over solid angle as seen from the point; a light without extent (point, directional)
 * has density 0 and counts in full.
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
    bool visible;
    float centre[3], axis_u[3], axis_v[3], normal[3], half[2];
    float radiance[3];
    float values[KOKSMA__MAX_VALUES]; /* of the kind's own parameters */
    float area;
    float reach; /* no part of it is further from its centre */
    float
        power; /* luminous, for choosing: all that it emits, over pi^2; of one that is far away, irradiance over pi */
    int shape; /* id of its own surface, or -1 */
    void *data; /* the kind's own, released by its close() */
} koksma__shading_light;

/* Light on its way to a point. */
typedef struct koksma__beam {
    float d[3];     /* from the point to the light, which is met at t = 1 */
    float w[3];     /* the same direction, of length 1 */
    float value[3]; /* radiance over pdf; for the cosine law and the material still to be applied */
    float pdf;      /* of w, or 0 */
} koksma__beam;

/* How the estimate of a light's contribution at a point (koksma__batch_lights) depends on the point. */
typedef enum koksma__light_distance {
    KOKSMA__LIGHT_NEAR,     /* falls with the distance from its centre */
    KOKSMA__LIGHT_PARALLEL, /* comes from one direction, -normal */
    KOKSMA__LIGHT_AROUND    /* comes from all directions that hit nothing */
} koksma__light_distance;

/* Which formula of batch_beams.c samples a kind for blocks of points. */
typedef enum koksma__beam_form {
    KOKSMA__BEAMS_RAYS, /* none: sample(), point by point */
    KOKSMA__BEAMS_RECTANGLE,
    KOKSMA__BEAMS_DISK,
    KOKSMA__BEAMS_CONE, /* a sphere */
    KOKSMA__BEAMS_PARALLEL,
    KOKSMA__BEAMS_AROUND, /* an environment, of which a scene has one */
    KOKSMA__N_BEAM_FORMS
} koksma__beam_form;

typedef struct koksma__light_kind {
    koksma__kind kind; /* parameters are written to koksma__light; its own at KOKSMA__LIGHT_VALUE(i) */
    koksma__light_distance distance;
    koksma__beam_form form;
    bool is_flat; /* shines to the side of its normal only; u, v along its axes, as far as half */
    /* NULL, or: reads the fields that are no parameters; name is the scene file's. */
    koksma_status (*parse)(const char *name, const field *f, koksma_scene *scene, koksma__light *light);
    /* Sets area, reach, power and data. Errors: MALFORMED (an image or a mesh can't be a light), MEMORY. */
    koksma_status (*open)(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *light);
    void (*close)(void *data); /* NULL: there is no data */
    /* A sample of the light that comes to p, by u; false when nothing comes. */
    bool (*sample)(const koksma__shading_light *light, const float p[3], const float u[2], koksma__beam *out);
    /* The light as a point at its centre (Whitted's), with pdf 0; NULL or false: it has none. */
    bool (*centre)(const koksma__shading_light *light, const float p[3], koksma__beam *out);
    /* The density with which sample() would choose the direction w (of length 1) from p, which meets the light at
       distance t, where its normal is n (unused far away). NULL: 0 everywhere. */
    float (*pdf)(const koksma__shading_light *light, const float p[3], const float w[3], float t, const float n[3]);
    /* NULL, or, of a mesh: what it sends from (u, v) of a triangle, and the density of sampling that position, over area. */
    float (*met)(const koksma__shading_light *light, uint32_t triangle, const float uv[2], float radiance[3]);
    /* NULL, or, of light from all around: the radiance along w. */
    void (*radiance)(const koksma__shading_light *light, const float w[3], float out[3]);
    /* NULL, or: sets what lambert_lanes.c samples, if the light is seen by no ray. */
    void (*lanes)(const koksma__light *from, koksma__batch_light *out);
} koksma__light_kind;

/* Where number i of a kind's own parameters is written. */
#define KOKSMA__LIGHT_VALUE(i) (offsetof(koksma__light, values) + (i) * sizeof(double))

/* All kinds in the order of lights.def, then NULL. */
extern const koksma__light_kind *const koksma__light_types[];
extern const koksma__kind *const koksma__light_kinds[];

typedef struct koksma__lights {
    size_t n;
    koksma__shading_light *lights;
    float *cdf;                      /* of the powers; n + 1 numbers */
    koksma__batch_lights *estimates; /* for choosing by position */
    koksma__batch_light *rectangles; /* for lambert_lanes.c; only where all kinds have lanes */
    size_t first_around;             /* the first light from all around, or n */
} koksma__lights;

/* The lights of a scene, ready for sampling; fini also after a failure. Errors: those of open(). */
koksma_status koksma__lights_init(const koksma_scene *scene, koksma__lights *out);
void koksma__lights_fini(koksma__lights *lights);

#define LIGHT(name) extern const koksma__light_kind koksma__light_##name;
#include "render/lights/lights.def"
#undef LIGHT

#endif
