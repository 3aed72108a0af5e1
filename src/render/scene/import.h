/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions and types that the readers of other renderers' scenes (pbrt.c, mitsuba.c) share: a scene to which
 * surfaces, lights and a camera are added with their matrices, and the list of unsupported features and their
 * replacements. Matrices are three rows of four, as everywhere (meshes/mesh.h).
 *
 * A reader of a text whose every word can be wrong fails nearly everywhere. So its functions return no status: a failure
 * sets the error's text and jumps back to koksma__import_try(). What is allocated belongs to the import, or to the
 * reader's own struct, from the moment when it is, and is freed by whoever called koksma__import_try().
 */
#ifndef KOKSMA_SCENE_IMPORT_H
#define KOKSMA_SCENE_IMPORT_H

#include <setjmp.h>

#include "core/files.h"
#include "meshes/mesh_file.h"
#include "meshes/names.h"
#include "render/description.h"
#include "render/scene_images.h"

/* ---- Sampled spectra ------------------------------------------------------------------------------------------------- */

/* The time that a spectrum takes, as many steps of koksma__import_spend: its values at some hundred wavelengths are
   added. */
enum { KOKSMA__SPECTRUM_STEPS = 128 };

/* The sums of a spectrum whose samples are added one by one; zeroed at first. */
typedef struct koksma__sampled_spectrum {
    size_t n;
    double last[2];     /* wavelength and value of the last sample */
    double seen[3];     /* XYZ of the spectrum itself */
    double in_light[3]; /* XYZ of daylight (CIE D65) multiplied by the spectrum */
} koksma__sampled_spectrum;

/* Adds a sample; between samples the spectrum is linear, and 0 before the first and after the last one. A value is
   clamped to +-1e30, so that sums are finite. Returns false if the wavelength, in nm, is not above the one before. */
bool koksma__sampled_spectrum_add(koksma__sampled_spectrum *s, double wavelength, double value);

/* What the values of a spectrum are; pbrt names the same three. */
typedef enum koksma__spectrum_use {
    KOKSMA__REFLECTANCE, /* of daylight: 1 at all wavelengths is white; clamped to [0, 1] */
    KOKSMA__UNBOUNDED,   /* the same without the upper bound: refractive indices, coefficients, factors of daylight */
    KOKSMA__EMISSION     /* 1 at all wavelengths has luminance 1 and is reddish */
} koksma__spectrum_use;

/* The colour of a spectrum; negative channels are 0. */
void koksma__sampled_spectrum_colour(const koksma__sampled_spectrum *s, koksma__spectrum_use use, double rgb[3]);

/* The colour of a black body at a temperature in kelvins, with luminance 1, from its chromaticity (Kim et al.
   2002). */
void koksma__black_body_colour(double kelvin, double rgb[3]);

/* ---- Types ----------------------------------------------------------------------------------------------------------- */

/* A position in a text of a scene that is read, for messages. */
typedef struct koksma__text_place {
    struct koksma__import *im;
    const char *file;
    unsigned long line;
} koksma__text_place;

/* Basic shapes in [-1, 1]^3, before their matrix is applied: the unit sphere, the square and the disk in the
   plane z = 0 that face +z, the cube, and the side of the cylinder around the z axis from z = 0 to 1. */
typedef enum koksma__form {
    KOKSMA__FORM_MESH,
    KOKSMA__FORM_SPHERE,
    KOKSMA__FORM_SQUARE,
    KOKSMA__FORM_DISK,
    KOKSMA__FORM_CUBE,
    KOKSMA__FORM_CYLINDER,
    KOKSMA__N_BASIC_FORMS
} koksma__form;

typedef struct koksma__open_text {
    const char *name; /* valid as long as the import, for messages about places in the text */
    char *bytes;
    size_t size;
} koksma__open_text;

