/* SPDX-License-Identifier: Apache-2.0 */
/* The readers of mesh files, one for each format, and zlib for those that are compressed. A reader adds the contents of a
   file, which is in memory, followed by a zero byte, and not empty, to `out`; out->path is set. Errors: MALFORMED, MEMORY,
   and what else is said below. */
#ifndef KOKSMA_MESHES_READERS_H
#define KOKSMA_MESHES_READERS_H

#include "meshes/mesh_file.h"
#include "meshes/mesh_text.h"

/* OBJ with its material files; also MISSING. */
koksma_status koksma__obj_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out);

/* glTF, JSON or binary, with its buffers; also MISSING. */
koksma_status koksma__gltf_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out);

koksma_status koksma__ply_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out);

/* Mitsuba's .serialized files; also UNSUPPORTED (this build lacks zlib). The second function checks their first bytes. */
koksma_status koksma__serialized_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out);
koksma_status koksma__serialized_start(const unsigned char *bytes, size_t size);

/* Names a word of t's line that a format does not have, in f->unknown: with its number of line and the one that may be
   meant. what: "a keyword of material files". Error: MEMORY. */
koksma_status koksma__name_word(const koksma__text *t, const char *word, size_t length, const char *what,
                                const char *const *keywords, koksma__mesh_file *f);

/* ---- Material files of OBJ ---- */

typedef struct koksma__mtl_name {
    char *name;      /* owned */
    size_t material; /* index of the material in the mesh file */
    bool made;       /* whether a material file defines the material; otherwise only usemtl lines name it */
} koksma__mtl_name;

typedef struct koksma__mtl_names {
    koksma__list names;   /* in the order of the file */
    koksma__names places; /* the index of each in that list */
} koksma__mtl_names;

/* The entry of the name; a new name gets an entry with a grey material. NULL when memory runs out. The pointer is
   valid until the next call. */
koksma__mtl_name *koksma__mtl_find(koksma__mtl_names *names, koksma__mesh_file *f, const char *name, size_t length);
void koksma__mtl_names_fini(koksma__mtl_names *names);

/* Reads the material file at `path` into the materials of f, and adds its hash to f's hash. Errors: MISSING,
   MALFORMED, MEMORY. */
koksma_status koksma__mtl_read(const char *path, koksma__mtl_names *names, koksma__mesh_file *f);

/* ---- Compressed bytes ---- */

/* Decompresses a whole gzip file, which has one or several streams, and adds a zero byte; the caller frees *out. Memory
   grows with the bytes that were decompressed. The error texts do not name the file. Errors: UNSUPPORTED (this build lacks
   zlib), MEMORY, MALFORMED (damaged, cut short, or more than `most` bytes). */
koksma_status koksma__inflate_all(const unsigned char *bytes, size_t size, size_t most, unsigned char **out,
                                  size_t *out_size);

#endif
