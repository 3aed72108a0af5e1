/* SPDX-License-Identifier: Apache-2.0 */
/* Blocks of path vertices in lanes: what wavefront.c hands to batch_materials.c and batch_beams.c. */
#ifndef KOKSMA_RENDER_PIPELINES_VERTICES_H
#define KOKSMA_RENDER_PIPELINES_VERTICES_H

#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "render/pipelines/batch.h"

typedef float koksma__lanes[KOKSMA__BLOCK];

enum { KOKSMA__UNLIT = -1 }; /* the form of a lane that met nothing, or a light */

/* Traits of a material: 1 << form, its lobes << KOKSMA__LOBES_AT, and others. */
enum {
    KOKSMA__LOBES_AT = 8,
    KOKSMA__TAKES_CHOICE = 1 << 16,
    KOKSMA__HAS_IMAGE = 1 << 17,
    KOKSMA__IS_CHECKER = 1 << 18
};

/* What blocks look up of materials, an array a number, by the material's index + 1; entry 0 is no material. */
typedef struct koksma__lane_materials {
    int32_t *form, *traits;
    float *albedo[2][3], *parameters[4], *diffuse;
    float *u[3], *v[3]; /* of a checker, at (u, v): floor(u[0] u + u[1] v + u[2]), and the same of v */
} koksma__lane_materials;

/* The surfaces that rays hit, seen from where these came. */
typedef struct koksma__surfaces {
    const koksma__hits *hits;
    const koksma__shading_material *materials; /* by hits->material */
    const koksma__lane_materials *table;       /* the same in arrays */
    unsigned traits;                           /* of all, ored */
    KOKSMA__LANES(int32_t, form);
    _Alignas(64) koksma__lanes out[3];
    _Alignas(64) koksma__lanes albedo[3];
    _Alignas(64) koksma__lanes parameters[4];  /* of lobes and facets */
    _Alignas(64) koksma__lanes diffuse;        /* of lobes: koksma__shading_material.derived */
    float local[KOKSMA__BLOCK][KOKSMA__LOCAL]; /* of lanes with images whose kinds have texture() */
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

/* A block of paths, in lanes. */
typedef struct koksma__paths {
    koksma__rays rays;
    _Alignas(64) koksma__lanes beta[3];
    _Alignas(64) koksma__lanes n[3];
    _Alignas(64) koksma__lanes pdf;
    KOKSMA__LANES(int32_t, from);
    KOKSMA__LANES(uint32_t, sample);
} koksma__paths;

/* A block of vertices, at the ends of a block of paths. */
typedef struct koksma__vertices {
    const koksma__paths *paths;
    int n, whole;
    bool moves, chooses; /* the times of paths are read; the normals that they leave, for choosing a light */
    koksma__hits hits;
    koksma__surfaces surfaces;           /* form KOKSMA__UNLIT: a miss, a light, or beyond n */
    _Alignas(64) koksma__lanes light[3]; /* that the paths carry to their samples from here */
} koksma__vertices;

/* What the camera has beside koksma__batch_camera: a lens, whose points are offsets from its centre in units of its
   radius; a shutter; and where the eye goes in a unit of time. */
typedef struct koksma__lens {
    float radius, focus, right[3], down[3], motion[3], open, interval;
} koksma__lens;

static inline unsigned koksma__lobes_of(const koksma__surfaces *s)
{
    return s->traits >> KOKSMA__LOBES_AT & 0xff;
}

/* Surface i, ray by ray. */
static inline koksma__surface koksma__surface_at(const koksma__surfaces *s, int i)
{
    const koksma__hits *h = s->hits;
    koksma__surface surface = {.material = &s->materials[h->material[i]],
                               .p = {h->px[i], h->py[i], h->pz[i]},
                               .n = {h->nx[i], h->ny[i], h->nz[i]},
                               .inside = h->back[i] != 0,
                               .primitive = h->primitive[i]};
    const koksma__bsdf *bsdf = surface.material->bsdf;
    surface.local = bsdf->texture && koksma__is_textured(surface.material) ? s->local[i] : NULL;
    for (int k = 0; k < 3; k++) {
        surface.out[k] = s->out[k][i];
        surface.albedo[k] = s->albedo[k][i];
    }
    return surface;
}

#endif
