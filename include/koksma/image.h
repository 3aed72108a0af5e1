/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Read, write and compare images of linear light, stored as floats. Part of libkoksma-lab. Formats: OpenEXR, PNG, PFM
 * and JPEG. EXR and PFM keep every float exactly.
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
     width, height  1 to KOKSMA_MAX_IMAGE_SIDE, width * height at most KOKSMA_MAX_PIXELS
     channels       1 or 3
   Errors: ARGUMENT, MEMORY. */
KOKSMA_API koksma_status koksma_image_init(koksma_image *image, int width, int height, int channels);

/* Frees the pixels and zeroes the struct. image may be NULL, or zeroed. */
KOKSMA_API void koksma_image_fini(koksma_image *image);

/* Reads an image; recognises the format by the file's content; allocates out.
     EXR   the first part of the file; scan lines or tiles; channels R, G and B, or Y, or a single channel. Files
           with compression B44, B44A, DWAA or DWAB are read with half precision, and if they have a single channel,
           its name must be Y. Colours of other `chromaticities` than Rec. 709's are converted to those, by way of CIE
           XYZ and without adaptation to another white
     PNG   1 to 16 bits, sRGB; if the file has a gAMA chunk but neither sRGB nor iCCP, its power law replaces the
           sRGB curve (1.0: linear)
     PFM   Pf and PF in either byte order; the magnitude of the scale is ignored (koksma_image_remark); extra bytes at
           the end are an error
     JPEG  baseline or progressive, Huffman-coded, grey or colour, sRGB; a colour profile is not applied; a file that
           is cut short, that lacks a scan, in which the decoder sees damaged data, or that has more than 100 scans is an
           error
   Alpha and further channels are dropped; colours are not multiplied by alpha.
   Errors: MISSING, MALFORMED (also for valid files that this function cannot read: deep or subsampled EXR files,
   those of a compression that is newer than the library,
   and files with B44 or DWA compression that have channels other than those above, or values above 65504),
   UNSUPPORTED (this build lacks the format), MEMORY, SYSTEM. */
KOKSMA_API koksma_status koksma_image_read(const char *path, koksma_image *out);

/* Returns what is odd about the image that this thread read last, as one line without the file's name: a PFM file whose
   scale is neither 1 nor -1, which programs understand in different ways. "": nothing. The string is valid until the thread
   reads another image. */
KOKSMA_API const char *koksma_image_remark(void);

/* Returns the name of image format i, or NULL past the last format.
     left_out  receives the name of the library that the format needs and this build lacks, or NULL if the format is
               available */
KOKSMA_API const char *koksma_image_format(size_t i, const char **left_out);

/* Checks by the ending of a path whether koksma_image_write supports the format; touches no file.
   Errors: ARGUMENT (unknown ending), UNSUPPORTED (this build lacks the library). */
KOKSMA_API koksma_status koksma_image_check_path(const char *path);

/* Checks whether files with this path's ending can hold several layers. */
KOKSMA_API bool koksma_image_has_layers(const char *path);

/* Writes an image, completely or not at all.
     path      ends in .exr, .pfm, .png or .jpg (for the last two values are clamped to [0,1] and encoded as sRGB
               with 8 bits; .jpg has quality 100)
     metadata  text to store in the file if its format has room for text; may be NULL
   Errors: ARGUMENT (unknown ending; an image without pixels, or with a size or number of channels that
   koksma_image_init does not accept), UNSUPPORTED (this build lacks the format), IO, MEMORY. */
KOKSMA_API koksma_status koksma_image_write(const char *path, const koksma_image *image, const char *metadata);

/* One layer of a file with several images of equal size. The name of the first layer is "". */
typedef struct koksma_layer {
    const char *name; /* up to 63 characters */
    const koksma_image *image;
} koksma_layer;

/* Writes n layers: an EXR file receives all layers, other formats receive only the first. The name of an EXR
   channel is the layer's name, a dot, and R, G or B ("normal.R"); a named layer with one channel uses the layer's
   name alone ("depth"). The channels of the first layer are R, G and B, or Y.
   Errors: those of koksma_image_write; also ARGUMENT for n = 0, layers of different sizes, a name that is too long,
   two channels with the same name, and more than 4,096 channels. */
KOKSMA_API koksma_status koksma_image_write_layers(const char *path, const koksma_layer *layers, size_t n,
                                                   const char *metadata);

/* Encodes an image as an 8-bit sRGB PNG file in memory.
     bytes, size  receive the file; the caller frees *bytes with free()
   Errors: ARGUMENT (as for koksma_image_write), UNSUPPORTED (this build lacks libpng), MEMORY. */
KOKSMA_API koksma_status koksma_image_png_bytes(const koksma_image *image, unsigned char **bytes, size_t *size);

