/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The section of a report that answers the questions of the study's plans (files that say what a study computes and
 * asks) from the results that the study has stored. A plan without tables and questions
 * gets every answer that its blocks can give, in the order of questions.def. An answer is first written into a
 * separate document; if that stays empty, the report says what the answer would need. Before an answer that depends on
 * the metric of image errors stands what a reader must know of that metric.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "study/report/report.h"

/* The functions that answer questions, in the order of koksma__question_kinds. */
static void (*const answers[])(koksma__report *, koksma__document *, const koksma__topic *) = {
#define QUESTION(name, fields, heading, rows) koksma__answer_##name,
#include "study/plan/questions.def"
#undef QUESTION
};

/* ---- The metric -------------------------------------------------------------------------------------------- */

/* The mean errors of a topic's images in the metric that ranks its patterns. */
typedef struct metric_facts {
    size_t images, measured; /* numbers of images of the topic, and of those with a row of the metric */
    size_t means,
        few; /* numbers of means with that metric, and of those in which a few pixels carry most of the error */
    /* the mean in which they carry most */
    char name[KOKSMA__VARIANT_TEXT + 64];
    const char *pattern;
    long long spp;
    koksma__metric_means worst;
} metric_facts;

static metric_facts find_facts(koksma__report *r, const koksma__topic *topic)
{
    metric_facts f = {.pattern = ""};
    koksma__subject s;
    for (size_t i = 0; !r->status && koksma__topic_subject(topic, i, false, &s); i++) {
        for (size_t k = 0; s.images && !r->status && k < s.patterns->n * s.n->n; k++) {
            const char *pattern = s.patterns->at[k / s.n->n];
            const long long spp = s.n->at[k % s.n->n];
            const koksma__metric_means means = koksma__read_metric(r, &s, pattern, spp, topic->metric);
            koksma__subject by_default = s;
            by_default.metric = KOKSMA__DEFAULT_METRIC;
            f.images += koksma__read_mean(r, &by_default, pattern, spp, NULL).n;
            f.measured += means.value.n;
            f.means += means.value.n > 0;
            f.few += means.top_share.n && means.top_share.mean >= KOKSMA_FEW_PIXELS;
            if (means.top_share.n && !(means.top_share.mean <= f.worst.top_share.mean)) {
                f.worst = means;
                f.pattern = pattern;
                f.spp = spp;
                memcpy(f.name, s.name, sizeof f.name);
            }
        }
    }
    return f;
}

/* Writes a paragraph that names the metric; and, where they apply, one on images without it and a warning of means that a
   few pixels decide. */
static void say_metric(koksma__document *d, const char *metric, const metric_facts *f)
{
    koksma_metric_spec spec;
    koksma__doc_paragraph(d, "Images are compared, and patterns ranked, by `%s`: %s.", metric,
                          koksma_metric_parse(metric, &spec) ? "" : spec.metric->title);
    if (f->measured < f->images) {
        koksma__doc_say(d,
                        " It is not measured in %zu of %zu images, whose rows are older than its mention in the "
                        "plan; the next run renders these again and adds it.",
                        f->images - f->measured, f->images);
    }
    if (f->few) {
        koksma__doc_warning(
            d,
            "Warning: 0.1 %% of the pixels carry most of the error in %zu of %zu means, and decide the order there. "
            "They carry most in %s with %lld sample%s of %s: %.0f %% of the error; without them `%s` is %.4g instead "
            "of %.4g. A metric that weighs them less, such as `smape`, may give another order.",
            f->few, f->means, f->name, f->spp, koksma__plural((double)f->spp), f->pattern,
            100 * f->worst.top_share.mean, metric, f->worst.robust.mean, f->worst.value.mean);
    }
}

/* Whether the answer to a kind of question depends on the metric of image errors. */
static bool names_metric(const koksma__plan_kind *kind, const koksma__topic *topic)
{
    return topic->n_images && (!(kind->fields & KOKSMA__NEEDS_POINTS) || kind->fields & KOKSMA__NEEDS_IMAGES);
}

/* ---- Topics ------------------------------------------------------------------------------------------------ */

/* Whether a block with this id belongs to a question about the blocks called `wanted` (NULL: no blocks). */
static bool is_asked(const char *wanted, const char *id)
{
    return wanted && id && !strcmp(id, wanted);
}

