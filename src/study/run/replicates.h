/* SPDX-License-Identifier: Apache-2.0 */
/* Sums over independent renders of one picture. */
#ifndef KOKSMA_STUDY_RUN_REPLICATES_H
#define KOKSMA_STUDY_RUN_REPLICATES_H

#include <koksma/image.h>

/* Sums of replicates, added in their order: of the channels for the picture; of each pixel the mean luminance and the
   sum of the squares of what differs from it, for its error. */
typedef struct koksma__replicates {
    double *sum, *luminance, *squares; /* one array, which begins at sum */
    size_t pixels, channels;
    long long n;
} koksma__replicates;

/* How long that array is; the sums in an array of n numbers, and in a new one. */
size_t koksma__replicates_numbers(const koksma__replicates *sums);
koksma__replicates koksma__replicates_over(double *numbers, size_t n, size_t pixels);
koksma_status koksma__replicates_init(koksma__replicates *sums, size_t pixels, size_t channels);

/* Adds one; the first makes room where there is none. */
koksma_status koksma__replicates_add(koksma__replicates *sums, const koksma_image *image);

/* Their mean, and its own expected absolute error in luminance. Allocates out. */
koksma_status koksma__replicates_mean(const koksma__replicates *sums, int width, int height, koksma_image *out,
                                      double *error);

#endif
