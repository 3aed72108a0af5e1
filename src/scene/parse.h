/* SPDX-License-Identifier: Apache-2.0 */
/* The parts of a scene file, one file each, and the fields that several of them have. */
#ifndef KOKSMA_SCENE_PARSE_H
#define KOKSMA_SCENE_PARSE_H

#include "render/fields.h"
#include "scene/scene.h"

koksma_status koksma__parse_camera(const field *root, koksma__camera *camera);
/* name: of the scene's file, next to which the files that it names are looked for. */
koksma_status koksma__parse_material(const char *name, const field *f, koksma_scene *scene);
koksma_status koksma__parse_shape(const char *name, const field *f, koksma_scene *scene);
koksma_status koksma__parse_light(const char *name, const field *f, koksma_scene *scene);

/* The albedo of a material with an image: its mean. */
void koksma__material_mean(koksma__material *material);

#endif
