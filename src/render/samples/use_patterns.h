/* SPDX-License-Identifier: Apache-2.0 */
/* The patterns that the options of a render assign to uses. */
#ifndef KOKSMA_RENDER_SAMPLES_USE_PATTERNS_H
#define KOKSMA_RENDER_SAMPLES_USE_PATTERNS_H

#include <koksma/render.h>

/* Returns the end of the part at the beginning of a text of patterns, "PATTERN" or "use+use=PATTERN": its ';', or the end
   of the text. A ';' that no names of uses and no '=' follow belongs to the part. *pattern receives the part's PATTERN. */
const char *koksma__use_part(const char *part, const char **pattern);

/* Checks that every spec names a pattern and that every group is valid. Errors: ARGUMENT, DIM. */
koksma_status koksma__check_use_patterns(const koksma_render_options *options);

/* Checks that a pattern can generate a set of n points, by generating one. Errors: those of the pattern; N in place of
   MISSING where a family of files has only sets of other numbers of points. */
koksma_status koksma__try_set(const koksma_spec *spec, size_t n, int dim, const koksma_run *run);

/* Checks that every pattern in the options can generate a set of n points. Errors: those of koksma__try_set. */
koksma_status koksma__try_use_patterns(const koksma_render_options *options, size_t n, const koksma_run *run);

/* Fails if the pattern exists only in more than 2 dimensions, because a single use has at most 2. Errors: DIM. */
koksma_status koksma__check_single_use(const koksma_spec *spec);

#endif
