/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The cases in which a question correlates a measure of points with the error of images. A case is a measure in a
 * number of dimensions, and a scene with its options and number of samples. Several blocks with one id may contain
 * the same case; the case then has the patterns of all these blocks.
 */
#ifndef KOKSMA_STUDY_REPORT_CASES_H
#define KOKSMA_STUDY_REPORT_CASES_H

#include "study/report/questions/topic.h"

/* Maximum number of patterns of a case, because the time of the bootstrap grows with the square of that number. */
enum { KOKSMA__CASE_PATTERNS = 256 };

/* A measure of points of `dim` dimensions; the same measure in two and in three dimensions counts as two measures. */
typedef struct koksma__measured {
    const char *measure;
    int dim;
    bool larger;                      /* whether larger values of the measure are better */
    char label[KOKSMA_MAX_SPEC + 16]; /* "l2-star", "l2-star (3D)" */
} koksma__measured;

typedef struct koksma__cases {
    koksma_study *study;
    const koksma__topic *topic;
    size_t n;
    koksma__measured *measured; /* in the order of the topic's blocks */
} koksma__cases;

typedef struct koksma__case {
    const koksma__image_block *image; /* the first block that renders the case */
    const char *scene, *variant;
    long long spp;
    const koksma__measured *of;
} koksma__case;

/* For each pattern of a case: the mean x of the measure, and the mean y of the image error with its interval low ..
   high. */
typedef struct koksma__pairs {
    size_t n,
        /* patterns_in_all counts all patterns, even those without results or beyond KOKSMA__CASE_PATTERNS */
        patterns_in_all;
    double x[KOKSMA__CASE_PATTERNS], y[KOKSMA__CASE_PATTERNS], low[KOKSMA__CASE_PATTERNS],
        high[KOKSMA__CASE_PATTERNS];
    double x_error[KOKSMA__CASE_PATTERNS], y_error[KOKSMA__CASE_PATTERNS]; /* standard errors of the means */
    const char *patterns[KOKSMA__CASE_PATTERNS];
} koksma__pairs;

/* Lists the measures of a topic. Errors: MEMORY. */
koksma_status koksma__cases_open(koksma_study *study, const koksma__topic *topic, koksma__cases *cases);
void koksma__cases_close(koksma__cases *cases);

/* Calls `visit` once for every case: every combination of scene, variant, number of samples and measure. */
typedef koksma_status (*koksma__case_visitor)(const koksma__cases *cases, void *context, const koksma__case *at);
koksma_status koksma__cases_visit(const koksma__cases *cases, koksma__case_visitor visit, void *context);

/* Reads the means of a case for all patterns that have results of both the measure and the image error. */
koksma_status koksma__case_pairs(const koksma__cases *cases, const koksma__case *at, koksma__pairs *out);

#endif
