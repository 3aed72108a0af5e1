/* SPDX-License-Identifier: Apache-2.0 */
/* Opens scenes of other renderers, which are recognised by the names of their files. */
#ifndef KOKSMA_SCENE_IMPORT_OPEN_H
#define KOKSMA_SCENE_IMPORT_OPEN_H

#include "core/files.h"
#include "render/description.h"

/* Whether a file with this name (.pbrt, .xml) is a scene of another renderer. */
bool koksma__is_import_file(const char *path);

/* Reads a scene of another renderer into an empty scene, which the caller must free even after an error. Errors:
   MISSING, MALFORMED, MEMORY, UNSUPPORTED. */
koksma_status koksma__import_open(const char *path, koksma__named by, koksma_scene *scene);

#endif
