/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_RENDER_TEXTURE_H
#define KOKSMA_RENDER_TEXTURE_H

#include <koksma/image.h>

/* An image over the plane, repeated or ending at its edges: (0, 0) is the lower left corner of its lower left pixel,
   (1, 1) the upper right corner; bilinear between the middles of pixels. rgb: within [0, 1]. */
void koksma__texture(const koksma_image *image, float u, float v, bool repeated, float rgb[3]);

#endif
