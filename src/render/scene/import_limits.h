/* SPDX-License-Identifier: Apache-2.0 */
/* Limits of the memory that a scene of another renderer may take, and of its textures' transforms. */
#ifndef KOKSMA_SCENE_IMPORT_LIMITS_H
#define KOKSMA_SCENE_IMPORT_LIMITS_H

#include "scene/import.h"

/* What the C library and a tree of names (meshes/names.h) take beside the bytes of a thing that has a name. */
enum { KOKSMA__HELD_WITH_NAME = 64 };

/* Counts memory, before it is taken, that texts make a reader keep: the texts that are open, elements, names, objects, and
   meshes whose triangles the texts have. A few characters make hundreds of bytes, and a text may be included again and
   again, so all may take 384 MiB together. Beside that are 128 MiB for expat (xml.c), and what a text of 64 MiB takes in
   passing: 320 MiB for the numbers of a mesh. Error: MALFORMED. */
koksma_status koksma__import_hold(koksma__import *im, koksma__text_place place, uint64_t bytes);

/* The same for a mesh. */
koksma_status koksma__import_hold_mesh(koksma__import *im, koksma__text_place place, const koksma__mesh *mesh);

/* Checks numbers by which a texture is scaled or moved, which must be within 1e6, so that texture coordinates are finite.
   Error: MALFORMED. */
koksma_status koksma__import_check_uv(koksma__text_place place, const double *values, size_t n);

#endif
