/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Answers how many samples of each pattern give the error that 16 samples of the block's first pattern give. The
 * number is interpolated in log-log between the plan's numbers of samples, or extrapolated beyond them
 * (koksma__samples_for); its interval follows from the standard errors of the means.
 */
#include <math.h>
#include <stdio.h>

#include "study/report/report.h"

enum { EQUAL_TO = 16 };

static void add_rows(koksma__report *r, koksma__document *d, const koksma__subject *s)
{
    const size_t sizes = s->n->n;
    const koksma__summary target = koksma__read_mean(r, s, s->patterns->at[0], EQUAL_TO, NULL);
    double *n = koksma__report_memory(r, 3 * sizes, sizeof *n);
    for (size_t i = 0; n && target.n && i < s->patterns->n; i++) {
        double *mean = n + sizes, *error = mean + sizes;
        koksma__convergence p = {n, mean, error, 0};
        bool outside = false;
        for (size_t k = 0; k < sizes; k++) {
            const koksma__summary at = koksma__read_mean(r, s, s->patterns->at[i], s->n->at[k], NULL);
            if (at.n && at.mean > 0) {
                n[p.count] = (double)s->n->at[k];
                mean[p.count] = at.mean;
                error[p.count++] = at.sd / sqrt((double)at.n);
            }
        }
        const koksma__estimate e =
            i ? koksma__samples_for(&p, target.mean, target.sd / sqrt((double)target.n), &outside)
              : (koksma__estimate){EQUAL_TO, EQUAL_TO, EQUAL_TO};
        koksma__doc_row(d, "ttit", s->name, s->patterns->at[i], e,
                        i == 0           ? "itself"
                        : isnan(e.value) ? "its error does not fall"
                        : outside        ? "extrapolated"
                                         : "between sizes");
    }
}

void koksma__answer_equal(koksma__report *r, koksma__document *d, const koksma__topic *topic)
{
    for (size_t b = 0; b < topic->n_images; b++) {
        const koksma__image_block *block = topic->images[b];
        if (block->spp.n < 2 || !koksma__wholes_have(&block->spp, EQUAL_TO)) {
            continue;
        }
        koksma__doc_table(d, "equal-%.32s-%zu", topic->id, b + 1);
        koksma__doc_columns(d, "t scene;t pattern;i3 samples as good as %lld of %s##%s;t how", (long long)EQUAL_TO,
                            block->patterns.at[0], topic->metric);
        for (size_t k = 0; k < block->scenes.n * block->variants.n; k++) {
            const koksma__subject s =
                koksma__subject_of_images(block, block->scenes.at[k / block->variants.n],
                                          block->variants.at[k % block->variants.n], topic->metric);
            add_rows(r, d, &s);
        }
    }
}
