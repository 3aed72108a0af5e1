/* SPDX-License-Identifier: Apache-2.0 */
/* The files of points that a study's patterns and references name. Its rows go by what is in them, as they go by the
   hash of a scene: another file behind the same name makes other rows. */
#ifndef KOKSMA_STUDY_PLAN_POINT_FILES_H
#define KOKSMA_STUDY_PLAN_POINT_FILES_H

#include <stddef.h>
#include <stdint.h>

typedef struct koksma__point_file {
    char *path;
    uint64_t hash;
} koksma__point_file;

/* Those that were looked at; a file is read once. {0}: none yet. */
typedef struct koksma__point_files {
    size_t n;
    koksma__point_file *at;
} koksma__point_files;

enum { KOKSMA__HASH_TEXT = 40 };

/* `hash`, and behind it that of the file where `spec` is "file:PATH", or ends in ":file:PATH@…" as a reference's name
   does. A file that can't be read counts as an empty one: who generates its points says why. known may be NULL. */
void koksma__hash_with_points(koksma__point_files *known, const char *hash, const char *spec,
                              char out[KOKSMA__HASH_TEXT]);

void koksma__point_files_fini(koksma__point_files *known);

#endif
