/* SPDX-License-Identifier: Apache-2.0 */
/* The reader of Mitsuba's .serialized files. */
#ifndef KOKSMA_MESHES_MESH_SERIALIZED_H
#define KOKSMA_MESHES_MESH_SERIALIZED_H

#include "core/read_file.h"
#include "meshes/mesh_file.h"

/* Checks the two bytes with which such a file begins. */
koksma__check_start koksma__serialized_start;

/* Adds the meshes of the file to out: all of them, or the one that out->part names. The whole file must be in memory
   and not empty; out->path is set. Errors: MALFORMED, UNSUPPORTED (this build lacks zlib), MEMORY. */
koksma_status koksma__serialized_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out);

#endif