typedef struct koksma__import {
    koksma_scene *scene;
    const char *path;                  /* path of the scene's own file */
    bool rows_down;                    /* images lie upside down: texture coordinate 0 is their upper edge */
    size_t n_files;                    /* number of texts that were read */
    uint64_t steps, held;              /* work so far, and bytes of memory: koksma__import_hold */
    char folders[8][KOKSMA__MAX_PATH]; /* folders to search for files that are not beside the scene */
    size_t n_folders;
    koksma__names files;              /* the meshes from files: 1 + the index of each; 0: it is left out */
    int forms[KOKSMA__N_BASIC_FORMS]; /* 1 + the index of the mesh of each basic shape; 0: it is not made yet */
    struct koksma__mesh_twins *twins; /* for each mesh: forms of the same mesh */
    koksma__mesh_file *packed;        /* the .serialized files */
    koksma__names packed_names;
    size_t n_twins, n_packed, kept; /* kept: the vertices and triangles of `packed` together */
    koksma__mesh mesh;              /* the one that is being made */
    koksma__open_text *texts;       /* those that are being read, of which each includes the next one */
    char **names;                   /* those of the texts that were read */
    size_t n_texts, n_names;
    jmp_buf *back; /* where a failure ends reading, with this status */
    koksma_status status;
} koksma__import;

/* A colour, or an image over texture coordinates, or a checkerboard with two colours. */
typedef struct koksma__import_colour {
    double rgb[3];
    char image[KOKSMA__MAX_PATH]; /* path of the image; "": no image */
    bool has_use;                 /* the image is read for `use`; otherwise for KOKSMA__PLAIN_IMAGE */
    koksma__image_use use;
    koksma__mapping mapping; /* how the image is mapped */
    double image_scale;      /* factor of the image; only its mean colour can have another one than 1 */
    bool is_checker;
    double second[3], period;
} koksma__import_colour;

/* A material as the nearest kind that Koksma has. */
typedef struct koksma__import_material {
    enum { KOKSMA__MATTE, KOKSMA__METAL, KOKSMA__GLASS, KOKSMA__COATED, KOKSMA__NOTHING /* light passes */ } kind;
    koksma__import_colour colour; /* colour of matte and coated materials; reflectance of metals along the normal */
    double alpha;                 /* GGX width of metals and coats; 0: smooth */
    bool has_index;               /* of metals: the index of refraction is eta + i k, and `colour` a factor */
    double eta[3], k[3];
    double ior; /* above 0 */
} koksma__import_material;

/* The material and emission of a shape. */
typedef struct koksma__import_surface {
    int material;       /* -1: no surface, light passes through */
    bool emits, turned; /* turned: the front and back sides are swapped */
    bool hidden;        /* the surface is a light, which no ray can hit */
    bool two_sided;     /* a light that emits from both sides */
    double radiance[3];
} koksma__import_surface;

/* A motion given by two poses (meshes/mesh.h): the shape's matrix at time t is the matrix of the interpolated pose
   times `before`. */
typedef struct koksma__import_motion {
    bool moves;
    koksma__pose poses[2];
    double before[12];
} koksma__import_motion;

/* A shape with its matrix (at time 0) and surface, before it is added to the scene. */
typedef struct koksma__import_item {
    koksma__form form;
    int mesh; /* the mesh, if form is KOKSMA__FORM_MESH */
    double matrix[12];
    koksma__import_motion motion;
    koksma__import_surface surface;
    koksma__text_place place;
} koksma__import_item;

/* ---- Tables of plug-ins ---------------------------------------------------------------------------------------------- */

/* A row of a format's table (plugins.c): the kinds of a class of objects that have these parameters. */
typedef struct koksma__plugin {
    const char *of, *kinds, *parameters;
    int makes;           /* what the class's reader makes of it */
    const char *instead; /* the name of that in a warning; NULL: it is the same */
} koksma__plugin;

typedef struct koksma__plugins {
    const koksma__plugin *rows;
    size_t n;
} koksma__plugins;

/* A parameter of a row; texts that refer to the row. All of them:
       for (koksma__entry e = koksma__entries_of(row); koksma__entry_next(&e);) */
