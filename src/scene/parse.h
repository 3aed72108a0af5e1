/* SPDX-License-Identifier: Apache-2.0 */
/* Materials of a scene file, the longest of its parts; parse.c has the others. */
#ifndef KOKSMA_SCENE_PARSE_H
#define KOKSMA_SCENE_PARSE_H

#include "render/fields.h"
#include "scene/scene.h"

/* name: of the scene's file, next to which the files that it names are looked for. */
koksma_status koksma__parse_material(const char *name, const field *f, koksma_scene *scene);

#endif
