/* SPDX-License-Identifier: Apache-2.0 */
/* The distribution of the coherence of errors that are white noise (koksma/image.h). */
#ifndef KOKSMA_IMAGE_COHERENCE_LAW_H
#define KOKSMA_IMAGE_COHERENCE_LAW_H

#include <stddef.h>

/* The power is a mean over `images` images; the share `common` of their squared errors is the same in all. Each has
   `waves` frequencies with a mirror image and `real` ones without (the mean, which is left out, is none). */
typedef struct koksma__coherence_law {
    size_t images, waves, real;
    double common;
} koksma__coherence_law;

/* The probability that the largest power over the mean power is above x. */
double koksma__coherence_tail(const koksma__coherence_law *law, double x);

/* The x that the ratio exceeds with probability `tail`, 0 < tail < 1: the inverse of koksma__coherence_tail. */
double koksma__coherence_quantile(const koksma__coherence_law *law, double tail);

#endif
