/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a surface does with light, direction by direction. A kind of material is one file, bsdf_<name>.c, and one line
 * of materials.def: its name and parameters in scene files, its value, its sampling and its density. All directions
 * are of length 1 and lead away from the surface; n.out > 0. A material's lobes are told apart, because integrators
 * follow some and not others.
 *
 * tests/render/test_bsdfs.c checks every line of the table with parameters drawn from the declared ranges: densities
 * integrate to what sampling returns, no energy is gained, reciprocity holds where it is claimed.
 */
#ifndef KOKSMA_RENDER_MATERIALS_MATERIALS_H
#define KOKSMA_RENDER_MATERIALS_MATERIALS_H

#include "render/description.h"
#include "render/fields.h"

/* Lobes. */
enum { KOKSMA__LOBE_DIFFUSE = 1, KOKSMA__LOBE_GLOSSY = 2, KOKSMA__LOBE_SPECULAR = 4 };

/* Fields of the diffuse part: "albedo"; "albedos" in the squares of a checker; "albedo": {"image": FILE}. */
enum { KOKSMA__ALBEDO = 1, KOKSMA__CHECKER = 2, KOKSMA__IMAGE = 4 };

/* Which formula of batch_materials.c shades blocks of a material; parameters 0 to 3 are the reflectance and the exponent
   of the lobes or the roughness of the facets. */
typedef enum koksma__material_form {
    KOKSMA__FORM_RAYS,    /* none: value() and sample(), ray by ray */
    KOKSMA__FORM_LAMBERT, /* albedo */
    KOKSMA__FORM_LOBES,   /* Lambert and a cosine lobe; `derived` is the part of directions that Lambert gets */
    KOKSMA__FORM_FACETS,  /* facets.h */
    KOKSMA__N_FORMS
} koksma__material_form;

/* A material in floats, as the renderer reads it. */
typedef struct koksma__shading_material {
    const struct koksma__bsdf *bsdf;
    float albedo[2][3];
    float values[KOKSMA__MAX_VALUES]; /* of the kind's parameters */
    float derived;                    /* what prepare() makes of them */
    const koksma_image *image;        /* of the albedo, or NULL */
    const koksma__material *from;     /* what it is made of: it has the images */
} koksma__shading_material;

/* Whether anything of it depends on where on the surface a point is, beside a checker. */
static inline bool koksma__is_textured(const koksma__shading_material *m)
{
    return m->image || m->from->tinted || m->from->maps[KOKSMA__MAP_SURFACE].image ||
           m->from->maps[KOKSMA__MAP_NORMAL].image;
}

enum { KOKSMA__LOCAL = 4 }; /* numbers of a kind that images decide: what its texture() makes of them */

/* A point on it, seen from `out`. */
typedef struct koksma__surface {
    const koksma__shading_material *material;
    float p[3], n[3]; /* n towards the side that it is seen from */
    float out[3];
    float albedo[3];    /* of the diffuse part, here */
    const float *local; /* of kinds with texture(), of textured materials: the numbers here; else NULL */
    bool inside;        /* seen from within a closed shape, or from a flat one's back */
    int32_t primitive;
} koksma__surface;

/* A direction that light may come from. */
typedef struct koksma__scatter {
    float w[3];
    float weight[3]; /* material times cosine over pdf */
    float pdf;       /* over solid angle, of the lobes that were asked for; 0 for specular ones */
    unsigned lobe;
} koksma__scatter;

typedef struct koksma__bsdf {
    koksma__kind kind; /* parameters are written to koksma__material: at = KOKSMA__VALUE(i) */
    unsigned lobes;    /* that it has */
    unsigned diffuse;  /* which fields of the diffuse part it takes; 0: none */
    bool is_lambert;   /* its value is albedo cosine / pi and nothing else, so that lambert_lanes.c can shade it */
    koksma__material_form form;
    bool takes_choice; /* sample() depends on choice */
    bool reciprocal;   /* value / cosine is the same with w and out exchanged */
    /* NULL, or: why these parameters are refused together; NULL if they are not. */
    const char *(*check)(const koksma__material *material);
    void (*prepare)(koksma__shading_material *material); /* NULL, or sets derived */
    /* value += material times cosine for light from w, of these lobes; the density with which sample() would choose w
       among these lobes. */
    float (*value)(const koksma__surface *s, const float w[3], unsigned lobes, float value[3]);
    /* Chooses a direction among these lobes: u for the direction, choice for the lobe. False: the light is lost. */
    bool (*sample)(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out);
    /* NULL, or: what becomes of an albedo here, and of roughness and metal by the factors of an image. Sets local[0] to
       [KOKSMA__LOCAL - 1], and albedo to that of the diffuse part. */
    void (*texture)(const koksma__shading_material *material, const float factors[2], float albedo[3], float *local);
    /* NULL, or, for integrators that follow both directions of glass: both, weighed by Fresnel's share. */
    void (*split)(const koksma__surface *s, koksma__scatter *reflected, koksma__scatter *refracted);
} koksma__bsdf;

/* Where parameter i of a material is written. */
#define KOKSMA__VALUE(i) (offsetof(koksma__material, values) + (i) * sizeof(double))

/* All kinds in the order of materials.def, then NULL. */
extern const koksma__bsdf *const koksma__bsdfs[];
extern const koksma__kind *const koksma__material_kinds[];

/* The fields of scene files that a kind has beside its parameters: those of all materials, and of the diffuse part.
   Ends at NULL. */
const char *const *koksma__material_keys(const koksma__bsdf *bsdf);

/* The values of the parameter of this name, which the material's kind has. */
double *koksma__material_value(koksma__material *material, const char *name);

koksma__shading_material koksma__shading_material_of(const koksma__material *from);

#define MATERIAL(name) extern const koksma__bsdf koksma__bsdf_##name;
#include "render/materials/materials.def"
#undef MATERIAL

#endif
