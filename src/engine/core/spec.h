/* SPDX-License-Identifier: Apache-2.0 */
/* Specs as text, and the checks of their parameters. `member` is the name of the pattern or measure in error
   messages. */
#ifndef KOKSMA_CORE_SPEC_H
#define KOKSMA_CORE_SPEC_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Parses "key=value,key=value" with a table of parameters (NULL: there are no parameters); all values start with
   their defaults. */
KOKSMA__LAB koksma_status koksma__params_parse(const char *member, const koksma_param *params, const char *text,
                                               double *values);

/* Fails unless all values are in their ranges. Errors: ARGUMENT. */
KOKSMA__LAB koksma_status koksma__params_check(const char *member, const koksma_param *params, const double *values);
koksma_status koksma__modifiers_check(const char *pattern, const double *values);

/* Fails unless a pattern or measure supports a number of dimensions. Errors: DIM. */
koksma_status koksma__dim_check(const char *member, int dim, int min_dim, int max_dim);

/* Appends ":key=value,…" with the parameters that differ from their defaults. */
KOKSMA__LAB void koksma__params_text(const koksma_param *params, const double *values, char *text, size_t size);

/* Splits a spec into the name before the colon, which has up to 63 letters, and the parameters. Errors: ARGUMENT. */
KOKSMA__LAB koksma_status koksma__spec_split(const char *text, char *name, const char **rest);

/* Converts the spec of a pattern or measure to the arguments of its functions. */
koksma_args koksma__spec_arguments(const koksma_spec *spec, const koksma_run *run);

#endif
