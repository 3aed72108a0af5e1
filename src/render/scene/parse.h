/* SPDX-License-Identifier: Apache-2.0 */
/* Reads scene files. */
#ifndef KOKSMA_SCENE_PARSE_H
#define KOKSMA_SCENE_PARSE_H

#include "render/description.h"

/* Fills a scene from a text; `name` is for error messages. The caller must call koksma__scene_fini even after an
   error. */
koksma_status koksma__scene_parse(const char *name, const char *text, size_t size, koksma_scene *scene);

#endif
