/* SPDX-License-Identifier: Apache-2.0 */
/* The target of gaussian-blue-noise on a domain: the density, as nodes with masses; the width of a point's Gaussian;
   and the function that puts a moved point back on the domain. */
#ifndef KOKSMA_DOMAINS_FIELD_H
#define KOKSMA_DOMAINS_FIELD_H

#include "domains/domain.h"

/* A small part of the domain: its centroid, its mass, which is the number of points that the density puts there, and
   `square`: the squared width of a point there plus twice the variance of the part along an axis. With the variance
   added, a Gaussian at the centroid is close to the mean of the Gaussian over the part, so that sums over nodes come
   close to integrals. */
typedef struct koksma__field_node {
    double x[3], mass, square;
} koksma__field_node;

typedef struct koksma__field {
    size_t n_nodes;
    koksma__field_node *nodes;
    void *data; /* argument of the functions below */
    /* Returns the width s of the Gaussian exp(-|t|^2 / s^2) of a point at x (gaussian.c). */
    double (*width)(const void *data, const double *x);
    /* Replaces x by the nearest position of the domain and writes this position to *point, which on entry is the
       position from which the point moved. Returns false, and leaves *point unchanged, if no point may be at x. */
    bool (*settle)(const void *data, double *x, koksma__domain_point *point);
    /* Removes from a vector at a point the component that is perpendicular to the domain. */
    void (*along)(const void *data, const koksma__domain_point *point, double *vector);
    void (*close)(void *data);
} koksma__field;

/* Nodes are squares that are at most this many widths wide. The sum of a Gaussian over a grid with this spacing has a
   relative error of 3e-9. Where nodes of different sizes meet, the variance in `square` corrects most of the error. */
#define KOKSMA__NODE_WIDTHS 1.01

/* Adds a node; *capacity is the capacity of field->nodes. Errors: MEMORY. */
koksma_status koksma__field_add(koksma__field *field, size_t *capacity, koksma__field_node node);
void koksma__field_close(koksma__field *field);

#endif
