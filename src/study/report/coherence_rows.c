/* SPDX-License-Identifier: Apache-2.0 */
/* Reads the coherence rows of one pattern from the store, and applies the rule of coherence_rows.h. */
#include "study/report/coherence_rows.h"

#include <stdlib.h>

#include "study/report/means.h"
#include "study/run/references.h"

enum { STRIDE = sizeof(koksma__result) / sizeof(double) };

bool koksma__in_bands(const koksma__row_coherence *c)
{
    return 2 * c->coherent > c->mean.n;
}

const char *koksma__bands_text(const koksma__row_coherence *c)
{
    return !c->mean.n ? "not known" : koksma__in_bands(c) ? "yes" : "no";
}

koksma_status koksma__image_coherence(koksma_study *study, const koksma__image_block *block, const char *scene,
                                      const char *variant, const char *pattern, long long spp,
                                      koksma__row_coherence *out)
{
    const koksma__study_scene *s = koksma__study_scene_of(study, scene);
    char name[KOKSMA__REFERENCE_NAME];
    koksma__reference_name(&block->references[block->n_references - 1], name);
    koksma__series series = {.kind = "coherence",
                             .scene = s->name,
                             .scene_hash = s->hash,
                             .options = variant,
                             .pattern = pattern,
                             .what = name,
                             .n = spp};
    int width, height;
    koksma__block_size(block, s, &width, &height);
    series.width = width;
    series.height = height;
    koksma__result *results;
    size_t n;
    *out = (koksma__row_coherence){0};
    KOKSMA__TRY(koksma__series_results(study, &series, block->trials, &results, &n));
    out->mean = koksma__summarize_sizes(results->values, n, STRIDE);
    for (size_t i = 0; i < n; i++) {
        out->coherent += results[i].values[1] < KOKSMA_COHERENT_P && results[i].values[0] >= KOKSMA_COHERENT_LEAST;
    }
    free(results);
    return KOKSMA_OK;
}