typedef struct koksma__entry {
    const char *rest; /* of the row's text */
    const char *type, *name;
    const char *older, *otherwise, *values; /* an older name, the default, a closed list of values; or NULL */
    size_t type_length, length, older_length, values_length;
    bool without_effect, is_needed;
} koksma__entry;

static inline koksma__entry koksma__entries_of(const koksma__plugin *row)
{
    return (koksma__entry){.rest = row->parameters};
}
bool koksma__entry_next(koksma__entry *e);

/* The default, 0 if it has none. */
double koksma__entry_number(const koksma__entry *e);

/* The place of a text in the closed list of values, without regard to case; -1: it is not in it. */
int koksma__entry_choice(const koksma__entry *e, const char *value);

/* Whether a list of words, separated by a character, has this word. */
bool koksma__lists(const char *list, size_t size, char separator, const char *word);

/* The row of a kind, or that of unknown kinds ("?"), or NULL. */
const koksma__plugin *koksma__plugin_find(const koksma__plugins *all, const char *of, const char *kind);

/* "; did you mean 'NAME'?" for a kind that no row of the class has, or a parameter that the row lacks; "" if none is near.
   They return text, which has KOKSMA__OR_MEANT bytes. */
const char *koksma__kind_meant(const koksma__plugins *all, const char *of, const char *kind, char *text);
const char *koksma__parameter_meant(const koksma__plugin *row, const char *name, char *text);

/* Finds a parameter of a row. */
bool koksma__row_entry(const koksma__plugin *row, const char *name, koksma__entry *out);

/* Finds a parameter of a kind, or of an unknown kind among those of its class. */
bool koksma__plugin_entry(const koksma__plugins *all, const char *of, const char *kind, const char *name,
                          koksma__entry *out);

extern const double koksma__import_identity[12];

/* ---- Failures and warnings ------------------------------------------------------------------------------------------- */

/* Calls read(reader) and returns KOKSMA_OK, or the status of the failure that ended it. */
koksma_status koksma__import_try(koksma__import *im, void (*read)(void *reader), void *reader);

/* Fail with MALFORMED and the text "FILE:LINE: ...", the second one if `is_so`. */
_Noreturn void koksma__import_fail(koksma__text_place place, const char *format, ...) KOKSMA_PRINTF(2, 3);
void koksma__import_fail_if(bool is_so, koksma__text_place place, const char *format, ...) KOKSMA_PRINTF(3, 4);

/* Fail if a call did, whose error's text is set: with "FILE:LINE" before the text, and with the text as it is. */
void koksma__import_check(koksma__text_place place, koksma_status status);
void koksma__import_pass(koksma__text_place place, koksma_status status);

/* koksma__add_one() and koksma__names_put(), which fail if there is no memory. */
void *koksma__import_add(koksma__text_place place, void *array, size_t *n, size_t item_size);
void koksma__import_put_name(koksma__text_place place, koksma__names *names, const char *name, size_t index);

/* Counts work, in steps of the time in which an element of a file is looked at. References let a small file ask for any
   amount of it, so the whole scene may take at most 2^26 steps, a second or two; more fail. */
void koksma__import_spend(koksma__text_place place, uint64_t steps);

/* Add a warning about an unsupported feature and its replacement, "FILE:LINE: ...", the second one if `is_so`. Warnings
   with equal texts become one, with the number of places. */
void koksma__import_unknown(koksma__text_place place, const char *format, ...) KOKSMA_PRINTF(2, 3);
void koksma__import_unknown_if(bool is_so, koksma__text_place place, const char *format, ...) KOKSMA_PRINTF(3, 4);

/* Whether the list of warnings is full: more would only be counted in its last entry. */
bool koksma__import_is_full(const koksma__import *im);

/* ---- Colours, materials, lights, the camera -------------------------------------------------------------------------- */

/* Writes to `out` the path of a file that the scene names: the file beside the scene or, if there is none, the file
   in the first of im->folders that has one. */
