/* SPDX-License-Identifier: Apache-2.0 */
/*
 * predictor: the measure of the first table of `by` orders the patterns as the errors of the tables do. Each table is a
 * test: Spearman's correlation rho of our n means must be above 0 at 5 %, by t = rho sqrt((n - 2) / (1 - rho^2)) with
 * n - 2 degrees of freedom. The other tables of `by` stand beside it without a test.
 */
#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "stats/stats.h"
#include "study/report/conclusions/conclusion.h"

typedef struct pair {
    double *ours, *in_print;
} pair;

static bool is_sure(double rho, size_t n)
{
    const double t = rho * sqrt(((double)n - 2) / fmax(1 - rho * rho, 1e-12));
    return n > 2 && t > koksma__student_quantile(0.95, (double)n - 2);
}

/* Writes the correlations of one measure with the errors of all tables, ours and in print. */
static koksma_status say_measure(koksma_study *study, koksma__document *d, const koksma__conclusion *c, size_t by,
                                 const pair *x, const pair *y, koksma__tested *tested)
{
    const size_t n = c->patterns.n;
    const koksma__table *of = koksma__conclusion_table(study, c, c->by.at[by]);
    KOKSMA__TRY(koksma__conclusion_means(study, of, &c->patterns, 0, x->ours, x->in_print, NULL));
    koksma__doc_say(d, "%s", by ? ". " : "Rank correlation with the error, ours (printed), of ");
    koksma__doc_say(
        d, of->measure ? "`%s` in table %s:" : "%sthe errors in table %s:", of->measure ? of->measure : "", of->id);
    for (size_t t = 0; t < c->tables.n; t++) {
        const koksma__table *table = koksma__conclusion_table(study, c, c->tables.at[t]);
        KOKSMA__TRY(koksma__conclusion_means(study, table, &c->patterns, 0, y->ours, y->in_print, NULL));
        const double rho = koksma__spearman(x->ours, y->ours, n);
        for (size_t i = 0; i < n && !by; i++) {
            tested->open += isnan(x->ours[i]) || isnan(y->ours[i]);
        }
        koksma__doc_say(d, "%s %.2f (%.2f) in %s", t ? ";" : "", rho, koksma__spearman(x->in_print, y->in_print, n),
                        table->id);
        if (by == 0) {
            koksma__test(tested, is_sure(rho, n));
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__conclude_predictor(koksma_study *study, koksma__document *d, const koksma__conclusion *c,
                                         koksma__tested *tested)
{
    const size_t n = c->patterns.n;
    double *numbers = malloc(4 * n * sizeof *numbers);
    KOKSMA__REQUIRE_MEMORY(numbers, 4 * n * sizeof *numbers);
    const pair x = {numbers, numbers + n}, y = {numbers + 2 * n, numbers + 3 * n};
    koksma_status status = KOKSMA_OK;
    for (size_t by = 0; !status && by < c->by.n; by++) {
        status = say_measure(study, d, c, by, &x, &y, tested);
    }
    koksma__doc_say(d, ".");
    free(numbers);
    return status;
}
