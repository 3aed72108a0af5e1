/* SPDX-License-Identifier: Apache-2.0 */
/* The coherence of errors (koksma/image.h) that are given as doubles instead of images. */
#ifndef KOKSMA_IMAGE_COHERENCE_H
#define KOKSMA_IMAGE_COHERENCE_H

#include <koksma/image.h>

/* Does what koksma_coherence_add does, from the errors of an image's pixels: errors[y * width + x], which the
   function overwrites. Errors: MALFORMED (an error is not a finite number), MEMORY. */
koksma_status koksma__coherence_add_errors(koksma_coherence *coherence, double *errors);

/* ---- The distribution of the coherence of errors that are white noise ---- */

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
