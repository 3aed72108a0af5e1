/* SPDX-License-Identifier: Apache-2.0 */
/* Functions for the methods whose samples come in point sets of the pattern (adaptive_sets.c). */
#ifndef KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_SETS_H
#define KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_SETS_H

#include "render/samples/adaptive/adaptive.h"

/* Statistics of the sets of a pixel. `origin`, the luminance of the first sample, is subtracted from all
   luminances, so that equal values have variance 0. */
typedef struct koksma__pixel_sets {
    uint32_t sets;      /* number of sets in the sums */
    uint32_t drawn;     /* number of sets that were drawn */
    float lo[3], hi[3]; /* minimum and maximum of the samples in each channel */
    float origin;
    double sum[3];  /* weighted sum of the samples in each channel */
    double half[3]; /* unweighted sum over the sets 0, 2, 4, … */
    double all[3];
    double sum_y, sum_yy;   /* sums of the luminances of samples and of their squares */
    double sum_mean_square; /* sum of the squared mean luminances of the sets */
    double sum_w3;          /* sum of the cubed weights */
    double moments[3][3];   /* element [j][k] is the sum over the samples of weight^j luminance^k */
} koksma__pixel_sets;

/* The parameters of every method that draws sets begin with these: first, most and, if there is one, threshold. */
enum { KOKSMA__SETS_FIRST, KOKSMA__SETS_MOST, KOKSMA__SETS_THRESHOLD };
#define KOKSMA__SETS_PARAMS(first, least)                                                                            \
    {"first", "number of point sets in the first round", first, least, 4096, NULL, true},                            \
    {                                                                                                                \
        "most", "largest number of point sets of a pixel", 64, 1, 1 << 16, NULL, true                                \
    }

/* The members of a method that stand for these functions; two-stage has its own `take`. */
#define KOKSMA__SETS_METHOD                                                                                          \
    .close = koksma__sets_close, .draw = koksma__sets_draw, .result = koksma__sets_result, .part = koksma__sets_part

koksma_status koksma__sets_open(koksma__adaptive *run);
void koksma__sets_close(koksma__adaptive *run);
koksma_status koksma__sets_draw(const koksma__adaptive *run, size_t pixel, uint32_t use, const float offset[2],
                                koksma__sample_scratch *room, float *pairs);
void koksma__sets_take(koksma__adaptive *run, size_t pixel, const koksma__sample_values *values);
double koksma__sets_result(const koksma__adaptive *run, size_t pixel, double rgb[3]);
void koksma__sets_part(const koksma__adaptive *run, size_t pixel, size_t a, double rgb[3]);

/* Resets the sums over a pixel's sets; the number of sets that were drawn is kept. */
void koksma__sets_forget(koksma__adaptive *run, size_t pixel);

koksma__pixel_sets *koksma__sets_of(const koksma__adaptive *run, size_t pixel);
size_t koksma__set_size(const koksma__adaptive *run);

/* Sets *demand to `sets` more sets, or to as many as the pixel may still take. */
void koksma__sets_demand(const koksma__adaptive *run, size_t pixel, double sets, double score,
                         koksma__sample_demand *demand);

/* Return the mean luminance of the samples, and the variance of the luminance of a sample as if the samples were
   independent. */
double koksma__sets_mean(const koksma__adaptive *run, const koksma__pixel_sets *p);
double koksma__sets_variance(const koksma__adaptive *run, const koksma__pixel_sets *p);

/* Returns the standard error of the mean luminance, estimated from the variance between the means of the sets. */
double koksma__sets_standard_error(const koksma__adaptive *run, const koksma__pixel_sets *p);

#endif
