/* SPDX-License-Identifier: Apache-2.0 */
/* Point sets of a pixel made in floats: see float_sets.c. */
#ifndef KOKSMA_RENDER_SAMPLES_FLOAT_SETS_H
#define KOKSMA_RENDER_SAMPLES_FLOAT_SETS_H

#include <koksma/koksma.h>

#include "render/pipelines/batch.h"

/* What a thread needs for a set of n points: 2 n + 16 words, n pairs, n + 64 positions. */
typedef struct koksma__float_scratch {
    uint32_t *fractions;
    float *pairs;
    uint16_t *order;
} koksma__float_scratch;

typedef struct koksma__float_set koksma__float_set;

/* Makes a set: set->words random words, the order of its points or NULL for the pattern's own, and offset, which is
   added to all points. */
typedef void koksma__float_draw(const koksma__float_set *set, const koksma__batch_table *batch, const uint32_t *words,
                                const uint16_t *order, const float offset[2], const koksma__float_scratch *scratch,
                                float *pairs);

/* The float form of a pattern for sets of n points in the plane, or on the line (y = 0). */
struct koksma__float_set {
    koksma__float_draw *draw; /* NULL: the pattern has none */
    size_t n, words;
    int dim;
    bool in_random_order; /* it takes an order even where the points are not shuffled for the pairing */
    float *corners;       /* pairs: of cells, or twice the same stratum */
    float scale[2];       /* of a random number below 2^24 in a cell */
    size_t columns, rows;
    uint32_t partners[2][32];
};

/* The set's draw is NULL where the pattern, these parameters or this n have no float form. Errors: the pattern's,
   MEMORY. */
koksma_status koksma__float_set_init(const koksma_spec *spec, size_t n, int dim, koksma__float_set *set);
void koksma__float_set_fini(koksma__float_set *set);

/* The name of float form i; NULL past the last. */
const char *koksma__float_set_name(size_t i);

#endif
