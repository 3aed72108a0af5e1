/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads and checks the conclusions of a plan: what a paper concludes, in words, and the kind of test of it, with the
 * tables or blocks whose rows decide it and the patterns that it is about. The table of kinds, conclusions.def, defines
 * which members a kind needs. What a conclusion names is checked after the whole plan has been read.
 */
#include <stdio.h>
#include <string.h>

#include "core/status.h"
#include "study/plan/plan.h"
#include "study/plan/plan_read.h"
#include "study/plan/variants.h"

const koksma__conclusion_kind koksma__conclusion_kinds[] = {
#define CONCLUSION(name, fields) {#name, fields},
#include "study/plan/conclusions.def"
#undef CONCLUSION
    {0}};

static koksma_status parse_kind(const koksma__json_node *node, koksma__conclusion *c)
{
    const char *name;
    char names[256] = "";
    const koksma_status status = koksma__json_get_text(node, "kind", true, &name);
    for (c->kind = koksma__conclusion_kinds; !status && c->kind->name; c->kind++) {
        if (!strcmp(c->kind->name, name)) {
            return KOKSMA_OK;
        }
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", names[0] ? ", " : "", c->kind->name);
    }
    return status ? status : koksma__json_fail(node, "kind '%s': it takes one of %s", name, names);
}

/* The members that some kinds need. Tables replace images where a kind takes images. */
static koksma_status check_fields(const koksma__json_node *node, const koksma__conclusion *c)
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

static koksma_status parse_list(const koksma__json_node *node, const char *key, koksma__spec_parser parser,
                                bool stored, koksma__texts *out)
{
    return koksma__json_has(node, key) ? koksma__plan_patterns(node, key, parser, stored, out) : KOKSMA_OK;
}

koksma_status koksma__plan_conclusion(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "says",    "kind",          "tables", "by",       "images",
                                       "metric",  "against", "discrepancies", "remark", "patterns", "beside",
                                       "figures", NULL};
    koksma__conclusion *c = item;
    const bool stored = trials->stored;
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : koksma__plan_text(node, "says", true, &c->says);
    status = status ? status : koksma__plan_text(node, "remark", false, &c->remark);
    status = status ? status : koksma__plan_text(node, "images", false, &c->images);
    status = status ? status : koksma__plan_text(node, "discrepancies", false, &c->discrepancies);
    status = status ? status : koksma__plan_spec(node, "metric", koksma__metric_text, false, &c->metric);
    status = status ? status : parse_list(node, "tables", NULL, stored, &c->tables);
    status = status ? status : parse_list(node, "by", NULL, stored, &c->by);
    status = status ? status : parse_list(node, "figures", NULL, stored, &c->figures);
    status = status ? status : parse_list(node, "against", koksma__image_pattern_text, stored, &c->against);
    status = status ? status : parse_list(node, "beside", koksma__image_pattern_text, stored, &c->beside);
    status =
        status ? status : koksma__plan_patterns(node, "patterns", koksma__image_pattern_text, stored, &c->patterns);
    status = status ? status : parse_kind(node, c);
    return status ? status : check_fields(node, c);
}

/* ---- Whether the plan has what a conclusion names ---------------------------------------------------------- */

static koksma_status check_tables(const koksma__json_node *node, const koksma__plan_trials *trials,
                                  const koksma__plan *p, const koksma__texts *ids, unsigned fields)
{
    for (size_t i = 0; i < ids->n; i++) {
        const koksma__table *t = koksma__plan_table_of(p, 0, ids->at[i]);
        KOKSMA__TRY(koksma__plan_step(node, trials, 1 + p->n_tables));
        KOKSMA__JSON_FAIL_IF(!t, node, "no table of the plan has the id '%s'", ids->at[i]);
        KOKSMA__JSON_FAIL_IF(fields & KOKSMA__NEEDS_IMAGES && !t->scene, node, "table %s is not one of a scene",
                             ids->at[i]);
        KOKSMA__JSON_FAIL_IF(fields & KOKSMA__NEEDS_SIZES && !koksma__table_is_over_n(t), node,
                             "table %s has one number of points", ids->at[i]);
    }
    return KOKSMA_OK;
}

