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
koksma_status koksma__parse_mesh(const char *name, const field *f, koksma_scene *scene);
koksma_status koksma__parse_instance(const field *f, koksma_scene *scene);
koksma_status koksma__parse_light(const char *name, const field *f, koksma_scene *scene);

/* One more mesh, zeroed; one more placement, zeroed but for material = light = -1. They may move the others.
   Errors: MALFORMED (too many), MEMORY. */
koksma_status koksma__scene_add_mesh(koksma_scene *scene, koksma__mesh **out);
koksma_status koksma__scene_add_placement(koksma_scene *scene, koksma__placement **out);

/* Makes the placement a luminaire. Errors: MALFORMED (too many, or it has no area where it stands). */
koksma_status koksma__scene_add_glow(koksma_scene *scene, koksma__placement *placement, const double radiance[3]);

/* The albedo of a material with an image: its mean. */
void koksma__material_mean(koksma__material *material);

#endif
