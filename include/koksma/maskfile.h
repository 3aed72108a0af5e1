/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Files of masks (koksma/mask.h), and filters by name. Part of libkoksma-lab.
 */
#ifndef KOKSMA_MASKFILE_H
#define KOKSMA_MASKFILE_H

#include <koksma/mask.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Parses the text of a filter and makes its weights, which sum to 1:
     box:size=K           K x K pixels of equal weight, K from 2 to 65
     binomial:size=K      the coefficients of (1 + x)^(K - 1) along each axis
     gaussian:sigma=S     exp(-x^2 / (2 S^2)) along each axis, up to the whole number nearest to 4 S, S from 0.1 to 8
     tent, mitchell ..    a filter of koksma_filter_at (koksma/render.h): its mean over each pixel, for a sample in the
                          middle of a pixel
     file:PATH            a text with a row of numbers a line, separated by blanks or commas; # begins a comment
   Errors: ARGUMENT (a parameter; weights that koksma_mask_filter_check refuses), UNKNOWN (the name), MISSING, MALFORMED. */
KOKSMA_API koksma_status koksma_mask_filter_parse(const char *text, koksma_mask_filter *out);

/* A mask in memory: values as those of koksma_mask_optimise. */
typedef struct koksma_mask {
    int width, height;
    const koksma_mask_space *space; /* not NULL */
    float *values;
} koksma_mask;

/* Frees the values and zeroes the struct. mask may be NULL, or zeroed. */
KOKSMA_API void koksma_mask_fini(koksma_mask *mask);

/* Reads a mask; allocates out. Levels of b bits are read as (k + 1/2) / 2^b and mapped to the range of the space; floats
   are read as they are.
     path   PNG, EXR or PFM, known by their content, or an .npy array of shape (height, width) or (height, width,
            numbers). Of an image all channels are read, but for an alpha that is 1 everywhere, a blue that is 0
            everywhere, and green and blue that equal red everywhere
     space  NULL: that of the recipe beside the file (koksma_mask_recipe_space); without one scalar, vector2, vector3 or
            vector4, by the number of channels
   Errors: MISSING, MALFORMED (also a size that masks do not have, a number outside the space, or another number of
   channels), UNSUPPORTED (this build lacks the format), MEMORY, SYSTEM. */
KOKSMA_API koksma_status koksma_mask_read(const char *path, const koksma_mask_space *space, koksma_mask *out);

/* Checks by the ending of a path whether koksma_mask_write supports it for this space and number of bits; touches no file.
   Errors: ARGUMENT. */
KOKSMA_API koksma_status koksma_mask_check_path(const char *path, const koksma_mask_space *space, int bits);

/* Writes a mask, completely or not at all. A value v of a space with the range [low, high] becomes the level
   floor(2^bits (v - low) / (high - low)), at most 2^bits - 1.
     path  ends in
             .png   levels of 8 or 16 bits (the default) without a transfer function; two numbers as red and green with
                    a blue of 0, four as red, green, blue and alpha
             .exr   floats, one or three numbers; two as red and green with a blue of 0
             .npy   little-endian float32 of shape (height, width) or (height, width, numbers)
             .raw   nothing but levels of 8 (the default) or 16 bits or float32, little-endian, in the order of the
                    values: what texture uploads take
             .h     a table of C: floats, or levels of 8 or 16 bits
     bits  8, 16 or 32 (floats); 0: the default of the ending
   Errors: ARGUMENT, UNSUPPORTED, IO, MEMORY. */
KOKSMA_API koksma_status koksma_mask_write(const char *path, const koksma_mask *mask, int bits);

enum { KOKSMA_MASK_MAX_TEXT = 4200 };

/* Everything that makes a mask again. */
typedef struct koksma_mask_recipe {
    koksma_mask_options options;
    koksma_mask_result result;
    char filter[KOKSMA_MASK_MAX_TEXT]; /* the text of koksma_mask_filter_parse; "": weights without one */
    char from[KOKSMA_MASK_MAX_TEXT];   /* the file of options.from, if the search began with one; "": none */
} koksma_mask_recipe;

/* Frees options.state and zeroes the struct. recipe may be NULL, or zeroed. */
KOKSMA_API void koksma_mask_recipe_fini(koksma_mask_recipe *recipe);

/* Writes a recipe as a JSON text, the filter's weights included; of a search that is not finished also options.state, if it
   is not NULL.
   Errors: ARGUMENT, IO, MEMORY. */
KOKSMA_API koksma_status koksma_mask_write_recipe(const char *path, const koksma_mask_recipe *recipe);

/* Finds the space of a mask's file by its recipe, whose name is that of the file and ".json"; NULL if there is none.
   Errors: MALFORMED (a recipe without a space), MEMORY, SYSTEM. */
KOKSMA_API koksma_status koksma_mask_recipe_space(const char *path, const koksma_mask_space **out);

/* Reads such a text such that out->options continue the search once options.from has the numbers of the mask: options.done
   and first are those of the result, and options.from is NULL. koksma_mask_recipe_fini releases out.
   Errors: MISSING, MALFORMED (also of another revision of the search), MEMORY, SYSTEM. */
KOKSMA_API koksma_status koksma_mask_read_recipe(const char *path, koksma_mask_recipe *out);

/* The power spectrum of a mask on the torus, summed over its numbers.
     power  receives width * height numbers: power[v * width + u] is that at u cycles along the width and v along the
            height, divided by the mean over all frequencies but (0, 0), which is 1 of white noise; 0 at (0, 0)
   Errors: ARGUMENT (numbers outside the space; pixels that are all equal), MEMORY. */
KOKSMA_API koksma_status koksma_mask_power(const koksma_mask *mask, double *power);

/* The correlation of two masks of equal size on the torus; of a mask with itself, its autocorrelation.
     out  receives width * height numbers: out[y * width + x] is the sum over pixels p of (a(p) - mean of a) . (b(p + (x,
          y)) - mean of b), divided by the geometric mean of the sums of |a(p) - mean of a|^2 and |b(p) - mean of b|^2. It
          lies in [-1, 1]; of two masks of white noise with n pixels its standard deviation is n^(-1/2) for scalars
   Errors: ARGUMENT (sizes or numbers a pixel that differ; numbers outside the space; pixels that are all equal), MEMORY. */
KOKSMA_API koksma_status koksma_mask_correlation(const koksma_mask *mask, const koksma_mask *other, double *out);

/* Counts pixels: counts[k * bins + i] have number k within [i, i + 1) / bins of the range of the space, the last with 1.
     bins  1 to 65536
   Errors: ARGUMENT. */
KOKSMA_API koksma_status koksma_mask_histogram(const koksma_mask *mask, int bins, size_t *counts);

/* The radial mean of a mask's power spectrum, summed over its numbers. With P(u, v) the power at u cycles along the width
   and v along the height, ring k of `rings` has the frequencies (k + [0,1)) / (2 rings) of sqrt((u / width)^2 + (v /
   height)^2), cycles a pixel; ring 0 lacks (0, 0).
     power       receives `rings` means, divided by the mean over all frequencies but (0, 0), which is 1 of white noise;
                 NaN for a ring without frequencies
     anisotropy  receives the variance of the power within each ring divided by the square of its mean, in decibels
                 (Ulichney 1988); 0 dB is that of one periodogram of noise without a preferred direction. May be NULL
   Errors: ARGUMENT (rings from 1 to 1024; pixels that are all equal), MEMORY. */
KOKSMA_API koksma_status koksma_mask_rings(const koksma_mask *mask, int rings, double *power, double *anisotropy);

#ifdef __cplusplus
}
#endif

#endif
