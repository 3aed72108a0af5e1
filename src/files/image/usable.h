/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_IMAGE_USABLE_H
#define KOKSMA_IMAGE_USABLE_H

#include "core/status.h"
#include "image/formats.h"
#include "image/image.h"

/* Fails with ARGUMENT unless the image has pixels and valid dimensions. */
static inline koksma_status koksma__image_usable(const koksma_image *image)
{
    return image->pixels ? koksma__image_check_shape(image->width, image->height, image->channels)
                         : koksma__fail(KOKSMA_ARGUMENT, "an image without pixels");
}

/* Fails with ARGUMENT unless both images have pixels and the same width and height. */
static inline koksma_status koksma__image_check_sizes(const koksma_image *a, const koksma_image *b)
{
    KOKSMA__TRY(koksma__image_usable(a));
    KOKSMA__TRY(koksma__image_usable(b));
    KOKSMA__FAIL_IF(a->width != b->width || a->height != b->height, KOKSMA_ARGUMENT,
                    "an image of %d x %d pixels can't be compared with one of %d x %d", a->width, a->height, b->width,
                    b->height);
    return KOKSMA_OK;
}

#endif
