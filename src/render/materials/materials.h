/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a surface does with light, direction by direction. All ways are of length 1 and lead away from the surface;
 * n.out > 0. A material's lobes are told apart, because integrators follow some and not others.
 */
#ifndef KOKSMA_RENDER_MATERIALS_MATERIALS_H
#define KOKSMA_RENDER_MATERIALS_MATERIALS_H

#include "scene/scene.h"

/* Lobes. */
enum { KOKSMA__LOBE_DIFFUSE = 1, KOKSMA__LOBE_GLOSSY = 2, KOKSMA__LOBE_SPECULAR = 4 };

/* A material in floats. */
typedef struct koksma__substance {
    koksma__material_kind kind;
    unsigned lobes; /* that it has */
    float albedo[2][3], reflectance[3];
    float exponent, roughness, ior;
    const koksma_image *image; /* of the albedo, or NULL */
    float diffuse_share;       /* of the choice between a diffuse and a glossy lobe */
} koksma__substance;

/* A place on it, seen from `out`. */
typedef struct koksma__surface {
    const koksma__substance *substance;
    float p[3], n[3]; /* n towards the side that it is seen from */
    float out[3];
    float albedo[3]; /* of the diffuse part, here */
    bool inside;     /* seen from within a closed shape, or from a flat one's back */
    int32_t primitive;
} koksma__surface;

/* A way that light may come from. */
typedef struct koksma__scatter {
    float w[3];
    float weight[3]; /* material times cosine over density */
    float density;   /* over solid angle, of the lobes that were asked for; 0 for specular ones */
    unsigned lobe;
} koksma__scatter;

typedef struct koksma__material_rules {
    const char *cite;
    unsigned lobes;
    /* value += material times cosine for light from w, of these lobes; the density with which sample() would choose w
       among these lobes. */
    float (*value)(const koksma__surface *s, const float w[3], unsigned lobes, float value[3]);
    /* Chooses a way among these lobes: u for the direction, choice for the lobe. False: the light is lost. */
    bool (*sample)(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out);
} koksma__material_rules;

/* By koksma__material_kind. */
const koksma__material_rules *koksma__material_rules_of(koksma__material_kind kind);

koksma__substance koksma__substance_of(const koksma__material *from);

/* Whether branching integrators should follow both ways of a dielectric: the reflected share and both ways. False:
   the material has one way only. */
bool koksma__dielectric_split(const koksma__surface *s, koksma__scatter *reflected, koksma__scatter *refracted);

#define MATERIAL(name, kind) extern const koksma__material_rules koksma__material_##name;
#include "render/materials/materials.def"
#undef MATERIAL

#endif
