/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads and checks the questions and the conclusions of a plan. A question has an id, a title, a kind, the ids of the
 * blocks that it is about, perhaps the metric that ranks its patterns and, for some kinds, groups of scenes. A conclusion
 * has what a paper concludes, in words, and the kind of test of it, with the tables or blocks whose rows decide it and the
 * patterns that it is about. The tables of kinds, questions.def and conclusions.def, define which members a kind needs or
 * takes. What they name is checked after the whole plan has been read, because a plan may list blocks after questions.
 */
#include <stdio.h>
#include <string.h>

#include <koksma/study.h>

#include "core/status.h"
#include "study/plan/plan.h"
#include "study/plan/plan_read.h"
#include "study/plan/variants.h"

const koksma__plan_kind koksma__question_kinds[] = {
#define QUESTION(name, fields, heading, rows) {#name, fields, heading, rows},
#include "study/plan/questions.def"
#undef QUESTION
    {0}};

const koksma__plan_kind koksma__conclusion_kinds[] = {
#define CONCLUSION(name, fields) {#name, fields, NULL, NULL},
#include "study/plan/conclusions.def"
#undef CONCLUSION
    {0}};

/* Reads the member "kind"; the error names all of them as "table, correlation, ... or options". */
static koksma_status parse_kind(const koksma__json_node *node, const koksma__plan_kind *kinds,
                                const koksma__plan_kind **out)
{
    const char *name;
    char names[256] = "";
    KOKSMA__TRY(koksma__json_get_text(node, "kind", true, &name));
    for (*out = kinds; (*out)->name; ++*out) {
        if (!strcmp((*out)->name, name)) {
            return KOKSMA_OK;
        }
        const size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%s",
                 *out == kinds    ? ""
                 : (*out)[1].name ? ", "
                                  : " or ",
                 (*out)->name);
    }
    return koksma__json_fail(node, "kind '%s': it takes %s", name, names);
}

/* ---- Questions --------------------------------------------------------------------------------------------- */

static koksma_status parse_group(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "title", "scenes", NULL};
    (void)trials;
    koksma__scene_group *g = item;
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : koksma__plan_text(node, "title", true, &g->title);
    return status ? status : koksma__plan_texts(node, "scenes", NULL, true, false, &g->scenes);
}

/* Fails unless the question has the members that its kind needs, and no member that its kind does not take. */
static koksma_status check_fields(const koksma__json_node *node, const koksma__question *q)
{
    const bool points = q->kind->fields & KOKSMA__NEEDS_POINTS, images = q->kind->fields & KOKSMA__NEEDS_IMAGES;
    KOKSMA__JSON_FAIL_IF((images && !q->images) || (points && !q->discrepancies) || (!q->images && !q->discrepancies),
                         node, "a question of kind %s needs %s", q->kind->name,
                         points && images ? "discrepancies and images"
                         : images         ? "images"
                         : points         ? "discrepancies"
                                          : "discrepancies or images");
    KOKSMA__JSON_FAIL_IF(q->metric && !q->images, node, "a question with a metric needs images");
    if (!(q->kind->fields & KOKSMA__TAKES_GROUPS) && koksma__json_has(node, "groups")) {
        koksma__json_node groups;
        koksma__json_member(node, "groups", &groups);
        return koksma__json_fail(&groups, "a question of kind %s takes no groups", q->kind->name);
    }
    return KOKSMA_OK;
}

koksma_status koksma__plan_question(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "id",     "title",  "kind", "discrepancies",
                                       "images",  "groups", "metric", NULL};
    koksma__question *q = item;
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : koksma__plan_id(node, true, &q->id);
    status = status ? status : koksma__plan_text(node, "title", true, &q->title);
    status = status ? status : koksma__plan_text(node, "discrepancies", false, &q->discrepancies);
    status = status ? status : koksma__plan_text(node, "images", false, &q->images);
    status = status ? status : koksma__plan_spec(node, "metric", koksma__metric_text, false, false, &q->metric);
    status = status ? status : parse_kind(node, koksma__question_kinds, &q->kind);
    status = status ? status : check_fields(node, q);
    return status ? status
                  : koksma__plan_list(node, "groups", false, sizeof *q->groups, parse_group, trials,
                                      (void **)&q->groups, &q->n_groups);
}

/* Whether an image block that the question names has the scene. */
static bool has_scene(const koksma__plan *p, const koksma__question *q, const char *scene)
{
    bool found = false;
    for (size_t b = 0; b < p->n_images && !found; b++) {
        const koksma__image_block *i = &p->images[b];
        found = i->id && !strcmp(i->id, q->images) && koksma__texts_have(&i->scenes, scene);
    }
    return found;
}

