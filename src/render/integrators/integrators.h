/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The flags and hooks by which an integrator controls the pipelines at each path vertex (integrators.c has the table).
 */
#ifndef KOKSMA_RENDER_INTEGRATORS_INTEGRATORS_H
#define KOKSMA_RENDER_INTEGRATORS_INTEGRATORS_H

#include "render/materials/materials.h"
#include "render/pipelines/batch.h"

struct koksma__frame;

typedef struct koksma__integrator_flags {
    unsigned followed; /* lobes from which paths continue; the other lobes reflect only sampled lights */
    bool areas;        /* true: positions on lights are sampled; false: lights count as points at their centres */
    bool shadows;
    /* the scene's ambient light replaces light that diffuse surfaces reflect onto each other */
    bool ambient;
    bool branches;               /* glass sends both a reflected and a refracted ray */
    bool media;                  /* rays are absorbed and scattered by the scene's medium */
    bool roulette;               /* paths of low weight end by Russian roulette */
    koksma__light_weight weight; /* how to weight light that both light sampling and a followed lobe can find */
    /* NULL, or two hooks: `replace_scene` makes the scene that is rendered in place of the caller's, with diffuse
       surfaces and without light from lights; `release_scene` frees its result, even after an error. */
    koksma_status (*replace_scene)(const koksma_scene *scene, koksma_scene **out);
    void (*release_scene)(koksma_scene *scene);
} koksma__integrator_flags;

#endif
