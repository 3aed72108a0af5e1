/* SPDX-License-Identifier: Apache-2.0 */
/*
 * metric: the images of the first pattern have a larger error than those of the first of `against`, by a metric such as
 * grain, in every scene of the block. Each scene is a test: the ratio of the means, with an interval from those of both
 * by first-order propagation, must be surely above 1.
 */
#include <math.h>
#include <string.h>

#include "study/report/conclusions/conclusion.h"
#include "study/report/means.h"

static koksma_status test_scene(koksma_study *study, koksma__document *d, const koksma__conclusion *c,
                                koksma__image_mean of, koksma__tested *tested)
{
    koksma__summary x = {0}, y = {0};
    of.pattern = c->patterns.at[0];
    KOKSMA__TRY(koksma__image_mean_by(study, &of, c->metric, NULL, &x));
    of.pattern = c->against.at[0];
    KOKSMA__TRY(koksma__image_mean_by(study, &of, c->metric, NULL, &y));
    if (x.n < 2 || y.n < 2) {
        tested->open++;
        return KOKSMA_OK;
    }
    const double ratio = x.mean / y.mean;
    const double half = ratio * hypot((x.high - x.mean) / x.mean, (y.high - y.mean) / y.mean);
    koksma__test(tested, ratio - half > 1);
    koksma__doc_say(d, "%s%.3g (%.3g to %.3g) in %s", tested->tests > 1 ? "; " : "", ratio, ratio - half,
                    ratio + half, of.scene);
    return KOKSMA_OK;
}

koksma_status koksma__conclude_metric(koksma_study *study, koksma__document *d, const koksma__conclusion *c,
                                      koksma__tested *tested)
{
    const koksma__plan_part *part = &study->plan.parts[c->part];
    koksma_status status = KOKSMA_OK;
    koksma__doc_say(d, "`%s` of %s over that of %s: ", c->metric,
                    koksma__conclusion_label(study, c, c->patterns.at[0]),
                    koksma__conclusion_label(study, c, c->against.at[0]));
    for (size_t b = part->images[0]; b < part->images[1]; b++) {
        const koksma__image_block *block = &study->plan.images[b];
        const size_t variants = block->variants.n, sizes = block->spp.n;
        const bool is_named = c->images && block->id && !strcmp(block->id, c->images);
        for (size_t i = 0; is_named && !status && i < block->scenes.n * variants * sizes; i++) {
            const koksma__image_mean of = {block, block->scenes.at[i / variants / sizes],
                                           block->variants.at[i % variants], NULL,
                                           block->spp.at[i / variants % sizes]};
            status = test_scene(study, d, c, of, tested);
        }
    }
    koksma__doc_say(d, ".");
    return status;
}
