/* SPDX-License-Identifier: Apache-2.0 */
/* Sums of Gaussian forces of sources whose widths differ. */
#ifndef KOKSMA_DOMAINS_SOURCE_TREE_H
#define KOKSMA_DOMAINS_SOURCE_TREE_H

#include "domains/field.h"

/* A box of the tree: the smallest about its sources, these, its children, and the largest squared width inside. */
typedef struct koksma__source_box {
    double low[3], high[3], square;
    uint32_t first, end, child, children; /* children == 0: a leaf */
} koksma__source_box;

typedef struct koksma__source_tree {
    int dim;
    bool torus;
    size_t n, n_boxes, capacity, n_groups; /* capacity: of the boxes */
    double *columns[5]; /* of the sorted sources: three coordinates, square, mass; negative masses attract */
    uint32_t *order;    /* of each sorted source its number before sorting */
    uint64_t *keys, *spare;
    koksma__source_box *boxes;
    uint32_t *groups; /* group g has the sorted sources groups[g] .. groups[g + 1] - 1, which are neighbours */
} koksma__source_tree;

/* The most sources of a group. */
enum { KOKSMA__SOURCE_GROUP = 32 };

koksma_status koksma__source_tree_init(koksma__source_tree *tree, int dim, bool torus, size_t n);
void koksma__source_tree_fini(koksma__source_tree *tree);

/* Sorts the n sources that `source(context, i)` gives for i = 0, 1, ..., and builds the boxes. Errors: MEMORY. */
koksma_status koksma__source_tree_build(koksma__source_tree *tree,
                                        koksma__field_node (*source)(const void *context, size_t i),
                                        const void *context);

/* The forces on sources of a group: on number i of it, if its number before sorting is at least `first`, the sum over all
   sources within d^2 < 12 v of mass (2 square / v)^2 (exp(-d^2 / v) - exp(-12)) (x - position), where x and `square` are
   those of source i, d is the distance and v the sum of both squares. On the torus all images act. force[i] of other
   sources is not written. */
void koksma__source_forces(const koksma__source_tree *tree, size_t group, size_t first,
                           double force[KOKSMA__SOURCE_GROUP][3]);

#endif
