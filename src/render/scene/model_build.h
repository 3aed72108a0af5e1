/* SPDX-License-Identifier: Apache-2.0 */
/* Makes a scene from the contents of a mesh file. */
#ifndef KOKSMA_SCENE_MODEL_BUILD_H
#define KOKSMA_SCENE_MODEL_BUILD_H

#include "core/files.h"
#include "render/description.h"

/* Reads everything in a file into the empty scene: meshes where its nodes place them, materials, cameras, lights.
   Members for which the file has no data remain empty. *has_camera: whether position, axes and angle of scene->camera
   are set. Errors: those of koksma__mesh_read. */
koksma_status koksma__model_read(const char *path, koksma__named by, koksma_scene *scene, bool *has_camera);

#endif
