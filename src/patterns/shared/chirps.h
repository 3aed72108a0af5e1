/* SPDX-License-Identifier: Apache-2.0 */
/* Discrete Fourier transforms of any length, in order. */
#ifndef KOKSMA_PATTERNS_SHARED_CHIRPS_H
#define KOKSMA_PATTERNS_SHARED_CHIRPS_H

#include "patterns/shared/fourier_pow2.h"

typedef struct koksma__chirps {
    size_t length, padded; /* padded: of the convolution; 0: by the definition */
    double *re, *im;       /* exp(-i pi j^2 / length), or exp(-2 pi i j / length) */
    double *filter_re, *filter_im;
} koksma__chirps;

/* The longest transform that f has to provide for `length`; as many pairs of numbers the room below takes. */
size_t koksma__chirps_padded(size_t length);

koksma_status koksma__chirps_init(koksma__chirps *chirps, const koksma__fourier *f, size_t length);
void koksma__chirps_fini(koksma__chirps *chirps);

/* The sums over j of x_j exp(-2 pi i j k / length), x_j at [j stride]; room_re and room_im have `padded` numbers, or
   `length` if that is more. */
void koksma__chirps_transform(const koksma__chirps *chirps, const koksma__fourier *f, size_t stride, double *re,
                              double *im, double *room_re, double *room_im);

#endif
