/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A variant: all settings of a render except its pattern, samples, size and seed, that is, the pairing and other
 * members of koksma_render_options. Its canonical text lists the options that differ from their defaults, in the
 * order of the table in variants.c and separated by ";": "" or "pairing=aligned". The text is part of the key of
 * every row.
 */
#ifndef KOKSMA_STUDY_PLAN_VARIANTS_H
#define KOKSMA_STUDY_PLAN_VARIANTS_H

#include <koksma/adaptive.h>
#include <koksma/render.h>

#include "study/plan/plan.h"
#include "json/json.h"

enum { KOKSMA__VARIANT_TEXT = 1024 };

/* The options that a variant sets. */
typedef struct koksma__variant {
    koksma_render_options render;
    koksma_adaptive_options adaptive; /* method NULL: every pixel has the same number of samples */
} koksma__variant;

/* Reads {"option": ["word", ...], ...} and writes the texts of all combinations, the last option changing
   fastest. */
koksma_status koksma__variants_parse(const koksma__json_node *node, koksma__texts *out);

/* Sets the options of a canonical text. With of_reference, sets only those that change the exact image; others,
   such as the pairing of samples, do not apply to a reference. Errors: ARGUMENT. */
koksma_status koksma__variant_apply(const char *text, bool of_reference, koksma__variant *variant);

/* The number of points in the first sets of a pixel whose budget is spp: spp, or less with an adaptive method. */
int koksma__variant_first_spp(const koksma__variant *variant, int spp);

/* Renders a scene. With an adaptive method spp is the budget of all rounds (the first gets a quarter of it), so that
   variants are compared at equal numbers of samples. Allocates out. */
koksma_status koksma__variant_render(const koksma_scene *scene, const koksma__variant *variant, const koksma_run *run,
                                     koksma_image *out);

/* Fails unless each part of the text is "name=word" with the name of an option. Errors: ARGUMENT. */
koksma_status koksma__variant_check_names(const char *text);

/* Writes the canonical text of a variant; of words that it does not know, nothing. Errors: ARGUMENT (the value of an
   option, or options that can't be combined). */
koksma_status koksma__variant_canonical(const char *text, char out[KOKSMA__VARIANT_TEXT]);

/* Writes the canonical text of the options that change the exact image. */
void koksma__variant_of_reference(const char *text, char *out);

/* The sampling patterns of a rendered image as plans and rankings write them: one text for all uses, as
   koksma_render_patterns takes it. The text's canonical form is part of a row's key in the store. */

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
