/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A pixel's samples in strata that are split. A stratum is a cell in the square of every use at once: the cells of
 * the uses are paired one to one, and with a stratum its cells are quartered. It has one sample.
 *
 * At first there are m x m strata; number i has cell i of the base use, which is the pixel or the use that carries
 * the variance, and some cell of every other use:
 *     aligned     the same cell i, so that all squares share one connectivity ("correlated jitter"; Shirley 1991,
 *                 section 5.6)
 *     shuffled    cell p(i), p a random permutation of the pixel and the use ("uncorrelated jitter")
 * A use of one number has m^2 strata on a line when it is shuffled, and the columns of the square when aligned.
 *
 * Aligned squares leave most of the product of the spaces unsampled: E.g. the left of the pixel never sees the right
 * of a light. `phase` can mend it: fixed       it is so shifted     the other uses are shifted on the torus, x ->
 * frac(x + s): with s uniform each pixel's estimate is right in the mean, but neighbours across the seam differ
 *     folded      x -> |2 frac(x + s) - 1|, which has no seam
 *
 * Which sample a part of a split stratum gets, `reuse`:
 *     kept        the old one in the part where it lies, new ones in the others
 *     renewed     new ones in all four; the old one is dropped
 *     fresh       as kept, and when no stratum is split any more every stratum is sampled afresh, for the estimate
 *                 (Kirk & Arvo 1991: what decides must not be counted); the parts of a split stratum are paired
 *                 afresh, too, in all uses
 */
#ifndef KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_STRATA_H
#define KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_STRATA_H

#include <stdatomic.h>

#include "render/samples/adaptive/adaptive.h"

enum { KOKSMA__PHASE_FIXED, KOKSMA__PHASE_SHIFTED, KOKSMA__PHASE_FOLDED };
enum { KOKSMA__REUSE_KEPT, KOKSMA__REUSE_RENEWED, KOKSMA__REUSE_FRESH };
enum { KOKSMA__MAX_LEVELS = 8, KOKSMA__MAX_STRATA_SIDE = 512 };

/* Which numbers place a sample in its stratum. */
enum { KOKSMA__STAGE_TREE, KOKSMA__STAGE_LAST, KOKSMA__STAGE_PROBE };

typedef struct koksma__stratum {
    uint32_t number;  /* of the m x m at first */
    uint16_t digits;  /* which quarter at each split, the first split highest; quarters are those of the base use */
    uint8_t level;    /* splits */
    uint8_t needless; /* bit k: split k of those that made it was needless */
    bool pending;     /* its sample is to be drawn */
    bool marked;      /* to be split */
    float value[3], weight;
} koksma__stratum;

typedef struct koksma__tree {
    koksma__stratum *strata;
    uint32_t n, marked, splits, needless;
    uint32_t base;          /* the use whose cells are neighbours */
    uint32_t stage;         /* of its samples */
    bool searched, carried; /* selective: base was looked for, and found */
} koksma__tree;

typedef struct koksma__strata {
    uint32_t m, levels;
    float threshold;
    bool shuffled, selective; /* selective: only the base use is split */
    int phase, reuse;
    double below; /* of selective */
    koksma__tree *trees;
    atomic_size_t total; /* strata of all trees */
} koksma__strata;

/* The cells of a use in one pixel. */
typedef struct koksma__use_cells {
    uint32_t use;
    uint64_t seed;
    const uint32_t *permutation; /* NULL: the identity */
    bool line, split, turned;    /* cells on a line; split with the stratum; moved by the phase */
} koksma__use_cells;

/* permutation has room for m^2 words. */
void koksma__use_cells_init(const koksma__adaptive *run, size_t pixel, uint32_t use, uint32_t *permutation,
                            koksma__use_cells *out);

/* The cell of a stratum in the base use, in units of its level: column and row; row 0 on a line. */
void koksma__stratum_cell(const koksma__strata *s, const koksma__use_cells *base, const koksma__stratum *stratum,
                          uint32_t cell[2]);

/* The cell of a stratum in another use, in units of the level of that use's cells. stage: which pairing of the parts
   applies. */
void koksma__stratum_cell_in(const koksma__strata *s, const koksma__use_cells *base, const koksma__use_cells *use,
                             const koksma__stratum *stratum, uint32_t stage, uint32_t cell[2]);

/* In which quarter of its base cell the sample of a stratum lies. */
int koksma__stratum_quarter(const koksma__strata *s, const koksma__use_cells *base, const koksma__stratum *stratum);

/* The position in [0,1)^2 of a stratum's sample in a use. */
void koksma__stratum_place(const koksma__strata *s, const koksma__use_cells *base, const koksma__use_cells *use,
                           const koksma__stratum *stratum, uint32_t stage, float place[2]);

/* Lists the uses of one or two dimensions, at the first two vertices, that this scene needs; returns how many. */
int koksma__list_spaces(const koksma__use_list *there, uint32_t list[KOKSMA_MAX_SPACES]);

/* ---- The method (adaptive_strata.c) ----------------------------------------------------------------------- */

/* Every such method's parameters begin with these. */
enum { KOKSMA__STRATA_LEVELS, KOKSMA__STRATA_THRESHOLD, KOKSMA__STRATA_REUSE };
extern const char *const koksma__reuse_names[];
#define KOKSMA__STRATA_PARAMS                                                                                        \
    {"levels", "splits of a stratum at most", 2, 0, KOKSMA__MAX_LEVELS, NULL, true},                                 \
        {"threshold", "difference of two values beyond which their strata are split", 0.05, 0, 1e30, NULL, false},   \
    {                                                                                                                \
        "reuse", "of the sample of a split stratum", KOKSMA__REUSE_KEPT, 0, 2, koksma__reuse_names, true             \
    }

koksma_status koksma__strata_open(koksma__adaptive *run);
void koksma__strata_close(koksma__adaptive *run);
koksma_status koksma__strata_prepare(koksma__adaptive *run, size_t pixel);
koksma_status koksma__strata_draw(const koksma__adaptive *run, size_t pixel, uint32_t use, const float offset[2],
                                  koksma__sample_scratch *room, float *pairs);
void koksma__strata_take(koksma__adaptive *run, size_t pixel, const float *rgb, const float *weights);
void koksma__strata_decide(koksma__adaptive *run, size_t pixel, void *scratch, koksma__sample_demand *demand);
void koksma__strata_last(koksma__adaptive *run);
size_t koksma__strata_probes(const koksma__adaptive *run, size_t pixel);
koksma_status koksma__strata_show(const koksma__adaptive *run, size_t pixel, koksma_strata *out);
double koksma__strata_result(const koksma__adaptive *run, size_t pixel, double rgb[3]);

#endif
