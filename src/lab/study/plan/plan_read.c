/* SPDX-License-Identifier: Apache-2.0 */
/* Reads a study's plan from JSON (studies/README.md lists the fields) and checks everything in it before any work
   starts. */
#define _GNU_SOURCE /* tdestroy */
#include "study/plan/plan.h"

#include <search.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/adaptive.h>
#include <koksma/image.h>
#include <koksma/render.h>
#include <koksma/study.h>
#include <koksma/warp.h>

#include "core/status.h"
#include "study/plan/plan_read.h"
#include "study/plan/plans_embedded.h"
#include "study/plan/variants.h"
#include "json/json.h"

/* ---- Figures ----------------------------------------------------------------------------------------------------- */

/* Reads and checks the figures of a plan. A figure shows points, random lines, a rendered scene, or the strata
   into which an adaptive method subdivided a pixel. */

enum { MAX_N = 1 << 20 };
#define MIN_EXPOSURE 1e-3
#define MAX_EXPOSURE 1e3

/* Reads a list of n numbers of at least `least`, if there is one. */
static koksma_status get_wholes(const koksma__json_node *node, const char *key, size_t n, long long least,
                                long long *out)
{
    koksma__json_node list;
    size_t length;
    if (!koksma__json_has(node, key)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_member(node, key, &list));
    KOKSMA__TRY(koksma__json_length(&list, SIZE_MAX, &length));
    KOKSMA__JSON_FAIL_IF(length != n, &list, "it takes %zu numbers, but has %zu items", n, length);
    for (size_t i = 0; i < n; i++) {
        const koksma__json_node item = koksma__json_item(&list, i);
        KOKSMA__TRY(koksma__json_whole(&item, least, KOKSMA_MAX_IMAGE_SIDE, &out[i]));
    }
    return KOKSMA_OK;
}

static koksma_status check_words(const koksma__json_node *node, const koksma__plan_trials *trials,
                                 const koksma__figure *f)
{
    koksma_adaptive_options adaptive;
    koksma_status status = f->scene ? koksma__scene_files_open(&trials->totals->scenes, f->scene) : KOKSMA_OK;
    if (!status && f->adaptive) {
        status = koksma_adaptive_parse(f->adaptive, &adaptive);
        if (!status && adaptive.method->own_samples && !koksma__image_pattern_is_one(f->pattern)) {
            status = koksma__fail(KOKSMA_ARGUMENT, "%s: adaptive=%s: it needs one pattern for all uses", f->pattern,
                                  f->adaptive);
        }
    }
    if (status) {
        return koksma__json_fail_in(node, status);
    }
    KOKSMA__JSON_FAIL_IF(f->warp && !koksma_warp_find(f->warp), node, "no warp '%s'; 'koksma list warps' names them",
                         f->warp);
    KOKSMA__JSON_FAIL_IF(!f->scene && (f->adaptive || *f->variant || f->detail[2]), node,
                         "options, adaptive and detail need a scene");
    KOKSMA__JSON_FAIL_IF(strstr(f->variant, "adaptive="), node,
                         "a figure's method is its own field 'adaptive', not one of its options");
    KOKSMA__JSON_FAIL_IF(f->strata[0] >= 0 && !f->adaptive, node, "strata need an adaptive method");
    KOKSMA__JSON_FAIL_IF(f->spaces.n && f->strata[0] < 0, node, "spaces need strata");
    KOKSMA__JSON_FAIL_IF(f->exposure != 1 && (!f->scene || f->strata[0] >= 0), node,
                         "exposure needs the picture of a scene");
    return KOKSMA_OK;
}

/* Reads the member "lines": random lines in the square ("primal") or their dual points ("dual"). */
static koksma_status get_lines(const koksma__json_node *node, koksma__figure *f)
{
    char *word = NULL;
    koksma_status status = koksma__plan_text(node, "lines", false, &word);
    f->lines = word != NULL;
    f->dual = word && !strcmp(word, "dual");
    if (!status && word && !f->dual && strcmp(word, "primal") != 0) {
        status = koksma__json_fail(node, "lines '%s': it takes primal or dual", word);
    }
    if (!status && f->lines && (f->scene || f->warp || f->cells)) {
        status = koksma__json_fail(node, "lines can't be combined with a scene, a warp or cells");
    }
    free(word);
    return status;
}

