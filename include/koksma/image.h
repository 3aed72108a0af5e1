/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Images of linear light in floats: read, write, and compare them. Part of libkoksma-lab.
 * Formats: OpenEXR, PNG and PFM. EXR and PFM keep every float exactly.
 */
#ifndef KOKSMA_IMAGE_H
#define KOKSMA_IMAGE_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { KOKSMA_MAX_IMAGE_SIDE = 65536 };

/* The most pixels of one image: 2^28, or 2^24 on machines with 32-bit sizes. */
#define KOKSMA_MAX_PIXELS KOKSMA_MAX_COORDINATES

/* An image of linear light. channels is 1 (luminance) or 3 (red, green, blue; Rec. 709). Row 0 is the top row; pixel
   (x, y) starts at pixels[(y * width + x) * channels]. */
typedef struct koksma_image {
    int width, height, channels;
    float *pixels;
} koksma_image;

/* Allocates an image of zeros.
     image          out; its old content is overwritten, not freed
     width, height  1 to KOKSMA_MAX_IMAGE_SIDE, at most KOKSMA_MAX_PIXELS together
     channels       1 or 3
   Errors: ARGUMENT, MEMORY. */
KOKSMA_API koksma_status koksma_image_init(koksma_image *image, int width, int height, int channels);

/* Frees the pixels and zeroes the struct. image may be NULL, or zeroed. */
KOKSMA_API void koksma_image_fini(koksma_image *image);

/* Reads an image; recognises the format by the file's content; allocates out.
     EXR   the first part; scan lines or tiles; channels R, G and B, or Y, or a single channel. Files with compression
           B44, B44A, DWAA or DWAB are read with half precision, and a single channel must be called Y
     PNG   1 to 16 bits, sRGB; the chunk gAMA sets another power (1.0: linear) unless sRGB or iCCP is present
     PFM   Pf and PF in either byte order; the magnitude of the scale is ignored; extra bytes at the end are an error
   Alpha and further channels are dropped; colours are not multiplied by alpha.
   Errors: MISSING, MALFORMED (also a kind that is not read: a deep or subsampled EXR; with B44 and DWA other channels
   and values above 65504), UNSUPPORTED (a format that this build lacks), MEMORY, SYSTEM. */
KOKSMA_API koksma_status koksma_image_read(const char *path, koksma_image *out);

/* Returns the name of image format i, NULL past the end.
     left_out  receives the name of the library that the format needs and this build lacks; NULL: none is missing */
KOKSMA_API const char *koksma_image_format(size_t i, const char **left_out);

/* Checks whether an image could be written to this path, by its ending; touches no file.
   Errors: ARGUMENT (unknown ending), UNSUPPORTED (this build lacks the library). */
KOKSMA_API koksma_status koksma_image_check_path(const char *path);

/* Checks whether files with this path's ending can hold several layers. */
KOKSMA_API bool koksma_image_has_layers(const char *path);

/* Writes an image, completely or not at all.
     path      ends in .exr, .png (values are clamped to [0,1] and encoded as sRGB with 8 bits) or .pfm
     metadata  text that is stored in formats that can hold it; may be NULL
   Errors: ARGUMENT (the ending; an image without pixels, or with sides or channels that koksma_image_init does not
   accept), UNSUPPORTED (this build lacks the format), IO, MEMORY. */
KOKSMA_API koksma_status koksma_image_write(const char *path, const koksma_image *image, const char *metadata);

/* One of several images of equal size in one file. The name of the first layer is "". */
typedef struct koksma_layer {
    const char *name; /* up to 63 characters */
    const koksma_image *image;
} koksma_layer;

/* Writes n layers: all of them to an EXR, the first to other formats. An EXR's channels are called R, G and B, or Y,
   after the layer's name and a dot ("normal.R"); a named layer of one channel has its own name ("depth").
   Errors: those of koksma_image_write; ARGUMENT also for no layers, different sizes, a name that is too long, and two
   channels of one name. */
KOKSMA_API koksma_status koksma_image_write_layers(const char *path, const koksma_layer *layers, size_t n,
                                                   const char *metadata);

/* Encodes an image as an 8-bit sRGB PNG file in memory.
     bytes, size  receive the file; the caller frees *bytes with free()
   Errors: ARGUMENT (as for koksma_image_write), UNSUPPORTED (this build lacks libpng), MEMORY. */
KOKSMA_API koksma_status koksma_image_png_bytes(const koksma_image *image, unsigned char **bytes, size_t *size);

/* Statistics over all pixels of the error e = luminance - luminance of the reference (Rec. 709 luminance). */
typedef struct koksma_image_error {
    double mean; /* mean of |e| */
    double sd;   /* standard deviation of |e| over the pixels */
    double max;  /* largest |e| */
    double rmse; /* root of the mean of e^2 */
} koksma_image_error;

/* Checks that all pixels are finite numbers.
     name  what the message calls the image, such as its path
   Errors: MALFORMED (the message names the first pixel that is not finite). */
KOKSMA_API koksma_status koksma_image_check_finite(const koksma_image *image, const char *name);

/* Compares the luminance of an image with that of a reference of equal size; either may have 1 or 3 channels.
   Errors: ARGUMENT (the sizes differ). */
KOKSMA_API koksma_status koksma_image_compare(const koksma_image *image, const koksma_image *reference,
                                              koksma_image_error *out);

/* Makes the one-channel image of |e|, the absolute difference of the luminances; allocates out.
   Errors: ARGUMENT (the sizes differ), MEMORY. */
KOKSMA_API koksma_status koksma_image_difference(const koksma_image *image, const koksma_image *reference,
                                                 koksma_image *out);

