/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_RENDER_SCENE_WARNINGS_H
#define KOKSMA_RENDER_SCENE_WARNINGS_H

#include "render/description.h"

/* Warning i of koksma_scene_warning; without by_paths it leaves out warnings that matter only to integrators that
   follow all paths. */
bool koksma__scene_warning(const koksma_scene *scene, bool by_paths, size_t i, char *text, size_t size);

#endif
