/* SPDX-License-Identifier: Apache-2.0 */
/* Hashes of the files of points that a study's patterns and references name. They are part of the keys of rows,
   as the hashes of scenes are: when a file's contents change, results that depend on it get new rows. */
#ifndef KOKSMA_STUDY_PLAN_POINT_FILES_H
#define KOKSMA_STUDY_PLAN_POINT_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <koksma/koksma.h>

typedef struct koksma__point_file {
    char *path;
    uint64_t hash;
} koksma__point_file;

/* The files that were hashed already, so that each is read once; {0} is an empty list. */
typedef struct koksma__point_files {
    size_t n;
    koksma__point_file *at;
} koksma__point_files;

enum { KOKSMA__HASH_TEXT = 40 };

/* Writes the hash of a scene to out, followed by one hash of all files that two texts name: the patterns of a row, of all
   uses of an image, and the name of its reference (koksma__reference_parse). Either text may be "". A file that can't be
   read has the hash 0; koksma__points_can_be_read tells why. known may be NULL. */
void koksma__hash_with_points(koksma__point_files *known, const char *scene_hash, const char *patterns,
                              const char *reference, char out[KOKSMA__HASH_TEXT]);

/* Fails if a file that the patterns or the reference name can't be read, with the reason; OK also if they name none. */
koksma_status koksma__points_can_be_read(const char *patterns, const char *reference);

/* Whether the patterns or the reference name a family of files (file_names.h). */
bool koksma__points_have_family(const char *patterns, const char *reference);

void koksma__point_files_fini(koksma__point_files *known);

#endif
