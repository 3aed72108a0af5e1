/* SPDX-License-Identifier: Apache-2.0 */
/* The value that a search minimises: a measure, or the mean of a measure over the prefixes of a sequence and over
   projections. */
#ifndef KOKSMA_OPTIMISE_VALUE_H
#define KOKSMA_OPTIMISE_VALUE_H

#include <koksma/optimise.h>

/* Checks the projections and weights. Errors: DIM (projections of more than 64 coordinates), ARGUMENT (a projection
   without a coordinate or with a coordinate that the points do not have; a weight outside 1e-100 to 1e100). */
koksma_status koksma__search_check(const koksma_optimise_options *options);

/* Computes the value of these points that a search minimises and reports (koksma_optimum.value). Errors: those of
   koksma_evaluate, ARGUMENT (a value of 0 in a geometric mean). */
koksma_status koksma__search_value(const koksma_spec *measure, const koksma_optimise_options *options,
                                   const koksma_points *points, const koksma_run *run, double *value);

/* Computes the square of the value and its derivatives with respect to the coordinates. Must not be called for
   sequences or for measures without a gradient. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__search_square(const koksma_spec *measure, const koksma_optimise_options *options,
                                    const koksma_points *points, const koksma_run *run, double *square,
                                    double *gradient);

#endif
