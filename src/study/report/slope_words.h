/* SPDX-License-Identifier: Apache-2.0 */
/* What a report says of the slopes of one measure or scene, in a sentence. */
#ifndef KOKSMA_STUDY_REPORT_SLOPE_WORDS_H
#define KOKSMA_STUDY_REPORT_SLOPE_WORDS_H

#include "stats/slopes.h"
#include "study/report/document.h"

/* Whether a slope says who is better. */
typedef enum koksma__slope_sense {
    KOKSMA__FALLS,  /* errors, discrepancies: the faster the better */
    KOKSMA__LARGER, /* distances: larger is better */
    KOKSMA__NO_SIZE /* a quality, which is 0 for good points and rises with n for others */
} koksma__slope_sense;

/* Slopes of n patterns; zeros: in how many of all sizes each one's mean is 0, which has no logarithm. */
typedef struct koksma__slopes {
    const char *name;
    const char *const *patterns;
    const koksma__trend *trends;
    const size_t *zeros;
    size_t n, sizes;
    koksma__slope_sense sense;
} koksma__slopes;

/* Who falls fastest, who falls faster than random samples, and what is left out; nothing where nothing has a slope
   and nothing is left out. */
void koksma__slopes_sentence(koksma__document *d, const koksma__slopes *slopes);

#endif