void koksma__import_path(koksma__text_place place, const char *name, char out[KOKSMA__MAX_PATH]);

/* Clamps radiance to what a scene allows, at most 1e6. */
void koksma__import_radiance(koksma__import *im, double rgb[3]);

/* Finds the reflectance along the normal of the metal with this name ("Au", "Cu", ...); returns false if the name is
   unknown. */
bool koksma__import_metal(const char *name, double rgb[3]);

/* Where only one colour fits: replaces an image or a checkerboard by its mean colour, with a warning that names it as
   `what`. An image's levels above 1 count as 1 in a reflectance. An image that can't be decoded is left out, as it is where
   it would be shown. */
void koksma__import_mean(koksma__text_place place, const char *what, koksma__spectrum_use use,
                         koksma__import_colour *c);

/* Turns a colour, image or checkerboard x into scale x + plus, channel by channel. */
void koksma__import_affine(koksma__import_colour *c, const double scale[3], const double plus[3]);

/* Turns an amount into the colour, image or checkerboard that goes from `first` to `second` as it goes from 0 to 1. */
void koksma__import_between(koksma__import_colour *amount, const double first[3], const double second[3]);

/* The functions that make materials return the index of one, -1 where light passes through. The nearest one of Koksma's: */
int koksma__import_material_of(koksma__text_place place, const koksma__import_material *from);

/* A mixture of two materials, of which the second has the share `amount`: exactly where one material of Koksma scatters as
   both do together, and else the one with the larger share, with a warning. */
int koksma__import_mix(koksma__text_place place, int first, int second, koksma__import_colour *amount);

/* A material of which only the share `opacity` of the light meets the surface. */
int koksma__import_mask(koksma__text_place place, int material, koksma__import_colour *opacity);

/* Makes a material, or a black one in place of -1, emit the image `radiance`, if that is one: the surface's radiance is
   then a factor, which becomes the image's scale. */
void koksma__import_glow(koksma__text_place place, const koksma__import_colour *radiance,
                         koksma__import_surface *surface);

/* Adds a light; its radiance is clamped to what scenes allow. */
void koksma__import_light(koksma__text_place place, const koksma__light *light);

/* Makes a light a spot with its axis along `direction` and full intensity up to `inner_deg`, which falls to 0 at
   `outer_deg` by `falloff` (koksma__falloff). */
void koksma__import_spot(koksma__text_place place, const double direction[3], double inner_deg, double outer_deg,
                         int falloff, koksma__light *light);

/* Adds an environment, multiplied by `scale`: of Mitsuba a latitude-longitude image, of pbrt-v4 an octahedral map (Clarberg
   2008); `matrix` transforms the image's directions to the scene's. With an illuminance above 0 the map has another factor,
   the illuminance divided by what pbrt takes for that of its upper half, z > 0: 2 pi times the mean over all pixels of
   luminance times cosine, twice the integral. */
void koksma__import_sky(koksma__text_place place, const char *name, double illuminance, const double scale[3],
                        const double matrix[12]);

/* Sets the camera. The columns of the matrix are the direction to the right (times `right`, 1 or -1), the direction
   up (whose length scales an orthographic camera's height), the direction ahead and the position; `lens` gives the
   angle or height and the lens. */
void koksma__import_camera(koksma__text_place place, const double matrix[12], double right,
                           const koksma__camera *lens);

/* Leaves the scene's medium, which is `whose`, out with a warning if it may not be there. */
void koksma__import_check_medium(koksma__text_place place, const char *whose);

/* Gives a vector of any finite length the length 1; returns false if it has no direction. */
bool koksma__import_normalise(double v[3]);

/* The image of a point (w = 1) or a direction (w = 0). */
void koksma__import_apply(const double matrix[12], const double v[3], double w, double out[3]);

/* Finds the inverse of a matrix; returns false if there is none. */
bool koksma__import_invert(const double matrix[12], double out[12]);

/* Finds the matrix of a camera at `eye` that looks at `target`: its columns are the direction across, up and ahead, and the
   eye. `name` is for errors. */
