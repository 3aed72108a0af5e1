/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Answers how many samples of each pattern give the error that 16 samples of the block's first pattern give. The
 * number is interpolated in log-log between the plan's numbers of samples, or extrapolated beyond them
 * (koksma__samples_for); its interval follows from the standard errors of the means.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/status.h"
#include "stats/stats.h"
#include "study/report/means.h"
#include "study/report/questions/topic.h"

enum { EQUAL_TO = 16 };

/* A scene of a block, with its options. */
typedef struct compared {
    const koksma__image_block *image;
    const char *scene, *variant, *metric;
} compared;

/* Reads the mean errors of a pattern over the block's numbers of samples. n, mean, error: arrays of that many
   numbers. */
static koksma_status convergence(koksma_study *study, const compared *c, const char *pattern, double *n, double *mean,
                                 double *error, koksma__convergence *out)
{
    koksma_status status = KOKSMA_OK;
    *out = (koksma__convergence){n, mean, error, 0};
    for (size_t k = 0; !status && k < c->image->spp.n; k++) {
        koksma__summary s;
        const koksma__image_mean of = {c->image, c->scene, c->variant, pattern, c->image->spp.at[k]};
        status = koksma__image_mean_by(study, &of, c->metric, NULL, &s);
        if (!status && s.n && s.mean > 0) {
            n[out->count] = (double)c->image->spp.at[k];
            mean[out->count] = s.mean;
            error[out->count++] = s.sd / sqrt((double)s.n);
        }
    }
    return status;
}

static koksma_status add_equal(koksma_study *study, koksma__document *d, const compared *c)
{
    const koksma__texts *patterns = &c->image->patterns;
    const size_t sizes = c->image->spp.n;
    koksma__convergence p;
    koksma__summary target = {0};
    double *n = malloc(3 * sizes * sizeof *n);
    KOKSMA__REQUIRE_MEMORY(n, 3 * sizes * sizeof *n);
    const koksma__image_mean first = {c->image, c->scene, c->variant, patterns->at[0], EQUAL_TO};
    koksma_status status = koksma__image_mean_by(study, &first, c->metric, NULL, &target);
    for (size_t i = 0; !status && target.n && i < patterns->n; i++) {
        bool outside = false;
        char name[KOKSMA__VARIANT_TEXT + 64];
        status = convergence(study, c, patterns->at[i], n, n + sizes, n + 2 * sizes, &p);
        const koksma__estimate e =
            i ? koksma__samples_for(&p, target.mean, target.sd / sqrt((double)target.n), &outside)
              : (koksma__estimate){EQUAL_TO, EQUAL_TO, EQUAL_TO};
        koksma__case_name(c->scene, c->variant, name, sizeof name);
        koksma__doc_row(d);
        koksma__doc_text(d, name);
        koksma__doc_text(d, patterns->at[i]);
        koksma__doc_interval(d, e);
        koksma__doc_text(d, i == 0           ? "itself"
                            : isnan(e.value) ? "its error does not fall"
                            : outside        ? "extrapolated"
                                             : "between sizes");
    }
    free(n);
    return status;
}

koksma_status koksma__answer_equal(koksma_study *study, koksma__document *d, const koksma__topic *topic)
{
    koksma_status status = KOKSMA_OK;
    char text[KOKSMA_MAX_SPEC + 64];
    for (size_t b = 0; b < topic->n_images; b++) {
        const koksma__image_block *i = topic->images[b];
        bool has_target = false;
        for (size_t k = 0; k < i->spp.n; k++) {
            has_target |= i->spp.at[k] == EQUAL_TO;
        }
        if (i->spp.n < 2 || !has_target) {
            continue;
        }
        snprintf(text, sizeof text, "equal-%.32s-%zu", topic->id, b + 1);
        koksma__doc_table_begin(d, text);
        koksma__doc_head(d, "scene");
        koksma__doc_head(d, "pattern");
        snprintf(text, sizeof text, "samples as good as %d of %s", EQUAL_TO, i->patterns.at[0]);
        koksma__doc_column(
            d, &(koksma__column){.name = text, .group = topic->metric, .type = KOKSMA__COLUMN_INTERVAL, .digits = 3});
        koksma__doc_head(d, "how");
        for (size_t k = 0; !status && k < i->scenes.n * i->variants.n; k++) {
            const compared c = {.image = i,
                                .scene = i->scenes.at[k / i->variants.n],
                                .variant = i->variants.at[k % i->variants.n],
                                .metric = topic->metric};
            status = add_equal(study, d, &c);
        }
        koksma__doc_table_end(d);
    }
    return status;
}
