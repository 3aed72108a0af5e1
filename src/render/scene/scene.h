/* SPDX-License-Identifier: Apache-2.0 */
/* Makes scenes from texts, from models and from the files of other renderers. The resulting description is declared in
   render/description.h. */
#ifndef KOKSMA_SCENE_SCENE_H
#define KOKSMA_SCENE_SCENE_H

#include "core/files.h"
#include "render/description.h"

/* Opens a scene as koksma_scene_open does; `by` tells whether the user or a file named it. */
koksma_status koksma__scene_open(const char *name_or_path, koksma__named by, koksma_scene **out);

/* Makes a scene from a text; `name` is for error messages. Errors: MALFORMED, MISSING, ARGUMENT, MEMORY. */
koksma_status koksma__scene_open_text(const char *name, const char *text, size_t size, koksma_scene **out);

void koksma__scene_fini(koksma_scene *scene);

/* ---- Readers, each for an empty scene that the caller frees even after an error -------------------------------------- */

/* Fills a scene from a text; `name` is for error messages. */
koksma_status koksma__scene_parse(const char *name, const char *text, size_t size, koksma_scene *scene);

/* Fills an empty scene from a mesh file. If the file has no camera, the scene gets one that sees everything; if
   it has no lights, a studio (model.c). */
koksma_status koksma__model_parse(const char *path, koksma__named by, koksma_scene *scene);

/* Sets the camera at `eye` that looks along `forward`; returns false if `up` is parallel to `forward`. */
bool koksma__camera_aim(const double eye[3], const double forward[3], const double up[3], double fov_rad,
                        koksma__camera *camera);

#endif
