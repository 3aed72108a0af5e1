/* SPDX-License-Identifier: Apache-2.0 */
/* Appends meshes and their placements to a scene. */
#ifndef KOKSMA_RENDER_PLACEMENTS_H
#define KOKSMA_RENDER_PLACEMENTS_H

#include "render/description.h"

/* Add a mesh, zeroed, or a placement, zeroed except for material = light = -1. Both functions may move the existing
   items in memory. Errors: MALFORMED (too many), MEMORY. */
koksma_status koksma__scene_add_mesh(koksma_scene *scene, koksma__mesh **out);
koksma_status koksma__scene_add_placement(koksma_scene *scene, koksma__placement **out);

/* Adds the last mesh, which is complete, to the scene's hash. in_file: it is from a file; otherwise the scene's text has
   it. */
void koksma__scene_hash_mesh(koksma_scene *scene, bool in_file);

/* Makes the placement a light; if it has a material, it reflects as well. Errors: MALFORMED (too many lights, or the
   placed mesh has no area). */
koksma_status koksma__scene_add_glow(koksma_scene *scene, koksma__placement *placement, const double radiance[3]);

#endif
