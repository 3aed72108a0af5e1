/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_STUDY_STATISTICS_H
#define KOKSMA_STUDY_STATISTICS_H

#include <stddef.h>

typedef struct koksma__summary {
    size_t n;
    double mean, sd;  /* sd: of the sample, with n - 1 */
    double low, high; /* 95 % interval of the mean by Student's t; equal to the mean for n = 1 */
    double max;
} koksma__summary;

/* Of values[0], values[stride], …, n of them; n = 0 gives NaN. Sums are compensated, in index order. */
koksma__summary koksma__summarize(const double *values, size_t n, size_t stride);

/* The 97.5 % point of Student's t with the given degrees of freedom (Fisher & Cornish's expansion; 1 and 2 exactly;
   error below 1 % from 3 on). */
double koksma__student_975(size_t degrees);

/* Mean over whole blocks of `block` values of each block's largest, and the sample SD of those; NaN without one. */
void koksma__largest_of(const double *values, size_t n, size_t stride, size_t block, double *mean, double *sd);

#endif