/* Statistics over all pixels of the error e, the Rec. 709 luminance of the image minus that of the reference. */
typedef struct koksma_image_error {
    double mean; /* mean of |e| */
    double sd;   /* standard deviation of |e| over the pixels */
    double max;  /* largest |e| */
    double rmse; /* root of the mean of e^2 */
} koksma_image_error;

/* Checks that all pixels are finite numbers.
     name  name of the image in the error message, such as its path
   Errors: MALFORMED (the message names the first pixel that is not finite). */
KOKSMA_API koksma_status koksma_image_check_finite(const koksma_image *image, const char *name);

/* Compares the luminance of an image with that of a reference of equal size; either may have 1 or 3 channels.
   Errors: ARGUMENT (the sizes differ). */
KOKSMA_API koksma_status koksma_image_compare(const koksma_image *image, const koksma_image *reference,
                                              koksma_image_error *out);

/* Returns what looks like a mistake in an image beside the reference that it is compared with, as one line without their
   names: equal images, one with black parts where the other has none, a picture that has the reference's light times a
   factor, one of another scene, red and blue exchanged, a reference with a fifth or more of the noise of both, a grey one
   beside colours. "": nothing, or images of different sizes. Of large images about 32,768 pixels are looked at. The string
   is valid until the thread calls this again.
     order  also say that the image has less noise than the reference, as if they were swapped */
KOKSMA_API const char *koksma_image_doubt(const koksma_image *image, const koksma_image *reference, bool order);

/* Makes the one-channel image of |e|, the absolute difference of the luminances; allocates out.
   Errors: ARGUMENT (the sizes differ), MEMORY. */
KOKSMA_API koksma_status koksma_image_difference(const koksma_image *image, const koksma_image *reference,
                                                 koksma_image *out);

/* Convolves each channel with a Gaussian of standard deviation sd, 0 to 100 pixels, whose weights are normalised at the
   edges. Allocates out. Errors: ARGUMENT, MEMORY. */
KOKSMA_API koksma_status koksma_image_blur(const koksma_image *image, double sd, koksma_image *out);

/* ---- Metrics of the error ------------------------------------------------------------------------------------ */

/* The two images that a metric compares: width x height pixels of metric->channels values each, row by row from the
   top. */
typedef struct koksma_metric_input {
    const double *params; /* values of the parameters, in the order of koksma_metric.params */
    int width, height;
    const double *image, *reference;
} koksma_metric_input;

/* A metric of image error. Each pixel has an error >= 0; the value is the mean over the pixels or the square root
   of that mean. */
typedef struct koksma_metric {
    const char *name, *title;
    const char *cite;           /* source of the metric: a key of docs/references.bib */
    const koksma_param *params; /* NULL: none */
    int channels;               /* 1: the metric compares Rec. 709 luminance; 3: it compares linear red, green and
                                   blue */
    bool root;                  /* true: the value is the square root of the mean error */
    int order;                  /* for small differences between the images, the value is proportional to this power
                                   of the differences; 0: to no power */
    int revision;               /* raised with every change of the code that changes any bit of a value; studies store
                                   it with their rows */
    bool in_all_studies;        /* true: cheap beside a render, so that studies evaluate it for every image */
    /* Computes the error of each pixel; `errors` receives width x height numbers. Returns OK or MEMORY. */
    koksma_status (*errors)(const koksma_metric_input *input, double *errors);
    /* Returns how the value of such images differs from what users of the metric expect, or NULL; NULL if it never
       does */
    const char *(*caveat)(const koksma_metric_input *input);
} koksma_metric;

/* Returns metric i of the table, or the metric with this name, or NULL if there is none. */
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

/* Writes the canonical text of a spec; parameters at their defaults are left out.
     text  buffer of KOKSMA_MAX_SPEC characters; receives an empty text if the spec has no metric */
KOKSMA_API void koksma_metric_text(const koksma_metric_spec *spec, char *text);

typedef struct koksma_metric_value {
    double value;
    double robust;      /* the value without the `top` pixels that have the largest error */
    double top_share;   /* fraction, 0 .. 1, of the summed error of all pixels that comes from the `top` pixels */
    size_t top;         /* number of pixels that `robust` leaves out: 0.1 % of all, rounded down; 0 below 1000 */
    const char *caveat; /* what a user must know of the value, in words, such as where an implementation of the
                           metric's authors gives another one; NULL: nothing. Valid as long as the library */
} koksma_metric_value;

/* If top_share is at least this number, a few pixels carry most of the error. */
#define KOKSMA_FEW_PIXELS 0.5