void koksma__import_look_at(koksma__text_place place, const char *name, const double eye[3], const double target[3],
                            const double up[3], double out[12]);

/* Finds the matrix of a rotation about an axis; returns false if the axis has no direction. */
bool koksma__import_rotation(double angle_deg, const double axis[3], double out[12]);

/* ---- Limits ---------------------------------------------------------------------------------------------------------- */

/* What the C library and a tree of names (meshes/names.h) take beside the bytes of a thing that has a name. */
enum { KOKSMA__HELD_WITH_NAME = 64 };

/* Counts memory, before it is taken, that texts make a reader keep: the texts that are open, elements, names, objects, and
   meshes whose triangles the texts have. A few characters make hundreds of bytes, and a text may be included again and
   again, so all may take 384 MiB together. Beside that are 128 MiB for expat (xml.c), and what a text of 64 MiB takes in
   passing: 320 MiB for the numbers of a mesh. */
void koksma__import_hold(koksma__text_place place, uint64_t bytes);

/* Checks numbers by which a texture is scaled or moved, which must be within 1e6, so that texture coordinates are
   finite. */
void koksma__import_check_uv(koksma__text_place place, const double *values, size_t n);

/* Opens a file that the scene includes, until koksma__import_text_close(). The file must be below the scene's folder, and a
   scene can include at most MOST_INCLUDES files; their bytes count as work. */
enum { KOKSMA__STEP_TEXT = 8 }; /* the bytes of a text that count as one step of koksma__import_spend */
koksma__open_text koksma__import_text(koksma__text_place place, const char *path);
void koksma__import_text_close(koksma__import *im); /* the last one */

/* ---- Shapes ---------------------------------------------------------------------------------------------------------- */

/* What becomes of a mesh from a file. */
typedef struct koksma__mesh_rules {
    bool facets;  /* its normals are left out */
    bool smooths; /* without normals in the file, it gets those of koksma__mesh_smooth_by_angles() */
    bool flips_v; /* each texture coordinate v becomes 1 - v */
} koksma__mesh_rules;

/* Gives im->mesh the texture coordinates that the triangles of pbrt (or of Mitsuba) have without any: (0, 0), (1, 0),
   (1, 1) (or (0, 1)) at their corners; of pbrt's bilinear patches, which are two triangles here, from the first corner
   to the second and fourth, and to the fourth and third: (0, 0), (1, 0), (0, 1), (1, 1). Corners no longer share
   vertices. */
void koksma__import_default_uv(koksma__text_place place, bool quads);

/* Add a mesh and return its index in the scene, or -1 if the mesh is left out with a warning: im->mesh, or one from a file,
   which is read only once; `part` is the number of the mesh in a .serialized file, -1 for all its meshes as one. */
int koksma__import_mesh(koksma__text_place place);
int koksma__import_mesh_file(koksma__text_place place, const char *name, long part, koksma__mesh_rules rules);

/* Adds a shape to the scene; `outer`, which may be NULL, is a transformation that is applied after the shape's own
   matrix. If that transformation moves, `poses` has its poses at the times 0 and 1; otherwise `poses` is NULL. */
void koksma__import_put(const koksma__import_item *item, const double outer[12], const koksma__pose poses[2]);

/* The type of Koksma's own shapes with this name, which exists. */
const struct koksma__shape_type *koksma__own_shape_type(const char *name);

/* Frees what an import keeps. */
void koksma__import_fini(koksma__import *im);

/* ---- Environments ---------------------------------------------------------------------------------------------------- */

/* Resamples an environment to a latitude-longitude image with Koksma's axes. octahedral: `from` is one of pbrt, in the
   equal-area octahedral map; otherwise one of Mitsuba, in latitude and longitude. inverse: the inverse of the
   environment's matrix. Errors: MALFORMED (its shape), MEMORY. */
koksma_status koksma__sky_turn(const koksma_image *from, bool octahedral, const double inverse[12],
                               koksma_image *out);

#endif
