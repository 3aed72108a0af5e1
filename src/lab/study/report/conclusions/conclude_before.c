/* SPDX-License-Identifier: Apache-2.0 */
/*
 * before: each pattern has a smaller mean than each of `against` in each table at each number of points. Every such
 * comparison is a test, by our means; the same comparisons of the printed means stand beside them.
 */
#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "study/report/conclusions/conclusion.h"

enum { NAMED = 4 };

/* The comparisons in print, and those of ours that fail, of which NAMED are named. */
typedef struct counts {
    size_t in_print, printed, failed;
} counts;

static void compare(const koksma_study *study, koksma__document *d, const koksma__conclusion *c,
                    const koksma__table *t, size_t k, size_t i, size_t j, const double *ours, const double *in_print,
                    counts *all, koksma__tested *tested)
{
    const double *x = ours + c->patterns.n, *y = in_print + c->patterns.n;
    tested->open += isnan(ours[i]) || isnan(x[j]);
    koksma__test(tested, ours[i] < x[j]);
    if (!isnan(in_print[i]) && !isnan(y[j])) {
        all->printed++;
        all->in_print += in_print[i] < y[j];
    }
    if (!(ours[i] < x[j]) && all->failed++ < NAMED) {
        koksma__doc_say(d, "%s%s against %s in table %s",
                        all->failed > 1 ? "; " : "Not: ", koksma__conclusion_label(study, c, c->patterns.at[i]),
                        koksma__conclusion_label(study, c, c->against.at[j]), t->id);
        if (koksma__table_is_over_n(t)) {
            koksma__doc_say(d, " at N = %lld", t->n.at[k]);
        }
    }
}

koksma_status koksma__conclude_before(koksma_study *study, koksma__document *d, const koksma__conclusion *c,
                                      koksma__tested *tested)
{
    const size_t n = c->patterns.n + c->against.n;
    double *ours = malloc(2 * n * sizeof *ours);
    KOKSMA__REQUIRE_MEMORY(ours, 2 * n * sizeof *ours);
    double *in_print = ours + n;
    counts all = {0};
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < c->tables.n * KOKSMA__TABLE_PRINTED; i++) {
        const koksma__table *t = koksma__conclusion_table(study, c, c->tables.at[i / KOKSMA__TABLE_PRINTED]);
        const size_t k = i % KOKSMA__TABLE_PRINTED, left = c->patterns.n;
        if (k >= t->n.n) {
            continue;
        }
        status = koksma__conclusion_means(study, t, &c->patterns, k, ours, in_print, NULL);
        status =
            status ? status : koksma__conclusion_means(study, t, &c->against, k, ours + left, in_print + left, NULL);
        for (size_t j = 0; !status && j < left * c->against.n; j++) {
            compare(study, d, c, t, k, j / c->against.n, j % c->against.n, ours, in_print, &all, tested);
        }
    }
    if (all.failed > NAMED) {
        koksma__doc_say(d, "; and %zu more", all.failed - NAMED);
    }
    koksma__doc_say(d, "%s", all.failed ? ". " : "");
    koksma__doc_say(d, "Smaller in %zu of %zu comparisons, in print in %zu of %zu.", tested->passed, tested->tests,
                    all.in_print, all.printed);
    free(ours);
    return status;
}
