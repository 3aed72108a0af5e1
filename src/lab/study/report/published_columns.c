/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The parts that all published tables of a report have in common: a row has its label, the published numbers, each
 * with the number of its note, and then our numbers with the verdict on the published mean. Below the table are its
 * notes, and a joint test of its k values of z, one for each compared mean: if the differences are due to chance
 * only, the sum of the values divided by sqrt k has a standard normal distribution, and the sum of their squares a
 * chi-squared distribution with k degrees of freedom.
 */
#include "study/report/published_columns.h"

#include <math.h>
#include <stdio.h>

#include "stats/stats.h"

void koksma__published_begin(koksma__document *d, const koksma__table *t)
{
    char id[96];
    snprintf(id, sizeof id, "table-%.80s", t->id);
    koksma__doc_section_begin(d, id, false);
    koksma__doc_say(d, "Table %s: %s", t->id, t->title);
    koksma__doc_section_body(d);
    koksma__doc_table_begin(d, id);
}

void koksma__published_end(koksma__document *d, const koksma__table *t)
{
    koksma__doc_table_end(d);
    if (t->n_notes) {
        koksma__doc_list_begin(d, NULL, true);
        for (size_t i = 0; i < t->n_notes; i++) {
            koksma__doc_item(d);
            koksma__doc_say(d, "%s", t->notes[i].reason);
        }
        koksma__doc_list_end(d);
    }
}

void koksma__published_columns(koksma__document *d, const char *group)
{
    static const char *const names[3][2] = {
        {"published mean", "ave"}, {"published SD", "SD"}, {"published max", "max"}};
    koksma__doc_column(d, &(koksma__column){.name = "row", .title = "pattern"});
    koksma__doc_column(d, &(koksma__column){.name = "pattern", .hidden = true});
    for (int i = 0; i < 3; i++) {
        koksma__doc_column(d, &(koksma__column){names[i][0], names[i][1], group, KOKSMA__COLUMN_NUMBER, .digits = 4});
    }
}

void koksma__published_row(koksma__document *d, const koksma__table *t, const koksma__table_row *row)
{
    koksma__doc_row(d);
    koksma__doc_text(d, row->label);
    koksma__doc_text(d, row->pattern);
    for (int s = 0; s < 3; s++) {
        koksma__published_cell(d, &row->published[s], koksma__table_note(t, row->pattern, 0, s));
    }
}

void koksma__published_cell(koksma__document *d, const koksma__printed *printed, size_t note)
{
    if (isnan(printed->value)) {
        koksma__doc_number(d, NAN);
        return;
    }
    koksma__cell_data cell = koksma__cell_of(printed->value);
    cell.text = printed->text;
    cell.note = note;
    koksma__doc_cell(d, &cell);
}

void koksma__published_mean(koksma__document *d, const koksma__summary *mean, size_t sets, const koksma__verdict *v)
{
    koksma__cell_data cell = koksma__cell_of(mean->mean);
    cell.low = mean->low;
    cell.high = mean->high;
    cell.sets = sets;
    if (v) {
        cell.note = v->kind == KOKSMA_VERDICT_EXPLAINED ? v->note : 0;
        cell.verdict = koksma_study_verdict_name(v->kind);
        cell.z = v->z;
        cell.change = v->ratio;
    }
    koksma__doc_cell(d, &cell);
}

void koksma__published_verdict(koksma__document *d, const koksma__verdict *v)
{
    koksma__published_mean(d, &(koksma__summary){.mean = NAN, .low = NAN, .high = NAN}, 0, v);
}

void koksma__published_add_z(koksma__z_sums *sums, const koksma__verdict *v, const koksma__cell *cell)
{
    /* if the standard deviation is 0, all sets are equal, and the difference is only rounding */
    if (isfinite(v->z) && cell->sd > 0 && v->kind != KOKSMA_VERDICT_EXPLAINED) {
        sums->count++;
        sums->sum += v->z;
        sums->squares += v->z * v->z;
    }
}

void koksma__published_say_z(koksma__document *d, const koksma__z_sums *z)
{
    if (z->count > 1) {
        const double k = (double)z->count, limit = koksma__chi_squared_quantile(0.95, k);
        const bool one_side = koksma__z_deviates(z), spread = z->squares > limit;
        koksma__doc_paragraph(
            d,
            "The %zu values of z together *%s*: their sum divided by √%zu is %+.2f, which %s (by "
            "chance between -1.96 and +1.96 in 95 %% of tables; otherwise the means deviate to one "
            "side), and the sum of their squares is %.1f, which %s (by chance below %.1f in 95 %%).",
            z->count, one_side || spread ? "fail" : "pass", z->count, z->sum / sqrt(k), one_side ? "fails" : "passes",
            z->squares, spread ? "fails" : "passes", limit);
    }
}

bool koksma__z_deviates(const koksma__z_sums *z)
{
    return z->count > 1 && fabs(z->sum) > 1.96 * sqrt((double)z->count);
}

bool koksma__z_fails(const koksma__z_sums *z)
{
    return koksma__z_deviates(z) ||
           (z->count > 1 && z->squares > koksma__chi_squared_quantile(0.95, (double)z->count));
}
