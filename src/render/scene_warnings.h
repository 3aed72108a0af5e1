/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_RENDER_SCENE_WARNINGS_H
#define KOKSMA_RENDER_SCENE_WARNINGS_H

#include "render/description.h"

/* Warning i of koksma_scene_warning. If by_paths is false, warnings that concern only path-tracing integrators are
   left out. */
bool koksma__scene_warning(const koksma_scene *scene, bool by_paths, size_t i, char *text, size_t size);

#endif
