/* SPDX-License-Identifier: Apache-2.0 */
/* Writes the report of images that another renderer made. */
#ifndef KOKSMA_STUDY_IMAGES_IMAGES_REPORT_H
#define KOKSMA_STUDY_IMAGES_IMAGES_REPORT_H

#include <koksma/study.h>

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
