/* SPDX-License-Identifier: Apache-2.0 */
/* The target of gaussian-blue-noise in a rectangle: the density, as nodes with masses; the width of a point's Gaussian;
   and the function that puts a moved point back on the domain. */
#ifndef KOKSMA_DOMAINS_FIELD_H
#define KOKSMA_DOMAINS_FIELD_H

#include "domains/domain.h"

/* A small part of the domain: its centroid, its mass, which is the number of points that the density puts there, and
   `square`: the squared width of a point there plus twice the variance of the part along an axis. With the variance
   added, a Gaussian at the centroid is close to the mean of the Gaussian over the part, so that sums over nodes come
   close to integrals. */
typedef struct koksma__field_node {
    double x[2], mass, square;
} koksma__field_node;

typedef struct koksma__field {
    size_t n_nodes;
    koksma__field_node *nodes;
    void *data; /* argument of the functions below */
    /* Returns the width s of the Gaussian exp(-|t|^2 / s^2) of a point at x (gaussian.c). */
    double (*width)(const void *data, const double *x);
    /* Moves x into the rectangle by periods of the torus and writes this position to *point. Returns false, and leaves
       *point unchanged, if no point may be at x. */
    bool (*settle)(const void *data, double *x, koksma__domain_point *point);
    void (*close)(void *data);
} koksma__field;

/* Nodes are squares that are at most this many widths wide. The sum of a Gaussian over a grid with this spacing has a
   relative error of 3e-9. Where nodes of different sizes meet, the variance in `square` corrects most of the error. */
#define KOKSMA__NODE_WIDTHS 1.01

/* ---- Sums of the Gaussian forces that sources of different widths exert on each other, by a tree ---- */

/* A box of the tree: the smallest that contains its sources, which are first .. end - 1 in the sorted order; square:
   the largest squared width of these; its children are boxes child .. child + children - 1. */
typedef struct koksma__source_box {
    double low[2], high[2], square;
    uint32_t first, end, child, children; /* children == 0: a leaf */
} koksma__source_box;

typedef struct koksma__source_tree {
    double lengths[2]; /* of the axes, as in domain.h; columns, boxes and forces are in their measure */
    size_t n, n_boxes, capacity, n_groups; /* capacity: of the array of boxes */
    double *columns[4]; /* x, y, squared width and mass of each sorted source; negative masses attract */
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
   v, of mass (2 s / v)^2 (exp(-d^2 / v) - exp(-12)) (x - position), where v is the sum of both squared widths. All
   periodic images on the torus are included. force[i] is not written for the remaining sources of the group. */
void koksma__source_forces(const koksma__source_tree *tree, size_t group, size_t first,
                           double force[KOKSMA__SOURCE_GROUP][2]);

#endif
