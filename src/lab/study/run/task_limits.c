/* SPDX-License-Identifier: Apache-2.0 */
/* A plan of kilobytes may list thousands of patterns and of sizes, each pair of which is a task. The limits are far above
   what studies need that end: an image of each of 2^18 tasks that takes a second takes three days of one processor. */
#include "study/run/task_limits.h"

#include "core/status.h"

/* The maximum sums over all blocks of a plan. A task takes some hundred bytes, a series as many and a row of the store,
   a reference over a kilobyte. */
static const long long MOST_TASKS = 1 << 18, MOST_SERIES = 1 << 21, MOST_REFERENCES = 1 << 16;

koksma_status koksma__task_limits_check(const koksma_study *study)
{
    const koksma__plan *plan = &study->plan;
    double tasks = 0, series = 0, references = 0;
    for (size_t i = 0; i < plan->n_discrepancies; i++) {
        const koksma__discrepancy_block *b = &plan->discrepancies[i];
        const double sets = (double)(b->warps.n ? b->warps.n : 1) * (double)b->patterns.n * (double)b->n.n;
        tasks += sets;
        series += sets * (double)b->measures.n;
    }
    for (size_t i = 0; i < plan->n_images; i++) {
        const koksma__image_block *b = &plan->images[i];
        const double views = (double)b->scenes.n * (double)b->variants.n, n = (double)b->n_references;
        const double images = views * (double)b->patterns.n * (double)b->spp.n;
        tasks += images;
        series += images * (n + 1 + (double)b->metrics.n);
        references += views * n;
    }
    const bool checked = !study->sink;
    KOKSMA__FAIL_IF(checked && tasks > (double)MOST_TASKS, KOKSMA_ARGUMENT,
                    "plan '%s': more than %lld combinations of patterns, sizes, warps, scenes and options",
                    plan->name, MOST_TASKS);
    KOKSMA__FAIL_IF(checked && series > (double)MOST_SERIES, KOKSMA_ARGUMENT,
                    "plan '%s': more than %lld combinations of these with measures, references and metrics",
                    plan->name, MOST_SERIES);
    KOKSMA__FAIL_IF(checked && references > (double)MOST_REFERENCES, KOKSMA_ARGUMENT,
                    "plan '%s': more than %lld images for reference", plan->name, MOST_REFERENCES);
    return KOKSMA_OK;
}
