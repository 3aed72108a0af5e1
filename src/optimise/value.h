/* SPDX-License-Identifier: Apache-2.0 */
/* What a search makes small: a measure, or its mean over prefixes of a sequence and over projections. */
#ifndef KOKSMA_OPTIMISE_VALUE_H
#define KOKSMA_OPTIMISE_VALUE_H

#include <koksma/optimise.h>

/* Errors: DIM (projections of more than 64 coordinates), ARGUMENT (projections without a coordinate or with one that the
   points have not; weights that are not above 0). */
koksma_status koksma__search_check(const koksma_optimise_options *options);

/* The value that koksma_optimum has. Errors: those of koksma_evaluate, ARGUMENT (a value of which a geometric mean is taken is
   0). */
koksma_status koksma__search_value(const koksma_spec *measure, const koksma_optimise_options *options,
                                   const koksma_points *points, double *value);

/* Its square, for a measure with a gradient and no sequence, and the derivatives by the coordinates. Errors: MEMORY. */
koksma_status koksma__search_square(const koksma_spec *measure, const koksma_optimise_options *options,
                                    const koksma_points *points, double *square, double *gradient);

#endif
