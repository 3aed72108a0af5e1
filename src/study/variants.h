/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How a scene is rendered besides pattern, samples, size and seed: pairing and whatever else koksma_render_options
 * offers. variants.c has one line an option. A variant's canonical text is what differs from the defaults, in the
 * order of that table, with ";" between: "" or "pairing=aligned". It is part of the key of every row.
 */
#ifndef KOKSMA_STUDY_VARIANTS_H
#define KOKSMA_STUDY_VARIANTS_H

#include <koksma/render.h>

#include "scene/json.h"
#include "study/plan.h"

enum { KOKSMA__VARIANT_TEXT = 1024 };

/* Reads {"option": ["word", ...], ...} into the texts of all combinations, the last option changing fastest. */
koksma_status koksma__variants_parse(const koksma__json_node *node, koksma__texts *out);

/* Sets what a canonical text says. With of_reference only options that change the exact image: a reference doesn't
   depend on how its samples were paired. Errors: ARGUMENT. */
koksma_status koksma__variant_apply(const char *text, bool of_reference, koksma_render_options *options);

/* The canonical text of the options that change the exact image. */
void koksma__variant_of_reference(const char *text, char *out);

#endif
