/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_API_EVALUATE_H
#define KOKSMA_API_EVALUATE_H

#include <koksma/koksma.h>

/* What koksma_evaluate asks of its arguments: a measure's spec with parameters that it takes, and points of the unit
   cube in as many dimensions as it has a form for. caller is what errors call the function. Errors: ARGUMENT, DIM. */
koksma_status koksma__evaluate_check(const char *caller, const koksma_spec *spec, const koksma_points *points);

#endif
