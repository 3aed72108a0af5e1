/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The reference images that a ranking measures errors against, for one metric: each is the mean of independent
 * replicates. For the jackknife estimate of the reference's own error (ranking_decisions.c), the means over all
 * replicates but one are also stored. A ranking begins with a reference of stage 0, which costs as much as 16 trials, and
 * goes on to those of stages 1 and 2, with 4 and 16 times as many samples, after a number of rounds
 * (koksma__rank_reference_stage). Errors of all stages are added up: the jackknife leaves out the replicates r of all
 * stages together. The samples depend only on the scene, the size, the samples per pixel and the stage.
 */
#ifndef KOKSMA_STUDY_RANKING_RANKING_REFERENCE_H
#define KOKSMA_STUDY_RANKING_RANKING_REFERENCE_H

#include "image/metrics/metrics.h"
#include "study/ranking/ranking_decisions.h"
#include "study/run/study.h"

typedef struct koksma__rank_reference {
    koksma_metric_spec metric;
    int width, height;
    size_t pixels, values; /* values: pixels times metric.metric->channels */
    double *mean;          /* mean of each value over the replicates */
    double *without;       /* the mean of value v over all replicates except r is at r * values + v */
    double error;          /* expected mean absolute error of the luminance of `mean`; NaN: not known */
    int made;              /* number of replicates rendered so far */
} koksma__rank_reference;

enum { KOKSMA__RANK_STAGES = 3 };

/* The stage of the reference against which the trials of a round are measured. */
int koksma__rank_reference_stage(int round);

/* The samples per pixel of a replicate when the patterns have spp samples per pixel: a square number, which suits
   jittered samplers of other renderers. */
long long koksma__rank_reference_spp(int spp, int stage);

/* Renders the replicates, never adaptively. metric: NULL for mae; variant: that of the trials. The reference has the
   scene's width and height. Errors: those of rendering, IMPOSSIBLE (a pixel is not a finite number, or another renderer
   makes equal pictures for all seeds), MEMORY, INTERRUPTED. koksma__rank_reference_fini also accepts a zeroed reference
   and one whose init failed. */
koksma_status koksma__rank_reference_init(koksma__rank_reference *reference, const koksma_metric_spec *metric,
                                          const koksma__study_scene *scene, const char *pattern, const char *variant,
                                          int spp, int stage, const koksma_run *run);

/* Takes a finished image as the reference, as if it had no error. Errors: ARGUMENT (another size), MEMORY. */
koksma_status koksma__rank_reference_take(koksma__rank_reference *reference, const koksma_metric_spec *metric,
                                          const koksma__study_scene *scene, const koksma_image *image);
void koksma__rank_reference_fini(koksma__rank_reference *reference);

/* Indices of a trial's errors: at 0 the error against the reference, at 1 + r the error against the reference
   without replicate r, and then two values that show how much a few pixels contribute to the error. */
enum {
    KOKSMA__RANK_ROBUST = 1 + KOKSMA__RANK_REPLICATES,
    KOKSMA__RANK_TOP_SHARE,
    KOKSMA__RANK_ERRORS,
};

/* Measures the errors of an image against the reference. Errors: MEMORY. */
koksma_status koksma__rank_reference_compare(const koksma__rank_reference *reference, const koksma_image *image,
                                             double errors[KOKSMA__RANK_ERRORS]);

/* Computes the signed luminance error of each pixel of the image. */
void koksma__rank_reference_subtract(const koksma__rank_reference *reference, const koksma_image *image,
                                     double *errors);

#endif
