/* SPDX-License-Identifier: Apache-2.0 */
/* The sampling patterns of a rendered image as plans and rankings write them: one text for all uses, as
   koksma_render_patterns takes it. The text's canonical form is part of a row's key in the store. */
#ifndef KOKSMA_STUDY_PLAN_IMAGE_PATTERNS_H
#define KOKSMA_STUDY_PLAN_IMAGE_PATTERNS_H

#include <koksma/render.h>

/* Sets the patterns in options from text; a use that the text does not name gets the pattern n-rooks. */
koksma_status koksma__image_pattern_set(const char *text, koksma_render_options *options);

/* Writes the canonical form of text. Errors: those of koksma_render_patterns; ARGUMENT: the result has
   KOKSMA_MAX_SPEC characters or more. */
koksma_status koksma__image_pattern_text(const char *text, char out[KOKSMA_MAX_SPEC]);

/* Returns spec i of the options: the common pattern, those of single uses, those of groups; NULL past the last. The
   pattern of a spec is NULL if a use or group has none. */
const koksma_spec *koksma__image_pattern_at(const koksma_render_options *options, size_t i);

/* Whether all uses have the same pattern, which native pairing and adaptive methods with their own strata
   require. */
bool koksma__image_pattern_is_one(const char *text);

/* Whether some use has a pattern that is not known to be unbiased (koksma_is_unbiased). */
bool koksma__image_pattern_is_biased(const char *text);

/* Fails unless each pattern of the text can make n points. Errors: those of the patterns. */
koksma_status koksma__image_pattern_try(const char *text, size_t n, const koksma_run *run);

#endif
