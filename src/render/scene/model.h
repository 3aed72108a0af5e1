/* SPDX-License-Identifier: Apache-2.0 */
/* Makes a scene from nothing but a mesh file. */
#ifndef KOKSMA_SCENE_MODEL_H
#define KOKSMA_SCENE_MODEL_H

#include "core/files.h"
#include "render/description.h"

/* Fills an empty scene from a mesh file. If the file has no camera, the scene gets one that sees everything; if
   it has no lights, a studio (model.c). The caller must call koksma__scene_fini even after an error. */
koksma_status koksma__model_parse(const char *path, koksma__named by, koksma_scene *scene);

#endif
