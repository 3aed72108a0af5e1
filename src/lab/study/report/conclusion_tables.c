/* SPDX-License-Identifier: Apache-2.0 */
/* A conclusion names tables and patterns; their means are those of the published tables (published_tables.h). */
#include "study/report/conclusion_tables.h"

#include <math.h>
#include <string.h>

#include "study/plan/plan.h"

koksma_status koksma__conclusion_means(koksma_study *study, const koksma__table *t, const koksma__texts *patterns,
                                       size_t k, double *ours, double *in_print, koksma__summary *of)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < patterns->n; i++) {
        const char *pattern = patterns->at[i];
        koksma__cell cell = {0};
        status = t->scene
                     ? koksma__table_image(study, t, &koksma__table_images(study, t)->references[0], pattern, &cell)
                     : koksma__table_discrepancy(study, t, t->measure, pattern, t->n.at[k], &cell);
        ours[i] = cell.mean.n ? cell.mean.mean : (double)NAN;
        in_print[i] = koksma__plan_row_of(t, pattern)->published[k].value;
        if (of) {
            of[i] = cell.mean;
        }
    }
    return status;
}

const koksma__table *koksma__conclusion_table(const koksma_study *study, const koksma__conclusion *c, const char *id)
{
    return koksma__plan_table_of(&study->plan, c->part, id);
}

const char *koksma__conclusion_label(const koksma_study *study, const koksma__conclusion *c, const char *pattern)
{
    for (size_t i = 0; i < study->plan.n_tables; i++) {
        const koksma__table *t = &study->plan.tables[i];
        const koksma__table_row *row = t->part == c->part ? koksma__plan_row_of(t, pattern) : NULL;
        if (row) {
            return row->label;
        }
    }
    return pattern;
}
