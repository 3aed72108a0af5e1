/* SPDX-License-Identifier: Apache-2.0 */
/* Builds the description of a scene. */
#ifndef KOKSMA_RENDER_DESCRIPTION_BUILD_H
#define KOKSMA_RENDER_DESCRIPTION_BUILD_H

#include "render/description.h"

/* Makes the lists of materials and lights of an empty scene, and sets the title to what follows the last slash. Error:
   MEMORY. */
koksma_status koksma__scene_begin(koksma_scene *scene, const char *title);

/* The index of the material with this name; -1 if there is none. */
int koksma__find_material(const koksma_scene *scene, const char *name);

/* Adds a shape, a copy of *from; the pointer is valid until the next shape is added. Errors: MALFORMED (too many),
   MEMORY. */
koksma_status koksma__scene_add_shape(koksma_scene *scene, const koksma__shape *from, koksma__shape **out);

/* Adds a light, zeroed. Errors: MALFORMED (too many). */
koksma_status koksma__scene_add_light(koksma_scene *scene, koksma__light **out);

/* Adds a warning about a model file. Errors: MEMORY. */
koksma_status koksma__scene_note(koksma_scene *scene, const char *text);

/* Sets the albedo of a material with an image to the image's mean. */
void koksma__material_mean(const koksma_scene *scene, koksma__material *material);

/* Computes the members that follow from the others: grey, moves and files_hash. It may be called again. */
void koksma__scene_finish(koksma_scene *scene);

/* ---- Meshes and placements -------------------------------------------------------------------------------------- */

/* Add a mesh, zeroed, or a placement, zeroed except for material = light = -1. Both functions may move the existing
   items in memory. Errors: MALFORMED (too many), MEMORY. */
koksma_status koksma__scene_add_mesh(koksma_scene *scene, koksma__mesh **out);
koksma_status koksma__scene_add_placement(koksma_scene *scene, koksma__placement **out);

/* The bytes that a mesh takes. */
KOKSMA__LAB uint64_t koksma__mesh_bytes(const koksma__mesh *mesh);

/* Counts a mesh that was read from the file at `path`. Its normals count even if it has none, because they may be made.
   All meshes from files together may take 1 GiB or, if that is more, 64 bytes for each byte of scene->mesh_files: a
   small packed file may stand for a large mesh, but many of them not for all memory; a text takes at most 36 bytes for
   each of its bytes. Errors: MALFORMED. */
koksma_status koksma__scene_limit_mesh(koksma_scene *scene, const koksma__mesh *mesh, const char *path);

/* Adds the last mesh, which is complete, to the scene's hash. in_file: it is from a file; otherwise the scene's text has
   it. */
void koksma__scene_hash_mesh(koksma_scene *scene, bool in_file);

/* Makes the placement a light; if it has a material, it reflects as well. Errors: MALFORMED (too many lights, or the
   placed mesh has no area). */
koksma_status koksma__scene_add_glow(koksma_scene *scene, koksma__placement *placement, const double radiance[3]);

#endif
