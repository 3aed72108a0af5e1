/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_RENDER_INTEGRATORS_INTEGRATORS_H
#define KOKSMA_RENDER_INTEGRATORS_INTEGRATORS_H

#include "render/materials/materials.h"

struct koksma__frame;

/* What an integrator does at a vertex; wavefront.c does it. */
typedef struct koksma__integrator_flags {
    unsigned followed; /* lobes whose ways are followed further; the others see luminaires only */
    bool areas;        /* luminaires are sampled all over; else from their centres */
    bool shadows;
    bool ambient;  /* the scene's ambient stands for light between diffuse surfaces */
    bool branches; /* glass sends two rays */
    bool roulette; /* dim paths end at random */
    /* NULL, or: what is made before the picture, kept in frame->cache; and what it says of the light that diffuse
       surfaces send to s at a time, as irradiance / pi, added to out. */
    koksma_status (*open)(struct koksma__frame *frame, const koksma_run *run);
    void (*close)(struct koksma__frame *frame);
    koksma_status (*indirect)(const struct koksma__frame *frame, const koksma__surface *s, float time, float out[3]);
} koksma__integrator_flags;

#define INTEGRATOR(name) extern const koksma_integrator koksma__integrator_##name;
#include "render/integrators/integrators.def"
#undef INTEGRATOR

#endif
