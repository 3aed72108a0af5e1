/* SPDX-License-Identifier: Apache-2.0 */
/* Blocks of path vertices in lanes: what wavefront.c hands to batch_materials.c and batch_beams.c. */
#ifndef KOKSMA_RENDER_PIPELINES_VERTICES_H
#define KOKSMA_RENDER_PIPELINES_VERTICES_H

#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "render/pipelines/batch.h"

typedef float koksma__lanes[KOKSMA__BLOCK];

enum { KOKSMA__UNLIT = -1 }; /* the form of a lane that met nothing, or a light */

/* The surfaces that rays hit, seen from where these came. */
typedef struct koksma__surfaces {
    const koksma__hits *hits;
    const koksma__shading_material *materials; /* by hits->material */
    unsigned forms, lobes;                     /* 1 << form of each that there is; all lobes */
    bool takes_choice, has_images;             /* of any */
    KOKSMA__LANES(int32_t, form);
    _Alignas(64) koksma__lanes out[3];
    _Alignas(64) koksma__lanes albedo[3];
    _Alignas(64) koksma__lanes parameters[4]; /* of lobes and facets */
    _Alignas(64) koksma__lanes diffuse;       /* of lobes: koksma__shading_material.derived */
} koksma__surfaces;

/* Material times cosine, and the density. */
typedef struct koksma__bsdf_values {
    _Alignas(64) koksma__lanes value[3];
    _Alignas(64) koksma__lanes pdf;
} koksma__bsdf_values;

/* koksma__scatter in lanes; kept 0: the light is lost. */
typedef struct koksma__directions {
    _Alignas(64) koksma__lanes w[3];
    _Alignas(64) koksma__lanes weight[3];
    _Alignas(64) koksma__lanes pdf;
    KOKSMA__LANES(int32_t, kept);
} koksma__directions;

/* The light that each vertex samples, or -1, with which probability. same: all lanes have this one, or -1. */
typedef struct koksma__light_lanes {
    const koksma__shading_light *lights;
    int same;
    bool centres; /* lights count as points at their centres */
    KOKSMA__LANES(int32_t, light);
    _Alignas(64) koksma__lanes probability;
} koksma__light_lanes;

/* koksma__beam in lanes; lit 0: nothing comes. */
typedef struct koksma__beams {
    _Alignas(64) koksma__lanes d[3];
    _Alignas(64) koksma__lanes w[3];
    _Alignas(64) koksma__lanes value[3];
    _Alignas(64) koksma__lanes pdf;
    KOKSMA__LANES(int32_t, lit);
    KOKSMA__LANES(int32_t, visible);
} koksma__beams;

/* Surface i, ray by ray. */
static inline koksma__surface koksma__surface_at(const koksma__surfaces *s, int i)
{
    const koksma__hits *h = s->hits;
    koksma__surface surface = {.material = &s->materials[h->material[i]],
                               .p = {h->px[i], h->py[i], h->pz[i]},
                               .n = {h->nx[i], h->ny[i], h->nz[i]},
                               .inside = h->back[i] != 0,
                               .primitive = h->primitive[i]};
    for (int k = 0; k < 3; k++) {
        surface.out[k] = s->out[k][i];
        surface.albedo[k] = s->albedo[k][i];
    }
    return surface;
}

#endif
