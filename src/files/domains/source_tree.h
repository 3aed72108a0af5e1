/* SPDX-License-Identifier: Apache-2.0 */
/* Sums of the Gaussian forces that sources of different widths exert on each other (domains/gaussian.c), by a
   tree. */
#ifndef KOKSMA_DOMAINS_SOURCE_TREE_H
#define KOKSMA_DOMAINS_SOURCE_TREE_H

#include "domains/field.h"

/* A box of the tree: the smallest that contains its sources, which are first .. end - 1 in the sorted order; square:
   the largest squared width of these; its children are boxes child .. child + children - 1. */
typedef struct koksma__source_box {
    double low[3], high[3], square;
    uint32_t first, end, child, children; /* children == 0: a leaf */
} koksma__source_box;

typedef struct koksma__source_tree {
    int dim;
    bool torus;
    double lengths[3]; /* of the axes, as in domain.h; columns, boxes and forces are in their measure */
    size_t n, n_boxes, capacity, n_groups; /* capacity: of the array of boxes */
    double *columns[5]; /* three coordinates, squared width and mass of each sorted source; negative masses attract */
    uint32_t *order;    /* number of each sorted source before sorting */
    uint64_t *keys, *spare;
    koksma__source_box *boxes;
    uint32_t *groups; /* group g has the sorted sources groups[g] .. groups[g + 1] - 1, which are neighbours */
} koksma__source_tree;

/* The maximum number of sources in a group. */
enum { KOKSMA__SOURCE_GROUP = 32 };

koksma_status koksma__source_tree_init(koksma__source_tree *tree, const koksma__point_domain *domain, size_t n);
void koksma__source_tree_fini(koksma__source_tree *tree);

/* Sorts the n sources that `source(context, i)` gives for i = 0, 1, ..., and builds the boxes. Errors: MEMORY,
   INTERRUPTED. */
koksma_status koksma__source_tree_build(koksma__source_tree *tree,
                                        koksma__field_node (*source)(const void *context, size_t i),
                                        const void *context, const koksma_run *run);

/* Computes the forces on those sources of a group whose number before sorting is at least `first`. force[i] belongs
   to source i of the group, at x with squared width s. It is the sum, over all sources at a distance d with d^2 < 12
   v, of mass (2 s / v)^2 (exp(-d^2 / v) - exp(-12)) (x - position), where v is the sum of both squared widths. On the
   torus all periodic images are included. force[i] is not written for the remaining sources of the group. */
void koksma__source_forces(const koksma__source_tree *tree, size_t group, size_t first,
                           double force[KOKSMA__SOURCE_GROUP][3]);

#endif
