/* SPDX-License-Identifier: Apache-2.0 */
/* Converts parameters of pbrt-v4 to colours, textures, materials and shapes. */
#ifndef KOKSMA_SCENE_PBRT_VALUES_H
#define KOKSMA_SCENE_PBRT_VALUES_H

#include "meshes/names.h"
#include "scene/import.h"
#include "scene/pbrt_tokens.h"

typedef struct koksma__pbrt_scene {
    koksma__import *im;
    struct koksma__pbrt_named *materials;
    struct koksma__pbrt_texture *textures;
    char **texts; /* names of the files that were read */
    size_t n_materials, n_textures, n_texts;
    koksma__names material_names, texture_names[2]; /* textures: of type "spectrum" and of type "float" */
    size_t n_divided;                               /* number of triangles that subdivision made so far */
    double exposure;                                /* factor of all light: what the film makes of radiance */
} koksma__pbrt_scene;

void koksma__pbrt_scene_fini(koksma__pbrt_scene *scene);

/* Radiance or intensity: the colour `name`, or white if there is none, times the parameter "scale" and the exposure. */
koksma_status koksma__pbrt_emission(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, const char *name,
                                    double rgb[3]);

/* A medium's absorption or scattering: the colour `name`, or 1 if there is none, times the parameter "scale"; at most FAR.
   Errors: MALFORMED (one that is negative, which pbrt refuses as well). */
koksma_status koksma__pbrt_coefficient(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, const char *name,
                                       double rgb[3]);

/* type: "float" or "spectrum", which have separate names. */
koksma_status koksma__pbrt_texture(koksma__pbrt_scene *scene, const char *name, const char *type, const char *kind,
                                   const koksma__pbrt_parameters *p);

/* Makes a material; *out is its index, or -1 if light passes through. */
koksma_status koksma__pbrt_material(koksma__pbrt_scene *scene, const char *type, const koksma__pbrt_parameters *p,
                                    int *out);
koksma_status koksma__pbrt_name_material(koksma__pbrt_scene *scene, const char *name,
                                         const koksma__pbrt_parameters *p);
koksma_status koksma__pbrt_find_material(koksma__pbrt_scene *scene, koksma__text_place place, const char *name,
                                         int *out);

/* Sets the item's basic shape or mesh, and the matrix that gives a basic shape its size; *is_there is false if
   the shape is left out. `power` above 0 is that of the light that the shape is, whose radiance is for radiant exitance
   pi: the radiance is scaled accordingly; `placed` is the matrix that the item gets. pbrt-v4 makes a light of each
   triangle, and of each patch of a bilinear mesh, and gives each this power; it takes the areas of spheres, disks and
   cylinders before their matrix is applied. */
koksma_status koksma__pbrt_shape(koksma__pbrt_scene *scene, const char *type, const koksma__pbrt_parameters *p,
                                 double power, const double placed[12], koksma__import_item *item, double matrix[12],
                                 bool *is_there);

#endif
