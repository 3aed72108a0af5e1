/* SPDX-License-Identifier: Apache-2.0 */
/* Images of another renderer: their names. */
#ifndef KOKSMA_STUDY_IMAGES_IMAGES_H
#define KOKSMA_STUDY_IMAGES_IMAGES_H

#include <stdbool.h>

#include <koksma/study.h>

/* Images are identified by their file names, which match a template with placeholders: out_{spp}_{trial}.exr. */

/* What a path has in place of the template's placeholders: {spp} and {trial} are numbers; the texts of all others
   form the group, "name=text name=text". */
typedef struct koksma__image_name {
    char group[KOKSMA_IMAGES_GROUP];
    long long spp, trial;
} koksma__image_name;

/* Writes the pattern for glob() that finds all paths that could match the template `places`. Errors: ARGUMENT (the
   template has no {name}, or the pattern is longer than size). */
koksma_status koksma__image_names_pattern(const char *places, char *pattern, size_t size);

/* Matches a path with a template for which koksma__image_names_pattern succeeded; *fits: whether they match. Errors:
   MEMORY. */
koksma_status koksma__image_name_read(const char *places, const char *path, koksma__image_name *out, bool *fits);

#endif
