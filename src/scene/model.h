/* SPDX-License-Identifier: Apache-2.0 */
/* Makes a scene from nothing but a mesh file. */
#ifndef KOKSMA_SCENE_MODEL_H
#define KOKSMA_SCENE_MODEL_H

#include "core/read_file.h"
#include "scene/scene.h"

/* Fills an empty scene from a mesh file. If the file has no camera, the scene gets one that sees everything; if
   it has no lights, a studio (model.c). The caller must call koksma__scene_fini even after an error. */
koksma_status koksma__model_parse(const char *path, koksma__named by, koksma_scene *scene);

/* Reads everything in a file into the empty scene: meshes where its nodes place them, materials, cameras, lights.
   Members for which the file has no data remain empty. *has_camera: whether position, axes and angle of scene->camera
   are set. Errors: those of koksma__mesh_read. Defined in model_build.c. */
koksma_status koksma__model_read(const char *path, koksma__named by, koksma_scene *scene, bool *has_camera);

/* Sets the camera at `eye` that looks along `forward`; false if `up` is parallel to `forward`. */
bool koksma__camera_aim(const double eye[3], const double forward[3], const double up[3], double fov_rad,
                        koksma__camera *camera);

#endif
