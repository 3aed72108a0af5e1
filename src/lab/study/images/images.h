/* SPDX-License-Identifier: Apache-2.0 */
/* Images of another renderer: their names, and their report. */
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

/* The results of koksma_study_images. */
typedef struct koksma__images {
    const char *places, *reference_path;
    const koksma_image *reference;
    const koksma_metric_spec *metric; /* metric of the errors, or NULL for the mean absolute error */
    const koksma_images_row *rows;    /* sorted by group, then by spp */
    const char *const *first;         /* path of the first image of each row */
    size_t n;
} koksma__images;

/* Writes report.json and report.html into a folder. */
koksma_status koksma__images_report(const koksma__images *images, const char *folder);

#endif
