/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_API_EVALUATE_H
#define KOKSMA_API_EVALUATE_H

#include <koksma/koksma.h>

/* Checks the arguments of koksma_evaluate: the spec must name a measure and have valid parameters, and the points
   must be in the unit cube in a dimension that the measure supports. `caller` is the name of the function in error
   texts. Errors: ARGUMENT, DIM. */
koksma_status koksma__evaluate_check(const char *caller, const koksma_spec *spec, const koksma_points *points);

#endif
