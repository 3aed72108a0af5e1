/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Places the samples of a pixel in strata that are split. A use is what two numbers of a sample decide, such as the
 * position in the pixel or a point on a light. A stratum is a cell in the unit square of every use at once: the cells
 * of the uses are paired one to one, and splitting a stratum quarters its cell in each use. A stratum has one sample.
 *
 * At first there are m x m strata. Stratum i has cell i of the base use, which is the pixel or the use that causes
 * most of the variance, and one cell of every other use. Aligned pairing takes cell i in every use, so that all uses
 * have the same neighbours ("correlated jitter"; Shirley 1991, section 5.6). Shuffled pairing takes cell p(i), with a
 * random permutation p for each pixel and use ("uncorrelated jitter"). The cells of a one-dimensional use are m^2
 * intervals of a line with shuffled pairing, and the columns of the square with aligned pairing.
 *
 * Aligned pairing samples only a small part of the product of the uses' unit squares: for example, samples in the
 * left of the pixel never see the right of a light. The parameter `phase` can correct this. With phase=fixed no use
 * is moved. With phase=shifted the other uses are shifted on the torus, x -> frac(x + s) with s uniform; the mean of
 * each pixel is then right, but neighbouring strata across the seam differ. With phase=folded the coordinates of all
 * uses but the pixel are mapped by x -> |2 frac(x + s) - 1|, s uniform in [0,1), which has no seam.
 *
 * The parameter `reuse` decides which samples the parts of a split stratum get. With reuse=kept the old sample stays
 * in the part that contains it, and the other parts get new samples. With reuse=renewed all four parts get new
 * samples, and the old sample is dropped. With reuse=fresh, samples are first reused as with reuse=kept; when no
 * stratum is split any more, every stratum gets a new sample for the estimate (Kirk & Arvo 1991: samples that decide
 * must not be counted), and the parts of split strata are paired again in all uses.
 */
#ifndef KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_PLACE_H
#define KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_PLACE_H

#include <stdatomic.h>

#include "render/samples/adaptive/adaptive.h"

enum { KOKSMA__PHASE_FIXED, KOKSMA__PHASE_SHIFTED, KOKSMA__PHASE_FOLDED };
enum { KOKSMA__REUSE_KEPT, KOKSMA__REUSE_RENEWED, KOKSMA__REUSE_FRESH };
enum { KOKSMA__MAX_LEVELS = 8, KOKSMA__MAX_STRATA_SIDE = 512 };

/* The stage of a sample selects the random numbers that place it in its stratum: while the tree grows, in the last
   round, or as a probe. */
enum { KOKSMA__STAGE_TREE, KOKSMA__STAGE_LAST, KOKSMA__STAGE_PROBE };

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
    float *parts; /* 3 numbers for each AOV of light for each stratum; NULL: there are none */
    uint32_t n, marked, splits, needless;
    uint32_t base;  /* the base use, in which neighbouring strata are compared */
    uint32_t stage; /* KOKSMA__STAGE_TREE or KOKSMA__STAGE_LAST */
    /* in the method `selective`: whether the base use was searched for, and whether it was found */
    bool searched, carried;
} koksma__tree;

typedef struct koksma__strata {
    uint32_t m, levels;
    float threshold;
    bool shuffled;
    bool selective; /* when a stratum is split, its cells are split in the base use only */
    int phase, reuse;
    double below; /* threshold of the method `selective` on the contiguity ratio */
    koksma__tree *trees;
    atomic_size_t total; /* number of strata in all trees */
} koksma__strata;

/* How the cells of a pixel's strata lie in the unit square of one use. */
typedef struct koksma__use_cells {
    uint32_t use;
    uint64_t seed;
    const uint32_t *permutation; /* permutation of the cells; NULL: identity */
    /* line: whether the cells lie on a line; split: whether they are split with the stratum; turned: whether the
       phase moves the samples */
    bool line, split, turned;
} koksma__use_cells;

/* Initialises the cells of a use in a pixel; `permutation` is a buffer of m^2 words, or NULL. */
void koksma__use_cells_init(const koksma__adaptive *run, size_t pixel, uint32_t use, uint32_t *permutation,
                            koksma__use_cells *out);

/* Computes the cell of a stratum in the base use, as column and row in the grid of its level; the row is 0 on a
   line. */
void koksma__stratum_cell(const koksma__strata *s, const koksma__use_cells *base, const koksma__stratum *stratum,
                          uint32_t cell[2]);

/* Computes the cell of a stratum in another use, in the grid of that cell's level. `stage` selects the pairing of
   the parts. */
void koksma__stratum_cell_in(const koksma__strata *s, const koksma__use_cells *base, const koksma__use_cells *use,
                             const koksma__stratum *stratum, uint32_t stage, uint32_t cell[2]);

/* Returns the quarter of the base cell that contains the sample of a stratum. */
int koksma__stratum_quarter(const koksma__strata *s, const koksma__use_cells *base, const koksma__stratum *stratum);

/* Computes the position in [0,1)^2 of a stratum's sample in a use. */
void koksma__stratum_place(const koksma__strata *s, const koksma__use_cells *base, const koksma__use_cells *use,
                           const koksma__stratum *stratum, uint32_t stage, float place[2]);

#endif
