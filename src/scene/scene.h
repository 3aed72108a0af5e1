/* SPDX-License-Identifier: Apache-2.0 */
/* Makes scenes from texts. The resulting description is declared in render/description.h. */
#ifndef KOKSMA_SCENE_SCENE_H
#define KOKSMA_SCENE_SCENE_H

#include "core/read_file.h"
#include "render/description.h"

/* The map from the square to a lens with this name, "concentric" or "polar"; NULL for other names. */
const koksma_warp *koksma__lens_map(const char *name);

/* Opens a scene as koksma_scene_open does; `by` tells whether the user or a file named it. */
koksma_status koksma__scene_open(const char *name_or_path, koksma__named by, koksma_scene **out);

/* Makes a scene from a text; `name` is for error messages. Errors: MALFORMED, MISSING, ARGUMENT, MEMORY. */
koksma_status koksma__scene_open_text(const char *name, const char *text, size_t size, koksma_scene **out);

/* Fills a scene from a text; `name` is for error messages. The caller must call koksma__scene_fini even after an
   error. */
koksma_status koksma__scene_parse(const char *name, const char *text, size_t size, koksma_scene *scene);
void koksma__scene_fini(koksma_scene *scene);

#endif