/* Evaluates a metric; image and reference have equal sizes, and 1 or 3 channels each. Pixel values outside the
   range of the metric (such as negative light in FLIP) are clamped as the definition of the metric says.
   Errors: ARGUMENT (the sizes differ, a spec without a metric), MEMORY. */
KOKSMA_API koksma_status koksma_metric_evaluate(const koksma_metric_spec *spec, const koksma_image *image,
                                                const koksma_image *reference, koksma_metric_value *out);

/* ---- Coherence: whether the error is noise, or bands and patterns -------------------------------------------- */

/* Accumulates the error spectra of images to test whether the error is noise or has a regular pattern: the
   coherence is the ratio of the largest peak of the power spectrum to white noise. With e the luminance of a W x H
   image minus that of the reference, less the mean of this difference,

       P(u, v) = |sum_xy e(x, y) exp(-2 pi i (u x / W + v y / H))|^2 / (its mean over (u, v) != (0, 0));

   the coherence is the largest value of P after P is averaged over the images that were added. Errors that are
   independent between pixels have an expected P of 1 at every frequency, for any distribution, even if the
   distribution varies over the image. A wave of amplitude A among noise of standard deviation s has P = 1 + W H A^2 /
   (4 s^2). Blue noise does not count as a regular pattern: where power increases with frequency to above the mean, P
   is divided by its mean over the ring of frequencies with similar |(u, v)| (docs/findings/coherence.md). Equal
   images added in equal order give bit-identical results. One thread at a time may use the struct. */
typedef struct koksma_coherence {
    int width, height;
    size_t images;   /* number of images added, not counting images whose error is the same in every pixel */
    double *error;   /* [y * width + x]: sum over the images of the error divided by its standard deviation */
    double *power;   /* [v * (width / 2 + 1) + u]: mean of P over the images */
    double *squares; /* [v * (width / 2 + 1) + u]: mean of P^2 over the images */
} koksma_coherence;

typedef struct koksma_coherence_values {
    size_t images;      /* number of images used; if it is 0, all other numbers of this struct are NaN */
    double coherence;   /* the peak of P */
    double low, high;   /* 95 % interval (Student's t) of the mean over the images of P at the frequency of the
                           peak, or NaN if there is one image. Of bands, with a P of 8 or more, it holds in 93 to 95 % of
                           simulations; the peak of noise is the largest of many: at 32 x 24 pixels it misses the true mean
                           of 1 in 8 % of cases with 4 images, in 18 % with 8 and in 65 % with 32 */
    double frequency_x; /* horizontal frequency of the peak, 0 .. 1/2 cycles per pixel */
    double frequency_y; /* vertical frequency of the peak, -1/2 .. 1/2 cycles per pixel; positive values point up in
                           the image */
    double common;      /* fraction, 0 .. 1, of the squared error that all images have in common: 1 for a pattern
                           without random numbers, NaN if there is one image */
    double noise_low, noise_high; /* interval that contains the coherence of 95 % of the white-noise errors that have
                                     the same value of `common` */
    double p;                     /* probability that white-noise errors with the same value of `common` have at least
                                     this coherence */
    bool coherent;                /* true if p < KOKSMA_COHERENT_P and the coherence is at least
                                     KOKSMA_COHERENT_LEAST */
} koksma_coherence_values;

/* Limits of koksma_coherence_values.p and .coherence for an error to be called coherent. KOKSMA_COHERENT_LEAST
   excludes peaks that are significant over many images but invisible in each image. */
#define KOKSMA_COHERENT_P 0.005
#define KOKSMA_COHERENT_LEAST 2.0

/* Allocates an accumulator for images of width x height pixels; it takes 16 bytes per pixel. Errors: ARGUMENT (a
   size that koksma_image_init does not accept), MEMORY. */
KOKSMA_API koksma_status koksma_coherence_init(koksma_coherence *coherence, int width, int height);

/* Frees the arrays and zeroes the struct. coherence may be NULL, or zeroed. */
KOKSMA_API void koksma_coherence_fini(koksma_coherence *coherence);

/* Adds the error of an image against its reference; each image may have its own reference. O(n log n) for n pixels,
   for any width and height. An image whose error is the same in every pixel has no power spectrum P and is
   not counted. Errors: ARGUMENT (the size differs from that of the accumulator), MALFORMED (a pixel is not a finite
   number), MEMORY. */
KOKSMA_API koksma_status koksma_coherence_add(koksma_coherence *coherence, const koksma_image *image,
                                              const koksma_image *reference);

/* Computes the coherence of the images added so far. Images with fewer than two frequencies (up to 1 x 3 pixels)
   have no coherence: out->images is then 0. */
KOKSMA_API void koksma_coherence_find(const koksma_coherence *coherence, koksma_coherence_values *out);

#ifdef __cplusplus
}
#endif

#endif
