/* SPDX-License-Identifier: Apache-2.0 */
/* Shapes of other renderers' scenes. */
#ifndef KOKSMA_SCENE_IMPORT_SHAPES_H
#define KOKSMA_SCENE_IMPORT_SHAPES_H

#include "scene/import.h"

/* A mesh that is taken over; or of a file, which is read once. -1: none, which was said. */
koksma_status koksma__import_mesh(koksma__import *im, koksma__text_place place, koksma__mesh *mesh, int *out);
koksma_status koksma__import_mesh_file(koksma__import *im, koksma__text_place place, const char *name,
                                       bool with_normals, int *out);

/* Places a shape, further moved by `outer` (may be NULL). */
koksma_status koksma__import_put(koksma__import *im, const koksma__import_item *item, const double outer[12]);

/* Frees what this file keeps of an import. */
void koksma__import_shapes_fini(koksma__import *im);

#endif
