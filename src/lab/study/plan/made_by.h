/* SPDX-License-Identifier: Apache-2.0 */
/* The revisions of the patterns, measures, warps and renderer that make a row. They are part of the row's key in the
   store: a row stays valid when code that it does not depend on changes, and a row of an older revision is not
   mistaken for one of the present revision. */
#ifndef KOKSMA_STUDY_PLAN_MADE_BY_H
#define KOKSMA_STUDY_PLAN_MADE_BY_H

#include <koksma/koksma.h>

enum { KOKSMA__MADE_BY = 512 };

/* The renderer's revision, raised with every change of any bit of a rendered image, of its error or of its
   coherence. */
enum { KOKSMA__RENDERER_REVISION = 2 };

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

#endif
