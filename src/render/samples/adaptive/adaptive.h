/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Adaptive sampling renders an image in rounds. In each round the samples of the selected pixels are drawn, traced
 * and added. Then each selected pixel either demands more samples or is done, which its method decides from the
 * values of that pixel alone. adaptive_choose.c selects the pixels of the next round: all that demand samples or,
 * under a budget, those with the highest scores. The result is a function of pixel and round and does not depend on
 * the threads.
 */
#ifndef KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_H
#define KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_H

#include <koksma/adaptive.h>

#include "render/frame.h"

/* The demand of a pixel for more samples. */
typedef struct koksma__sample_demand {
    uint32_t now;   /* samples in the next round; 0: the pixel is done */
    uint32_t later; /* number of samples that a later round must take as a result of those of the next round */
    float score;    /* priority of the pixel; under a budget the highest scores are selected first */
    bool selected;  /* whether the next round draws samples of this pixel */
} koksma__sample_demand;

typedef struct koksma__adaptive koksma__adaptive;

/* The values of the samples that a pixel demanded. */
typedef struct koksma__sample_values {
    const float *rgb;
    const float *weights; /* weights of the filter (filters/filters.h); NULL: all are 1 */
    const float *parts;   /* 3 numbers for each AOV of light for each sample; unused without AOVs */
} koksma__sample_values;

/* An adaptive method. Any thread may call the functions that take a pixel, but only one thread at a time for each
   pixel. */
typedef struct koksma__adaptive_method {
    bool fresh; /* whether sets are drawn independently, even if the pattern is a sequence that could be continued */
    bool pilot; /* whether the samples of the first sets only determine the demands and are not averaged */
    /* Allocates the state and sets the demands of the first round, which selects all pixels. */
    koksma_status (*open)(koksma__adaptive *run);
    void (*close)(koksma__adaptive *run);
    /* NULL, or prepares a selected pixel before its samples are drawn. Errors: MEMORY. */
    koksma_status (*prepare)(koksma__adaptive *run, size_t pixel);
    /* Draws the coordinates of one use for the samples of a pixel in this round, and adds the offset to them.
       pairs[2 i] and pairs[2 i + 1] are the two coordinates of sample i. */
    koksma_status (*draw)(const koksma__adaptive *run, size_t pixel, uint32_t use, const float offset[2],
                          koksma__sample_scratch *room, float *pairs);
    /* Receives the values of the samples that the pixel demanded. Methods decide by the unweighted values; the result
       uses the weights as film.c describes. */
    void (*take)(koksma__adaptive *run, size_t pixel, const koksma__sample_values *values);
    /* NULL, or determines the next demand of the pixel; *demand is zero before the call, and scratch has run->scratch
       bytes. */
    void (*decide)(koksma__adaptive *run, size_t pixel, void *scratch, koksma__sample_demand *demand);
    /* NULL, or a function that is called between rounds and may examine the whole image and change demands */
    void (*plan)(koksma__adaptive *run);
    /* NULL, or a function that is called when no pixel is selected any more and sets demands for one last round */
    void (*last)(koksma__adaptive *run);
    /* NULL, or returns the number of probes for the splits of a selected pixel. Probes are extra samples that test
       whether a split was needed; in a round of probes, draw() and take() process probes in place of samples. */
    size_t (*probes)(const koksma__adaptive *run, size_t pixel);
    /* computes the value of a pixel and returns its variance */
    double (*result)(const koksma__adaptive *run, size_t pixel, double rgb[3]);
    /* computes the value of a pixel in AOV `a`, whose kind is not ID; called only if run->frame->aovs is set */
    void (*part)(const koksma__adaptive *run, size_t pixel, size_t a, double rgb[3]);
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
    double *sums;    /* sums for the AOVs in methods that draw sets (koksma__sets_part); NULL: no AOVs */
    koksma_adaptive_report report;
};

#define ADAPTIVE(name) extern const koksma_adaptive koksma__adaptive_##name;
#include "render/samples/adaptive/adaptive.def"
#undef ADAPTIVE

#endif
