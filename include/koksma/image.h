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

/* Whether a file of the path's ending holds several layers. */
KOKSMA_API bool koksma_image_has_layers(const char *path);

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

/* ---- Coherence: whether the error is noise, or bands and patterns -------------------------------------------- */

/* How far the error of images stands out of noise at one frequency. With e = luminance - reference luminance on
   W x H pixels, its mean taken off,

       P(u, v) = |sum_xy e(x, y) exp(-2 pi i (u x / W + v y / H))|^2 / mean of the same over all (u, v) but (0, 0);

   the coherence is the largest P, averaged over the images that were added. Errors that are independent from pixel
   to pixel have an expected P of 1 everywhere, whatever their distribution and however their size varies over the
   image. A wave of amplitude A among noise of standard deviation s has P = 1 + W H A^2 / (4 s^2). Where rings of
   finer detail have more power than the mean (blue noise), P is divided by theirs: docs/findings/coherence.md. The
   values of equal images in equal order have equal bits; the struct is used by one thread at a time. */
typedef struct koksma_coherence {
    int width, height;
    size_t images;   /* added, but those whose error is the same in every pixel */
    double *error;   /* [y * width + x]: the sum of the errors, each divided by its standard deviation */
    double *power;   /* [v * (width / 2 + 1) + u]: the mean of P */
    double *squares; /* likewise of P^2 */
} koksma_coherence;

typedef struct koksma_coherence_values {
    size_t images;      /* of which this is said; 0: there is no coherence, all that follows is NaN */
    double coherence;   /* the peak of P */
    double low, high;   /* 95 % interval of the mean of P over images at the peak's frequency, by Student's t;
                           NaN of one image */
    double frequency_x; /* where the peak is, in cycles a pixel: 0 .. 1/2 */
    double frequency_y; /* -1/2 .. 1/2; up in the image where it is as positive as frequency_x */
    double common;      /* the share of the squared error that all images have in common, 0 .. 1: that of a
                           pattern without random numbers is 1; NaN of one image */
    double noise_low, noise_high; /* 95 % of white-noise errors, with as much in common, have a coherence in here */
    double p;                     /* the probability that those have at least this coherence */
    bool coherent;                /* p < KOKSMA_COHERENT_P, and the coherence is at least KOKSMA_COHERENT_LEAST */
} koksma_coherence_values;

/* When an error is called coherent. So many images find peaks that nobody sees: hence the second condition. */
#define KOKSMA_COHERENT_P 0.005
#define KOKSMA_COHERENT_LEAST 2.0

/* For images of that size. Takes 16 bytes a pixel. Errors: ARGUMENT (no such size), MEMORY. */
KOKSMA_API koksma_status koksma_coherence_init(koksma_coherence *coherence, int width, int height);

/* Frees what init allocated; takes a zeroed struct and NULL. */
KOKSMA_API void koksma_coherence_fini(koksma_coherence *coherence);

/* Adds an image and its reference, which may be another for each: O(n log n) for n pixels, of any width and height.
   An image whose error is the same in every pixel has no P and is not counted. Errors: ARGUMENT (another size),
   MALFORMED (a pixel is not a finite number), MEMORY. */
KOKSMA_API koksma_status koksma_coherence_add(koksma_coherence *coherence, const koksma_image *image,
                                              const koksma_image *reference);

/* The coherence of the images so far. Images of fewer than 2 frequencies (1 x 3 pixels and less) have none. */
KOKSMA_API void koksma_coherence_find(const koksma_coherence *coherence, koksma_coherence_values *out);

#ifdef __cplusplus
}
#endif

#endif