/* ---- Metrics of the error ------------------------------------------------------------------------------------ */

/* What a metric compares: width x height pixels of metric->channels values each, row by row from the top. */
typedef struct koksma_metric_input {
    const double *params; /* in the order of the metric's table */
    int width, height;
    const double *image, *reference;
} koksma_metric_input;

/* A metric of the error of images: each pixel has an error of at least 0; the value is the mean of them, or its root. */
typedef struct koksma_metric {
    const char *name, *title;
    const char *cite;           /* a key of docs/references.bib */
    const koksma_param *params; /* NULL: none */
    int channels;               /* 1: of the luminance (Rec. 709); 3: of linear red, green and blue */
    bool root;                  /* the value is the root of the mean */
    /* errors  receives width x height numbers. Errors: MEMORY. */
    koksma_status (*errors)(const koksma_metric_input *input, double *errors);
} koksma_metric;

/* Returns metric i of the table, NULL past the end; the metric of a name, NULL if unknown. */
KOKSMA_API const koksma_metric *koksma_metric_at(size_t i);
KOKSMA_API const koksma_metric *koksma_metric_find(const char *name);

/* A metric with its parameters. Plain data; copy it freely. */
typedef struct koksma_metric_spec {
    const koksma_metric *metric;
    double params[KOKSMA_MAX_PARAMS];
} koksma_metric_spec;

/* Parses a spec of a metric, such as "relmse" or "ldr-flip:ppd=40".
   Errors: ARGUMENT (a parameter), UNKNOWN (the name). */
KOKSMA_API koksma_status koksma_metric_parse(const char *text, koksma_metric_spec *spec);

/* Writes the canonical text of a spec, without parameters at their defaults.
     text  KOKSMA_MAX_SPEC characters; empty if the spec has no metric */
KOKSMA_API void koksma_metric_text(const koksma_metric_spec *spec, char *text);

typedef struct koksma_metric_value {
    double value;
    double robust;    /* the value without the `top` pixels of largest error */
    double top_share; /* the share of the sum of all pixels' errors that these carry, 0 .. 1 */
    size_t top;       /* 0.1 % of the pixels, rounded down */
} koksma_metric_value;

/* From this top_share on, few pixels carry most of the error. */
#define KOKSMA_FEW_PIXELS 0.5

/* Evaluates a metric; image and reference have equal sizes, and 1 or 3 channels each. Values outside a metric's
   range (negative light in FLIP) are clamped as its definition says.
   Errors: ARGUMENT (the sizes differ, a spec without a metric), MEMORY. */
KOKSMA_API koksma_status koksma_metric_evaluate(const koksma_metric_spec *spec, const koksma_image *image,
                                                const koksma_image *reference, koksma_metric_value *out);

/* ---- Coherence: whether the error is noise, or bands and patterns -------------------------------------------- */

/* Whether the errors of images are noise, or have a regular pattern: how far the largest peak of their power spectrum
   stands above white noise. With e = luminance - luminance of the reference on W x H pixels, minus its mean,

       P(u, v) = |sum_xy e(x, y) exp(-2 pi i (u x / W + v y / H))|^2 / mean of the same over all (u, v) but (0, 0);

   the coherence is the largest P, where P is averaged over the images that were added. Errors that are independent
   between pixels have an expected P of 1 at every frequency, for any distribution, also one that varies over the
   image. A wave of amplitude A among noise of standard deviation s has P = 1 + W H A^2 / (4 s^2). Where rings of
   finer detail have more power than the mean (blue noise), P is divided by theirs: docs/findings/coherence.md.
   Equal images in equal order give equal bits. One thread at a time may use the struct. */
typedef struct koksma_coherence {
    int width, height;
    size_t images;   /* added, without those whose error is the same in every pixel */
    double *error;   /* [y * width + x]: the sum of the errors, each divided by its standard deviation */
    double *power;   /* [v * (width / 2 + 1) + u]: the mean of P */
    double *squares; /* likewise of P^2 */
} koksma_coherence;

typedef struct koksma_coherence_values {
    size_t images;      /* images that count; 0: there is no coherence, and the numbers below are NaN */
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

/* An error is called coherent if it passes both limits. The second one excludes peaks that are significant over many
   images but invisible in each. */
#define KOKSMA_COHERENT_P 0.005
#define KOKSMA_COHERENT_LEAST 2.0

/* Allocates an accumulator for images of width x height pixels, 16 bytes a pixel. Errors: ARGUMENT (a side that
   koksma_image_init does not accept), MEMORY. */
KOKSMA_API koksma_status koksma_coherence_init(koksma_coherence *coherence, int width, int height);

/* Frees the arrays and zeroes the struct. coherence may be NULL, or zeroed. */
KOKSMA_API void koksma_coherence_fini(koksma_coherence *coherence);

/* Adds the error of an image against its reference; each image may have its own reference. O(n log n) for n pixels,
   of any width and height. An image whose error is the same in every pixel has no P and is not counted.
   Errors: ARGUMENT (another size),
   MALFORMED (a pixel is not a finite number), MEMORY. */
KOKSMA_API koksma_status koksma_coherence_add(koksma_coherence *coherence, const koksma_image *image,
                                              const koksma_image *reference);

/* Computes the coherence of the images added so far. Images with fewer than two frequencies (up to 1 x 3 pixels) have
   none: out->images is 0. */
KOKSMA_API void koksma_coherence_find(const koksma_coherence *coherence, koksma_coherence_values *out);

#ifdef __cplusplus
}
#endif

#endif
