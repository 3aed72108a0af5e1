/* SPDX-License-Identifier: Apache-2.0 */
/* The target of gaussian-blue-noise on a domain: its density as nodes with masses, the width of a point's Gaussian, and
   the map of a moved point back to the domain. */
#ifndef KOKSMA_DOMAINS_FIELD_H
#define KOKSMA_DOMAINS_FIELD_H

#include "domains/domain.h"

/* A small part of the domain: its centroid, its number of points, and the square of its width. The width is that of a
   point there, and the square is larger by twice the variance of the part along an axis, so that sums over nodes come
   close to integrals. */
typedef struct koksma__field_node {
    double x[3], mass, square;
} koksma__field_node;

typedef struct koksma__field {
    size_t n_nodes;
    koksma__field_node *nodes;
    void *data; /* of the functions */
    /* The standard deviation of the Gaussian of a point at x. */
    double (*width)(const void *data, const double *x);
    /* Replaces x by the nearest position of the domain and stores its part; `point` is where the point was. Returns
       false, and leaves `point`, if it may not be at x. */
    bool (*settle)(const void *data, double *x, koksma__domain_point *point);
    /* Removes from a vector at a point what is perpendicular to the domain. */
    void (*along)(const void *data, const koksma__domain_point *point, double *vector);
    void (*close)(void *data);
} koksma__field;

/* Nodes are squares at most this many widths wide: a grid of that spacing is within 3e-9 of the integral of a Gaussian,
   and the variance of a node makes up for most of what neighbours of different sizes leave. */
#define KOKSMA__NODE_WIDTHS 1.01

/* Adds a node; *capacity is that of the field's nodes. Errors: MEMORY. */
koksma_status koksma__field_add(koksma__field *field, size_t *capacity, koksma__field_node node);
void koksma__field_close(koksma__field *field);

#endif
