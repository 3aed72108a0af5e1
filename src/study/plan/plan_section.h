/* SPDX-License-Identifier: Apache-2.0 */
/* The pieces that plans are read with: copies of texts, specs in their canonical form, lists. */
#ifndef KOKSMA_STUDY_PLAN_PLAN_SECTION_H
#define KOKSMA_STUDY_PLAN_PLAN_SECTION_H

#include "study/plan/plan.h"
#include "json/json.h"

/* Writes the canonical form of a text. */
typedef koksma_status (*koksma__spec_parser)(const char *text, char out[KOKSMA_MAX_SPEC]);
typedef koksma_status (*koksma__item_parser)(const koksma__json_node *node, const koksma__plan_trials *trials,
                                             void *item);

/* A copy of the member's text; *out stays NULL when it is not there and not needed. */
koksma_status koksma__plan_text(const koksma__json_node *node, const char *key, bool needed, char **out);

/* Its "id": letters, digits, '.', '-' and '_', as reports have it in links. */
koksma_status koksma__plan_id(const koksma__json_node *node, bool needed, char **out);

/* Parsers: of a pattern of points, of a measure; of an image's patterns see image_patterns.h. */
koksma_status koksma__pattern_text(const char *text, char out[KOKSMA_MAX_SPEC]);
koksma_status koksma__measure_text(const char *text, char out[KOKSMA_MAX_SPEC]);

/* "error of SPEC" of an integrand. */
koksma_status koksma__error_text(const char *text, char out[KOKSMA_MAX_SPEC]);

/* The member `key` as a spec that `parser` checks; *out is its canonical form, which the caller frees. */
koksma_status koksma__plan_spec(const koksma__json_node *node, const char *key, koksma__spec_parser parser,
                                bool needed, char **out);

/* Lists of at least one; these are needed. */
koksma_status koksma__plan_texts(const koksma__json_node *node, const char *key, koksma__texts *out);
koksma_status koksma__plan_specs(const koksma__json_node *node, const char *key, koksma__spec_parser parser,
                                 koksma__texts *out);
/* Moves the texts of `more` behind those of `to`. */
koksma_status koksma__plan_join(koksma__texts *to, koksma__texts *more);
koksma_status koksma__plan_wholes(const koksma__json_node *node, const char *key, long long min, long long max,
                                  koksma__wholes *out);

/* By size: what is said of the larger sizes, or between neighbours, doesn't depend on how a plan lists them. Places
   in the plan are lost: errors that name them come before. */
void koksma__plan_sort(koksma__wholes *wholes);

/* A list of objects into an array of zeroed items of item_size bytes; *n counts the items that must be freed, also on
   failure. */
koksma_status koksma__plan_list(const koksma__json_node *node, const char *key, bool needed, size_t item_size,
                                koksma__item_parser parser, const koksma__plan_trials *trials, void **items,
                                size_t *n);

/* An item of `questions`; and whether the blocks that questions name are there. */
koksma_status koksma__plan_question(const koksma__json_node *node, const koksma__plan_trials *trials, void *item);
koksma_status koksma__plan_check_questions(const koksma__json_node *root, const koksma__plan *plan);

/* An item of "tables", and whether blocks of the plan make every row (plan_tables.c). */
koksma_status koksma__plan_table(const koksma__json_node *node, const koksma__plan_trials *trials, void *item);
koksma_status koksma__plan_check_tables(const koksma__json_node *root, const koksma__plan *plan);

/* An item of "figures" (plan_figures.c). */
koksma_status koksma__plan_figure(const koksma__json_node *node, const koksma__plan_trials *trials, void *item);

/* Whether every pattern can make each number of points, and an image block's samples, and a reference's; of a block
   with `skip` those that can't are left out. Sorts the numbers (plan_sets.c). */
koksma_status koksma__plan_check_sets(const koksma__json_node *node, koksma__discrepancy_block *block);
koksma_status koksma__plan_check_measures(const koksma__json_node *node, const koksma__discrepancy_block *block);
koksma_status koksma__plan_check_spp(const koksma__json_node *node, koksma__image_block *block);
koksma_status koksma__plan_check_reference(const koksma__json_node *node, const koksma__reference *reference);

#endif