/* Checks that no two groups have the same title and that all their scenes are in the question's blocks. */
static koksma_status check_groups(const koksma__json_node *question, const koksma__plan *p, const koksma__question *q)
{
    koksma__json_node list, scenes;
    koksma_status status = q->n_groups ? koksma__json_member(question, "groups", &list) : KOKSMA_OK;
    for (size_t g = 0; !status && g < q->n_groups; g++) {
        const koksma__json_node group = koksma__json_item(&list, g);
        for (size_t before = 0; before < g; before++) {
            KOKSMA__JSON_FAIL_IF(!strcmp(q->groups[before].title, q->groups[g].title), &group,
                                 "title '%s': another group has the same title", q->groups[g].title);
        }
        status = koksma__json_member(&group, "scenes", &scenes);
        for (size_t s = 0; !status && s < q->groups[g].scenes.n; s++) {
            const koksma__json_node item = koksma__json_item(&scenes, s);
            KOKSMA__JSON_FAIL_IF(!has_scene(p, q, q->groups[g].scenes.at[s]), &item,
                                 "no block of images '%s' has the scene '%s'", q->images, q->groups[g].scenes.at[s]);
        }
    }
    return status;
}

koksma_status koksma__plan_check_questions(const koksma__json_node *root, const koksma__plan *p)
{
    for (size_t i = 0; i < p->n_questions; i++) {
        const koksma__question *q = &p->questions[i];
        bool discrepancies = !q->discrepancies, images = !q->images;
        for (size_t b = 0; b < p->n_discrepancies; b++) {
            const char *id = p->discrepancies[b].id;
            discrepancies |= id && q->discrepancies && !strcmp(id, q->discrepancies);
        }
        for (size_t b = 0; b < p->n_images; b++) {
            images |= p->images[b].id && q->images && !strcmp(p->images[b].id, q->images);
        }
        koksma__json_node questions;
        koksma__json_member(root, "questions", &questions);
        const koksma__json_node node = koksma__json_item(&questions, i);
        KOKSMA__JSON_FAIL_IF(!discrepancies || !images, &node, "no block of the plan has the id '%s'",
                             discrepancies ? q->images : q->discrepancies);
        KOKSMA__TRY(check_groups(&node, p, q));
    }
    return KOKSMA_OK;
}

bool koksma_question_at(size_t i, koksma_entry *out)
{
    KOKSMA__REQUIRE_OR(false, out);
    const koksma__plan_kind *k = koksma__question_kinds;
    while (k->name && i-- > 0) {
        k++;
    }
    *out = (koksma_entry){.name = k->name, .title = k->heading};
    return k->name;
}

/* ---- Conclusions ------------------------------------------------------------------------------------------- */

/* The members that some kinds need. Tables replace images where a kind takes images. */
static koksma_status check_members(const koksma__json_node *node, const koksma__conclusion *c)
{
    const struct {
        unsigned field;
        bool has;
        const char *name;
    } members[] = {{KOKSMA__NEEDS_TABLES, c->tables.n, "tables"},
                   {KOKSMA__NEEDS_SIZES, c->tables.n, "tables"},
                   {KOKSMA__NEEDS_FIGURES, c->figures.n, "figures"},
                   {KOKSMA__NEEDS_BY, c->by.n, "by"},
                   {KOKSMA__NEEDS_AGAINST, c->against.n, "against"},
                   {KOKSMA__NEEDS_METRIC, c->metric, "metric"},
                   {KOKSMA__NEEDS_POINTS, c->discrepancies, "discrepancies"},
                   {KOKSMA__NEEDS_IMAGES, c->images || c->tables.n, "images or tables"}};
    for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
        KOKSMA__JSON_FAIL_IF((c->kind->fields & members[i].field) && !members[i].has, node,
                             "a conclusion of kind %s needs %s", c->kind->name, members[i].name);
    }
    return KOKSMA_OK;
}

koksma_status koksma__plan_conclusion(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "says",     "kind",   "tables",  "by",
                                       "than",    "images",   "metric", "against", "discrepancies",
                                       "remark",  "patterns", "beside", "figures", NULL};
    koksma__conclusion *c = item;
    const bool stored = trials->stored;
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : koksma__plan_text(node, "says", true, &c->says);
    status = status ? status : koksma__plan_text(node, "remark", false, &c->remark);
    status = status ? status : koksma__plan_text(node, "images", false, &c->images);
    status = status ? status : koksma__plan_text(node, "discrepancies", false, &c->discrepancies);
    status = status ? status : koksma__plan_spec(node, "metric", koksma__metric_text, false, false, &c->metric);
    status = status ? status : koksma__plan_texts(node, "tables", NULL, false, stored, &c->tables);
    status = status ? status : koksma__plan_texts(node, "by", NULL, false, stored, &c->by);
    status = status ? status : koksma__plan_texts(node, "than", NULL, false, stored, &c->than);
    status = status ? status : koksma__plan_texts(node, "figures", NULL, false, stored, &c->figures);
    status =
        status ? status : koksma__plan_texts(node, "against", koksma__image_pattern_text, false, stored, &c->against);
    status =
        status ? status : koksma__plan_texts(node, "beside", koksma__image_pattern_text, false, stored, &c->beside);
    status = status ? status
                    : koksma__plan_texts(node, "patterns", koksma__image_pattern_text, true, stored, &c->patterns);
    status = status ? status : parse_kind(node, koksma__conclusion_kinds, &c->kind);
    return status ? status : check_members(node, c);
}

