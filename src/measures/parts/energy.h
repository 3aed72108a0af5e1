/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Measures that are energies of pairs. Points minus their domain's measure is a signed measure of mass 0; the mean
 * square over random half-spaces of what it gives them is a multiple of
 *     energy = (1/n) sum_i P(x_i) - (1/n^2) sum_{i<j} |x_i - x_j| - C/2,
 * P(x) being the mean distance of x from the domain and C the mean of P there (Alexander 1990).
 */
#ifndef KOKSMA_MEASURES_PARTS_ENERGY_H
#define KOKSMA_MEASURES_PARTS_ENERGY_H

#include "measures/parts/warped.h"

typedef struct koksma__energy {
    double (*potential)(const double *x, const void *context);
    const void *context;
    double self;   /* C */
    double factor; /* the measure's square is factor times the energy */
} koksma__energy;

/* The square and the value of the measure. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__energy_measure(const koksma__warped *points, const koksma__energy *energy,
                                     const koksma_run *run, koksma_value *out);

/* P and C of the unit disk, of the equilateral triangle with side 1 (x in the plane, a corner at the origin, a side
   on the x axis), and of the hemisphere (uniform or weighted by the cosine). */
double koksma__disk_potential(const double *x, const void *context);
double koksma__triangle_potential(const double *x, const void *context);
double koksma__hemisphere_potential(const double *x, const void *context); /* context: NULL uniform, else cosine */

#define KOKSMA__DISK_SELF (128 / (45 * M_PI))
#define KOKSMA__TRIANGLE_SELF ((4 + 3 * log(3)) / 20)

#endif
