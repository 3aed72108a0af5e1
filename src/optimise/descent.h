/* SPDX-License-Identifier: Apache-2.0 */
/* L-BFGS of a function of the coordinates of points, and where searches that descend begin. */
#ifndef KOKSMA_OPTIMISE_DESCENT_H
#define KOKSMA_OPTIMISE_DESCENT_H

#include "optimise/methods.h"

enum { KOKSMA__MEMORY = 10, KOKSMA__ITERATIONS = 300 };

/* The value at the points, and its derivatives by their coordinates. */
typedef koksma_status (*koksma__function)(const void *context, const koksma_points *points, double *value,
                                          double *gradient);

typedef struct koksma__descent {
    koksma_points points; /* x */
    koksma__function function;
    const void *context;
    bool bounded;
    size_t count;                       /* of coordinates */
    double *low, *gradient, *direction; /* low: of the intervals */
    double *before, *gradient_before;
    double *steps, *changes; /* KOKSMA__MEMORY of them: of x, of the gradient */
    double length, products[KOKSMA__MEMORY], work, cost,
        budget;  /* done, of one gradient, and allowed: in numbers looked at */
    size_t kept; /* steps so far */
    double goal; /* a descent that will hardly get there ends early */
} koksma__descent;

/* Allocates for points like these, whose intervals are kept with keep=net; not bounded: coordinates are on the torus.
   `cost` is what one call of the function counts. Errors: MEMORY. */
koksma_status koksma__descent_init(koksma__descent *d, const koksma_points *points, koksma_keep keep, bool bounded,
                                   double cost);
void koksma__descent_fini(koksma__descent *d);

/* The points to begin with: the best set changed, or new ones. */
void koksma__descent_start(koksma__descent *d, const koksma_points *best, koksma_keep keep, koksma__stream *random);

/* Points {i a + s}, a and s random vectors; of half of them one axis is i / n + s. */
void koksma__descent_kronecker(koksma__descent *d, koksma__stream *random);

/* Leaves the points at the least value found from where they are, in at most so many iterations. */
koksma_status koksma__descend(koksma__descent *d, int iterations, double *least);

#endif
