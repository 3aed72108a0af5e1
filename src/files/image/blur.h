/* SPDX-License-Identifier: Apache-2.0 */
/* Gaussian blur of numbers on the pixels of an image. */
#ifndef KOKSMA_IMAGE_BLUR_H
#define KOKSMA_IMAGE_BLUR_H

#include <koksma/image.h>

enum { KOKSMA__MOST_BLUR = 100 };

/* Convolves width x height numbers with a Gaussian of standard deviation sd, in pixels, 0 to KOKSMA__MOST_BLUR (0: changes
   nothing), whose weights are normalised at the edges. Errors: MEMORY. */
koksma_status koksma__blur(int width, int height, double sd, double *values);

#endif