/* Reads an item of "figures". */
static koksma_status parse_figure(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "id",       "title",  "pattern",  "scene", "n",
                                       "cells",   "adaptive", "strata", "detail",   "warp",  "options",
                                       "lines",   "printed",  "spaces", "exposure", NULL};
    koksma__figure *f = item;
    koksma__texts variants = {0};
    f->strata[0] = f->strata[1] = -1;
    f->exposure = 1;
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : koksma__plan_id(node, true, &f->id);
    status = status ? status : koksma__plan_text(node, "title", true, &f->title);
    status = status ? status : koksma__plan_text(node, "scene", false, &f->scene);
    status = status ? status : koksma__plan_text(node, "adaptive", false, &f->adaptive);
    status = status ? status : koksma__plan_text(node, "warp", false, &f->warp);
    status = status ? status : koksma__plan_text(node, "printed", false, &f->printed);
    status = status ? status
                    : koksma__plan_spec(node, "pattern", f->scene ? koksma__image_pattern_text : koksma__pattern_text,
                                        true, trials->stored, &f->pattern);
    status = status ? status : koksma__json_get_whole(node, "n", true, 1, MAX_N, &f->n);
    status = status ? status : koksma__json_get_flag(node, "cells", false, &f->cells);
    status = status ? status : get_lines(node, f);
    status = status ? status : get_wholes(node, "strata", 2, 0, f->strata);
    status = status ? status : get_wholes(node, "detail", 4, 0, f->detail);
    status = status ? status : koksma__plan_texts(node, "spaces", NULL, false, false, &f->spaces);
    status =
        status ? status : koksma__json_get_number(node, "exposure", false, MIN_EXPOSURE, MAX_EXPOSURE, &f->exposure);
    status = status ? status : koksma__variants_parse(node, &variants);
    if (!status && variants.n != 1) {
        status = koksma__json_fail(node, "a figure can have only one value of each option");
    }
    if (!status) {
        f->variant = variants.at[0];
        variants.at[0] = NULL;
    }
    koksma__texts_fini(&variants);
    return status ? status : check_words(node, trials, f);
}

/* ---- Metrics ----------------------------------------------------------------------------------------------------- */

/*
 * The metrics of a plan. The member `metric` names the metric that ranks patterns, and `metrics` lists further
 * metrics; a question may name another metric for its ranking. Every image block evaluates the metrics that all
 * studies evaluate (in_all_studies) and all that the plan names, so that any of them can rank the patterns in a
 * later report of the same rows. A metric that takes long in comparison with a render, such as FLIP, is evaluated
 * only if the plan names it.
 */

/* parse_metrics reads the members "metric" and "metrics" of the plan; call it when the image blocks have been
   read. set_metrics lists the metrics of all image blocks; call it when the questions, which may name
   metrics, have been read. */
static koksma_status parse_metrics(const koksma__json_node *root, koksma__plan *plan)
{
    static const char *const keys[] = {"metric", "metrics"};
    koksma_status status = koksma__plan_spec(root, "metric", koksma__metric_text, false, false, &plan->metric);
    status = status ? status : koksma__plan_texts(root, "metrics", koksma__metric_text, false, false, &plan->metrics);
    for (size_t i = 0; !status && !plan->n_images && i < sizeof keys / sizeof *keys; i++) {
        koksma__json_node node;
        if (koksma__json_has(root, keys[i])) {
            koksma__json_member(root, keys[i], &node);
            status = koksma__json_fail(&node, "the plan has no 'images', whose error it would measure");
        }
    }
    if (!status && !plan->metric) {
        plan->metric = strdup(KOKSMA__DEFAULT_METRIC);
        status = plan->metric ? KOKSMA_OK : koksma__fail_memory(sizeof KOKSMA__DEFAULT_METRIC);
    }
    return status;
}

/* Appends a metric to a list with free capacity, unless the list contains it already. */
static koksma_status add(koksma__texts *to, const char *metric)
{
    if (koksma__texts_have(to, metric)) {
        return KOKSMA_OK;
    }
    char *copy = strdup(metric);
    KOKSMA__REQUIRE_MEMORY(copy, strlen(metric));
    to->at[to->n++] = copy;
    return KOKSMA_OK;
}