/* Collects the blocks of a plan that the question q names, or all blocks if q is NULL, and the metric. Returns false after
   a failure. */
static bool choose_blocks(koksma__report *r, const koksma__plan_part *part, const koksma__question *q,
                          koksma__topic *topic)
{
    const koksma__plan *plan = &r->study->plan;
    *topic = (koksma__topic){.id = q ? q->id : "",
                             .metric = q && q->metric ? q->metric : part->metric,
                             .n_groups = q ? q->n_groups : 0,
                             .groups = q ? q->groups : NULL,
                             .discrepancies =
                                 koksma__report_memory(r, plan->n_discrepancies, sizeof(koksma__discrepancy_block *)),
                             .images = koksma__report_memory(r, plan->n_images, sizeof(koksma__image_block *))};
    for (size_t b = part->discrepancies[0]; !r->status && b < part->discrepancies[1]; b++) {
        if (!q || is_asked(q->discrepancies, plan->discrepancies[b].id)) {
            topic->discrepancies[topic->n_discrepancies++] = &plan->discrepancies[b];
        }
    }
    for (size_t b = part->images[0]; !r->status && b < part->images[1]; b++) {
        if (!q || is_asked(q->images, plan->images[b].id)) {
            topic->images[topic->n_images++] = &plan->images[b];
        }
    }
    return !r->status;
}

/* Writes the answer to a question; q NULL: to what a plan without questions may ask, if its blocks can answer it. */
static void answer(koksma__report *r, koksma__document *d, const koksma__plan_kind *kind, const koksma__question *q,
                   const koksma__topic *topic, const metric_facts *facts)
{
    koksma__document content = {0};
    char id[128];
    answers[kind - koksma__question_kinds](r, &content, topic);
    const bool empty = koksma__doc_is_empty(&content);
    if (q) {
        snprintf(id, sizeof id, "question-%.110s", q->id);
        koksma__doc_section(d, id, "(%s) %s", q->id, q->title);
    } else if (!empty) {
        koksma__doc_section(d, NULL, "%s", kind->heading);
    } else {
        return;
    }
    if (empty) {
        koksma__doc_paragraph(d, "No answer: this needs %s.", kind->rows);
    } else if (names_metric(kind, topic)) {
        say_metric(d, topic->metric, facts);
    }
    koksma__doc_append(d, &content);
    koksma__doc_end(d);
}

/* Writes all answers that the blocks of a plan without questions can give. */
static void answer_all(koksma__report *r, koksma__document *d, size_t part)
{
    const koksma__plan *plan = &r->study->plan;
    koksma__topic topic;
    if (!choose_blocks(r, &plan->parts[part], NULL, &topic)) {
        return;
    }
    const metric_facts facts = find_facts(r, &topic);
    for (size_t k = 0; !r->status && k < sizeof answers / sizeof *answers; k++) {
        char id[48]; /* the number of an answer: "1.2" for answer 2 of plan 1, or "2" if there is only one plan */
        snprintf(id, sizeof id, "%zu.%zu", part + 1, k + 1);
        topic.id = plan->n_parts > 1 ? id : strchr(id, '.') + 1;
        answer(r, d, &koksma__question_kinds[k], NULL, &topic, &facts);
    }
}

static void write_questions(koksma__report *r, koksma__document *d)
{
    const koksma__plan *plan = &r->study->plan;
    for (size_t i = 0; i < plan->n_questions; i++) {
        const koksma__question *q = &plan->questions[i];
        koksma__topic topic;
        if (!r->status && !koksma__keep_going(r->run, (double)i / (double)plan->n_questions)) {
            koksma__report_keep(r, koksma__fail_interrupted());
        }
        if (choose_blocks(r, &plan->parts[q->part], q, &topic)) {
            const metric_facts facts = find_facts(r, &topic);
            answer(r, d, q->kind, q, &topic, &facts);
        }
        koksma__report_release(r);
    }
    for (size_t i = 0; !r->status && i < plan->n_parts; i++) {
        if (plan->parts[i].asks) {
            continue;
        }
        if (plan->n_parts > 1) {
            koksma__doc_section(d, NULL, "Results: %s", plan->parts[i].title);
        }
        answer_all(r, d, i);
        if (plan->n_parts > 1) {
            koksma__doc_end(d);
        }
    }
}

const koksma__section koksma__section_questions = {"Questions and answers", false, write_questions};
