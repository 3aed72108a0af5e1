/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Adaptive sampling renders an image in rounds. In each round the samples of the selected pixels are drawn, traced
 * and added. Each selected pixel then demands more samples or is done, judging by its own values. adaptive_choose.c
 * selects the pixels of the next round: all that demand samples or, under a budget, those with the highest scores.
 * The result is a function of pixel and round and does not depend on the threads.
 */
#ifndef KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_H
#define KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_H

#include <koksma/adaptive.h>

#include "render/frame.h"

/* The demand of a pixel for more samples. */
typedef struct koksma__sample_demand {
    uint32_t now;   /* samples in the next round; 0: the pixel is done */
    uint32_t later; /* number of samples that the last round will need because of these samples */
    float score;    /* priority of the pixel; under a budget the highest scores are selected first */
    bool selected;  /* whether the next round draws samples of this pixel */
} koksma__sample_demand;

typedef struct koksma__adaptive koksma__adaptive;

/* An adaptive method. Any thread may call the functions that take a pixel, but only one thread at a time for each
   pixel. */
typedef struct koksma__adaptive_method {
    bool fresh; /* whether sets are drawn independently, even from patterns that could be continued */
    bool pilot; /* whether the samples of the first sets only determine the demands and are not averaged */
    /* Allocates the state and sets the demands of the first round, which selects all pixels. */
    koksma_status (*open)(koksma__adaptive *run);
    void (*close)(koksma__adaptive *run);
    /* NULL, or prepares a selected pixel before its samples are drawn. Errors: MEMORY. */
    koksma_status (*prepare)(koksma__adaptive *run, size_t pixel);
    /* Draws the pairs of a pixel's samples in this round. */
    koksma_status (*draw)(const koksma__adaptive *run, size_t pixel, uint32_t use, const float offset[2],
                          koksma__sample_scratch *room, float *pairs);
    /* Receives the values of the samples that the pixel demanded, and the filter weights of these samples
       (filters.h; NULL: all 1). Methods decide by the unweighted values; the result uses the weights as film.c
       describes. */
    void (*take)(koksma__adaptive *run, size_t pixel, const float *rgb, const float *weights);
    /* Determines the next demand of the pixel; *demand is zero before the call, and scratch has run->scratch
       bytes. */
    void (*decide)(koksma__adaptive *run, size_t pixel, void *scratch, koksma__sample_demand *demand);
    /* NULL, or a function that is called between rounds and may examine the whole image and change demands */
    void (*plan)(koksma__adaptive *run);
    /* NULL, or a function that is called when no pixel is selected any more and sets demands for one last round */
    void (*last)(koksma__adaptive *run);
    /* NULL, or returns the number of probes for the splits of a selected pixel; in a round of probes, draw and
       take process the probes. */
    size_t (*probes)(const koksma__adaptive *run, size_t pixel);
    /* computes the value of a pixel and returns its variance */
    double (*result)(const koksma__adaptive *run, size_t pixel, double rgb[3]);
    /* NULL, or describes the strata of a pixel for a figure. Errors: MEMORY. */
    koksma_status (*show)(const koksma__adaptive *run, size_t pixel, koksma_strata *out);
} koksma__adaptive_method;

struct koksma__adaptive {
    const koksma__frame *frame;
    const koksma_adaptive_options *options;
    const koksma__adaptive_method *method;
    size_t pixels, scratch;
    uint64_t budget, spent; /* numbers of samples; a budget of UINT64_MAX means no budget */
    koksma__sampler base;   /* the sampler that draws sets of the pattern */
    koksma__sample_demand *demands;
    uint32_t *taken; /* number of samples of each pixel so far */
    bool probing;    /* this round draws only probes */
    void *state;     /* state of the method: koksma__pixel_sets of every pixel, or koksma__strata */
    void *extra;     /* further memory of the method, freed by the engine; NULL: none */
    koksma_adaptive_report report;
};

/* Selects the pixels of the next round and sets *selected to their number. Errors: MEMORY. */
koksma_status koksma__adaptive_choose(koksma__adaptive *run, size_t *selected);

/* ---- Methods whose samples are sets of the pattern ------------------------------------------------------- */

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
    double sum_y, sum_yy;   /* sums of the samples' luminances and of the squares of these */
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

koksma_status koksma__sets_open(koksma__adaptive *run);
void koksma__sets_close(koksma__adaptive *run);
koksma_status koksma__sets_draw(const koksma__adaptive *run, size_t pixel, uint32_t use, const float offset[2],
                                koksma__sample_scratch *room, float *pairs);
void koksma__sets_take(koksma__adaptive *run, size_t pixel, const float *rgb, const float *weights);
double koksma__sets_result(const koksma__adaptive *run, size_t pixel, double rgb[3]);

koksma__pixel_sets *koksma__sets_of(const koksma__adaptive *run, size_t pixel);
size_t koksma__set_size(const koksma__adaptive *run);

/* Sets *demand to `sets` more sets, or to as many as the pixel may still take. */
void koksma__sets_demand(const koksma__adaptive *run, size_t pixel, double sets, double score,
                         koksma__sample_demand *demand);

/* Return the mean luminance of the samples, and the variance of one sample's luminance, computed as if the samples
   were independent. */
double koksma__sets_mean(const koksma__adaptive *run, const koksma__pixel_sets *p);
double koksma__sets_variance(const koksma__adaptive *run, const koksma__pixel_sets *p);

/* Returns the standard error of the mean luminance, estimated from the variance between the means of the sets. */
double koksma__sets_standard_error(const koksma__adaptive *run, const koksma__pixel_sets *p);

#define ADAPTIVE(name) extern const koksma_adaptive koksma__adaptive_##name;
#include "render/samples/adaptive/adaptive.def"
#undef ADAPTIVE

#endif
