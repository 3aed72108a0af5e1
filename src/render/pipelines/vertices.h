/* SPDX-License-Identifier: Apache-2.0 */
/* The structures for blocks of path vertices in SIMD lanes, which wavefront.c passes to the kernels of
   batch_materials.c, batch_beams.c and batch_paths.c. */
#ifndef KOKSMA_RENDER_PIPELINES_VERTICES_H
#define KOKSMA_RENDER_PIPELINES_VERTICES_H

#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "render/pipelines/batch.h"

enum { KOKSMA__UNLIT = -1 }; /* the form of a lane whose ray hit nothing or a light, in place of a material's form */

/* The trait bits of a material: 1 << form, its lobes << KOKSMA__LOBES_AT, and the flags below. */
enum {
    KOKSMA__LOBES_AT = 8,
    KOKSMA__TAKES_CHOICE = 1 << 16,
    KOKSMA__HAS_IMAGE = 1 << 17,
    KOKSMA__IS_CHECKER = 1 << 18,
    KOKSMA__GLOWS = 1 << 19 /* some mesh of the material is a light */
};

/* The properties of materials that kernels look up, one array per property, indexed by the material + 1; entry 0
   means no material. */
typedef struct koksma__lane_materials {
    int32_t n; /* of materials + 1; columns are followed by room for 16 numbers */
    int32_t *form, *traits;
    float *albedo[2][3], *parameters[4], *derived;
    /* The square of a checker at (u, v) has column floor(u[0] u + u[1] v + u[2]) and row floor(v[0] u + v[1] v +
       v[2]). */
    float *u[3], *v[3];
} koksma__lane_materials;

/* The surfaces that rays hit; `out` is the direction back along each ray. */
typedef struct koksma__surfaces {
    const koksma__hits *hits;
    const koksma__shading_material *materials; /* indexed by hits->material */
    const koksma__lane_materials *table;       /* the materials as arrays of their properties */
    unsigned traits;                           /* the bitwise "or" of the traits of all materials that were hit */
    int32_t met_lights; /* not 0 if some lane hit a surface without a material, which is a light's */
    KOKSMA__LANES(int32_t, form);
    KOKSMA__LANES(int32_t, trait); /* the traits of each lane's material */
    _Alignas(64) koksma__lanes out[3];
    _Alignas(64) koksma__lanes albedo[3];
    _Alignas(64) koksma__lanes parameters[4]; /* those of materials of the forms LOBES, FACETS and COATED */
    _Alignas(64) koksma__lanes derived;       /* koksma__shading_material.derived of the forms LOBES and COATED */
} koksma__surfaces;

/* The values of BSDFs times the cosine, and their sampling densities. */
typedef struct koksma__bsdf_values {
    _Alignas(64) koksma__lanes value[3];
    _Alignas(64) koksma__lanes pdf;
} koksma__bsdf_values;

/* Sampled directions: the members of koksma__scatter, each as an array over the lanes. If `kept` is 0, the path
   ends. */
typedef struct koksma__directions {
    _Alignas(64) koksma__lanes w[3];
    _Alignas(64) koksma__lanes weight[3];
    _Alignas(64) koksma__lanes pdf;
    KOKSMA__LANES(int32_t, kept);
} koksma__directions;

/* The light that each vertex samples, or -1, and the probability of choosing that light. `same` is the light of all
   lanes if they share one, otherwise -1. */
typedef struct koksma__light_lanes {
    const koksma__shading_light *lights;
    int same;
    bool centres; /* lights are treated as points at their centres */
    KOKSMA__LANES(int32_t, light);
    _Alignas(64) koksma__lanes probability;
} koksma__light_lanes;

/* Samples of lights: the members of koksma__beam, each as an array over the lanes. If `lit` is 0, no light
   arrives. */
typedef struct koksma__beams {
    _Alignas(64) koksma__lanes d[3];
    _Alignas(64) koksma__lanes w[3];
    _Alignas(64) koksma__lanes value[3];
    _Alignas(64) koksma__lanes pdf;
    KOKSMA__LANES(int32_t, lit);
    KOKSMA__LANES(int32_t, visible);
} koksma__beams;

/* A block of paths: their current rays and the weights `beta` with which light along the rays counts for their samples. */
typedef struct koksma__paths {
    koksma__rays rays;
    _Alignas(64) koksma__lanes beta[3];
    _Alignas(64) koksma__lanes n[3]; /* normals of the surfaces where the rays start */
    /* sampling densities of the directions: 0 if a ray comes from a mirror or the eye, -1 if it must not see lights */
    _Alignas(64) koksma__lanes pdf;
    KOKSMA__LANES(int32_t, from); /* the primitives on which the rays start, or -1 */
    KOKSMA__LANES(uint32_t, sample);
} koksma__paths;

/* A block of vertices, where the rays of a block of paths end. */
typedef struct koksma__vertices {
    const koksma__paths *paths;
    int n, whole;
    /* moves: whether kernels read the times of paths; chooses: whether they read the normals of paths, to choose
       lights */
    bool moves, chooses;
    koksma__hits hits;
    /* the form of a lane is KOKSMA__UNLIT if its ray hit nothing or a light, or if the lane is unused */
    koksma__surfaces surfaces;
    _Alignas(64) koksma__lanes light[3]; /* light that this vertex adds to the sample of each path */
} koksma__vertices;

static inline unsigned koksma__lobes_of(const koksma__surfaces *s)
{
    return s->traits >> KOKSMA__LOBES_AT & 0xff;
}

/* Returns the surface of lane i, for materials that are evaluated one ray at a time. */
static inline koksma__surface koksma__surface_at(const koksma__surfaces *s, int i)
{
    const koksma__hits *h = s->hits;
    koksma__surface surface = {.material = &s->materials[h->material[i]],
                               .p = {h->p[0][i], h->p[1][i], h->p[2][i]},
                               .n = {h->n[0][i], h->n[1][i], h->n[2][i]},
                               .inside = h->back[i] != 0,
                               .primitive = h->primitive[i]};
    for (int k = 0; k < 3; k++) {
        surface.out[k] = s->out[k][i];
        surface.albedo[k] = s->albedo[k][i];
    }
    return surface;
}

#endif
