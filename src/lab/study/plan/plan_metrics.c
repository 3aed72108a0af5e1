/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The metrics of a plan. The member `metric` names the metric that ranks patterns, and `metrics` lists further
 * metrics; a question may name another metric for its ranking. Every image block evaluates the metrics that all
 * studies evaluate (in_all_studies) and all that the plan names, so that any of them can rank the patterns in a
 * later report of the same rows. A metric that takes long in comparison with a render, such as FLIP, is evaluated
 * only if the plan names it.
 */
#include <stdlib.h>
#include <string.h>

#include <koksma/image.h>

#include "core/status.h"
#include "study/plan/plan.h"
#include "study/plan/plan_read.h"

koksma_status koksma__metric_text(const char *text, char out[KOKSMA_MAX_SPEC])
{
    koksma_metric_spec spec;
    const koksma_status status = koksma_metric_parse(text, &spec);
    if (!status) {
        koksma_metric_text(&spec, out);
    }
    return status;
}

koksma_status koksma__plan_metrics(const koksma__json_node *root, koksma__plan *plan)
{
    static const char *const keys[] = {"metric", "metrics"};
    koksma_status status = koksma__plan_spec(root, "metric", koksma__metric_text, false, &plan->metric);
    if (!status && koksma__json_has(root, "metrics")) {
        status = koksma__plan_texts(root, "metrics", koksma__metric_text, &plan->metrics);
    }
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

koksma_status koksma__plan_set_metrics(const koksma__json_node *root, koksma__plan *plan)
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
