/* SPDX-License-Identifier: Apache-2.0 */
/* Reads EXR files by the interface for half floats of OpenEXR. */
#ifndef KOKSMA_IMAGE_EXR_RGBA_H
#define KOKSMA_IMAGE_EXR_RGBA_H

#include <koksma/image.h>

/* exr_rgba.c: reads EXR files as half floats: those compressed by DWAA, DWAB, B44 or B44A whose channels are R, G, B
   or Y. wide: the file's numbers are not halves; a number too large for a half is UNSUPPORTED. */
koksma_status koksma__exr_rgba_read(const unsigned char *bytes, size_t size, int channels, bool wide,
                                    koksma_image *out);

#endif
