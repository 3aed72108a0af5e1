/* SPDX-License-Identifier: Apache-2.0 */
/* The patterns that the options of a render assign to uses. */
#ifndef KOKSMA_RENDER_SAMPLES_USE_PATTERNS_H
#define KOKSMA_RENDER_SAMPLES_USE_PATTERNS_H

#include <koksma/render.h>

/* Checks that every spec names a pattern and that every group is valid. Errors: ARGUMENT, DIM. */
koksma_status koksma__check_use_patterns(const koksma_render_options *options);

/* Checks that every pattern in the options can generate a set of n points, by generating one. Errors: those of the
   patterns. */
koksma_status koksma__try_use_patterns(const koksma_render_options *options, size_t n, const koksma_run *run);

/* Fails if the pattern exists only in more than 2 dimensions, because a single use has at most 2. Errors: DIM. */
koksma_status koksma__check_single_use(const koksma_spec *spec);

#endif
