/* SPDX-License-Identifier: Apache-2.0 */
/* The parts of the reader of pbrt-v4's scenes: words and parameter lists with their lines (pbrt_tokens.c), the vocabulary
   (pbrt_names.c), what parameters stand for (pbrt_values.c), and the directives (pbrt.c). */
#ifndef KOKSMA_SCENE_PBRT_H
#define KOKSMA_SCENE_PBRT_H

#include "scene/import.h"

/* Reads a scene of pbrt-v4 into an empty scene. Errors: MISSING, MALFORMED, MEMORY. */
koksma_status koksma__pbrt_read(koksma__import *im, const char *text, size_t size);

/* ---- Tokens and parameters ------------------------------------------------------------------------------------------- */

enum { KOKSMA__MAX_PBRT_PARAMETERS = 64 };

typedef enum koksma__pbrt_kind {
    KOKSMA__PBRT_END,
    KOKSMA__PBRT_WORD,
    KOKSMA__PBRT_TEXT,
    KOKSMA__PBRT_BRACKET
} koksma__pbrt_kind;

/* A token, which refers to the text of the file; a text comes without its quotation marks. */
typedef struct koksma__pbrt_token {
    koksma__pbrt_kind kind;
    const char *at;
    size_t length;
} koksma__pbrt_token;

typedef struct koksma__pbrt_source {
    const char *at, *end; /* the text ends with a zero byte */
    koksma__text_place place;
    const char *directive; /* the one that is read, for messages; or NULL */
} koksma__pbrt_source;

/* A parameter: its type and name, and its values: numbers or texts, of which the first is kept (for booleans "true" or
   "false"). There is at least one value, and each is of the parameter's type. */
typedef struct koksma__pbrt_parameter {
    char type[24], name[40], text[1024];
    char second[256]; /* the second text; "": there is none */
    double *numbers;
    size_t n, n_texts;
    unsigned long line;
} koksma__pbrt_parameter;

/* A parameter that an Attribute directive gives to all directives of this target ("shape", "light", ...) that follow. */
typedef struct koksma__pbrt_attribute {
    const char *target;
    koksma__pbrt_parameter parameter;
} koksma__pbrt_attribute;

typedef struct koksma__pbrt_parameters {
    koksma__pbrt_parameter items[KOKSMA__MAX_PBRT_PARAMETERS];
    bool used[KOKSMA__MAX_PBRT_PARAMETERS]; /* whether koksma__pbrt_find has found it */
    size_t n, n_inherited;                  /* the first n_inherited come from Attribute directives */
    const koksma__pbrt_attribute *attributes;
    size_t n_attributes;
    const char *directive, *kind; /* for the table of plug-ins */
    const char *target;           /* "": the directive inherits no attributes */
    koksma__text_place place;
} koksma__pbrt_parameters;

koksma__pbrt_token koksma__pbrt_token_next(koksma__pbrt_source *source);

/* Reads the next token without consuming it. */
koksma__pbrt_token koksma__pbrt_token_peek(koksma__pbrt_source *source);

/* Read the next token, which must be a text (of less than `size` bytes), or n numbers. */
void koksma__pbrt_text(koksma__pbrt_source *source, char *out, size_t size);
void koksma__pbrt_numbers(koksma__pbrt_source *source, size_t n, double *out);

/* Reads all parameters up to the next directive, after those that the directive inherits, and checks that each has values
   of its type. */
void koksma__pbrt_parameters_read(koksma__pbrt_source *source, koksma__pbrt_parameters *out);

/* Copies a parameter with its numbers. */
void koksma__pbrt_parameter_copy(koksma__text_place place, const koksma__pbrt_parameter *from,
                                 koksma__pbrt_parameter *out);
void koksma__pbrt_parameters_fini(koksma__pbrt_parameters *parameters);

/* Finds a parameter by its name; NULL if there is none. Of two with one name the last one counts, as in pbrt. */
const koksma__pbrt_parameter *koksma__pbrt_find(koksma__pbrt_parameters *p, const char *name);

/* Whether the parameter's type is one of those in the list, as in "point3 vector3". */
bool koksma__pbrt_is(const koksma__pbrt_parameter *parameter, const char *types);

