/* SPDX-License-Identifier: Apache-2.0 */
/* The sentence of a report on the slopes of one measure or scene. */
#ifndef KOKSMA_STUDY_REPORT_SLOPE_WORDS_H
#define KOKSMA_STUDY_REPORT_SLOPE_WORDS_H

#include "stats/stats.h"
#include "study/report/document.h"

/* Whether a steeper slope means a better pattern. */
typedef enum koksma__slope_sense {
    KOKSMA__FALLS,  /* for errors and discrepancies: a faster fall is better */
    KOKSMA__LARGER, /* for distances: larger values are better */
    KOKSMA__NO_SIZE /* for a measure of quality, which is 0 for good points and rises with n for others */
} koksma__slope_sense;

/* The slopes of n patterns. zeros: for each pattern, the number of sizes at which its mean is 0, which has no
   logarithm. */
typedef struct koksma__slopes {
    const char *name;
    const char *const *patterns;
    const koksma__trend *trends;
    const size_t *zeros;
    size_t n, sizes;
    koksma__slope_sense sense;
    double
        random_slope; /* the slope of independent random points, for comparison if no pattern is one; NaN: unknown */
} koksma__slopes;

/* Writes which pattern falls fastest, how many fall faster than random samples, and which means are left out. Writes
   nothing if no pattern has a slope and no mean is left out. */
void koksma__slopes_sentence(koksma__document *d, const koksma__slopes *slopes);

#endif
