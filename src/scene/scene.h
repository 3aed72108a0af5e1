/* SPDX-License-Identifier: Apache-2.0 */
/* Scenes from texts. The description that comes of it is render/description.h. */
#ifndef KOKSMA_SCENE_SCENE_H
#define KOKSMA_SCENE_SCENE_H

#include "core/read_file.h"
#include "render/description.h"

/* The map of the square to a lens: "concentric" or "polar"; NULL for another name. */
const koksma_warp *koksma__lens_map(const char *name);

/* koksma_scene_open, and who named the file. */
koksma_status koksma__scene_open(const char *name_or_path, koksma__named by, koksma_scene **out);

/* A scene of a text; name is for errors. Errors: MALFORMED, MISSING, ARGUMENT, MEMORY. */
koksma_status koksma__scene_open_text(const char *name, const char *text, size_t size, koksma_scene **out);

/* Fills scene from a text; name is for errors. Whatever comes of it, the caller calls fini. */
koksma_status koksma__scene_parse(const char *name, const char *text, size_t size, koksma_scene *scene);
void koksma__scene_fini(koksma_scene *scene);

#endif
