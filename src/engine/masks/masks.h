/* SPDX-License-Identifier: Apache-2.0 */
/* Masks optimised for a filter. Each section is the interface of the file of its name. */
#ifndef KOKSMA_MASKS_MASKS_H
#define KOKSMA_MASKS_MASKS_H

#include <koksma/mask.h>

#include <stddef.h>
#include <stdint.h>

#include "core/visibility.h"

/* ---- Mask values ----------------------------------------------------------------------------------------- */

enum { KOKSMA__MASK_DIM = 4 };

/* The values of a mask in an order in which neighbours are close, and which pixel has which. */
typedef struct koksma__mask_values {
    size_t n;
    int dim;         /* coordinates of a value for the search: 1 for all spaces of one number */
    float *search;   /* n * dim: coordinate k of value i is search[i * dim + k] */
    float *numbers;  /* n * space->dim: the numbers of value i that the mask's file has */
    uint32_t *value; /* n: the value of each pixel */
} koksma__mask_values;

/* Makes the values of the options in random order, or takes those of options->from in their order. koksma__mask_values_fini
   releases them, also after an error. Errors: ARGUMENT (a number of `from` outside the space), MEMORY, INTERRUPTED. */
koksma_status koksma__mask_values_init(const koksma_mask_options *options, const koksma_run *run,
                                       koksma__mask_values *out);
void koksma__mask_values_fini(koksma__mask_values *values);

/* Checks the size and space of a mask and, if they are not NULL, its numbers. *space: NULL becomes scalar. */
KOKSMA__LAB koksma_status koksma__mask_check(int width, int height, const koksma_mask_space **space,
                                             const float *numbers);

/* ---- Mask window ----------------------------------------------------------------------------------------- */

/* The autocorrelation A of a filter at the offsets -before .. after along each axis: weights[(dy + before[1]) * columns +
   dx + before[0]]. On the torus A is summed over periodic images, so that each pixel occurs at most once. */
typedef struct koksma__mask_window {
    int before[2], after[2];
    size_t columns, rows;
    double *weights;
} koksma__mask_window;

/* Makes the window of a checked filter. Rows and columns at its edge are left out while all their weights are below
   `least` times A(0). The caller frees out->weights. Errors: MEMORY. */
koksma_status koksma__mask_window_init(const koksma_mask_options *options, double least, koksma__mask_window *out);

/* Computes the mean distance h of each value from all values. Of vectors, 2^28 pairs are evaluated at most: the mean is
   then over every m-th value. Errors: INTERRUPTED. */
koksma_status koksma__mask_distances(const koksma__mask_values *values, const koksma_run *run, double *h);

/* Computes the error of koksma_mask_optimise (koksma/mask.h) by its definition. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__mask_energy(const koksma_mask_options *options, const koksma__mask_values *values,
                                  const double *h, const koksma_run *run, double *error);

#endif