static koksma_status set_block(const koksma__plan *plan, koksma__image_block *block)
{
    const koksma_metric *metric;
    const size_t named = 1 + plan->metrics.n + plan->n_questions + plan->n_conclusions;
    size_t n = 0;
    while (koksma_metric_at(n)) {
        n++;
    }
    block->metrics.at = calloc(n + named, sizeof *block->metrics.at);
    KOKSMA__REQUIRE_MEMORY(block->metrics.at, (n + named) * sizeof *block->metrics.at);
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && (metric = koksma_metric_at(i)); i++) {
        status = metric->in_all_studies ? add(&block->metrics, metric->name) : KOKSMA_OK;
    }
    status = status ? status : add(&block->metrics, plan->metric);
    for (size_t i = 0; !status && i < plan->metrics.n; i++) {
        status = add(&block->metrics, plan->metrics.at[i]);
    }
    for (size_t i = 0; !status && i < plan->n_questions; i++) {
        status = plan->questions[i].metric ? add(&block->metrics, plan->questions[i].metric) : KOKSMA_OK;
    }
    for (size_t i = 0; !status && i < plan->n_conclusions; i++) {
        const koksma__conclusion *c = &plan->conclusions[i];
        const bool is_of_block = c->metric && c->images && block->id && !strcmp(c->images, block->id);
        status = is_of_block ? add(&block->metrics, c->metric) : KOKSMA_OK;
    }
    return status;
}

static koksma_status set_metrics(const koksma__json_node *root, koksma__plan *plan)
{
    koksma_status status = KOKSMA_OK;
    for (size_t b = 0; !status && b < plan->n_images; b++) {
        status = set_block(plan, &plan->images[b]);
        KOKSMA__JSON_FAIL_IF(!status && plan->images[b].metrics.n > KOKSMA__MOST_METRICS, root,
                             "images[%zu]: %zu metrics, with those of all studies; a block of images has at most %d",
                             b, plan->images[b].metrics.n, KOKSMA__MOST_METRICS);
    }
    return status;
}

enum { MAX_SPP = 1 << 20, MAX_NAME = 64, MAX_VARIANTS = 1 << 16 };

const char *koksma_plan_name_at(size_t i)
{
    return i < sizeof embedded_texts / sizeof *embedded_texts ? embedded_texts[i].name : NULL;
}

const char *koksma__plan_shipped(const char *name, size_t *size)
{
    for (size_t i = 0; koksma_plan_name_at(i); i++) {
        if (!strcmp(embedded_texts[i].name, name)) {
            *size = embedded_texts[i].size;
            return embedded_texts[i].text;
        }
    }
    return NULL;
}

/* ---- Fields that discrepancy blocks and image blocks share ----------------------------------------------- */

/* Sets *out to a block's number of trials: the run's number if the run gives one; otherwise the block's `quick` in a
   quick run, and the block's `trials` in other runs. */
static koksma_status parse_trials(const koksma__json_node *node, const koksma__plan_trials *given, long long *out)
{
    long long quick = 0;
    koksma_status status = koksma__json_get_whole(node, "trials", true, 1, KOKSMA__MOST_TRIALS, out);
    status = status ? status : koksma__json_get_whole(node, "quick", false, 1, KOKSMA__MOST_TRIALS, &quick);
    *out = given->quick && quick ? quick : *out;
    *out = given->trials > 0 ? given->trials : *out;
    return status;
}

/* Checks that every warp exists and supports every measure, by evaluating each pair on one point. */
static koksma_status check_warps(const koksma__json_node *node, const koksma__discrepancy_block *b)
{
    double xs[] = {0.5, 0.5};
    const koksma_points point = {1, 2, xs};
    for (size_t w = 0; w < b->warps.n; w++) {
        const koksma_warp *warp = koksma_warp_find(b->warps.at[w]);
        KOKSMA__JSON_FAIL_IF(!warp, node, "no warp '%s'; 'koksma list warps' names them", b->warps.at[w]);
        for (size_t m = 0; m < b->measures.n; m++) {
            koksma_spec spec;
            koksma_value value;
            KOKSMA__JSON_FAIL_IF(koksma__integrand_of(b->measures.at[m]), node,
                                 "warps can be combined with measures only, not with integrands");
            koksma_status status = koksma_measure_spec(b->measures.at[m], &spec);
            status = status ? status : koksma_warp_evaluate(warp, &spec, &point, NULL, &value);
            if (status) {
                return koksma__json_fail_in(node, status);
            }
        }
    }
    return b->warps.n && b->dim != 2 ? koksma__json_fail(node, "warps need dim 2") : KOKSMA_OK;
}

