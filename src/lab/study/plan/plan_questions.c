/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads and checks the questions of a plan. A question has an id, a title, a kind, the ids of the blocks that it
 * is about, perhaps the metric that ranks its patterns and, for some kinds, groups of scenes. The table of kinds,
 * questions.def, defines which members a kind needs or takes. The blocks and scenes that a question names are checked
 * after the whole plan has been read, because a plan may list blocks after questions.
 */
#include <stdio.h>
#include <string.h>

#include <koksma/study.h>

#include "core/status.h"
#include "study/plan/plan.h"
#include "study/plan/plan_read.h"

const koksma__question_kind koksma__question_kinds[] = {
#define QUESTION(name, fields, heading, rows) {#name, fields, heading, rows},
#include "study/plan/questions.def"
#undef QUESTION
    {0}};

static koksma_status parse_group(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "title", "scenes", NULL};
    (void)trials;
    koksma__scene_group *g = item;
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : koksma__plan_text(node, "title", true, &g->title);
    return status ? status : koksma__plan_texts(node, "scenes", NULL, &g->scenes);
}

/* Writes the names of all kinds as "table, correlation, ... or inequality". */
static void list_kinds(char *text, size_t size)
{
    size_t used = 0;
    for (const koksma__question_kind *k = koksma__question_kinds; k->name && used < size; k++) {
        const char *before = k == koksma__question_kinds ? "" : k[1].name ? ", " : " or ";
        used += (size_t)snprintf(text + used, size - used, "%s%s", before, k->name);
    }
}

static koksma_status parse_kind(const koksma__json_node *node, koksma__question *q)
{
    const char *name;
    char names[256];
    const koksma_status status = koksma__json_get_text(node, "kind", true, &name);
    for (q->kind = koksma__question_kinds; !status && q->kind->name; q->kind++) {
        if (!strcmp(q->kind->name, name)) {
            return KOKSMA_OK;
        }
    }
    list_kinds(names, sizeof names);
    return status ? status : koksma__json_fail(node, "kind '%s': it takes %s", name, names);
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
    status = status ? status : koksma__plan_spec(node, "metric", koksma__metric_text, false, &q->metric);
    status = status ? status : parse_kind(node, q);
    status = status ? status : check_fields(node, q);
    return status ? status
                  : koksma__plan_list(node, "groups", false, sizeof *q->groups, parse_group, trials,
                                      (void **)&q->groups, &q->n_groups);
}

/* Finds whether an image block that the question names has the scene. */
static koksma_status find_scene(const koksma__json_node *node, const koksma__plan_trials *trials,
                                const koksma__plan *p, const koksma__question *q, const char *scene, bool *found)
{
    *found = false;
    for (size_t b = 0; b < p->n_images && !*found; b++) {
        const koksma__image_block *i = &p->images[b];
        const bool is_meant = i->id && !strcmp(i->id, q->images);
        *found = is_meant && koksma__texts_have(&i->scenes, scene);
        KOKSMA__TRY(koksma__plan_step(node, trials, 1 + (is_meant ? i->scenes.n : 0)));
    }
    return KOKSMA_OK;
}

/* Checks that no two groups have the same title and that all their scenes are in the question's blocks. */
static koksma_status check_groups(const koksma__json_node *question, const koksma__plan_trials *trials,
                                  const koksma__plan *p, const koksma__question *q)
{
    koksma__json_node list, scenes;
    koksma_status status = q->n_groups ? koksma__json_member(question, "groups", &list) : KOKSMA_OK;
    for (size_t g = 0; !status && g < q->n_groups; g++) {
        const koksma__json_node group = koksma__json_item(&list, g);
        for (size_t before = 0; before < g; before++) {
            KOKSMA__JSON_FAIL_IF(!strcmp(q->groups[before].title, q->groups[g].title), &group,
                                 "title '%s': another group has the same title", q->groups[g].title);
        }
        KOKSMA__TRY(koksma__plan_step(&group, trials, g));
        status = koksma__json_member(&group, "scenes", &scenes);
        for (size_t s = 0; !status && s < q->groups[g].scenes.n; s++) {
            const koksma__json_node item = koksma__json_item(&scenes, s);
            bool found;
            status = find_scene(&item, trials, p, q, q->groups[g].scenes.at[s], &found);
            if (!status && !found) {
                status = koksma__json_fail(&item, "no block of images '%s' has the scene '%s'", q->images,
                                           q->groups[g].scenes.at[s]);
            }
        }
    }
    return status;
}

koksma_status koksma__plan_check_questions(const koksma__json_node *root, const koksma__plan_trials *trials,
                                           const koksma__plan *p)
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
        KOKSMA__TRY(koksma__plan_step(&node, trials, p->n_discrepancies + p->n_images));
        KOKSMA__JSON_FAIL_IF(!discrepancies || !images, &node, "no block of the plan has the id '%s'",
                             discrepancies ? q->images : q->discrepancies);
        KOKSMA__TRY(check_groups(&node, trials, p, q));
    }
    return KOKSMA_OK;
}

bool koksma_question_at(size_t i, koksma_entry *out)
{
    KOKSMA__REQUIRE_OR(false, out);
    const koksma__question_kind *k = koksma__question_kinds;
    while (k->name && i-- > 0) {
        k++;
    }
    *out = (koksma_entry){.name = k->name, .title = k->heading};
    return k->name;
}
