/* SPDX-License-Identifier: Apache-2.0 */
/* The revisions of the patterns, measures, warps and renderer that make a row. They are part of the row's key in the
   store: a row stays valid when code that it does not depend on changes, and a row of an older revision is not
   mistaken for one of the present revision. */
#ifndef KOKSMA_STUDY_PLAN_MADE_BY_H
#define KOKSMA_STUDY_PLAN_MADE_BY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <koksma/koksma.h>

enum { KOKSMA__MADE_BY = 512 };

/* The renderer's revision, raised with every change of any bit of a rendered image, of its error or of its
   coherence. */
enum { KOKSMA__RENDERER_REVISION = 4 };

/* Revisions as texts of the form "name revision, name revision". */
typedef struct koksma__made_by {
    char points[KOKSMA__MADE_BY]; /* revisions of the pattern; for an image, of the renderer and all patterns */
    /* Revisions of the measure and the warp. For an image: the metric's revision, if the row's value is in a metric,
       and then the revisions of the renderer and of the patterns that made its reference. */
    char value[KOKSMA__MADE_BY];
} koksma__made_by;

/* Writes the revisions of all code that makes a row of the series that the texts describe. For a reference, pattern
   is ""; metric is "" unless the row's value is in a metric. Errors: those of the specs. */
koksma_status koksma__find_made_by(bool image, const char *pattern, const char *options, const char *what,
                                   const char *metric, koksma__made_by *out);

/* Splits the text of a reference, "name:pattern@SPPxREPLICATES" as in "r:jittered@256x4", into its parts. Errors:
   MALFORMED. */
koksma_status koksma__reference_parse(const char *text, char name[KOKSMA_MAX_SPEC], char pattern[KOKSMA_MAX_SPEC],
                                      long long *spp, long long *replicates);

/* Hashes of the files of points that a study's patterns and references name. They are part of the keys of rows,
   as the hashes of scenes are: when a file's contents change, results that depend on it get new rows. */

/* The files that were hashed already, so that each is read once; {0}: none. A damaged store may name any number of files,
   so they are in a balanced tree. */
typedef struct koksma__point_files {
    void *tree; /* of tsearch(3) */
} koksma__point_files;

enum { KOKSMA__HASH_TEXT = 40 };

/* The texts of a row that may name files. Either may be "". */
typedef struct koksma__row_texts {
    /* whether the row is of an image, whose text has a pattern for each use; in the text of a set of points, which is one
       pattern, ';' and '=' belong to a path */
    bool image;
    const char *patterns;
    const char *reference; /* of an image: koksma__reference_parse */
} koksma__row_texts;

/* Writes the hash of a scene to out, followed by one hash of all files that the texts of a row name: those of its patterns,
   then those of its reference. Of a sampler in a library it is the hash of the library. A file that can't be read has the
   hash 0. known may be NULL. */
void koksma__hash_with_points(koksma__point_files *known, const char *scene_hash, const koksma__row_texts *row,
                              char out[KOKSMA__HASH_TEXT]);

/* Whether a row names any files but programs and libraries. */
bool koksma__points_read_files(const koksma__row_texts *row);

void koksma__point_files_fini(koksma__point_files *known);

#endif
