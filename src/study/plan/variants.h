/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How a scene is rendered besides pattern, samples, size and seed: pairing and whatever else koksma_render_options
 * offers. variants.c has one line an option. A variant's canonical text is what differs from the defaults, in the
 * order of that table, with ";" between: "" or "pairing=aligned". It is part of the key of every row.
 */
#ifndef KOKSMA_STUDY_PLAN_VARIANTS_H
#define KOKSMA_STUDY_PLAN_VARIANTS_H

#include <koksma/adaptive.h>
#include <koksma/render.h>

#include "study/plan/plan.h"
#include "json/json.h"

enum { KOKSMA__VARIANT_TEXT = 1024 };

/* What a variant sets. */
typedef struct koksma__variant {
    koksma_render_options render;
    koksma_adaptive_options adaptive; /* method NULL: every pixel has equally many samples */
} koksma__variant;

/* Reads {"option": ["word", ...], ...} into the texts of all combinations, the last option changing fastest. */
koksma_status koksma__variants_parse(const koksma__json_node *node, koksma__texts *out);

/* Sets what a canonical text says. With of_reference only options that change the exact image: a reference doesn't
   depend on how its samples were paired. Errors: ARGUMENT. */
koksma_status koksma__variant_apply(const char *text, bool of_reference, koksma__variant *variant);

/* Renders. With an adaptive method spp is the budget: a quarter of it is for the first round, so that variants are
   compared at equal samples. Allocates out. */
koksma_status koksma__variant_render(const koksma_scene *scene, const koksma__variant *variant, const koksma_run *run,
                                     koksma_image *out);

/* The canonical text of an integrator and a filter, each NULL for the default. */
void koksma__variant_text(const koksma_integrator *integrator, const koksma_filter *filter,
                          char out[KOKSMA__VARIANT_TEXT]);

/* The canonical text of the options that change the exact image. */
void koksma__variant_of_reference(const char *text, char *out);

#endif
