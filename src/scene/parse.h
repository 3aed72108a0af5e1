/* SPDX-License-Identifier: Apache-2.0 */
/* Reads the materials of a scene file; parse.c reads everything else. */
#ifndef KOKSMA_SCENE_PARSE_H
#define KOKSMA_SCENE_PARSE_H

#include "render/fields.h"
#include "scene/scene.h"

/* Reads a material. `name` is the path of the scene's file; files that the material names are searched beside it. */
koksma_status koksma__parse_material(const char *name, const field *f, koksma_scene *scene);

#endif
