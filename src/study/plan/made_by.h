/* SPDX-License-Identifier: Apache-2.0 */
/* Which revisions of patterns, measures, warps and of the renderer make a row: part of its key in the store, so that
   rows stay valid when another generator changes, and those of an older revision are not taken for new ones. */
#ifndef KOKSMA_STUDY_PLAN_MADE_BY_H
#define KOKSMA_STUDY_PLAN_MADE_BY_H

#include <koksma/koksma.h>

enum { KOKSMA__MADE_BY = 512 };

/* Raised with every change of any bit of a rendered image, of its error or of its coherence. */
enum { KOKSMA__RENDERER_REVISION = 1 };

/* "name revision, name revision" */
typedef struct koksma__made_by {
    char points[KOKSMA__MADE_BY]; /* of the pattern; of an image of the renderer and all its patterns */
    char value[KOKSMA__MADE_BY];  /* of the measure, and of the warp before it; of an image as `points`, of its
                                     reference */
} koksma__made_by;

/* What makes a row of a series of the store, by its texts; of a reference, pattern is "". first: as everything was at
   revision 0, else as it is in this program. Errors: those of the specs. */
koksma_status koksma__find_made_by(bool image, const char *pattern, const char *options, const char *what, bool first,
                                   koksma__made_by *out);

/* The parts of a reference's text, "name:pattern@spp x replicates" without blanks. Errors: MALFORMED. */
koksma_status koksma__reference_parse(const char *text, char name[KOKSMA_MAX_SPEC], char pattern[KOKSMA_MAX_SPEC],
                                      long long *spp, long long *replicates);

#endif
