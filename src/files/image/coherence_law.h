/* SPDX-License-Identifier: Apache-2.0 */
/* The distribution of the coherence of errors that are white noise (koksma/image.h). */
#ifndef KOKSMA_IMAGE_COHERENCE_LAW_H
#define KOKSMA_IMAGE_COHERENCE_LAW_H

#include <stddef.h>

/* The model of the power: a mean over `images` images; the share `common` of the squared error is the same in all of
   them. The spectrum of an image has `waves` pairs of conjugate frequencies (u, v) and (-u, -v), each pair counted
   once, and `real` frequencies that are their own conjugates; the mean (0, 0) is not counted. */
typedef struct koksma__coherence_law {
    size_t images, waves, real;
    double common;
} koksma__coherence_law;

/* Returns the probability that the largest power divided by the mean power exceeds x. */
double koksma__coherence_tail(const koksma__coherence_law *law, double x);

/* Returns the inverse of koksma__coherence_tail: the x that the largest power divided by the mean power exceeds with
   probability `tail`, 0 < tail < 1. */
double koksma__coherence_quantile(const koksma__coherence_law *law, double tail);

#endif