/* ---- Whether the plan has what a conclusion names ---------------------------------------------------------- */

static koksma_status check_tables(const koksma__json_node *node, const koksma__plan *p, const koksma__texts *ids,
                                  unsigned fields)
{
    for (size_t i = 0; i < ids->n; i++) {
        const koksma__table *t = koksma__plan_table_of(p, 0, ids->at[i]);
        KOKSMA__JSON_FAIL_IF(!t, node, "no table of the plan has the id '%s'", ids->at[i]);
        KOKSMA__JSON_FAIL_IF(fields & KOKSMA__NEEDS_IMAGES && !t->scene, node, "table %s is not one of a scene",
                             ids->at[i]);
        KOKSMA__JSON_FAIL_IF(fields & KOKSMA__NEEDS_SIZES && !koksma__table_is_over_n(t), node,
                             "table %s has one number of points", ids->at[i]);
    }
    return KOKSMA_OK;
}

/* Checks that every pattern has a row in every table; in some: in one of them. */
static koksma_status check_rows(const koksma__json_node *node, const koksma__plan *p, const koksma__texts *ids,
                                const koksma__texts *patterns, bool in_some)
{
    for (size_t i = 0, found = 0; i < ids->n * patterns->n; i++) {
        const koksma__table *t = koksma__plan_table_of(p, 0, ids->at[i % ids->n]);
        found = (i % ids->n ? found : 0) + (koksma__plan_row_of(t, patterns->at[i / ids->n]) != NULL);
        KOKSMA__JSON_FAIL_IF(in_some ? i % ids->n + 1 == ids->n && !found : found <= i % ids->n, node,
                             "table %s has no row of %s", t->id, patterns->at[i / ids->n]);
    }
    return KOKSMA_OK;
}

/* Checks that figures are of adaptive methods and come in pairs. */
static koksma_status check_figures(const koksma__json_node *node, const koksma__plan *p, const koksma__texts *ids)
{
    for (size_t i = 0; i < ids->n; i++) {
        const koksma__figure *f = koksma__plan_figure_of(p, 0, ids->at[i]);
        KOKSMA__JSON_FAIL_IF(!f || !f->adaptive, node, "no figure with the id '%s' has an adaptive method",
                             ids->at[i]);
    }
    return ids->n % 2 ? koksma__json_fail(node, "figures come in pairs") : KOKSMA_OK;
}

/* Checks that every block of the id has all patterns, and that there is one. */
static koksma_status check_blocks(const koksma__json_node *node, const koksma__plan *p, const koksma__conclusion *c,
                                  const koksma__texts *patterns)
{
    const char *id = c->images ? c->images : c->discrepancies;
    const size_t n = c->images ? p->n_images : p->n_discrepancies;
    bool found = !id;
    for (size_t b = 0; b < n && id; b++) {
        const char *of = c->images ? p->images[b].id : p->discrepancies[b].id;
        const koksma__texts *has = c->images ? &p->images[b].patterns : &p->discrepancies[b].patterns;
        for (size_t i = 0; of && !strcmp(of, id) && i < patterns->n; i++) {
            KOKSMA__JSON_FAIL_IF(!koksma__texts_have(has, patterns->at[i]), node, "a block '%s' lacks the pattern %s",
                                 id, patterns->at[i]);
        }
        found |= of && !strcmp(of, id);
    }
    return found ? KOKSMA_OK : koksma__json_fail(node, "no block of the plan has the id '%s'", id);
}

koksma_status koksma__plan_check_conclusions(const koksma__json_node *root, const koksma__plan *p)
{
    koksma__json_node list;
    koksma_status status = p->n_conclusions ? koksma__json_member(root, "conclusions", &list) : KOKSMA_OK;
    for (size_t i = 0; !status && i < p->n_conclusions; i++) {
        const koksma__conclusion *c = &p->conclusions[i];
        const koksma__json_node node = koksma__json_item(&list, i);
        const koksma__texts *all[] = {&c->patterns, &c->against, &c->beside};
        const unsigned fields = c->kind->fields, sizes = fields & KOKSMA__NEEDS_SIZES;
        status = check_tables(&node, p, &c->tables,
                              fields & KOKSMA__NEEDS_AGAINST ? 0
                              : sizes                        ? sizes
                                                             : KOKSMA__NEEDS_IMAGES);
        status = status ? status : check_tables(&node, p, &c->by, sizes);
        status = status ? status : check_tables(&node, p, &c->than, sizes);
        status = status ? status : check_figures(&node, p, &c->figures);
        for (size_t k = 0; !status && k < 3; k++) {
            status = check_rows(&node, p, &c->tables, all[k], sizes);
            status = status ? status : check_rows(&node, p, &c->by, all[k], false);
            status = status ? status : check_rows(&node, p, &c->than, all[k], false);
            status = status ? status : check_blocks(&node, p, c, all[k]);
        }
    }
    return status;
}
