/* SPDX-License-Identifier: Apache-2.0 */
/*
 * order: the overall order of the patterns in a paper's text. Each pattern's mean rank over the tables, by our means
 * against the paper's reference, must not fall along that order: each neighbouring pair is a test. Beside it stands
 * Spearman's correlation of the printed with our means, table by table.
 */
#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "stats/stats.h"
#include "study/report/conclusions/conclusion.h"

/* Adds the rank of each of n values: 1 + the number of smaller ones, and half a rank for each other equal one. */
static void add_ranks(const double *values, size_t n, double *ranks)
{
    for (size_t i = 0; i < n; i++) {
        ranks[i] += 0.5;
        for (size_t k = 0; k < n; k++) {
            ranks[i] += values[k] < values[i] ? 1 : values[k] == values[i] ? 0.5 : 0;
        }
    }
}

koksma_status koksma__conclude_order(koksma_study *study, koksma__document *d, const koksma__conclusion *c,
                                     koksma__tested *tested)
{
    const size_t n = c->patterns.n, tables = c->tables.n;
    double *numbers = calloc(3 * n + tables, sizeof *numbers);
    KOKSMA__REQUIRE_MEMORY(numbers, (3 * n + tables) * sizeof *numbers);
    double *ranks = numbers, *ours = ranks + n, *in_print = ours + n, *rho = in_print + n;
    koksma_status status = KOKSMA_OK;
    for (size_t t = 0; !status && t < tables; t++) {
        status = koksma__conclusion_means(study, koksma__conclusion_table(study, c, c->tables.at[t]), &c->patterns, 0,
                                          ours, in_print, NULL);
        rho[t] = status ? (double)NAN : koksma__spearman(ours, in_print, n);
        add_ranks(ours, n, ranks);
        for (size_t i = 0; i < n; i++) {
            tested->open += isnan(ours[i]);
        }
    }
    koksma__doc_say(d, "Ours by mean rank: ");
    for (size_t i = 0; i < n; i++) {
        koksma__doc_say(d, "%s%s %.3g", i ? "; " : "", koksma__conclusion_label(study, c, c->patterns.at[i]),
                        ranks[i] / (double)tables);
        if (i) {
            koksma__test(tested, ranks[i - 1] <= ranks[i] * (1 + 1e-12));
        }
    }
    koksma__doc_say(d, ". Rank correlation of the printed means with ours:");
    for (size_t t = 0; t < tables; t++) {
        koksma__doc_say(d, "%s %.2f in %s", t ? ";" : "", rho[t], c->tables.at[t]);
    }
    koksma__doc_say(d, ".");
    free(numbers);
    return status;
}
