/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Materials: how a surface scatters light, as a function of directions. A kind of material is one file,
 * bsdf_<name>.c, and one line of materials.def: its name and parameters in scene files, its value, its sampling and
 * its density. All directions are of length 1 and lead away from the surface; n.out > 0. A material's lobes are
 * evaluated and sampled separately, because some integrators follow only some of them.
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

/* Which fields of the diffuse part a material has: "albedo"; "albedos" of the squares of a checker; "albedo":
   {"image": FILE}. */
enum { KOKSMA__ALBEDO = 1, KOKSMA__CHECKER = 2, KOKSMA__IMAGE = 4 };

/* The formula of batch_materials.c that shades blocks of points of a material. Parameters 0 to 2 are the reflectance;
   parameter 3 is the exponent of the lobe or the roughness of the facets. */
typedef enum koksma__material_form {
    KOKSMA__FORM_RAYS,    /* no formula: value() and sample() are called for each ray */
    KOKSMA__FORM_LAMBERT, /* albedo */
    KOKSMA__FORM_LOBES,   /* Lambert and a cosine lobe; `derived` is the fraction of directions that Lambert gets */
    KOKSMA__FORM_FACETS,  /* lobes.h */
    KOKSMA__FORM_COATED,  /* facets over Lambert (bsdf_principled.c); `derived` is the reflectance of the coat */
    KOKSMA__N_FORMS
} koksma__material_form;

/* A material in floats, as the renderer reads it. */
typedef struct koksma__shading_material {
    const struct koksma__bsdf *bsdf;
    float albedo[2][3];
    float values[KOKSMA__MAX_VALUES]; /* values of the kind's parameters */
    float derived;                    /* a number that prepare() computes from the values */
    const koksma_image *image;        /* the image of the albedo, or NULL */
    const koksma__material *from;     /* the description of this material, which has the images */
    bool glows;                       /* some mesh of this material is a light */
} koksma__shading_material;

/* Whether an image or vertex colours make the material vary over the surface; checkers are treated separately. */
static inline bool koksma__is_textured(const koksma__shading_material *m)
{
    return m->image || m->from->tinted || m->from->maps[KOKSMA__MAP_SURFACE].image ||
           m->from->maps[KOKSMA__MAP_NORMAL].image;
}

/* largest number of a material's values that images can change; the kind's texture() computes these values */
enum { KOKSMA__LOCAL = 4 };

/* A point on a surface, seen from `out`. */
typedef struct koksma__surface {
    const koksma__shading_material *material;
    float p[3], n[3]; /* n points to the side from which the surface is seen */
    float out[3];
    float albedo[3]; /* albedo of the diffuse part at this point */
    bool inside;     /* whether the point is seen from inside a closed shape, or from the back of a flat one */
    int32_t primitive;
} koksma__surface;

/* A direction that light may come from. */
typedef struct koksma__scatter {
    float w[3];
    float weight[3]; /* value times cosine, divided by the pdf */
    float pdf;       /* density over solid angle of the requested lobes; 0 for specular lobes */
    unsigned lobe;
} koksma__scatter;

typedef struct koksma__bsdf {
    koksma__kind kind; /* parameters are written to koksma__material; koksma__parameter.at is KOKSMA__VALUE(i) */
    unsigned lobes;    /* all lobes that the kind has */
    unsigned diffuse;  /* the fields of its diffuse part; 0 if it has none */
    /* the value times the cosine is exactly albedo cosine / pi, so that lambert_lanes.c can shade the material */
    bool is_lambert;
    koksma__material_form form;
    bool takes_choice; /* sample() uses its argument `choice` */
    bool reciprocal;   /* value / cosine is symmetric in w and out */
    /* NULL, or a check of the parameters: returns the reason why they are not valid together, or NULL. */
    const char *(*check)(const koksma__material *material);
    void (*prepare)(koksma__shading_material *material); /* NULL, or computes `derived` */
    /* Adds to `value` the BSDF times the cosine for light from w, over the requested lobes; returns the density with
       which sample() chooses w among these lobes. NULL, as sample(): the kind has a form. */
    float (*value)(const koksma__surface *s, const float w[3], unsigned lobes, float value[3]);
    /* Samples a direction from the requested lobes: u selects the direction, `choice` the lobe. Returns false if no
       light arrives along the sampled direction, for example because it is below the surface. */
    bool (*sample)(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out);
    /* NULL, or computes local[0] to [KOKSMA__LOCAL - 1] at a point from the albedo there and from an image's factors
       of roughness and metallic value, and sets albedo to that of the diffuse part. */
    void (*texture)(const koksma__shading_material *material, const float factors[2], float albedo[3], float *local);
    /* NULL, or gives both directions of glass, weighted by Fresnel's reflectance, to integrators that follow both. */
    void (*split)(const koksma__surface *s, koksma__scatter *reflected, koksma__scatter *refracted);
} koksma__bsdf;

/* The offset at which parameter i of a material is stored. */
#define KOKSMA__VALUE(i) (offsetof(koksma__material, values) + (i) * sizeof(double))

/* All kinds of materials in the order of materials.def; ends with NULL. */
extern const koksma__bsdf *const koksma__bsdfs[];
extern const koksma__kind *const koksma__material_kinds[];

/* The fields of scene files that a kind has beside its parameters: those of all materials, and those of its diffuse
   part. The list ends with NULL. */
const char *const *koksma__material_keys(const koksma__bsdf *bsdf);

/* The values of the parameter with this name, which the material's kind must have. */
double *koksma__material_value(koksma__material *material, const char *name);

koksma__shading_material koksma__shading_material_of(const koksma__material *from);

#define MATERIAL(name) extern const koksma__bsdf koksma__bsdf_##name;
#include "render/materials/materials.def"
#undef MATERIAL

#endif
