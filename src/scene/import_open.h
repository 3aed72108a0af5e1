/* SPDX-License-Identifier: Apache-2.0 */
/* Scenes of other renderers by their files' names. */
#ifndef KOKSMA_SCENE_IMPORT_OPEN_H
#define KOKSMA_SCENE_IMPORT_OPEN_H

#include "core/read_file.h"
#include "render/description.h"

/* Whether a file of this name (.pbrt, .xml) is a scene of another renderer. */
bool koksma__is_import_file(const char *path);

/* Reads one into an empty scene; whatever comes of it, the caller frees that. Errors: MISSING, MALFORMED, MEMORY,
   UNSUPPORTED. */
koksma_status koksma__import_open(const char *path, koksma__named by, koksma_scene *scene);

#endif
