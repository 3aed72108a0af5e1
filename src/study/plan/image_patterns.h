/* SPDX-License-Identifier: Apache-2.0 */
/* The pattern of a rendered image as plans and rankings name it: what koksma_render_patterns takes, one text for all
   uses; in its canonical form it is a key of rows. */
#ifndef KOKSMA_STUDY_PLAN_IMAGE_PATTERNS_H
#define KOKSMA_STUDY_PLAN_IMAGE_PATTERNS_H

#include <koksma/render.h>

/* Sets the patterns of options; n-rooks serves the uses that no part of the text names. */
koksma_status koksma__image_pattern_set(const char *text, koksma_render_options *options);

/* The canonical text. Errors: those of koksma_render_patterns, ARGUMENT (it is longer than a key may be). */
koksma_status koksma__image_pattern_text(const char *text, char out[KOKSMA_MAX_SPEC]);

/* Whether all uses have the same pattern, as native pairing and methods with strata of their own take it. */
bool koksma__image_pattern_is_one(const char *text);

/* Whether each of its patterns can make n points. Errors: theirs. */
koksma_status koksma__image_pattern_try(const char *text, size_t n, const koksma_run *run);

#endif
