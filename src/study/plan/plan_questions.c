/* SPDX-License-Identifier: Apache-2.0 */
/* The questions of a plan. */
#include <string.h>

#include "study/plan/plan_owned.h"
#include "study/plan/plan_section.h"

static const char *const kinds[KOKSMA__ASK_KINDS] = {"correlation", "slopes", "equal",
                                                     "options",     "table",  "inequality"};

static koksma_status parse_group(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "title", "scenes", NULL};
    (void)trials;
    koksma__scene_group *g = item;
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : koksma__plan_text(node, "title", true, &g->title);
    return status ? status : koksma__plan_texts(node, "scenes", &g->scenes);
}

koksma_status koksma__plan_question(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "id", "title", "kind", "discrepancies", "images", "groups", NULL};
    koksma__question *q = item;
    const char *kind;
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : koksma__plan_id(node, true, &q->id);
    status = status ? status : koksma__plan_text(node, "title", true, &q->title);
    status = status ? status : koksma__plan_text(node, "discrepancies", false, &q->discrepancies);
    status = status ? status : koksma__plan_text(node, "images", false, &q->images);
    status = status ? status : koksma__json_get_text(node, "kind", true, &kind);
    for (int k = 0; !status; k++) {
        if (k == KOKSMA__ASK_KINDS) {
            return koksma__json_fail(
                node, "kind '%s': it takes correlation, slopes, equal, options, table or inequality", kind);
        }
        if (!strcmp(kinds[k], kind)) {
            q->kind = (koksma__question_kind)k;
            break;
        }
    }
    const bool needs_images = q->kind == KOKSMA__ASK_CORRELATION || q->kind == KOKSMA__ASK_EQUAL;
    const bool needs_sets = q->kind == KOKSMA__ASK_CORRELATION || q->kind == KOKSMA__ASK_INEQUALITY;
    if (!status &&
        ((needs_images && !q->images) || (needs_sets && !q->discrepancies) || (!q->images && !q->discrepancies))) {
        status = koksma__json_fail(node, "a question of kind %s needs %s", kind,
                                   q->kind == KOKSMA__ASK_CORRELATION ? "discrepancies and images"
                                   : needs_images                     ? "images"
                                   : needs_sets                       ? "discrepancies"
                                                                      : "discrepancies or images");
    }
    if (!status && q->kind != KOKSMA__ASK_CORRELATION && koksma__json_has(node, "groups")) {
        koksma__json_node groups;
        koksma__json_member(node, "groups", &groups);
        status = koksma__json_fail(&groups, "only a question of kind correlation takes it");
    }
    return status ? status
                  : koksma__plan_list(node, "groups", false, sizeof *q->groups, parse_group, trials,
                                      (void **)&q->groups, &q->n_groups);
}

/* Whether a block of images that the question names has the scene. */
static bool has_scene(const koksma__plan *p, const koksma__question *q, const char *scene)
{
    for (size_t b = 0; b < p->n_images; b++) {
        const koksma__image_block *i = &p->images[b];
        if (i->id && !strcmp(i->id, q->images) && koksma__texts_have(&i->scenes, scene)) {
            return true;
        }
    }
    return false;
}

/* Every group has a title of its own and scenes of the question's blocks. */
static koksma_status check_groups(const koksma__json_node *question, const koksma__plan *p, const koksma__question *q)
{
    koksma__json_node list, scenes;
    koksma_status status = q->n_groups ? koksma__json_member(question, "groups", &list) : KOKSMA_OK;
    for (size_t g = 0; !status && g < q->n_groups; g++) {
        const koksma__json_node group = koksma__json_item(&list, g);
        for (size_t before = 0; before < g; before++) {
            if (!strcmp(q->groups[before].title, q->groups[g].title)) {
                return koksma__json_fail(&group, "title '%s': another group has it", q->groups[g].title);
            }
        }
        status = koksma__json_member(&group, "scenes", &scenes);
        for (size_t s = 0; !status && s < q->groups[g].scenes.n; s++) {
            if (!has_scene(p, q, q->groups[g].scenes.at[s])) {
                const koksma__json_node item = koksma__json_item(&scenes, s);
                status = koksma__json_fail(&item, "no block of images '%s' has the scene '%s'", q->images,
                                           q->groups[g].scenes.at[s]);
            }
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
        if (!discrepancies || !images) {
            return koksma__json_fail(&node, "no block of the plan has the id '%s'",
                                     discrepancies ? q->images : q->discrepancies);
        }
        const koksma_status status = check_groups(&node, p, q);
        if (status) {
            return status;
        }
    }
    return KOKSMA_OK;
}
