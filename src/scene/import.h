/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the readers of other renderers' scenes (pbrt.c, mitsuba.c) share: a scene that grows by surfaces, lights and a
 * camera given with matrices, and the list of what was unknown and taken for something else. Matrices are three rows of
 * four, as everywhere (meshes/mesh.h).
 */
#ifndef KOKSMA_SCENE_IMPORT_H
#define KOKSMA_SCENE_IMPORT_H

#include "core/read_file.h"
#include "render/description.h"

/* Where in a text something stands. */
typedef struct koksma__text_place {
    const char *file;
    unsigned long line;
} koksma__text_place;

typedef struct koksma__import {
    koksma_scene *scene;
    const char *path; /* of the scene's own file */
    bool rows_down;   /* texture coordinate 0 is an image's upper edge */
    size_t n_files;   /* texts that were read */
    struct koksma__known_mesh *known;
    int *twins; /* of a mesh: the same inside out, or -1 */
    size_t n_known, n_twins;
} koksma__import;

/* A colour, an image over texture coordinates, or the squares of a checker. */
typedef struct koksma__import_colour {
    double rgb[3];
    char image[KOKSMA__MAX_PATH]; /* "": none */
    bool is_checker;
    double second[3], period;
} koksma__import_colour;

/* A material by what it is nearest to here. */
typedef struct koksma__import_material {
    enum { KOKSMA__MATTE, KOKSMA__METAL, KOKSMA__GLASS, KOKSMA__COATED } kind;
    koksma__import_colour colour; /* of matte and coated ones; of metals the reflectance of light along the normal */
    double alpha;                 /* GGX width of metals and coats; 0: smooth */
    double ior;
} koksma__import_material;

/* What a shape is made of. */
typedef struct koksma__import_surface {
    int material;       /* -1: nothing that light meets */
    bool emits, turned; /* turned: fronts are backs */
    double radiance[3];
} koksma__import_surface;

/* Forms within [-1, 1]^3 before their matrix: the unit sphere, the square and the disk of z = 0 that face +z, the cube,
   the side of the cylinder about z from z = 0 to 1. */
typedef enum koksma__form {
    KOKSMA__FORM_MESH,
    KOKSMA__FORM_SPHERE,
    KOKSMA__FORM_SQUARE,
    KOKSMA__FORM_DISK,
    KOKSMA__FORM_CUBE,
    KOKSMA__FORM_CYLINDER
} koksma__form;

/* A shape before it is placed. */
typedef struct koksma__import_item {
    koksma__form form;
    int mesh; /* of KOKSMA__FORM_MESH */
    double matrix[12];
    koksma__import_surface surface;
    koksma__text_place place;
} koksma__import_item;

extern const double koksma__import_identity[12];

/* Fails with "FILE:LINE: ...", MALFORMED; or puts the place in front of a failure's text. */
koksma_status koksma__import_fail(koksma__text_place place, const char *format, ...) KOKSMA_PRINTF(2, 3);
koksma_status koksma__import_fail_at(koksma__text_place place, koksma_status status);

/* Says what is taken for something else: "FILE:LINE: ...". The same text is said once, with the number of places.
   Errors: MEMORY. */
koksma_status koksma__import_unknown(koksma__import *im, koksma__text_place place, const char *format, ...)
    KOKSMA_PRINTF(3, 4);

/* Reads a text that the scene includes: only files below the scene's folder, KOKSMA__MAX_INCLUDES in all. The caller
   frees *bytes. */
koksma_status koksma__import_text(koksma__import *im, koksma__text_place place, const char *path, char **bytes,
                                  size_t *size);

/* The path of a mesh or image that the scene names. */
koksma_status koksma__import_path(const koksma__import *im, koksma__text_place place, const char *name,
                                  char out[KOKSMA__MAX_PATH]);

/* Colours within what scenes take: albedos to [0, 1], radiance to at most 1e6. */
void koksma__import_albedo(double rgb[3]);
void koksma__import_radiance(koksma__import *im, double rgb[3]);

/* The colour of a black body of so many kelvins, with luminance 1 (Kim et al. 2002, by its chromaticity). */
void koksma__import_black_body(double kelvin, double rgb[3]);

/* The reflectance of light along the normal of a metal by its name ("Au", "Cu", ...); false: an unknown one. */
bool koksma__import_metal(const char *name, double rgb[3]);

koksma_status koksma__import_add_material(koksma__import *im, koksma__text_place place,
                                          const koksma__import_material *from, int *out);

/* One more light of a kind; its radiance is cut to what scenes take. */
koksma_status koksma__import_light(koksma__import *im, koksma__text_place place, const koksma__light *light);

/* An environment from an image by latitude and longitude, or by the octahedral map of pbrt-v4 (Clarberg 2008), times
   scale; matrix turns its own directions into the scene's. */
koksma_status koksma__import_sky(koksma__import *im, koksma__text_place place, const char *name, bool octahedral,
                                 const double scale[3], const double matrix[12]);

/* The camera whose matrix has the direction to the right (times `right`, 1 or -1), upwards, and ahead as its columns. */
koksma_status koksma__import_camera(koksma__import *im, koksma__text_place place, const double matrix[12],
                                    double right, double fov_rad, double lens_radius, double focus_distance);

/* Finds x -> matrix^-1 x; false where there is none. */
bool koksma__import_invert(const double matrix[12], double out[12]);
void koksma__import_rotation(double angle_deg, const double axis[3], double out[12]);

#endif
