/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The reference that a ranking measures errors against, in luminance: independent replicates of jittered samples,
 * kept apart so that errors can be measured against the reference without each of them (ranking_decisions.c says what
 * for). Its samples depend on the scene, the size and the samples a pixel only.
 */
#ifndef KOKSMA_STUDY_RANKING_RANKING_REFERENCE_H
#define KOKSMA_STUDY_RANKING_RANKING_REFERENCE_H

#include "study/ranking/ranking_decisions.h"
#include "study/run/study.h"

typedef struct koksma__rank_reference {
    size_t pixels;
    double *mean;    /* of a pixel's luminance over the replicates */
    double *without; /* pixel p, replicate r: the mean without it, at p * KOKSMA__RANK_REPLICATES + r */
    double error;    /* expected mean absolute error of `mean` */
    int made;        /* replicates so far */
} koksma__rank_reference;

/* The samples a pixel of a replicate, for patterns of spp samples: a square number, as they are jittered. */
long long koksma__rank_reference_spp(int spp);

/* Renders the replicates; the scene's width and height are those of the picture. Errors: those of rendering,
   IMPOSSIBLE (a pixel is not a finite number; another renderer makes equal pictures for all seeds), MEMORY,
   INTERRUPTED. fini takes zeros and what a failed init left. */
koksma_status koksma__rank_reference_init(koksma__rank_reference *reference, const koksma__study_scene *scene,
                                          const char *pattern, const char *variant, int spp, const koksma_run *run);
void koksma__rank_reference_fini(koksma__rank_reference *reference);

/* The image's mean absolute error against the reference, and then without each replicate. */
void koksma__rank_reference_compare(const koksma__rank_reference *reference, const koksma_image *image,
                                    double errors[1 + KOKSMA__RANK_REPLICATES]);

/* The image's errors pixel by pixel, with their signs. */
void koksma__rank_reference_subtract(const koksma__rank_reference *reference, const koksma_image *image,
                                     double *errors);

#endif
