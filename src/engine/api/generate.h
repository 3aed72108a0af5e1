/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_API_GENERATE_H
#define KOKSMA_API_GENERATE_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Checks a pattern's spec for points of `dim` dimensions: its parameters, modifiers and path. Errors: ARGUMENT, DIM. */
KOKSMA__LAB koksma_status koksma__generate_check(const koksma_spec *spec, const koksma_pattern *p, int dim);

#endif
