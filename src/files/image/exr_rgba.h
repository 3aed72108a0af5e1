/* SPDX-License-Identifier: Apache-2.0 */
/* Reads EXR files by the interface for half floats of OpenEXR. */
#ifndef KOKSMA_IMAGE_EXR_RGBA_H
#define KOKSMA_IMAGE_EXR_RGBA_H

#include <koksma/image.h>

/* Reads an EXR file that is compressed by DWAA, DWAB, B44 or B44A and has the channels R, G, B or Y, as half floats.
   wide: whether the file's numbers are not halves; a number that is too large for a half is then the error
   UNSUPPORTED. */
koksma_status koksma__exr_rgba_read(const unsigned char *bytes, size_t size, int channels, bool wide,
                                    koksma_image *out);

#endif
