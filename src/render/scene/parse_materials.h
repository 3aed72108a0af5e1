/* SPDX-License-Identifier: Apache-2.0 */
/* Reads the materials of a scene file. */
#ifndef KOKSMA_SCENE_PARSE_MATERIALS_H
#define KOKSMA_SCENE_PARSE_MATERIALS_H

#include "render/description.h"
#include "render/fields.h"

/* Reads a material. `name` is the path of the scene's file; files that the material names are looked for in its
   folder. */
koksma_status koksma__parse_material(const char *name, const field *f, koksma_scene *scene);

#endif
