/* SPDX-License-Identifier: Apache-2.0 */
/* How an image looks beside the reference that it is compared with. */
#ifndef KOKSMA_IMAGE_DOUBT_H
#define KOKSMA_IMAGE_DOUBT_H

#include <koksma/image.h>

/* As the reference with noise; or, the first that holds: equal in all pixels; with black parts that are not black in the
   reference, as after an interruption, or the reverse; like it but for a factor; different by more than noise (what noise
   leaves of the mean square difference is above half of the reference's variance); with red and blue exchanged; with less
   noise; beside a reference with a fifth or more of the noise of both; without its colours. */
typedef enum koksma__likeness {
    KOKSMA__LIKE_NOISE,
    KOKSMA__LIKE_ITSELF,
    KOKSMA__LIKE_CUT,
    KOKSMA__LIKE_WHOLE,
    KOKSMA__LIKE_SCALED,
    KOKSMA__LIKE_ANOTHER,
    KOKSMA__LIKE_REVERSED,
    KOKSMA__LIKE_SMOOTHER,
    KOKSMA__LIKE_NOISY,
    KOKSMA__LIKE_GREY,
} koksma__likeness;

/* Of images of equal size. order: look for less noise, too. number: CUT and WHOLE: of the pixels that are black in one of
   them; NOISY: by how many % an RMS error is too large; else the mean of the image over that of the reference. */
koksma__likeness koksma__image_likeness(const koksma_image *image, const koksma_image *reference, bool order,
                                        double *number);

#endif
