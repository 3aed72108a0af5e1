/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The power spectrum of an image's error. The eye overlooks error of high frequencies and notices that of low ones.
 * With e = luminance - reference luminance on W x H pixels,
 *
 *     P(u, v) = |sum_xy e(x, y) exp(-2 pi i (u x / W + v y / H))|^2 / (W H),
 *
 * averaged over rings of the frequency f = sqrt((u/W)^2 + (v/H)^2) in cycles a pixel (Ulichney 1988, radially
 * averaged power). White noise has P = its variance at every f. The mean error, P(0, 0), is left out, as are
 * frequencies above 1/2, which only the diagonals have.
 */
#ifndef KOKSMA_STUDY_REPORT_ERROR_SPECTRUM_H
#define KOKSMA_STUDY_REPORT_ERROR_SPECTRUM_H

#include <koksma/image.h>

enum { KOKSMA__SPECTRUM_RINGS = 48 };

/* Ring r has frequencies (r .. r + 1) / (2 n) and P its mean; NaN: it has none. Starts as zeros. */
typedef struct koksma__error_spectrum {
    size_t n, images;
    double power[KOKSMA__SPECTRUM_RINGS]; /* mean over the images so far */
} koksma__error_spectrum;

/* The number of rings that images of this size are seen with: one a frequency of the shorter side. */
size_t koksma__spectrum_rings(int width, int height);

/* Adds an image to the mean. Errors: ARGUMENT (another size than the reference), MEMORY. */
koksma_status koksma__spectrum_add(koksma__error_spectrum *spectrum, const koksma_image *image,
                                   const koksma_image *reference);

#endif
