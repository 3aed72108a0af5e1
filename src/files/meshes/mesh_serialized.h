/* SPDX-License-Identifier: Apache-2.0 */
/* The reader of Mitsuba's .serialized files. */
#ifndef KOKSMA_MESHES_MESH_SERIALIZED_H
#define KOKSMA_MESHES_MESH_SERIALIZED_H

#include "core/read_file.h"
#include "meshes/mesh_file.h"

/* Checks the two bytes with which such a file begins. */
koksma__check_start koksma__serialized_start;

/* Adds all meshes of the file to out. The whole file must be in memory and not empty; out->path is set. Errors:
   MALFORMED, UNSUPPORTED (this build lacks zlib), MEMORY. */
koksma_status koksma__serialized_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out);

/* A file whose meshes are read one by one; zeroed at first. */
typedef struct koksma__serialized {
    unsigned char *bytes; /* NULL: it is closed */
    size_t size;          /* length of the file, also after it is closed */
    uint64_t read;        /* number of bytes to which the meshes that were read decompress */
} koksma__serialized;

/* Reads the file and checks its dictionary. Errors: MISSING, MALFORMED, MEMORY. */
koksma_status koksma__serialized_open(const char *path, koksma__serialized *file);
void koksma__serialized_close(koksma__serialized *file);

/* Reads mesh number `part`, from 0, of an open file as a checked mesh. Of all meshes that are read of a file, the same
   one again too, no more may be decompressed than a model may have. *out must be zeroed. Errors as above. */
koksma_status koksma__serialized_mesh(koksma__serialized *file, const char *path, long part, koksma__mesh *out);

#endif
