/* SPDX-License-Identifier: Apache-2.0 */
/* The distance between the radial power of a point set and a target curve. */
#ifndef KOKSMA_OPTIMISE_RADIAL_POWER_H
#define KOKSMA_OPTIMISE_RADIAL_POWER_H

#include <koksma/optimise.h>

/* The measure that a search for a target power minimises, in place of one from the table of measures. */
extern const koksma_measure koksma__measure_radial_power;

/* The largest power of a target: its square and sums of such squares are in the range of doubles. */
#define KOKSMA__MOST_POWER 1e100

/* Fails unless the options of a search for a target power are valid. Errors: ARGUMENT, DIM. */
koksma_status koksma__radial_power_check(const koksma_optimise_options *options);

/* Returns the work of one gradient, as the number of points times the number of frequencies. */
double koksma__radial_power_cost(const koksma_optimise_options *options);

/* Computes the square of the distance, and its derivatives with respect to the coordinates if `gradient` is not NULL.
   Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__radial_power_square(const koksma_optimise_options *options, const koksma_points *points,
                                          const koksma_run *run, double *square, double *gradient);

#endif
