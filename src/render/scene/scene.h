/* SPDX-License-Identifier: Apache-2.0 */
/* Makes scenes from texts. The resulting description is declared in render/description.h. */
#ifndef KOKSMA_SCENE_SCENE_H
#define KOKSMA_SCENE_SCENE_H

#include "core/files.h"
#include "render/description.h"

/* Opens a scene as koksma_scene_open does; `by` tells whether the user or a file named it. */
koksma_status koksma__scene_open(const char *name_or_path, koksma__named by, koksma_scene **out);

/* Makes a scene from a text; `name` is for error messages. Errors: MALFORMED, MISSING, ARGUMENT, MEMORY. */
koksma_status koksma__scene_open_text(const char *name, const char *text, size_t size, koksma_scene **out);

void koksma__scene_fini(koksma_scene *scene);

#endif
