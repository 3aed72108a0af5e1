/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The section of a report that answers the questions of the study's plans (files that say what a study computes and
 * asks) from the results that the study has stored. A plan without tables and questions
 * gets every answer that its blocks can give, in the order of questions.def. An answer is first written into a
 * separate document; if that stays empty, the report says what the answer would need.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "study/report/metric_words.h"
#include "study/report/questions/topic.h"
#include "study/report/report.h"

typedef koksma_status (*answer)(koksma_study *study, koksma__document *d, const koksma__topic *topic);

/* The functions that answer questions, in the order of koksma__question_kinds. */
static const answer answers[] = {
#define QUESTION(name, fields, heading, rows) koksma__answer_##name,
#include "study/plan/questions.def"
#undef QUESTION
};

static bool is_shown(const koksma__report_scope *scope)
{
    bool found = scope->study->plan.n_questions > 0;
    for (size_t i = 0; i < scope->study->plan.n_parts; i++) {
        found |= !scope->study->plan.parts[i].asks;
    }
    return found;
}

static koksma_status topic_init(const koksma__plan *plan, const char *id, koksma__topic *topic)
{
    *topic = (koksma__topic){.id = id,
                             .discrepancies = calloc(plan->n_discrepancies + 1, sizeof *topic->discrepancies),
                             .images = calloc(plan->n_images + 1, sizeof *topic->images)};
    return topic->discrepancies && topic->images
               ? KOKSMA_OK
               : koksma__fail_memory((plan->n_discrepancies + plan->n_images) * sizeof *topic->images);
}

static void topic_fini(koksma__topic *topic)
{
    free(topic->discrepancies);
    free(topic->images);
}

/* Whether a block with this id belongs to a question about the blocks called `wanted` (NULL: no blocks). */
static bool is_asked(const char *wanted, const char *id)
{
    return wanted && id && !strcmp(id, wanted);
}

/* Collects the blocks of a plan that the question q names, or all blocks if q is NULL, and the metric. */
static void choose_blocks(const koksma__plan *plan, const koksma__plan_part *part, const koksma__question *q,
                          koksma__topic *topic)
{
    for (size_t b = part->discrepancies[0]; b < part->discrepancies[1]; b++) {
        if (!q || is_asked(q->discrepancies, plan->discrepancies[b].id)) {
            topic->discrepancies[topic->n_discrepancies++] = &plan->discrepancies[b];
        }
    }
    topic->metric = q && q->metric ? q->metric : part->metric;
    for (size_t b = part->images[0]; b < part->images[1]; b++) {
        if (!q || is_asked(q->images, plan->images[b].id)) {
            topic->images[topic->n_images++] = &plan->images[b];
        }
    }
}

/* Whether the answer to a kind of question depends on the metric of image errors. */
static bool names_metric(const koksma__question_kind *kind, const koksma__topic *topic)
{
    return topic->n_images && (!(kind->fields & KOKSMA__NEEDS_POINTS) || kind->fields & KOKSMA__NEEDS_IMAGES);
}

static koksma_status answer_question(koksma_study *study, koksma__document *d, const koksma__question *q)
{
    const koksma__plan *plan = &study->plan;
    koksma__topic topic;
    koksma__metric_facts facts;
    koksma__document content = {0};
    koksma_status status = topic_init(plan, q->id, &topic);
    if (!status) {
        choose_blocks(plan, &plan->parts[q->part], q, &topic);
        status = koksma__metric_facts_find(study, &topic, &facts);
    }
    if (!status) {
        char id[128];
        topic.groups = q->groups;
        topic.n_groups = q->n_groups;
        snprintf(id, sizeof id, "question-%.110s", q->id);
        koksma__doc_section_begin(d, id, false);
        koksma__doc_say(d, "(%s) %s", q->id, q->title);
        koksma__doc_section_body(d);
        status = answers[q->kind - koksma__question_kinds](study, &content, &topic);
        if (koksma__doc_is_empty(&content)) {
            koksma__doc_paragraph(d, "No answer: this needs %s.", q->kind->rows);
        } else if (names_metric(q->kind, &topic)) {
            koksma__metric_say(d, topic.metric, &facts);
        }
        koksma__doc_append(d, &content);
        koksma__doc_end(d);
    }
    topic_fini(&topic);
    return status;
}

/* Writes all answers that the blocks of a plan without questions can give. */
static koksma_status answer_all(koksma_study *study, koksma__document *d, size_t part)
{
    const koksma__plan *plan = &study->plan;
    koksma__topic topic;
    koksma__metric_facts facts;
    size_t number = 0;
    koksma_status status = topic_init(plan, "", &topic);
    if (!status) {
        choose_blocks(plan, &plan->parts[part], NULL, &topic);
        status = koksma__metric_facts_find(study, &topic, &facts);
    }
    for (size_t k = 0; !status && k < sizeof answers / sizeof *answers; k++) {
        const koksma__question_kind *kind = &koksma__question_kinds[k];
        koksma__document content = {0};
        char id[48]; /* the number of an answer: "1.2" for answer 2 of plan 1, or "2" if there is only one plan */
        if (kind->fields & KOKSMA__ASKED_BY_NAME) {
            continue;
        }
        snprintf(id, sizeof id, "%zu.%zu", part + 1, ++number);
        topic.id = plan->n_parts > 1 ? id : strchr(id, '.') + 1;
        status = answers[k](study, &content, &topic);
        if (!koksma__doc_is_empty(&content)) {
            koksma__doc_section(d, NULL, kind->heading);
            if (names_metric(kind, &topic)) {
                koksma__metric_say(d, topic.metric, &facts);
            }
            koksma__doc_append(d, &content);
            koksma__doc_end(d);
        }
    }
    topic_fini(&topic);
    return status;
}

static koksma_status write(const koksma__report_scope *scope, koksma__document *d)
{
    const koksma__plan *plan = &scope->study->plan;
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < plan->n_questions; i++) {
        status = koksma__keep_going(scope->study->report, (double)i / (double)plan->n_questions)
                     ? answer_question(scope->study, d, &plan->questions[i])
                     : koksma__fail_interrupted();
    }
    for (size_t i = 0; !status && i < plan->n_parts; i++) {
        if (plan->parts[i].asks) {
            continue;
        }
        if (plan->n_parts > 1) {
            koksma__doc_section_begin(d, NULL, false);
            koksma__doc_say(d, "Results: %s", plan->parts[i].title);
            koksma__doc_section_body(d);
        }
        status = answer_all(scope->study, d, i);
        if (plan->n_parts > 1) {
            koksma__doc_end(d);
        }
    }
    return status;
}

const koksma__section koksma__section_questions = {"Questions and answers", false, is_shown, write};