/* Reads the members "measures" and "integrands", of which a block has one or both. */
static koksma_status parse_measures(const koksma__json_node *node, koksma__discrepancy_block *b)
{
    koksma__texts errors = {0};
    const bool integrands = koksma__json_has(node, "integrands");
    koksma_status status =
        koksma__plan_texts(node, "measures", koksma__measure_text, !integrands, false, &b->measures);
    status = status ? status : koksma__plan_texts(node, "integrands", koksma__error_text, false, false, &errors);
    status = status || !integrands ? status : koksma__plan_join(&b->measures, &errors);
    koksma__texts_fini(&errors);
    return status;
}

static koksma_status parse_discrepancy(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "id",  "patterns", "measures", "integrands", "warps",
                                       "n",       "dim", "trials",   "quick",    "skip",       NULL};
    koksma__discrepancy_block *b = item;
    long long dim = 2;
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : koksma__plan_id(node, false, &b->id);
    status = status ? status
                    : koksma__plan_texts(node, "patterns", koksma__pattern_text, true, trials->stored, &b->patterns);
    status = status ? status : parse_measures(node, b);
    status = status ? status : koksma__plan_texts(node, "warps", NULL, false, false, &b->warps);
    status = status ? status : koksma__plan_wholes(node, "n", 1, (long long)KOKSMA_MAX_COORDINATES, &b->n);
    status = status ? status : koksma__json_get_whole(node, "dim", false, 1, KOKSMA_MAX_DIM, &dim);
    status = status ? status : parse_trials(node, trials, &b->trials);
    b->dim = (int)dim;
    status = status ? status : koksma__plan_check_sets(node, trials, b);
    status = status ? status : koksma__plan_check_measures(node, b);
    return status ? status : check_warps(node, b);
}

static koksma_status parse_reference(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "name", "pattern", "spp", "replicates", NULL};
    koksma__reference *r = item;
    r->replicates = 1;
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : koksma__plan_text(node, "name", true, &r->name);
    status = status
                 ? status
                 : koksma__plan_spec(node, "pattern", koksma__image_pattern_text, true, trials->stored, &r->pattern);
    status = status ? status : koksma__json_get_whole(node, "spp", true, 1, MAX_SPP, &r->spp);
    status = status ? status : koksma__json_get_whole(node, "replicates", false, 1, 1000000, &r->replicates);
    KOKSMA__JSON_FAIL_IF(!status && strlen(r->name) > MAX_NAME, node, "the name has more than %d characters",
                         MAX_NAME);
    /* the name must not contain ':', which ends it in the keys of rows (made_by.h) */
    if (!status && strchr(r->name, ':')) {
        return koksma__json_fail(node, "the name contains ':'");
    }
    return status ? status : koksma__plan_check_reference(node, trials, r);
}

/* Checks that the scenes open; an error of a scene is reported with the plan's line. */
static koksma_status check_scenes(const koksma__json_node *node, const koksma__plan_trials *trials,
                                  const koksma__texts *scenes)
{
    koksma__json_node list;
    koksma_status status = koksma__json_member(node, "scenes", &list);
    for (size_t i = 0; !status && i < scenes->n; i++) {
        const koksma__json_node item = koksma__json_item(&list, i);
        status = koksma__scene_files_open(&trials->totals->scenes, scenes->at[i]);
        status = status ? koksma__json_fail_in(&item, status) : KOKSMA_OK;
    }
    return status;
}

static koksma_status parse_image(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "id",     "scenes", "patterns",   "spp",  "options",
                                       "size",    "trials", "quick",  "references", "skip", NULL};
    koksma__image_block *b = item;
    long long size[2] = {0};
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : koksma__plan_id(node, false, &b->id);
    status = status ? status : koksma__plan_texts(node, "scenes", NULL, true, false, &b->scenes);
    status = status ? status : check_scenes(node, trials, &b->scenes);
    status =
        status ? status
               : koksma__plan_texts(node, "patterns", koksma__image_pattern_text, true, trials->stored, &b->patterns);
    status = status ? status : koksma__plan_wholes(node, "spp", 1, MAX_SPP, &b->spp);
    status = status ? status : koksma__variants_parse(node, &b->variants);
    trials->totals->variants += b->variants.n;
    KOKSMA__JSON_FAIL_IF(!status && trials->totals->variants > MAX_VARIANTS, node,
                         "with it the blocks have more than %d combinations of options", MAX_VARIANTS);
    status = status ? status : koksma__plan_check_spp(node, trials, b);
    status = status ? status : get_wholes(node, "size", 2, 1, size);
    b->width = (int)size[0];
    b->height = (int)size[1];
    status = status ? status : parse_trials(node, trials, &b->trials);
    return status ? status
                  : koksma__plan_list(node, "references", true, sizeof *b->references, parse_reference, trials,
                                      (void **)&b->references, &b->n_references);
}

