/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The power spectrum of an image's error. The eye overlooks errors of high frequency and notices errors of low
 * frequency. With e = luminance - reference luminance on W x H pixels,
 *
 *     P(u, v) = |sum_xy e(x, y) exp(-2 pi i (u x / W + v y / H))|^2 / (W H),
 *
 * averaged over rings of the frequency f = sqrt((u/W)^2 + (v/H)^2) in cycles a pixel (Ulichney 1988, radially
 * averaged power). For white noise, P equals the variance at every f. The power P(0, 0) of the mean error is left
 * out, and so are frequencies above 1/2, which occur only near the diagonals.
 */
#ifndef KOKSMA_STUDY_REPORT_ERROR_SPECTRUM_H
#define KOKSMA_STUDY_REPORT_ERROR_SPECTRUM_H

#include <koksma/image.h>

enum { KOKSMA__SPECTRUM_RINGS = 48 };

/* Ring r holds the frequencies from r / (2 n) to (r + 1) / (2 n), and power[r] is the mean of P over them; NaN: the
   ring holds no frequency. A spectrum is all zero at first. */
typedef struct koksma__error_spectrum {
    size_t n, images;
    double power[KOKSMA__SPECTRUM_RINGS]; /* mean over the images so far */
} koksma__error_spectrum;

/* The number of rings for images of this size: one per frequency of the shorter side, at most
   KOKSMA__SPECTRUM_RINGS. */
size_t koksma__spectrum_rings(int width, int height);

/* Adds the spectrum of an image's error to the mean. Errors: ARGUMENT (image and reference differ in size),
   MEMORY. */
koksma_status koksma__spectrum_add(koksma__error_spectrum *spectrum, const koksma_image *image,
                                   const koksma_image *reference);

#endif
