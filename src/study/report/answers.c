/* SPDX-License-Identifier: Apache-2.0 */
#include "study/report/answers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/run/references.h"

/* ---- What the store has -------------------------------------------------------------------------------- */

/* sets: of point sets, not of images, which a pattern without other sets makes differ all the same. */
static koksma_status mean_of(koksma_study *study, const koksma__series *series, bool sets, long long trials,
                             koksma__result **results, koksma__summary *mean)
{
    koksma__result *found;
    size_t n;
    const koksma_status status = koksma__series_results(study, series, trials, &found, &n);
    if (status) {
        return status;
    }
    *mean = sets ? koksma__summarize_sets(series->pattern, found, n)
                 : koksma__summarize(found->values, n, KOKSMA__RESULT_STRIDE);
    if (results) {
        *results = found;
    } else {
        free(found);
    }
    return KOKSMA_OK;
}

koksma_status koksma__discrepancy_mean(koksma_study *study, const koksma__discrepancy_block *block, const char *warp,
                                       const char *pattern, long long n, const char *measure,
                                       koksma__result **results, koksma__summary *mean)
{
    const koksma__series series = {.kind = "discrepancy",
                                   .scene = "",
                                   .scene_hash = "",
                                   .options = warp,
                                   .pattern = pattern,
                                   .what = measure,
                                   .n = n,
                                   .dim = block->dim};
    return mean_of(study, &series, true, block->trials, results, mean);
}

koksma_status koksma__image_mean(koksma_study *study, const koksma__image_block *block, const char *scene,
                                 const char *variant, const char *pattern, long long spp, koksma__result **results,
                                 koksma__summary *mean)
{
    const koksma__study_scene *s = koksma__study_scene_of(study, scene);
    char name[KOKSMA__REFERENCE_NAME];
    int width, height;
    koksma__block_size(block, s, &width, &height);
    koksma__reference_name(&block->references[block->n_references - 1], name);
    const koksma__series series = {.kind = "image",
                                   .scene = s->name,
                                   .scene_hash = s->hash,
                                   .options = variant,
                                   .pattern = pattern,
                                   .what = name,
                                   .n = spp,
                                   .width = width,
                                   .height = height};
    return mean_of(study, &series, false, block->trials, results, mean);
}

void koksma__case_name(const char *scene, const char *variant, char *text, size_t size)
{
    snprintf(text, size, "%s%s%s", scene, variant[0] ? ", " : "", variant);
}

koksma_status koksma__add_reference(koksma_study *study, koksma__html *h, const koksma__image_block *block,
                                    const char *scene, const char *variant)
{
    size_t index;
    double own = NAN;
    char name[KOKSMA__REFERENCE_NAME];
    const size_t last = block->n_references - 1;
    const koksma__reference *r = &block->references[last];
    koksma_status status =
        koksma__reference_index(study, block, koksma__study_scene_of(study, scene), variant, last, &index);
    if (!status) {
        const koksma__series key = koksma__reference_key(&study->references[index], name);
        status = koksma__store_reference(study->store, &key, &own);
    }
    koksma__html_add(h, "<p>Mean absolute errors against the reference <em>");
    koksma__html_text(h, r->name);
    koksma__html_add(h, "</em>, the mean of %lld renders with %lld samples a pixel of ", r->replicates, r->spp);
    koksma__html_text(h, r->pattern);
    if (isfinite(own)) {
        koksma__html_add(h, "; its own error is about %.2g", own);
    } else {
        koksma__html_add(h, "; its own error is not known");
    }
    koksma__html_add(h, ". Up to %lld trials.%s</p>\n", block->trials,
                     last ? " Those against the plan's other references are among the exported rows." : "");
    return status;
}

koksma__estimate koksma__estimate_of(const koksma__summary *s)
{
    return (koksma__estimate){s->mean, s->low, s->high};
}

/* ---- Questions ----------------------------------------------------------------------------------------- */

typedef koksma_status (*answer)(koksma_study *study, koksma__html *html, const koksma__topic *topic);

static const answer answers[KOKSMA__ASK_KINDS] = {
    [KOKSMA__ASK_CORRELATION] = koksma__answer_correlation,
    [KOKSMA__ASK_SLOPES] = koksma__answer_slopes,
    [KOKSMA__ASK_EQUAL] = koksma__answer_equal,
    [KOKSMA__ASK_OPTIONS] = koksma__answer_options,
    [KOKSMA__ASK_TABLE] = koksma__answer_table,
    [KOKSMA__ASK_INEQUALITY] = koksma__answer_inequality,
};

/* What each kind takes. */
static const char *const needs[KOKSMA__ASK_KINDS] = {
    [KOKSMA__ASK_CORRELATION] = "4 patterns with points and images of one number, whose means differ",
    [KOKSMA__ASK_SLOPES] = "a block of two sizes or more",
    [KOKSMA__ASK_EQUAL] = "a block of images with 16 samples a pixel and another number of them",
    [KOKSMA__ASK_OPTIONS] = "a block of images with two combinations of options, or of points with two warps",
    [KOKSMA__ASK_TABLE] = "a block of points or of images",
    [KOKSMA__ASK_INEQUALITY] = "a block of up to 4096 points in 1 or 2 dimensions",
};

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

