/* SPDX-License-Identifier: Apache-2.0 */
/* Reads a study's plan from JSON (studies/README.md lists the fields) and checks everything in it before any work
   starts. */
#define _GNU_SOURCE /* tdestroy */
#include "study/plan/plan.h"

#include <search.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/render.h>
#include <koksma/study.h>
#include <koksma/warp.h>

#include "core/status.h"
#include "study/plan/plan_read.h"
#include "study/plan/plans_embedded.h"
#include "study/plan/variants.h"
#include "json/json.h"

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
    koksma_status status = KOKSMA_OK;
    const bool integrands = koksma__json_has(node, "integrands");
    if (!integrands || koksma__json_has(node, "measures")) {
        status = koksma__plan_texts(node, "measures", koksma__measure_text, &b->measures);
    }
    if (!status && integrands) {
        status = koksma__plan_texts(node, "integrands", koksma__error_text, &errors);
        status = status ? status : koksma__plan_join(&b->measures, &errors);
    }
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
    status =
        status ? status : koksma__plan_patterns(node, "patterns", koksma__pattern_text, trials->stored, &b->patterns);
    status = status ? status : parse_measures(node, b);
    if (!status && koksma__json_has(node, "warps")) {
        status = koksma__plan_texts(node, "warps", NULL, &b->warps);
    }
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
    status =
        status ? status
               : koksma__plan_pattern(node, "pattern", koksma__image_pattern_text, true, trials->stored, &r->pattern);
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
    koksma_scene *scene;
    koksma_status status = koksma__json_member(node, "scenes", &list);
    for (size_t i = 0; !status && i < scenes->n; i++) {
        const koksma__json_node item = koksma__json_item(&list, i);
        status = koksma__scene_files_open(&trials->totals->scenes, scenes->at[i], &scene);
        status = status ? koksma__json_fail_in(&item, status) : KOKSMA_OK;
    }
    return status;
}

static koksma_status parse_size(const koksma__json_node *node, koksma__image_block *b)
{
    koksma__json_node size;
    size_t length;
    long long sides[2];
    if (!koksma__json_has(node, "size")) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_member(node, "size", &size));
    KOKSMA__TRY(koksma__json_length(&size, SIZE_MAX, &length));
    KOKSMA__JSON_FAIL_IF(length != 2, &size, "it takes 2 numbers, but has %zu items", length);
    for (size_t i = 0; i < 2; i++) {
        const koksma__json_node side = koksma__json_item(&size, i);
        KOKSMA__TRY(koksma__json_whole(&side, 1, KOKSMA_MAX_IMAGE_SIDE, &sides[i]));
    }
    b->width = (int)sides[0];
    b->height = (int)sides[1];
    return KOKSMA_OK;
}

static koksma_status parse_image(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "id",     "scenes", "patterns",   "spp",  "options",
                                       "size",    "trials", "quick",  "references", "skip", NULL};
    koksma__image_block *b = item;
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : koksma__plan_id(node, false, &b->id);
    status = status ? status : koksma__plan_texts(node, "scenes", NULL, &b->scenes);
    status = status ? status : check_scenes(node, trials, &b->scenes);
    status = status
                 ? status
                 : koksma__plan_patterns(node, "patterns", koksma__image_pattern_text, trials->stored, &b->patterns);
    status = status ? status : koksma__plan_wholes(node, "spp", 1, MAX_SPP, &b->spp);
    status = status ? status : koksma__variants_parse(node, &b->variants);
    trials->totals->variants += b->variants.n;
    KOKSMA__JSON_FAIL_IF(!status && trials->totals->variants > MAX_VARIANTS, node,
                         "with it the blocks have more than %d combinations of options", MAX_VARIANTS);
    status = status ? status : koksma__plan_check_spp(node, trials, b);
    status = status ? status : parse_size(node, b);
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
    static const char *const keys[] = {"comment",       "name",    "title",       "about",   "order",
                                       "discrepancies", "images",  "tables",      "figures", "questions",
                                       "metric",        "metrics", "conclusions", NULL};
    koksma_status status = koksma__json_only(root, keys);
    status = status ? status : koksma__plan_text(root, "name", true, &p->name);
    status = status ? status : koksma__plan_text(root, "title", true, &p->title);
    status = status ? status : koksma__plan_text(root, "about", false, &p->about);
    status = status ? status : koksma__plan_text(root, "order", false, &p->order);
    status = status ? status
                    : koksma__plan_list(root, "discrepancies", false, sizeof *p->discrepancies, parse_discrepancy,
                                        trials, (void **)&p->discrepancies, &p->n_discrepancies);
    status = status ? status
                    : koksma__plan_list(root, "images", false, sizeof *p->images, parse_image, trials,
                                        (void **)&p->images, &p->n_images);
    status = status ? status : koksma__plan_metrics(root, p);
    status = status ? status
                    : koksma__plan_list(root, "tables", false, sizeof *p->tables, koksma__plan_table, trials,
                                        (void **)&p->tables, &p->n_tables);
    status = status ? status
                    : koksma__plan_list(root, "figures", false, sizeof *p->figures, koksma__plan_figure, trials,
                                        (void **)&p->figures, &p->n_figures);
    status = status ? status
                    : koksma__plan_list(root, "questions", false, sizeof *p->questions, koksma__plan_question, trials,
                                        (void **)&p->questions, &p->n_questions);
    status = status ? status
                    : koksma__plan_list(root, "conclusions", false, sizeof *p->conclusions, koksma__plan_conclusion,
                                        trials, (void **)&p->conclusions, &p->n_conclusions);
    static const char *const with_ids[] = {"tables", "figures", "questions"};
    for (size_t i = 0; !status && !trials->stored && i < sizeof with_ids / sizeof *with_ids; i++) {
        status = check_ids(root, with_ids[i]);
    }
    status = status ? status : koksma__plan_check_questions(root, trials, p);
    KOKSMA__JSON_FAIL_IF(!status && p->n_discrepancies + p->n_images == 0, root,
                         "the plan has neither 'discrepancies' nor 'images', so there is nothing to do");
    status = status ? status : koksma__plan_check_tables(root, trials, p);
    status = status ? status : koksma__plan_check_figures(root, trials, p);
    status = status ? status : koksma__plan_check_conclusions(root, trials, p);
    status = status ? status : koksma__plan_set_metrics(root, p);
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
