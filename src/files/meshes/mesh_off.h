/* SPDX-License-Identifier: Apache-2.0 */
/* The reader of OFF files. */
#ifndef KOKSMA_MESHES_MESH_OFF_H
#define KOKSMA_MESHES_MESH_OFF_H

#include "meshes/mesh_file.h"

/* Adds the contents of the file to out. The whole file must be in memory, followed by a zero byte, and not empty;
   out->path must be set. Errors: MALFORMED, MEMORY. */
koksma_status koksma__off_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out);

#endif
