/* SPDX-License-Identifier: Apache-2.0 */
/*
 * rates: the patterns converge faster than random points, by every measure of the block. Each pattern and measure is a
 * test: the whole interval of the slope over the block's numbers of points must be below -1/2 - TOLERANCE. Exponents
 * that differ from -1/2 by less are taken for those of finite sizes: the part of an error that vanishes faster still
 * tilts it. If the block has random points, each pattern's mean at the largest size is given as a multiple of theirs.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "stats/stats.h"
#include "study/plan/plan.h"
#include "study/report/conclusions/conclusion.h"
#include "study/report/means.h"

#define TOLERANCE 0.05

/* Reads the means of a pattern at all sizes; *known: the number of sizes with a mean. */
static koksma_status read_means(koksma_study *study, const koksma__discrepancy_block *b, const char *pattern,
                                const char *measure, double *x, koksma__summary *means, size_t *known)
{
    *known = 0;
    for (size_t k = 0; k < b->n.n; k++) {
        koksma__summary mean = {0};
        KOKSMA__TRY(koksma__discrepancy_mean(study, b, "", pattern, b->n.at[k], measure, NULL, &mean));
        if (mean.n && mean.mean > 0) {
            x[*known] = (double)b->n.at[k];
            means[(*known)++] = mean;
        }
    }
    return KOKSMA_OK;
}

static koksma_status test_measure(koksma_study *study, koksma__document *d, const koksma__conclusion *c,
                                  const koksma__discrepancy_block *b, const char *measure, double *x,
                                  koksma__summary *means, koksma__tested *tested)
{
    koksma_status status = KOKSMA_OK;
    double random = NAN;
    size_t known;
    if (koksma__texts_have(&b->patterns, "random")) {
        KOKSMA__TRY(read_means(study, b, "random", measure, x, means, &known));
        random = known == b->n.n ? means[known - 1].mean : (double)NAN;
    }
    koksma__doc_say(d, "`%s`, N = %lld to %lld: ", measure, b->n.at[0], b->n.at[b->n.n - 1]);
    for (size_t i = 0; !status && i < c->patterns.n; i++) {
        status = read_means(study, b, c->patterns.at[i], measure, x, means, &known);
        const koksma__estimate slope =
            status ? (koksma__estimate){NAN, NAN, NAN} : koksma__trend_of(x, means, known).slope;
        if (status || known < b->n.n || isnan(slope.high)) {
            tested->open++;
            continue;
        }
        koksma__test(tested, slope.high < -0.5 - TOLERANCE);
        koksma__doc_say(d, "%s N^%.3f^ (± %.3f)", koksma__conclusion_label(study, c, c->patterns.at[i]), slope.value,
                        slope.high - slope.value);
        if (!isnan(random)) {
            koksma__doc_say(d, ", at the end %.2g times random", means[known - 1].mean / random);
        }
        koksma__doc_say(d, i + 1 < c->patterns.n ? "; " : ". ");
    }
    return status;
}

koksma_status koksma__conclude_rates(koksma_study *study, koksma__document *d, const koksma__conclusion *c,
                                     koksma__tested *tested)
{
    const koksma__plan_part *part = &study->plan.parts[c->part];
    koksma_status status = KOKSMA_OK;
    for (size_t i = part->discrepancies[0]; !status && i < part->discrepancies[1]; i++) {
        const koksma__discrepancy_block *b = &study->plan.discrepancies[i];
        if (!b->id || strcmp(b->id, c->discrepancies) != 0) {
            continue;
        }
        double *x = calloc(b->n.n, sizeof *x);
        koksma__summary *means = calloc(b->n.n, sizeof *means);
        status = x && means ? KOKSMA_OK : koksma__fail_memory(b->n.n * sizeof *means);
        for (size_t m = 0; !status && m < b->measures.n; m++) {
            status = test_measure(study, d, c, b, b->measures.at[m], x, means, tested);
        }
        free(x);
        free(means);
    }
    koksma__doc_say(d, "Faster means an exponent surely below %.2f.", -0.5 - TOLERANCE);
    return status;
}
