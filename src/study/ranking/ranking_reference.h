/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The reference that a ranking measures errors against, by one metric: independent replicates of jittered samples,
 * kept apart so that errors can be measured against the reference without each of them (ranking_decisions.c says what
 * for). Its samples depend on the scene, the size and the samples a pixel only.
 */
#ifndef KOKSMA_STUDY_RANKING_RANKING_REFERENCE_H
#define KOKSMA_STUDY_RANKING_RANKING_REFERENCE_H

#include "image/metrics/metrics.h"
#include "study/ranking/ranking_decisions.h"
#include "study/run/study.h"

typedef struct koksma__rank_reference {
    koksma_metric_spec metric;
    int width, height;
    size_t pixels, values; /* values: of all pixels, metric.metric->channels each */
    double *mean;          /* of a value over the replicates */
    double *without;       /* replicate r, value v: the mean without it, at r * values + v */
    double error;          /* expected mean absolute error of the luminance of `mean` */
    int made;              /* replicates so far */
} koksma__rank_reference;

/* The samples a pixel of a replicate, for patterns of spp samples: a square number, as they are jittered. */
long long koksma__rank_reference_spp(int spp);

/* metric: NULL for mae. Renders the replicates; the scene's width and height are those of the picture. Errors: those of rendering,
   IMPOSSIBLE (a pixel is not a finite number; another renderer makes equal pictures for all seeds), MEMORY,
   INTERRUPTED. fini takes zeros and what a failed init left. */
koksma_status koksma__rank_reference_init(koksma__rank_reference *reference, const koksma_metric_spec *metric,
                                          const koksma__study_scene *scene, const char *pattern, const char *variant,
                                          int spp, const koksma_run *run);
void koksma__rank_reference_fini(koksma__rank_reference *reference);

/* What a trial gives: the error against the reference, against it without each replicate, and what few pixels do to
   the first. */
enum {
    KOKSMA__RANK_ROBUST = 1 + KOKSMA__RANK_REPLICATES,
    KOKSMA__RANK_TOP_SHARE,
    KOKSMA__RANK_ERRORS,
};

/* Errors: MEMORY. */
koksma_status koksma__rank_reference_compare(const koksma__rank_reference *reference, const koksma_image *image,
                                             double errors[KOKSMA__RANK_ERRORS]);

/* The image's errors of luminance pixel by pixel, with their signs. */
void koksma__rank_reference_subtract(const koksma__rank_reference *reference, const koksma_image *image,
                                     double *errors);

#endif
