/* SPDX-License-Identifier: Apache-2.0 */
/* Sums of Gaussian forces of sources whose widths differ. */
#ifndef KOKSMA_DOMAINS_SOURCE_TREE_H
#define KOKSMA_DOMAINS_SOURCE_TREE_H

#include "domains/field.h"

/* A box of the tree: its sources, its children, and the largest squared width inside. */
typedef struct koksma__source_box {
    double low[3], side, square;
    uint32_t first, end, child, children; /* children == 0: a leaf */
} koksma__source_box;

typedef struct koksma__source_tree {
    int dim;
    bool torus;
    size_t n, n_boxes, capacity; /* capacity: of the boxes */
    koksma__field_node *sources; /* sorted; negative masses attract */
    uint32_t *order;             /* of each sorted source its number before sorting */
    uint64_t *keys, *spare;
    koksma__source_box *boxes;
} koksma__source_tree;

koksma_status koksma__source_tree_init(koksma__source_tree *tree, int dim, bool torus, size_t n);
void koksma__source_tree_fini(koksma__source_tree *tree);

/* Sorts the n sources that `source(context, i)` gives for i = 0, 1, ..., and builds the boxes. Errors: MEMORY. */
koksma_status koksma__source_tree_build(koksma__source_tree *tree,
                                        koksma__field_node (*source)(const void *context, size_t i),
                                        const void *context);

/* The sum over all sources within d^2 < 12 v of mass (2 square / v)^2 (exp(-d^2 / v) - exp(-12)) (x - position), d the
   distance, v = square + the source's square. On the torus all images act. */
void koksma__source_force(const koksma__source_tree *tree, const double *x, double square, double force[3]);

#endif
