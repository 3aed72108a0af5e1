/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_SPEC_H
#define KOKSMA_CORE_SPEC_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Parses "key=value,key=value" for a table of parameters (NULL: it has none); values get defaults first.
   owner is what errors call the thing. */
KOKSMA__LAB koksma_status koksma__params_parse(const char *owner, const koksma_param *params, const char *text,
                                               double *values);

/* What koksma_evaluate asks of its arguments: a measure's spec with parameters that it takes, and points of the unit
   cube in as many dimensions as it has a form for. caller is what errors call the function. Errors: ARGUMENT, DIM. */
koksma_status koksma__evaluate_check(const char *caller, const koksma_spec *spec, const koksma_points *points);

/* Whether the seed does not matter: the pattern claims so, and the spec neither shifts nor scrambles it. */
KOKSMA__LAB bool koksma__is_deterministic(const koksma_spec *spec);

/* Appends ":key=value,…" for the parameters that are not at their defaults. */
KOKSMA__LAB void koksma__params_text(const koksma_param *params, const double *values, char *text, size_t size);

#endif
