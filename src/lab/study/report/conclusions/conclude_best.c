/* SPDX-License-Identifier: Apache-2.0 */
/*
 * best: the first pattern has the least error in most tables, and in the others only the patterns of `against` have less.
 * Each table is a test: all patterns of its rows but those of `against` must have a mean above the first pattern's. More
 * than half of the tables must have it first, which is one more test.
 */
#include <math.h>

#include "study/plan/plan.h"
#include "study/report/conclusions/conclusion.h"

static koksma_status test_table(koksma_study *study, koksma__document *d, const koksma__conclusion *c,
                                const koksma__table *t, koksma__tested *tested, size_t *first)
{
    size_t before = 0, unexpected = 0;
    double best, mean, in_print;
    KOKSMA__TRY(koksma__conclusion_means(study, t, &(koksma__texts){1, c->patterns.at}, 0, &best, &in_print, NULL));
    for (size_t r = 0; r < t->n_rows; r++) {
        char *pattern = t->rows[r].pattern;
        KOKSMA__TRY(koksma__conclusion_means(study, t, &(koksma__texts){1, &pattern}, 0, &mean, &in_print, NULL));
        tested->open += isnan(mean);
        if (mean < best) {
            koksma__doc_say(d, before ? "; %s" : "%s: after ", before ? t->rows[r].label : t->id);
            koksma__doc_say(d, "%s", before++ ? "" : t->rows[r].label);
            unexpected += !koksma__texts_have(&c->against, pattern);
        }
    }
    if (before) {
        koksma__doc_say(d, ". ");
    } else {
        koksma__doc_say(d, "%s: first. ", t->id);
    }
    *first += !before;
    koksma__test(tested, !unexpected);
    return KOKSMA_OK;
}

koksma_status koksma__conclude_best(koksma_study *study, koksma__document *d, const koksma__conclusion *c,
                                    koksma__tested *tested)
{
    koksma_status status = KOKSMA_OK;
    size_t first = 0;
    for (size_t t = 0; !status && t < c->tables.n; t++) {
        status = test_table(study, d, c, koksma__conclusion_table(study, c, c->tables.at[t]), tested, &first);
    }
    koksma__test(tested, 2 * first > c->tables.n);
    koksma__doc_say(d, "First in %zu of %zu tables.", first, c->tables.n);
    return status;
}
