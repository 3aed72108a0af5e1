/* SPDX-License-Identifier: Apache-2.0 */
/*
 * bands: the errors of the patterns are in visible bands, and those of the patterns of `against` are not, in the images
 * of the tables or blocks. Each pattern in each image is a test, by the coherence of the mean spectrum
 * (mean_coherence.h), which is the rule of the whole report.
 */
#include <math.h>
#include <string.h>

#include "study/report/conclusions/conclusion.h"
#include "study/report/mean_coherence.h"

static koksma_status test_pattern(koksma_study *study, koksma__document *d, const koksma__conclusion *c,
                                  koksma__image_mean of, bool expected, koksma__tested *tested)
{
    koksma_coherence_values v;
    const koksma_status status = koksma__mean_coherence(study, &of, &v);
    if (!status && !v.images) {
        tested->open++;
    } else if (!status) {
        koksma__test(tested, v.coherent == expected);
        koksma__doc_say(d, "%s %.3g (%.2g)%s; ", koksma__conclusion_label(study, c, of.pattern), v.coherence,
                        v.noise_high,
                        v.coherent == expected ? ""
                        : expected             ? ", no bands"
                                               : ", in bands");
    }
    return status;
}

static koksma_status test_images(koksma_study *study, koksma__document *d, const koksma__conclusion *c,
                                 koksma__image_mean of, koksma__tested *tested)
{
    koksma_status status = KOKSMA_OK;
    koksma__doc_say(d, "_%s_: ", of.scene);
    for (size_t i = 0; !status && i < c->patterns.n + c->against.n; i++) {
        const bool expected = i < c->patterns.n;
        of.pattern = expected ? c->patterns.at[i] : c->against.at[i - c->patterns.n];
        status = test_pattern(study, d, c, of, expected, tested);
    }
    return status;
}

/* Tests all images of the blocks that the conclusion names. */
static koksma_status test_blocks(koksma_study *study, koksma__document *d, const koksma__conclusion *c,
                                 koksma__tested *tested)
{
    const koksma__plan_part *part = &study->plan.parts[c->part];
    koksma_status status = KOKSMA_OK;
    for (size_t b = part->images[0]; c->images && b < part->images[1]; b++) {
        const koksma__image_block *block = &study->plan.images[b];
        const size_t sizes = block->spp.n, variants = block->variants.n;
        const bool is_named = block->id && !strcmp(block->id, c->images);
        for (size_t i = 0; is_named && !status && i < block->scenes.n * sizes * variants; i++) {
            const koksma__image_mean of = {block, block->scenes.at[i / sizes / variants],
                                           block->variants.at[i % variants], NULL,
                                           block->spp.at[i / variants % sizes]};
            status = test_images(study, d, c, of, tested);
        }
    }
    return status;
}

koksma_status koksma__conclude_bands(koksma_study *study, koksma__document *d, const koksma__conclusion *c,
                                     koksma__tested *tested)
{
    koksma_status status = KOKSMA_OK;
    koksma__doc_say(d, "Coherence (noise below), ");
    for (size_t i = 0; !status && i < c->tables.n; i++) {
        const koksma__table *t = koksma__conclusion_table(study, c, c->tables.at[i]);
        const koksma__image_mean of = {koksma__table_images(study, t), t->scene, "", NULL, t->n.at[0]};
        status = test_images(study, d, c, of, tested);
    }
    status = status ? status : test_blocks(study, d, c, tested);
    koksma__doc_say(d, "%zu of %zu as concluded.", tested->passed, tested->tests);
    return status;
}
