/* SPDX-License-Identifier: Apache-2.0 */
/* Discrete Fourier transforms of one sequence, for convolutions: in place, and nothing is put in order. */
#ifndef KOKSMA_PATTERNS_SHARED_FOURIER_POW2_H
#define KOKSMA_PATTERNS_SHARED_FOURIER_POW2_H

#include <koksma/koksma.h>

/* cos and sin of 2 pi p / 4q at [q + p], p < q, for each power of two q. */
typedef struct koksma__fourier {
    double *cosines, *sines;
} koksma__fourier;

/* For lengths that are powers of two up to `longest`, itself one. */
koksma_status koksma__fourier_init(koksma__fourier *f, size_t longest);
void koksma__fourier_fini(koksma__fourier *f);

/* The sums over j of x_j exp(-2 pi i j k / n), n a power of two, in an order that only the other function knows; and
   n times its inverse. */
void koksma__fourier_forward(const koksma__fourier *f, size_t n, double *re, double *im);
void koksma__fourier_back(const koksma__fourier *f, size_t n, double *re, double *im);

#endif
