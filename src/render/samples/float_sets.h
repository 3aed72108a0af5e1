/* SPDX-License-Identifier: Apache-2.0 */
/* Generates the point sets of a pixel in single precision; float_sets.c explains how. */
#ifndef KOKSMA_RENDER_SAMPLES_FLOAT_SETS_H
#define KOKSMA_RENDER_SAMPLES_FLOAT_SETS_H

#include <koksma/koksma.h>

#include "render/pipelines/batch.h"

/* The scratch memory of a thread for a set of n points: 2 n + 16 words, n pairs of coordinates, n + 64 indices. */
typedef struct koksma__float_scratch {
    uint32_t *fractions;
    float *pairs;
    uint16_t *order;
} koksma__float_scratch;

typedef struct koksma__float_set koksma__float_set;

/* Generates a set from set->words random words. `order` is the order of its points, or NULL for the pattern's own
   order; `offset` is added to all points. pairs[2 i] and pairs[2 i + 1] are the two coordinates of point i. */
typedef void koksma__float_draw(const koksma__float_set *set, const koksma__batch_table *batch, const uint32_t *words,
                                const uint16_t *order, const float offset[2], const koksma__float_scratch *scratch,
                                float *pairs);

/* The float form of a pattern for sets of n points in the plane or on the line (where y = 0). */
struct koksma__float_set {
    koksma__float_draw *draw; /* NULL if there is no float form */
    size_t n, words;
    int dim;
    bool in_random_order; /* whether `draw` needs an order even where the pairing does not shuffle the points */
    bool has_order;       /* whether the first words are for a random order, which `draw` finds in scratch->order */
    float *corners;       /* n pairs: the two coordinates of a cell's corner, or twice the start of a stratum */
    float scale[2];       /* factor from a 24-bit word to an offset within a cell */
    size_t columns, rows;
    uint32_t partners[2][32];
};

/* Initialises the float form of a pattern. set->draw is NULL if the pattern with these parameters and this n has
   none. Errors: the pattern's, MEMORY. */
koksma_status koksma__float_set_init(const koksma_spec *spec, size_t n, int dim, koksma__float_set *set);
void koksma__float_set_fini(koksma__float_set *set);

/* Returns the pattern name of float form i; NULL past the last one. */
const char *koksma__float_set_name(size_t i);

#endif
