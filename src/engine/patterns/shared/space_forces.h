/* SPDX-License-Identifier: Apache-2.0 */
/* Forces between points of the torus in 3 to 6 dimensions that repel each other with Gaussians, for
   gaussian-blue-noise. */
#ifndef KOKSMA_PATTERNS_SHARED_SPACE_FORCES_H
#define KOKSMA_PATTERNS_SHARED_SPACE_FORCES_H

#include <koksma/koksma.h>

enum { KOKSMA__FORCE_DIMS = 6 };

typedef struct koksma__space_forces {
    int dim;
    size_t n;
    uint32_t side;           /* number of cells along an axis */
    double s;                /* standard deviation of the Gaussian */
    double *sorted;          /* the points, cell by cell */
    double *table;           /* if s > 1/10: four coefficients of each piece of the periodic Gaussian; else NULL */
    uint32_t *start, *order; /* index of the first sorted point of each cell; original number of each sorted point */
} koksma__space_forces;

koksma_status koksma__space_forces_init(koksma__space_forces *f, size_t n, int dim, double s);
void koksma__space_forces_fini(koksma__space_forces *f);

/* Copies the points into f->sorted, cell by cell; the functions below read these copies. */
void koksma__space_forces_sort(koksma__space_forces *f, const double *xs);

/* Computes the force on sorted point number `at`: with w(t) = exp(-|t|^2 / (2 s^2)), the sum of t w(t) over the other
   points and their periodic images, t the difference to an image. For s <= 1/10 points further away than 5 s are left
   out. */
void koksma__space_force(const koksma__space_forces *f, size_t at, double *force);

#endif
