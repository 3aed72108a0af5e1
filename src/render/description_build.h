/* SPDX-License-Identifier: Apache-2.0 */
/* Builds the description of a scene. */
#ifndef KOKSMA_RENDER_DESCRIPTION_BUILD_H
#define KOKSMA_RENDER_DESCRIPTION_BUILD_H

#include "render/description.h"

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

#endif
