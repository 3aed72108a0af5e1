/* SPDX-License-Identifier: Apache-2.0 */
/* Functions that read parts of a plan: texts, specs in canonical form, and lists. */
#ifndef KOKSMA_STUDY_PLAN_PLAN_READ_H
#define KOKSMA_STUDY_PLAN_PLAN_READ_H

#include "study/plan/plan.h"
#include "json/json.h"

/* Parses a plan; `name` is its name in error messages ("plan 'my.json': line 3: …"). Checks every spec, so that a
   study does not fail halfway. If trials is NULL, the plan's numbers of trials are used. */
koksma_status koksma__plan_parse(const char *name, const char *text, size_t size, const koksma__plan_trials *trials,
                                 koksma__plan *plan);

/* Returns the text of a plan that is built into the library, or NULL. */
const char *koksma__plan_shipped(const char *name, size_t *size);

/* Writes the canonical form of a text. */
typedef koksma_status (*koksma__spec_parser)(const char *text, char out[KOKSMA_MAX_SPEC]);
typedef koksma_status (*koksma__item_parser)(const koksma__json_node *node, const koksma__plan_trials *trials,
                                             void *item);

/* Copies the text of the member `key`; *out remains NULL if the member is missing and not needed. */
koksma_status koksma__plan_text(const koksma__json_node *node, const char *key, bool needed, char **out);

/* Copies the member "id": letters, digits, '.', '-' and '_', because reports use it in links. */
koksma_status koksma__plan_id(const koksma__json_node *node, bool needed, char **out);

/* Parsers of a pattern of points and of a measure. koksma__image_pattern_text parses the patterns of an image. */
koksma_status koksma__pattern_text(const char *text, char out[KOKSMA_MAX_SPEC]);
koksma_status koksma__measure_text(const char *text, char out[KOKSMA_MAX_SPEC]);

/* Parses an integrand; the canonical text is "error of SPEC". */
koksma_status koksma__error_text(const char *text, char out[KOKSMA_MAX_SPEC]);

/* Parses a metric of image errors. */
koksma_status koksma__metric_text(const char *text, char out[KOKSMA_MAX_SPEC]);

/* Reads the member `key` as a spec that `parser` checks; *out is its canonical form, which the caller frees. The paths of
   patterns start at the plan's folder. `stored` is that of koksma__plan_trials: otherwise a folder's name with which they
   would be read as something else is an error. */
koksma_status koksma__plan_spec(const koksma__json_node *node, const char *key, koksma__spec_parser parser,
                                bool needed, bool stored, char **out);

/* Reads the member `key` as a list of at least one text, no two equal. With a parser, the texts are specs, and their
   canonical forms are kept. */
koksma_status koksma__plan_texts(const koksma__json_node *node, const char *key, koksma__spec_parser parser,
                                 bool needed, bool stored, koksma__texts *out);

/* Moves the texts of `more` to the end of `to`. */
koksma_status koksma__plan_join(koksma__texts *to, koksma__texts *more);

/* Reads the member `key`, which must be there, as a list of at least one number from min to max, no two equal. */
koksma_status koksma__plan_wholes(const koksma__json_node *node, const char *key, long long min, long long max,
                                  koksma__wholes *out);

/* Sorts the numbers in ascending order, so that results do not depend on the order in a plan. The order of the plan
   is lost, so that checks whose errors name a position in the plan must come before this call. */
void koksma__plan_sort(koksma__wholes *wholes);

/* Reads a list of objects into an array of zeroed items of item_size bytes; *n is the number of items to free, even
   after a failure. */
koksma_status koksma__plan_list(const koksma__json_node *node, const char *key, bool needed, size_t item_size,
                                koksma__item_parser parser, const koksma__plan_trials *trials, void **items,
                                size_t *n);

/* Reads an item of "questions"; checks that the blocks and scenes that questions name exist (plan_questions.c). */
koksma_status koksma__plan_question(const koksma__json_node *node, const koksma__plan_trials *trials, void *item);
koksma_status koksma__plan_check_questions(const koksma__json_node *root, const koksma__plan *plan);

/* Reads an item of "conclusions"; checks that the tables, blocks and patterns that conclusions name exist
   (plan_questions.c). */
koksma_status koksma__plan_conclusion(const koksma__json_node *node, const koksma__plan_trials *trials, void *item);
koksma_status koksma__plan_check_conclusions(const koksma__json_node *root, const koksma__plan *plan);

/* Reads an item of "tables"; checks that blocks of the plan make every row (plan_tables.c). */
koksma_status koksma__plan_table(const koksma__json_node *node, const koksma__plan_trials *trials, void *item);
koksma_status koksma__plan_check_tables(const koksma__json_node *root, const koksma__plan *plan);

/* Check that every pattern can make each number of points, of samples of an image block, or of samples of a
   reference, and that every measure accepts each number of points. In a block with `skip` the sizes that a pattern or
   measure refuses are left out, and `stored` (koksma__plan_trials) allows them. Sort the numbers (plan_sets.c). */
koksma_status koksma__plan_check_sets(const koksma__json_node *node, const koksma__plan_trials *trials,
                                      koksma__discrepancy_block *block);
koksma_status koksma__plan_check_measures(const koksma__json_node *node, const koksma__discrepancy_block *block);
koksma_status koksma__plan_check_spp(const koksma__json_node *node, const koksma__plan_trials *trials,
                                     koksma__image_block *block);
koksma_status koksma__plan_check_reference(const koksma__json_node *node, const koksma__plan_trials *trials,
                                           const koksma__reference *reference);

#endif
