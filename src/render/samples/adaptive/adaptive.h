/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Adaptive sampling renders an image in rounds. In each round the samples of the selected pixels are drawn, traced
 * and added. Then each selected pixel either demands more samples or is done, which its method decides from the
 * values of that pixel alone. adaptive_engine.c selects the pixels of the next round: all that demand samples or,
 * under a budget, those with the highest scores. The result is a function of pixel and round and does not depend on
 * the threads.
 */
#ifndef KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_H
#define KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_H

#include <stdatomic.h>

#include <koksma/adaptive.h>

#include "render/one_image.h"
#include "render/samples/samples.h"

/* The demand of a pixel for more samples. */
typedef struct koksma__sample_demand {
    uint32_t now;  /* samples in the next round; 0: the pixel is done */
    float score;   /* priority of the pixel; under a budget the highest scores are selected first */
    bool selected; /* whether the next round draws samples of this pixel */
} koksma__sample_demand;

typedef struct koksma__adaptive koksma__adaptive;

/* The values of the samples that a pixel demanded. */
typedef struct koksma__sample_values {
    const float *rgb;
    const float *weights; /* weights of the filter (filters/filters.h); NULL: all are 1 */
} koksma__sample_values;

/* What methods of one family share: those whose samples come in point sets, and those that split strata. Any thread may
   call the functions that take a pixel, but only one thread at a time for each pixel. */
typedef struct koksma__adaptive_family {
    size_t (*bytes)(int spp); /* what the state of a pixel takes at first */
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
    /* NULL, or returns the number of probes for the splits of a selected pixel. Probes are extra samples that test
       whether a split was needed; in a round of probes, draw() and take() process probes in place of samples. */
    size_t (*probes)(const koksma__adaptive *run, size_t pixel);
    /* computes the value of a pixel and returns its variance */
    double (*result)(const koksma__adaptive *run, size_t pixel, double rgb[3]);
    /* NULL, or describes the strata of a pixel for a figure. Errors: MEMORY. */
    koksma_status (*show)(const koksma__adaptive *run, size_t pixel, koksma_strata *out);
} koksma__adaptive_family;

/* An adaptive method. */
typedef struct koksma__adaptive_method {
    const koksma__adaptive_family *family;
    /* Allocates the state and sets the demands of the first round, which selects all pixels. */
    koksma_status (*open)(koksma__adaptive *run);
    /* NULL, or determines the next demand of the pixel; *demand is zero before the call, and scratch has run->scratch
       bytes. */
    void (*decide)(koksma__adaptive *run, size_t pixel, void *scratch, koksma__sample_demand *demand);
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
    void *state;     /* state of the method */
    void *extra;     /* further memory of the method, freed by the engine; NULL: none */
    koksma_adaptive_report report;
};

/* ---- Places in strata that are split (adaptive_place.c) --------------------------------------------------------- */

/*
 * Places the samples of a pixel in strata that are split. A use is what two numbers of a sample decide, such as the
 * position in the pixel or a point on a light. A stratum is a cell in the unit square of every use at once: the cells
 * of the uses are paired one to one, and splitting a stratum quarters its cell in each use. A stratum has one sample.
 *
 * At first there are m x m strata. Stratum i has cell i of the pixel and one cell of every other use. Neighbours are
 * compared in the base use. Aligned pairing takes cell i in every use, so that all uses have the same neighbours
 * ("correlated jitter"; Shirley 1991, section 5.6). It samples only a small part of the product of the uses' unit
 * squares: for example, samples in the left of the pixel never see the right of a light. Shuffled pairing takes cell
 * p(i), with a random permutation p for each pixel and use ("uncorrelated jitter"). The cells of a one-dimensional use
 * are m^2 intervals of a line with shuffled pairing, and the columns of the square with aligned pairing. Of a split
 * stratum the old sample stays in the part that contains it, and the other parts get new samples.
 *
 * The method `selective` splits cells in the base use only, which is the use that causes most of the variance; else the
 * base use is the pixel.
 */

enum { KOKSMA__MAX_LEVELS = 8, KOKSMA__MAX_STRATA_SIDE = 512 };

/* The stage of a sample selects the random numbers that place it in its stratum: while the tree grows, or as a probe. */
enum { KOKSMA__STAGE_TREE = 0, KOKSMA__STAGE_PROBE = 2 };

typedef struct koksma__stratum {
    uint32_t number;  /* index of the initial stratum, below m x m */
    uint16_t digits;  /* the quarter of the base use that each split led to; the first split has the highest digit */
    uint8_t level;    /* number of splits that led to this stratum */
    uint8_t needless; /* bit k is set if split k of those that led to this stratum was needless */
    bool pending;     /* whether the sample of the stratum remains to be drawn */
    bool marked;      /* whether the stratum will be split */
    float value[3], weight;
} koksma__stratum;

typedef struct koksma__tree {
    koksma__stratum *strata;
    uint32_t n, marked, splits, needless;
    uint32_t base; /* the base use, in which neighbouring strata are compared */
    /* in the method `selective`: whether the base use was searched for, and whether it was found */
    bool searched, carried;
} koksma__tree;

typedef struct koksma__strata {
    uint32_t m, levels;
    float threshold;
    bool shuffled;
    bool selective; /* when a stratum is split, its cells are split in the base use only */
    double below;   /* threshold of the method `selective` on the contiguity ratio */
    koksma__tree *trees;
    atomic_size_t total; /* number of strata in all trees */
} koksma__strata;

/* How the cells of a pixel's strata lie in the unit square of one use. */
typedef struct koksma__use_cells {
    uint32_t use;
    uint64_t seed;
    const uint32_t *permutation; /* permutation of the cells; NULL: identity */
    bool line, split; /* line: whether the cells lie on a line; split: whether they are split with the stratum */
} koksma__use_cells;

/* Initialises the cells of a use in a pixel; `permutation` is a buffer of m^2 words, or NULL. */
void koksma__use_cells_init(const koksma__adaptive *run, size_t pixel, uint32_t use, uint32_t *permutation,
                            koksma__use_cells *out);

/* Computes the cell of a stratum in a use, as column and row in the grid of the cell's level; the row is 0 on a line. */
void koksma__stratum_cell(const koksma__strata *s, const koksma__use_cells *base, const koksma__use_cells *use,
                          const koksma__stratum *stratum, uint32_t cell[2]);

/* Returns the quarter of the base cell that contains the sample of a stratum. */
int koksma__stratum_quarter(const koksma__strata *s, const koksma__use_cells *base, const koksma__stratum *stratum);

/* Computes the position in [0,1)^2 of a stratum's sample in a use. */
void koksma__stratum_place(const koksma__strata *s, const koksma__use_cells *base, const koksma__use_cells *use,
                           const koksma__stratum *stratum, uint32_t stage, float place[2]);

/* ---- Strata for figures (adaptive_show.c) ----------------------------------------------------------------------- */

/* Lists the uses whose strata are shown, and returns their number: the pixel, the lens, the time, and the first
   lights and the lobe of the first two vertices, as far as the scene needs these uses. */
int koksma__list_spaces(const koksma__use_list *there, uint32_t list[KOKSMA_MAX_SPACES]);

/* Describes the strata of a pixel. Errors: MEMORY. */
koksma_status koksma__strata_show(const koksma__adaptive *run, size_t pixel, koksma_strata *out);

#define ADAPTIVE(name) extern const koksma_adaptive koksma__adaptive_##name;
#include "render/samples/adaptive/adaptive.def"
#undef ADAPTIVE

#endif
