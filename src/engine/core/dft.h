/* SPDX-License-Identifier: Apache-2.0 */
/* Discrete Fourier transforms of one sequence: either of any length with the result in order, or of a power of two
   with the result in permuted order, which is enough for convolutions. */
#ifndef KOKSMA_CORE_DFT_H
#define KOKSMA_CORE_DFT_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Twiddle factors: cos and sin of 2 pi p / 4q at index q + p, p < q, for each power of two q. */
typedef struct koksma__fourier {
    double *cosines, *sines;
} koksma__fourier;

/* Makes tables for lengths that are powers of two up to `longest`, which is a power of two. */
KOKSMA__LAB koksma_status koksma__fourier_init(koksma__fourier *f, size_t longest);
KOKSMA__LAB void koksma__fourier_fini(koksma__fourier *f);

/* forward: the sums over j of x_j exp(-2 pi i j k / n), n a power of two, in a permuted order that
   koksma__fourier_back undoes. back: n times the inverse of forward. */
void koksma__fourier_forward(const koksma__fourier *f, size_t n, double *re, double *im);
void koksma__fourier_back(const koksma__fourier *f, size_t n, double *re, double *im);

typedef struct koksma__dft {
    size_t length, padded; /* padded: the length of the convolution; 0: the sums are computed by the definition */
    double *re, *im;       /* table of exp(-i pi j^2 / length) for convolutions, or of exp(-2 pi i j / length) */
    double *filter_re, *filter_im;
} koksma__dft;

/* Returns the power of two up to which f must have tables for `length`, or 0 if no tables are needed. */
KOKSMA__LAB size_t koksma__dft_padded(size_t length);

/* Prepares transforms of `length` numbers, which use the tables f; koksma__dft_fini releases the memory of *dft.
   Errors: MEMORY. */
KOKSMA__LAB koksma_status koksma__dft_init(koksma__dft *dft, const koksma__fourier *f, size_t length);
KOKSMA__LAB void koksma__dft_fini(koksma__dft *dft);

/* Computes the sums over j of x_j exp(-2 pi i j k / length), where x_j is at index j * stride; scratch_re and
   scratch_im have `padded` numbers, or `length` if that is more. */
KOKSMA__LAB void koksma__dft_transform(const koksma__dft *dft, const koksma__fourier *f, size_t stride, double *re,
                                       double *im, double *scratch_re, double *scratch_im);

#endif