/* The same as koksma__pbrt_find for a parameter with one of these types; one of another type fails. */
const koksma__pbrt_parameter *koksma__pbrt_find_typed(koksma__pbrt_parameters *p, const char *name,
                                                      const char *types);

/* The only number, whole number, text or flag of a parameter; that of the table if it is missing. A parameter of another
   type, or with several values, fails. A number may also be a texture or spectrum, which is not read: then the parameter
   stays unused, and the result is that of the table. */
double koksma__pbrt_number(koksma__pbrt_parameters *p, const char *name);
double koksma__pbrt_whole(koksma__pbrt_parameters *p, const char *name);
const char *koksma__pbrt_word(koksma__pbrt_parameters *p, const char *name);
bool koksma__pbrt_flag(koksma__pbrt_parameters *p, const char *name);

/* Reads a point or vector; without it, *out stays as it is. */
void koksma__pbrt_point(koksma__pbrt_parameters *p, const char *name, double out[3]);

/* ---- Vocabulary ------------------------------------------------------------------------------------------------------ */

extern const koksma__plugins koksma__pbrt_plugins;

/* Whether a directive has this kind; true for directives that have none. */
bool koksma__pbrt_is_kind(const char *directive, const char *kind);

/* koksma__kind_meant() of a kind that pbrt-v4 does not have, "" of others. */
const char *koksma__pbrt_kind_meant(const char *directive, const char *kind, char *text);

/* Warns about each of the directive's own parameters that pbrt-v4 would refuse: by its name, its type, or a value that is
   not in a closed list. A kind that does not exist, or NULL, stands for all kinds. */
void koksma__pbrt_name_parameters(const char *directive, const char *kind, const koksma__pbrt_parameters *p);

/* Warns about those that pbrt knows and nothing has looked up, except those that have no effect on the pictures that
   Koksma makes. */
void koksma__pbrt_name_unused(const koksma__pbrt_parameters *p);

/* ---- Values ---------------------------------------------------------------------------------------------------------- */

typedef struct koksma__pbrt_scene {
    koksma__import *im;
    struct koksma__pbrt_named *materials;
    struct koksma__pbrt_named_texture *textures;
    size_t n_materials, n_textures;
    koksma__names material_names, texture_names[2]; /* textures: of type "spectrum" and of type "float" */
    size_t n_divided;                               /* number of triangles that subdivision made so far */
    double exposure;                                /* factor of all light: what the film makes of radiance */
} koksma__pbrt_scene;

void koksma__pbrt_scene_fini(koksma__pbrt_scene *scene);

/* Radiance or intensity: the colour `name`, or white if there is none, times the parameter "scale" and the exposure. */
void koksma__pbrt_emission(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p, const char *name, double rgb[3]);

/* A medium's absorption or scattering: the colour `name`, or 1 if there is none, times the parameter "scale"; at most FAR.
   One that is negative fails, which pbrt refuses as well. */
void koksma__pbrt_coefficient(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p, const char *name, double rgb[3]);

/* type: "float" or "spectrum", which have separate names. */
void koksma__pbrt_texture(koksma__pbrt_scene *scene, const char *name, const char *type, const char *kind,
                          koksma__pbrt_parameters *p);

/* Make or find a material, and return its index, or -1 if light passes through. */
int koksma__pbrt_material(koksma__pbrt_scene *scene, const char *type, koksma__pbrt_parameters *p);
void koksma__pbrt_name_material(koksma__pbrt_scene *scene, const char *name, koksma__pbrt_parameters *p);
int koksma__pbrt_find_material(koksma__pbrt_scene *scene, koksma__text_place place, const char *name);

/* Sets the item's basic shape or mesh, and the matrix that gives a basic shape its size; returns false if the shape is left
   out. `power` above 0 is that of the light that the shape is, whose radiance is for radiant exitance pi: the radiance is
   scaled accordingly; `placed` is the matrix that the item gets. pbrt-v4 makes a light of each triangle, and of each patch
   of a bilinear mesh, and gives each this power; it takes the areas of spheres, disks and cylinders before their matrix is
   applied. */
bool koksma__pbrt_shape(koksma__pbrt_scene *scene, const char *type, koksma__pbrt_parameters *p, double power,
                        const double placed[12], koksma__import_item *item, double matrix[12]);

#endif
