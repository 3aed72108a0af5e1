/* SPDX-License-Identifier: Apache-2.0 */
/* Reads the mean errors of a topic's images in the metric that ranks its patterns (one mean for each scene,
   combination of options, pattern and number of samples), and writes what a reader must know of the metric before
   the answers. */
#include "study/report/metric_words.h"

#include <string.h>

static koksma_status add_mean(koksma_study *study, const koksma__topic *topic, const koksma__image_mean *of,
                              koksma__metric_facts *facts)
{
    koksma__metric_means means;
    koksma__summary images;
    koksma_status status = koksma__image_metric(study, of, topic->metric, &means);
    status = status ? status : koksma__image_mean_by(study, of, KOKSMA__DEFAULT_METRIC, NULL, &images);
    if (status) {
        return status;
    }
    facts->images += images.n;
    facts->measured += means.value.n;
    facts->means += means.value.n > 0;
    facts->few += means.top_share.n && means.top_share.mean >= KOKSMA_FEW_PIXELS;
    if (means.top_share.n && !(means.top_share.mean <= facts->worst.top_share.mean)) {
        facts->worst = means;
        facts->scene = of->scene;
        facts->variant = of->variant;
        facts->pattern = of->pattern;
        facts->spp = of->spp;
    }
    return KOKSMA_OK;
}

koksma_status koksma__metric_facts_find(koksma_study *study, const koksma__topic *topic, koksma__metric_facts *out)
{
    koksma_status status = KOKSMA_OK;
    *out = (koksma__metric_facts){.scene = ""};
    for (size_t b = 0; b < topic->n_images; b++) {
        const koksma__image_block *i = topic->images[b];
        const size_t cells = i->patterns.n * i->spp.n;
        for (size_t k = 0; !status && k < i->scenes.n * i->variants.n * cells; k++) {
            const koksma__image_mean of = {.block = i,
                                           .scene = i->scenes.at[k / (i->variants.n * cells)],
                                           .variant = i->variants.at[k / cells % i->variants.n],
                                           .pattern = i->patterns.at[k / i->spp.n % i->patterns.n],
                                           .spp = i->spp.at[k % i->spp.n]};
            status = add_mean(study, topic, &of, out);
        }
    }
    return status;
}

static void warn(koksma__document *d, const char *metric, const koksma__metric_facts *facts)
{
    char name[KOKSMA__VARIANT_TEXT + 64];
    koksma__case_name(facts->scene, facts->variant, name, sizeof name);
    koksma__doc_warning_begin(d);
    koksma__doc_say(
        d,
        "Warning: 0.1 %% of the pixels carry most of the error in %zu of %zu means, and decide the order "
        "there. They carry most in %s with %lld sample%s of %s: %.0f %% of the error; without them `%s` is "
        "%.4g instead of %.4g. A metric that weighs them less, such as `smape`, may give another order.",
        facts->few, facts->means, name, facts->spp, koksma__plural((double)facts->spp), facts->pattern,
        100 * facts->worst.top_share.mean, metric, facts->worst.robust.mean, facts->worst.value.mean);
    koksma__doc_paragraph_end(d);
}

void koksma__metric_say(koksma__document *d, const char *metric, const koksma__metric_facts *facts)
{
    koksma_metric_spec spec;
    koksma__doc_metric_begin(d, metric);
    koksma__doc_say(d, "Images are compared, and patterns ranked, by `%s`: %s.", metric,
                    koksma_metric_parse(metric, &spec) ? "" : spec.metric->title);
    if (facts->measured < facts->images) {
        koksma__doc_say(
            d,
            " It is not measured in %zu of %zu images, whose rows are older than its mention in the plan; the "
            "next run renders these again and adds it.",
            facts->images - facts->measured, facts->images);
    }
    koksma__doc_paragraph_end(d);
    if (facts->few) {
        warn(d, metric, facts);
    }
}
