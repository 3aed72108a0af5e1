/* SPDX-License-Identifier: Apache-2.0 */
/* A bare mesh file as a scene. */
#ifndef KOKSMA_SCENE_MODEL_H
#define KOKSMA_SCENE_MODEL_H

#include "core/read_file.h"
#include "scene/scene.h"

/* Fills an empty scene from a mesh file; where it has no camera, one is set up that sees all of it; where it has no
   light, there is a studio (model.c). Whatever comes of it, the caller calls fini. */
koksma_status koksma__model_parse(const char *path, koksma__named by, koksma_scene *scene);

/* Everything in a file, as a scene: meshes where its nodes place them, materials, cameras, lights. scene is empty;
   what the file has none of is left so. has_camera: scene->camera has eye, axes and angle. Errors: as
   koksma__mesh_read. In model_build.c. */
koksma_status koksma__model_read(const char *path, koksma__named by, koksma_scene *scene, bool *has_camera);

/* The camera at eye that looks along forward; false where up is along it. */
bool koksma__camera_aim(const double eye[3], const double forward[3], const double up[3], double fov_rad,
                        koksma__camera *camera);

#endif