/* Whether a question about blocks called `wanted` (NULL: none) is about a block of this id. */
static bool is_asked(const char *wanted, const char *id)
{
    return wanted && id && !strcmp(id, wanted);
}

/* A part's blocks, those that the question (NULL: all) names. */
static void choose_blocks(const koksma__plan *plan, const koksma__plan_part *part, const koksma__question *q,
                          koksma__topic *topic)
{
    for (size_t b = part->discrepancies[0]; b < part->discrepancies[1]; b++) {
        if (!q || is_asked(q->discrepancies, plan->discrepancies[b].id)) {
            topic->discrepancies[topic->n_discrepancies++] = &plan->discrepancies[b];
        }
    }
    for (size_t b = part->images[0]; b < part->images[1]; b++) {
        if (!q || is_asked(q->images, plan->images[b].id)) {
            topic->images[topic->n_images++] = &plan->images[b];
        }
    }
}

static koksma_status ask(koksma_study *study, koksma__html *html, const koksma__question *q)
{
    const koksma__plan *plan = &study->plan;
    koksma__topic topic;
    koksma_status status = topic_init(plan, q->id, &topic);
    if (!status) {
        choose_blocks(plan, &plan->parts[q->part], q, &topic);
        topic.groups = q->groups;
        topic.n_groups = q->n_groups;
        koksma__html_add(html, "<h3");
        koksma__html_id(html, "question", q->id);
        koksma__html_add(html, ">(%s) ", q->id);
        koksma__html_text(html, q->title);
        koksma__html_add(html, "</h3>\n");
        const size_t heading = html->size;
        status = answers[q->kind](study, html, &topic);
        if (html->size == heading) {
            koksma__html_add(html, "<p>No answer: these blocks lack what it takes, %s.</p>\n", needs[q->kind]);
        }
    }
    topic_fini(&topic);
    return status;
}

/* A plan that asks nothing gets what its blocks can answer; Koksma's inequality is not of their rows. */
static koksma_status ask_all(koksma_study *study, koksma__html *html, size_t part)
{
    static const char *const titles[KOKSMA__ASK_KINDS] = {"Which measure orders the patterns as the error does?",
                                                          "How fast does it fall?",
                                                          "How many samples are as good?",
                                                          "What do the options change?",
                                                          "Means",
                                                          "Koksma's inequality"};
    static const koksma__question_kind order[] = {KOKSMA__ASK_TABLE, KOKSMA__ASK_CORRELATION, KOKSMA__ASK_SLOPES,
                                                  KOKSMA__ASK_EQUAL, KOKSMA__ASK_OPTIONS};
    const koksma__plan *plan = &study->plan;
    koksma__topic topic;
    koksma_status status = topic_init(plan, "", &topic);
    if (!status) {
        choose_blocks(plan, &plan->parts[part], NULL, &topic);
    }
    for (size_t k = 0; !status && k < sizeof order / sizeof *order; k++) {
        char id[48]; /* in the CSV files' names: "2", and "1.2" of the first of several plans */
        snprintf(id, sizeof id, "%zu.%zu", part + 1, k + 1);
        topic.id = plan->n_parts > 1 ? id : strchr(id, '.') + 1;
        const size_t before = html->size;
        koksma__html_add(html, "<h3>%s</h3>\n", titles[order[k]]);
        const size_t heading = html->size;
        status = answers[order[k]](study, html, &topic);
        if (html->size == heading && !html->failed) { /* nothing to say */
            html->size = before;
            html->text[before] = '\0';
        }
    }
    topic_fini(&topic);
    return status;
}

/* Those of a plan that is one of several say of which. */
static void add_heading(koksma__html *html, const koksma__plan *plan, size_t part)
{
    if (plan->n_parts == 1) {
        koksma__html_add(html, "<h2 id=\"results\">Results</h2>\n");
        return;
    }
    koksma__html_add(html, "<h2 id=\"results-%zu\">Results: ", part + 1);
    koksma__html_text(html, plan->parts[part].title);
    koksma__html_add(html, "</h2>\n");
}

koksma_status koksma__report_questions(koksma_study *study, koksma__html *html)
{
    const koksma__plan *plan = &study->plan;
    koksma_status status = KOKSMA_OK;
    if (plan->n_questions) {
        koksma__html_add(html, "<h2 id=\"questions\">Questions</h2>\n");
    }
    for (size_t i = 0; !status && i < plan->n_questions; i++) {
        status = ask(study, html, &plan->questions[i]);
    }
    for (size_t i = 0; !status && i < plan->n_parts; i++) {
        if (!plan->parts[i].asks) {
            add_heading(html, plan, i);
            status = ask_all(study, html, i);
        }
    }
    return status;
}
