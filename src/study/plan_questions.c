/* SPDX-License-Identifier: Apache-2.0 */
/* The questions of a plan. */
#include <string.h>

#include "study/plan_parts.h"

static const char *const kinds[KOKSMA__ASK_KINDS] = {"correlation", "slopes", "equal",
                                                     "options",     "table",  "inequality"};

koksma_status koksma__plan_question(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "id", "title", "kind", "discrepancies", "images", NULL};
    (void)trials;
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
        if (!discrepancies || !images) {
            koksma__json_node questions;
            koksma__json_member(root, "questions", &questions);
            const koksma__json_node node = koksma__json_item(&questions, i);
            return koksma__json_fail(&node, "no block of the plan has the id '%s'",
                                     discrepancies ? q->images : q->discrepancies);
        }
    }
    return KOKSMA_OK;
}
