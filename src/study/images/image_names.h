/* SPDX-License-Identifier: Apache-2.0 */
/* Images identified by their file names: a path with places (names in braces), as in out_{spp}_{trial}.exr. */
#ifndef KOKSMA_STUDY_IMAGES_IMAGE_NAMES_H
#define KOKSMA_STUDY_IMAGES_IMAGE_NAMES_H

#include <stdbool.h>

#include <koksma/study.h>

/* The texts at the places of a path: {spp} and {trial} are numbers; all others form the group, "name=text
   name=text". */
typedef struct koksma__image_name {
    char group[KOKSMA_IMAGES_GROUP];
    long long spp, trial;
} koksma__image_name;

/* Writes the pattern for glob() that finds all paths that could match. Errors: ARGUMENT (no {name}, or too long). */
koksma_status koksma__image_names_pattern(const char *places, char *pattern, size_t size);

/* Whether a path fits a template for which koksma__image_names_pattern succeeded. Errors: MEMORY. */
koksma_status koksma__image_name_read(const char *places, const char *path, koksma__image_name *out, bool *fits);

#endif
