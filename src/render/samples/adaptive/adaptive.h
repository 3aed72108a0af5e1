/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One picture in rounds. In a round the samples of the selected pixels are drawn, traced and added. After it each
 * selected pixel demands more samples or is done, by its own values. adaptive_choose.c then selects the pixels of the
 * next round: all that demand samples, or, under a budget, those with the highest scores. All of it is a function of
 * pixel and round, never of threads.
 */
#ifndef KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_H
#define KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_H

#include <koksma/adaptive.h>

#include "render/frame.h"

/* How many more samples a pixel demands. */
typedef struct koksma__sample_demand {
    uint32_t now;   /* samples in the next round; 0: the pixel is done */
    uint32_t later; /* samples of the last round that these bring about */
    float score;    /* under a budget the highest come first */
    bool selected;  /* for the next round */
} koksma__sample_demand;

typedef struct koksma__adaptive koksma__adaptive;

/* A method. Functions of a pixel are called by any thread, one at a time for each pixel. */
typedef struct koksma__adaptive_method {
    bool fresh; /* sets that are independent of each other, also of patterns that could be continued */
    bool pilot; /* the first sets only decide */
    koksma_status (*open)(
        koksma__adaptive *run); /* also sets the demands of the first round, which selects all pixels */
    void (*close)(koksma__adaptive *run);
    /* NULL, or what is done before the samples of a selected pixel are drawn. Errors: MEMORY. */
    koksma_status (*prepare)(koksma__adaptive *run, size_t pixel);
    /* The pairs of this round's samples of a pixel. */
    koksma_status (*draw)(const koksma__adaptive *run, size_t pixel, uint32_t use, const float offset[2],
                          koksma__sample_scratch *room, float *pairs);
    /* The values of the samples that the pixel demanded, and their weights as drawn from the filter (filters.h; NULL: all 1).
       Methods decide by the values as they are; in the result weights count as film.c says. */
    void (*take)(koksma__adaptive *run, size_t pixel, const float *rgb, const float *weights);
    /* What the pixel demands next; *demand is zero before. scratch has run->scratch bytes. */
    void (*decide)(koksma__adaptive *run, size_t pixel, void *scratch, koksma__sample_demand *demand);
    void (*plan)(koksma__adaptive *run); /* NULL, or between rounds: looks at the whole image, may change demands */
    void (*last)(koksma__adaptive *run); /* NULL, or when no pixel is selected any more: demands of one more round */
    /* NULL, or the number of probes that a selected pixel's splits take; draw and take are then called for those. */
    size_t (*probes)(const koksma__adaptive *run, size_t pixel);
    double (*result)(const koksma__adaptive *run, size_t pixel, double rgb[3]); /* returns the variance */
    /* NULL, or a pixel's strata for a picture. Errors: MEMORY. */
    koksma_status (*show)(const koksma__adaptive *run, size_t pixel, koksma_strata *out);
} koksma__adaptive_method;

struct koksma__adaptive {
    const koksma__frame *frame;
    const koksma_adaptive_options *options;
    const koksma__adaptive_method *method;
    size_t pixels, scratch;
    uint64_t budget, spent; /* samples; budget UINT64_MAX: none */
    koksma__sampler base;   /* draws sets of the pattern */
    koksma__sample_demand *demands;
    uint32_t *taken; /* samples of a pixel so far */
    bool probing;    /* this round is for probes only */
    void *state;     /* the method's: koksma__pixel_sets of every pixel, or koksma__strata */
    void *extra;     /* its own, for malloc; NULL: none */
    koksma_adaptive_report report;
};

/* Selects the pixels of the next round; *selected: how many. Errors: MEMORY. */
koksma_status koksma__adaptive_choose(koksma__adaptive *run, size_t *selected);

/* ---- Methods whose samples are sets of the pattern ------------------------------------------------------- */

/* What is known of a pixel from its sets; luminances are less `origin`, the first one, so that equal values have
   variance 0. */
typedef struct koksma__pixel_sets {
    uint32_t sets;      /* in the sums */
    uint32_t drawn;     /* all that were drawn */
    float lo[3], hi[3]; /* over the samples */
    float origin;
    double sum[3];  /* weighed */
    double half[3]; /* of sets 0, 2, 4, …, not weighed; as `all` */
    double all[3];
    double sum_y, sum_yy;   /* of the samples' luminances */
    double sum_mean_square; /* of the sets' mean luminances, squared */
    double sum_w3;          /* of the cubes of weights */
    double moments[3][3];   /* [j][k]: sums of weight^j luminance^k, sample by sample */
} koksma__pixel_sets;

/* Every such method's parameters begin with these two. */
enum { KOKSMA__SETS_FIRST, KOKSMA__SETS_MOST, KOKSMA__SETS_THRESHOLD };
#define KOKSMA__SETS_PARAMS(first, least)                                                                            \
    {"first", "sets of the pattern at first", first, least, 4096, NULL, true},                                       \
    {                                                                                                                \
        "most", "sets that a pixel gets at most", 64, 1, 1 << 16, NULL, true                                         \
    }

koksma_status koksma__sets_open(koksma__adaptive *run);
void koksma__sets_close(koksma__adaptive *run);
koksma_status koksma__sets_draw(const koksma__adaptive *run, size_t pixel, uint32_t use, const float offset[2],
                                koksma__sample_scratch *room, float *pairs);
void koksma__sets_take(koksma__adaptive *run, size_t pixel, const float *rgb, const float *weights);
double koksma__sets_result(const koksma__adaptive *run, size_t pixel, double rgb[3]);

koksma__pixel_sets *koksma__sets_of(const koksma__adaptive *run, size_t pixel);
size_t koksma__set_size(const koksma__adaptive *run);

/* Sets *demand to `sets` more sets, or to as many as the pixel may still have. */
void koksma__sets_demand(const koksma__adaptive *run, size_t pixel, double sets, double score,
                         koksma__sample_demand *demand);

/* Of the samples' luminance: its mean, and the variance of a sample as if they were independent. */
double koksma__sets_mean(const koksma__adaptive *run, const koksma__pixel_sets *p);
double koksma__sets_variance(const koksma__adaptive *run, const koksma__pixel_sets *p);

/* The standard error of the mean luminance, from the spread of the sets' means. */
double koksma__sets_standard_error(const koksma__adaptive *run, const koksma__pixel_sets *p);

#define ADAPTIVE(name) extern const koksma_adaptive koksma__adaptive_##name;
#include "render/samples/adaptive/adaptive.def"
#undef ADAPTIVE

#endif
