/* SPDX-License-Identifier: Apache-2.0 */
/* What integrators tell the pipelines to do at a vertex. The table of them is integrators.c. */
#ifndef KOKSMA_RENDER_INTEGRATORS_INTEGRATOR_FLAGS_H
#define KOKSMA_RENDER_INTEGRATORS_INTEGRATOR_FLAGS_H

#include "render/materials/materials.h"
#include "render/pipelines/batch.h"

struct koksma__frame;

typedef struct koksma__integrator_flags {
    unsigned followed; /* lobes whose directions are followed further; the others see lights only */
    bool areas;        /* lights are sampled all over; else from their centres */
    bool shadows;
    bool ambient;                /* the scene's ambient stands for light between diffuse surfaces */
    bool branches;               /* glass sends two rays */
    bool roulette;               /* dim paths end at random */
    koksma__light_weight weight; /* of light that sampling it and a followed lobe can both find */
    bool is_biased;              /* converges to something else than its formula, even without its depth limit */
    /* NULL, or: what is made before the picture, kept in frame->cache; and what it says of the light that diffuse
       surfaces send to s at a time, as irradiance / pi, added to out. */
    koksma_status (*open)(struct koksma__frame *frame, const koksma_run *run);
    void (*close)(struct koksma__frame *frame);
    koksma_status (*indirect)(const struct koksma__frame *frame, const koksma__surface *s, float time, float out[3]);
    /* NULL, or: the scene that is rendered in place of the one that the caller has, of diffuse surfaces and without
       light from lights; release is called on what it made, also where it failed. */
    koksma_status (*replace_scene)(const koksma_scene *scene, koksma_scene **out);
    void (*release_scene)(koksma_scene *scene);
} koksma__integrator_flags;

#endif
