/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Luminaires, place by place: what comes from one of them to a point, from a place that two numbers choose. Densities
 * are over solid angle as seen from the point; a luminaire without extent (point, directional) has density 0 and
 * counts in full.
 */
#ifndef KOKSMA_RENDER_LIGHTS_LIGHTS_H
#define KOKSMA_RENDER_LIGHTS_LIGHTS_H

#include "render/pipelines/batch.h"
#include "scene/scene.h"

typedef struct koksma__environment koksma__environment;

typedef struct koksma__lamp_mesh koksma__lamp_mesh;

typedef struct koksma__lamp {
    koksma__light_kind kind;
    bool visible;
    float centre[3], axis_u[3], axis_v[3], normal[3], half[2], area;
    float radiance[3];
    float
        power; /* luminous, for choosing: all that it emits, over pi^2; of one that is far away, irradiance over pi */
    int light_shape; /* id of its own surface, or -1 */
    const koksma__environment *environment;
    koksma__lamp_mesh *mesh; /* of a luminous mesh, or NULL */
} koksma__lamp;

typedef struct koksma__lights {
    size_t n;
    koksma__lamp *lamps;
    float *cdf;                       /* of the powers; n + 1 numbers */
    koksma__batch_lamps *estimates;   /* for choosing by place */
    koksma__batch_light *rectangles;  /* for lambert_lanes.c; only where all are rectangles */
    koksma__environment *environment; /* or NULL */
    int environment_lamp;             /* its number, or -1 */
} koksma__lights;

/* Errors: MALFORMED (an image or a mesh can't be a light), MEMORY. */
koksma_status koksma__lights_init(const koksma_scene *scene, koksma__lights *out);
void koksma__lights_fini(koksma__lights *lights);

/* Light on its way to a point. */
typedef struct koksma__beam {
    float d[3];     /* from the point to the luminaire, which is met at t = 1 */
    float w[3];     /* the same way, of length 1 */
    float value[3]; /* radiance over density; for the cosine law and the material still to be applied */
    float density;  /* of w, or 0 */
} koksma__beam;

/* False when nothing comes. */
bool koksma__lamp_sample(const koksma__lamp *lamp, const float p[3], const float u[2], koksma__beam *out);

/* The luminaire as a point at its centre (Whitted's); false for an environment, which has none. */
bool koksma__lamp_centre(const koksma__lamp *lamp, const float p[3], koksma__beam *out);

/* The density with which sample() would choose the way w (of length 1) from p, which meets the luminaire at distance
   t, where its normal is n (idle for the environment). */
float koksma__lamp_density(const koksma__lamp *lamp, const float p[3], const float w[3], float t, const float n[3]);

/* Radiance along the way w from far away. */
void koksma__environment_radiance(const koksma__environment *environment, const float w[3], float out[3]);

/* ---- mesh_light.c --------------------------------------------------------------------------------------- */

/* Sets what a lamp has of its mesh. Errors: MALFORMED (no area), MEMORY. */
koksma_status koksma__lamp_mesh_open(const koksma_scene *scene, const koksma__light *light, koksma__lamp *lamp);
void koksma__lamp_mesh_close(koksma__lamp_mesh *mesh);
bool koksma__lamp_mesh_sample(const koksma__lamp *lamp, const float p[3], const float u[2], koksma__beam *out);

/* ---- environment.c ------------------------------------------------------------------------------------- */

/* Errors: MALFORMED (a pixel that is infinite or no number), MEMORY. */
koksma_status koksma__environment_open(const koksma__light *light, koksma__environment **out);
void koksma__environment_close(koksma__environment *environment);
/* A way by importance; its density. */
float koksma__environment_sample(const koksma__environment *environment, const float u[2], float w[3]);
float koksma__environment_density(const koksma__environment *environment, const float w[3]);
/* The mean radiance over all directions, as luminance. */
float koksma__environment_mean(const koksma__environment *environment);

#endif