/* ---- The whole plan -------------------------------------------------------------------------------------- */

static int compare_ids(const void *a, const void *b)
{
    return strcmp(a, b);
}

static void keep_id(void *id)
{
    (void)id;
}

/* No two items of a list have the same id, by which readers of a report and of `export` tell them apart. */
static koksma_status check_ids(const koksma__json_node *root, const char *key)
{
    koksma__json_node list;
    void *ids = NULL; /* of tsearch(3): pointers to the texts of the JSON document */
    size_t n;
    if (!koksma__json_has(root, key)) {
        return KOKSMA_OK;
    }
    koksma_status status = koksma__json_member(root, key, &list);
    status = status ? status : koksma__json_length(&list, SIZE_MAX, &n);
    for (size_t i = 0; !status && i < n; i++) {
        const koksma__json_node item = koksma__json_item(&list, i);
        const char *id = NULL;
        status = koksma__json_get_text(&item, "id", true, &id);
        const char *const *known = status ? NULL : tsearch(id, &ids, compare_ids);
        status = status || known ? status : koksma__fail_memory(sizeof known);
        status =
            status || *known == id ? status : koksma__json_fail(&item, "an earlier item has the id '%s' too", id);
    }
    tdestroy(ids, keep_id);
    return status;
}

static koksma_status parse(const koksma__json_node *root, const koksma__plan_trials *trials, koksma__plan *p)
{
    static const char *const keys[] = {"comment", "name",        "title",   "about",     "discrepancies",
                                       "images",  "tables",      "figures", "questions", "metric",
                                       "metrics", "conclusions", NULL};
    koksma_status status = koksma__json_only(root, keys);
    status = status ? status : koksma__plan_text(root, "name", true, &p->name);
    status = status ? status : koksma__plan_text(root, "title", true, &p->title);
    status = status ? status : koksma__plan_text(root, "about", false, &p->about);
#define LIST(items, parser)                                                                                          \
    status = status ? status                                                                                         \
                    : koksma__plan_list(root, #items, false, sizeof *p->items, parser, trials, (void **)&p->items,   \
                                        &p->n_##items)
    LIST(discrepancies, parse_discrepancy);
    LIST(images, parse_image);
    status = status ? status : parse_metrics(root, p);
    LIST(tables, koksma__plan_table);
    LIST(figures, parse_figure);
    LIST(questions, koksma__plan_question);
    LIST(conclusions, koksma__plan_conclusion);
#undef LIST
    static const char *const with_ids[] = {"tables", "figures", "questions"};
    for (size_t i = 0; !status && !trials->stored && i < sizeof with_ids / sizeof *with_ids; i++) {
        status = check_ids(root, with_ids[i]);
    }
    status = status ? status : koksma__plan_check_questions(root, p);
    KOKSMA__JSON_FAIL_IF(!status && p->n_discrepancies + p->n_images == 0, root,
                         "the plan has neither 'discrepancies' nor 'images', so there is nothing to do");
    status = status ? status : koksma__plan_check_tables(root, p);
    status = status ? status : koksma__plan_check_conclusions(root, p);
    status = status ? status : set_metrics(root, p);
    return status ? status : koksma__plan_own(p);
}

koksma_status koksma__plan_parse(const char *name, const char *text, size_t size, const koksma__plan_trials *trials,
                                 koksma__plan *plan)
{
    koksma__plan_totals alone = {0};
    koksma__plan_trials of_plan = trials ? *trials : (koksma__plan_trials){0};
    koksma__json *document;
    of_plan.totals = of_plan.totals ? of_plan.totals : &alone;
    *plan = (koksma__plan){0};
    KOKSMA__TRY(koksma__json_open("plan", name, text, size, &document));
    const koksma__json_node root = koksma__json_root(document);
    const koksma_status status = parse(&root, &of_plan, plan);
    koksma__json_close(document);
    koksma__scene_files_fini(&alone.scenes);
    if (status) {
        koksma__plan_fini(plan);
    }
    return status;
}
