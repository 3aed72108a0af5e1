/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Images of linear light in floats: reading, writing, and how far one is from another.
 * Files: OpenEXR, PNG and PFM, as koksma_image_read says. What is written as EXR or PFM keeps every float exactly.
 */
#ifndef KOKSMA_IMAGE_H
#define KOKSMA_IMAGE_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { KOKSMA_MAX_IMAGE_SIDE = 65536 };

/* The most pixels one image may have; as for points, fewer where a size has 32 bits. */
#define KOKSMA_MAX_PIXELS KOKSMA_MAX_COORDINATES

/* channels is 1 (luminance) or 3 (red, green and blue of Rec. 709); linear. Row 0 is on top; pixel (x, y) starts at
   pixels[(y * width + x) * channels]. */
typedef struct koksma_image {
    int width, height, channels;
    float *pixels;
} koksma_image;

/* An image of zeros. Errors: ARGUMENT, MEMORY. */
KOKSMA_API koksma_status koksma_image_init(koksma_image *image, int width, int height, int channels);

/* Frees what init or read allocated; takes a zeroed struct and NULL. */
KOKSMA_API void koksma_image_fini(koksma_image *image);

/* Reads EXR, PNG or PFM, known by their content. Transparency and further channels are dropped: a pixel's colour is
   what it has, not what is seen of it over black.
   EXR: the first part, in scan lines or tiles; channels R, G and B, or Y, or the only one. Files compressed by B44(A)
   or DWA(A, B) come as half floats; an only channel must be Y there. PNG: 1 to 16 bits of sRGB; of another power
   where a chunk gAMA says so (1.0: linear) and no sRGB or iCCP overrides it. PFM: Pf and PF, of either byte order;
   the scale's size is not applied; bytes too many are an error. Errors: MISSING, MALFORMED, UNSUPPORTED (a deep or
   subsampled EXR; of B44 and DWA also other channels, and numbers above 65504), MEMORY. */
KOKSMA_API koksma_status koksma_image_read(const char *path, koksma_image *out);

/* The i-th image format's name, NULL past the end; *left_out is the library that it needs and this build does
   without, or NULL. */
KOKSMA_API const char *koksma_image_format(size_t i, const char **left_out);

/* Whether the path's ending says a format that can be written. Errors: ARGUMENT, UNSUPPORTED (left out). */
KOKSMA_API koksma_status koksma_image_check_path(const char *path);

/* Writes by the ending of the path: .exr, .png or .pfm; whole or not at all. PNG clamps to [0,1]. metadata (may be
   NULL) is kept as a text where the format has a place for it. Errors: ARGUMENT (the ending; an image that has no
   pixels, or sizes or channels that koksma_image_init refuses), UNSUPPORTED (left out), IO, MEMORY. */
KOKSMA_API koksma_status koksma_image_write(const char *path, const koksma_image *image, const char *metadata);

/* An image among others of its size in one file; the first has the name "". */
typedef struct koksma_layer {
    const char *name; /* to 63 letters */
    const koksma_image *image;
} koksma_layer;

/* The same for n layers: all of them in an EXR, the first in the other formats. The channels of an EXR are called R,
   G and B, or Y, after the layer's name and a dot if it has one; a layer of one channel gives it its own name.
   Errors also: ARGUMENT (no layers, sizes differ, a name is too long, or two channels have one name). */
KOKSMA_API koksma_status koksma_image_write_layers(const char *path, const koksma_layer *layers, size_t n,
                                                   const char *metadata);

/* The image as an 8-bit sRGB PNG file in memory; the caller frees *bytes. Errors: ARGUMENT (as for write),
   UNSUPPORTED (left out), MEMORY. */
KOKSMA_API koksma_status koksma_image_png_bytes(const koksma_image *image, unsigned char **bytes, size_t *size);

/* The error e = luminance - reference luminance over the pixels (luminance is Rec. 709's). */
typedef struct koksma_image_error {
    double mean; /* mean of |e| */
    double sd;   /* standard deviation of |e| over the pixels */
    double max;  /* largest |e| */
    double rmse; /* root of the mean of e^2 */
} koksma_image_error;

/* Whether all pixels are finite numbers: one that is not would make the error of the whole image none. Errors:
   MALFORMED, which names the first after `name`, the file's or another. */
KOKSMA_API koksma_status koksma_image_check_finite(const koksma_image *image, const char *name);

/* Errors: ARGUMENT (the sizes differ). */
KOKSMA_API koksma_status koksma_image_compare(const koksma_image *image, const koksma_image *reference,
                                              koksma_image_error *out);

/* A one-channel picture of |e|; allocates out. Errors: ARGUMENT, MEMORY. */
KOKSMA_API koksma_status koksma_image_difference(const koksma_image *image, const koksma_image *reference,
                                                 koksma_image *out);

#ifdef __cplusplus
}
#endif

#endif
