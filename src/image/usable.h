/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_IMAGE_USABLE_H
#define KOKSMA_IMAGE_USABLE_H

#include "core/status.h"
#include "image/formats.h"

/* ARGUMENT unless an image has pixels, and a shape that it may have. */
static inline koksma_status koksma__image_usable(const koksma_image *image)
{
    return image->pixels ? koksma__image_check_shape(image->width, image->height, image->channels)
                         : koksma__fail(KOKSMA_ARGUMENT, "an image without pixels");
}

#endif