/* Checks that every pattern has a row in every table; in some: in one of them. */
static koksma_status check_rows(const koksma__json_node *node, const koksma__plan_trials *trials,
                                const koksma__plan *p, const koksma__texts *ids, const koksma__texts *patterns,
                                bool in_some)
{
    for (size_t i = 0, found = 0; i < ids->n * patterns->n; i++) {
        const koksma__table *t = koksma__plan_table_of(p, 0, ids->at[i % ids->n]);
        KOKSMA__TRY(koksma__plan_step(node, trials, 1 + p->n_tables + t->n_rows));
        found = (i % ids->n ? found : 0) + (koksma__plan_row_of(t, patterns->at[i / ids->n]) != NULL);
        KOKSMA__JSON_FAIL_IF(in_some ? i % ids->n + 1 == ids->n && !found : found <= i % ids->n, node,
                             "table %s has no row of %s", t->id, patterns->at[i / ids->n]);
    }
    return KOKSMA_OK;
}

/* Checks that figures are of adaptive methods and come in pairs. */
static koksma_status check_figures(const koksma__json_node *node, const koksma__plan_trials *trials,
                                   const koksma__plan *p, const koksma__texts *ids)
{
    for (size_t i = 0; i < ids->n; i++) {
        const koksma__figure *f = koksma__plan_figure_of(p, 0, ids->at[i]);
        KOKSMA__TRY(koksma__plan_step(node, trials, 1 + p->n_figures));
        KOKSMA__JSON_FAIL_IF(!f || !f->adaptive, node, "no figure with the id '%s' has an adaptive method",
                             ids->at[i]);
    }
    return ids->n % 2 ? koksma__json_fail(node, "figures come in pairs") : KOKSMA_OK;
}

/* Checks that every block of the id has all patterns, and that there is one. */
static koksma_status check_blocks(const koksma__json_node *node, const koksma__plan_trials *trials,
                                  const koksma__plan *p, const koksma__conclusion *c, const koksma__texts *patterns)
{
    const char *id = c->images ? c->images : c->discrepancies;
    const size_t n = c->images ? p->n_images : p->n_discrepancies;
    bool found = !id;
    for (size_t b = 0; b < n && id; b++) {
        const char *of = c->images ? p->images[b].id : p->discrepancies[b].id;
        const koksma__texts *has = c->images ? &p->images[b].patterns : &p->discrepancies[b].patterns;
        KOKSMA__TRY(koksma__plan_step(node, trials, 1 + patterns->n * has->n));
        for (size_t i = 0; of && !strcmp(of, id) && i < patterns->n; i++) {
            KOKSMA__JSON_FAIL_IF(!koksma__texts_have(has, patterns->at[i]), node, "a block '%s' lacks the pattern %s",
                                 id, patterns->at[i]);
        }
        found |= of && !strcmp(of, id);
    }
    return found ? KOKSMA_OK : koksma__json_fail(node, "no block of the plan has the id '%s'", id);
}

koksma_status koksma__plan_check_conclusions(const koksma__json_node *root, const koksma__plan_trials *trials,
                                             const koksma__plan *p)
{
    koksma__json_node list;
    koksma_status status = p->n_conclusions ? koksma__json_member(root, "conclusions", &list) : KOKSMA_OK;
    for (size_t i = 0; !status && i < p->n_conclusions; i++) {
        const koksma__conclusion *c = &p->conclusions[i];
        const koksma__json_node node = koksma__json_item(&list, i);
        const koksma__texts *all[] = {&c->patterns, &c->against, &c->beside};
        const unsigned fields = c->kind->fields, sizes = fields & KOKSMA__NEEDS_SIZES;
        status = check_tables(&node, trials, p, &c->tables,
                              fields & KOKSMA__NEEDS_AGAINST ? 0
                              : sizes                        ? sizes
                                                             : KOKSMA__NEEDS_IMAGES);
        status = status ? status : check_tables(&node, trials, p, &c->by, sizes);
        status = status ? status : check_figures(&node, trials, p, &c->figures);
        for (size_t k = 0; !status && k < 3; k++) {
            status = check_rows(&node, trials, p, &c->tables, all[k], sizes);
            status = status ? status : check_rows(&node, trials, p, &c->by, all[k], false);
            status = status ? status : check_blocks(&node, trials, p, c, all[k]);
        }
    }
    return status;
}
