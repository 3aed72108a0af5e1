/* SPDX-License-Identifier: Apache-2.0 */
/* L-BFGS for functions of the coordinates of points, and the starting points of such descents. */
#ifndef KOKSMA_OPTIMISE_DESCENT_H
#define KOKSMA_OPTIMISE_DESCENT_H

#include "optimise/methods.h"

enum { KOKSMA__MEMORY = 10, KOKSMA__ITERATIONS = 300 };

/* Computes a function of points: its value, and its derivatives with respect to the coordinates. */
typedef koksma_status (*koksma__function)(const void *context, const koksma_points *points, double *value,
                                          double *gradient);

typedef struct koksma__descent {
    koksma_points points; /* x */
    koksma__function function;
    const void *context;
    const koksma_run *run; /* asked before each call of the function */
    bool bounded;
    size_t count;                       /* number of coordinates of all points */
    double *low, *gradient, *direction; /* low: lower ends of the coordinates' intervals */
    double *before, *gradient_before;
    double *steps, *changes; /* the last KOKSMA__MEMORY differences between successive x, and between successive
                                gradients */
    double length, products[KOKSMA__MEMORY], work, cost,
        budget;  /* work done so far, work of one gradient, limit of work; the unit is one coordinate read */
    size_t kept; /* number of steps so far */
    double goal; /* a descent that is unlikely to reach this value ends early */
} koksma__descent;

/* Allocates a descent for sets of the size of `points`; with keep=net each coordinate stays in its interval of length
   1/n. If `bounded` is false, coordinates are on the torus. `cost` is the work of one call of the function. Errors:
   MEMORY. */
koksma_status koksma__descent_init(koksma__descent *d, const koksma_points *points, koksma_keep keep, bool bounded,
                                   double cost);
void koksma__descent_fini(koksma__descent *d);

/* Sets the points from which a descent starts: a changed copy of the best set, or new points. Errors: those of the
   function, INTERRUPTED. */
koksma_status koksma__descent_start(koksma__descent *d, const koksma_points *best, koksma_keep keep,
                                    koksma__stream *random);

/* Sets the points {i a + s} (fractional parts) with random vectors a and s; in half of the calls the first coordinate
   is i / n + s. */
void koksma__descent_kronecker(koksma__descent *d, koksma__stream *random);

/* Descends from d->points in at most the given number of iterations. On return, also after INTERRUPTED, d->points has the
   best points found, and *least their value (infinite: not even the first was computed). Errors: those of the
   function, INTERRUPTED. */
koksma_status koksma__descend(koksma__descent *d, int iterations, double *least);

#endif
