/* SPDX-License-Identifier: Apache-2.0 */
/* Discrete Fourier transforms of one sequence: of a power of two for convolutions, and of any length in order. */
#ifndef KOKSMA_CORE_DFT_H
#define KOKSMA_CORE_DFT_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* cos and sin of 2 pi p / 4q at [q + p], p < q, for each power of two q. */
typedef struct koksma__fourier {
    double *cosines, *sines;
} koksma__fourier;

/* For lengths that are powers of two up to `longest`, itself one. */
KOKSMA__LAB koksma_status koksma__fourier_init(koksma__fourier *f, size_t longest);
KOKSMA__LAB void koksma__fourier_fini(koksma__fourier *f);

/* The sums over j of x_j exp(-2 pi i j k / n), n a power of two, in an order that only the other function knows; and
   n times its inverse. */
void koksma__fourier_forward(const koksma__fourier *f, size_t n, double *re, double *im);
void koksma__fourier_back(const koksma__fourier *f, size_t n, double *re, double *im);

typedef struct koksma__dft {
    size_t length, padded; /* padded: of the convolution; 0: by the definition */
    double *re, *im;       /* exp(-i pi j^2 / length), or exp(-2 pi i j / length) */
    double *filter_re, *filter_im;
} koksma__dft;

/* The power of two, or 0, that f has to provide for `length`; the scratch below has as many numbers. */
KOKSMA__LAB size_t koksma__dft_padded(size_t length);

/* Plans transforms of `length` numbers by the tables f; koksma__dft_fini releases them. Errors: MEMORY. */
KOKSMA__LAB koksma_status koksma__dft_init(koksma__dft *dft, const koksma__fourier *f, size_t length);
KOKSMA__LAB void koksma__dft_fini(koksma__dft *dft);

/* The sums over j of x_j exp(-2 pi i j k / length), x_j at [j stride]; scratch_re and scratch_im have `padded`
   numbers, or `length` if that is more. */
KOKSMA__LAB void koksma__dft_transform(const koksma__dft *dft, const koksma__fourier *f, size_t stride, double *re,
                                       double *im, double *scratch_re, double *scratch_im);

#endif
