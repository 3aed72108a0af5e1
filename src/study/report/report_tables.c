/* SPDX-License-Identifier: Apache-2.0 */
/* Published tables of a report beside what the store has: labels, marks and notes, and those of discrepancies. */
#include "study/report/report_tables.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/c_locale.h"
#include "stats/quantiles.h"

/* ---- Marks ------------------------------------------------------------------------------------------------- */

void koksma__table_begin_row(koksma__html *h, koksma__html *csv, const koksma__table *t, const koksma__table_row *row)
{
    koksma__csv_row(csv);
    koksma__csv_text(csv, row->label);
    koksma__csv_text(csv, row->pattern);
    for (int s = 0; s < 3; s++) {
        koksma__csv_number(csv, row->published[s].value);
    }
    koksma__html_add(h, "<tr><td>");
    koksma__html_text(h, row->label);
    koksma__html_add(h, "</td>");
    for (int s = 0; s < 3; s++) {
        koksma__table_add_printed(h, &row->published[s], koksma__table_note(t, row->pattern, 0, s));
    }
}

void koksma__table_add_printed(koksma__html *h, const koksma__printed *printed, size_t note)
{
    if (isnan(printed->value)) {
        koksma__html_add(h, "<td>&#8211;</td>");
        return;
    }
    koksma__html_add(h, "<td>");
    koksma__html_text(h, printed->text);
    if (note) {
        koksma__html_add(h, "<sup class=\"note\">%zu</sup>", note);
    }
    koksma__html_add(h, "</td>");
}

void koksma__table_add_mean(koksma__html *h, const koksma__summary *mean, int digits, bool behind_point)
{
    const double half = mean->high - mean->mean;
    if (mean->n == 0) {
        koksma__html_add(h, "&#8211;");
        return;
    }
    koksma__html_add(h, behind_point ? "%.*f" : "%.*g", digits, mean->mean);
    if (isnan(half)) {
        koksma__html_add(h, " <span class=\"pm\">&#177; ?</span>");
    } else if (half > 0) {
        koksma__html_add(
            h, behind_point ? " <span class=\"pm\">&#177; %.*f</span>" : " <span class=\"pm\">&#177; %.*g</span>",
            behind_point ? digits : 2, half);
    }
}

void koksma__table_add_number(koksma__html *h, double value, int digits, bool behind_point)
{
    if (isnan(value)) {
        koksma__html_add(h, "<td>&#8211;</td>");
    } else {
        koksma__html_add(h, behind_point ? "<td>%.*f</td>" : "<td>%.*g</td>", digits, value);
    }
}

void koksma__table_add_judgement(koksma__html *h, koksma__agreement *agreement, const koksma__verdict *v,
                                 bool with_number)
{
    static const char *const classes[] = {[KOKSMA_VERDICT_AGREES] = "good",
                                          [KOKSMA_VERDICT_FITTED] = "good",
                                          [KOKSMA_VERDICT_EXPLAINED] = "note",
                                          [KOKSMA_VERDICT_UNEXPLAINED] = "bad"};
    char text[48] = "";
    agreement->of[v->kind]++;
    if (v->kind == KOKSMA_VERDICT_NEW || v->kind == KOKSMA_VERDICT_WAITING) {
        koksma__html_add(h, v->kind == KOKSMA_VERDICT_NEW ? "new" : "not yet");
        return;
    }
    if (!isnan(v->z)) {
        koksma__snprintf(text, sizeof text, "z = %+.1f", v->z);
    } else {
        koksma__snprintf(text, sizeof text, "%+.0f %%", 100 * v->ratio);
    }
    koksma__html_add(h, "<span class=\"%s\" title=\"%s\">", classes[v->kind], text);
    if (v->kind == KOKSMA_VERDICT_EXPLAINED) {
        koksma__html_add(h, "note %zu", v->note);
    } else {
        koksma__html_add(h, v->kind == KOKSMA_VERDICT_UNEXPLAINED ? "&#10007;" : "&#10003;");
    }
    koksma__html_add(h, with_number ? " %s</span>" : "</span>", text);
}

void koksma__table_add_verdict(koksma__html *h, koksma__agreement *agreement, const koksma__verdict *v)
{
    koksma__html_add(h, "<td>");
    koksma__table_add_judgement(h, agreement, v, true);
    koksma__html_add(h, "</td>");
}

void koksma__table_end(koksma__html *h, koksma__html *csv, const koksma__table *t)
{
    char name[96];
    koksma__html_add(h, "</table></div>\n");
    snprintf(name, sizeof name, "table-%.80s", t->id);
    koksma__csv_close(csv, h, name);
    if (t->n_notes) {
        koksma__html_add(h, "<ol class=\"notes note\">\n");
        for (size_t i = 0; i < t->n_notes; i++) {
            koksma__html_add(h, "<li>");
            koksma__html_text(h, t->notes[i].reason);
            koksma__html_add(h, "</li>\n");
        }
        koksma__html_add(h, "</ol>\n");
    }
}

void koksma__table_csv_heads(koksma__html *csv, const char *of)
{
    static const char *const names[] = {"mean", "mean low", "mean high", "SD", "max"};
    char text[KOKSMA_MAX_SPEC + 64];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(text, sizeof text, "%s, %s", of, names[i]);
        koksma__csv_text(csv, text);
    }
}

void koksma__table_csv_cell(koksma__html *csv, const koksma__cell *cell)
{
    koksma__csv_number(csv, cell->mean.mean);
    koksma__csv_number(csv, cell->mean.low);
    koksma__csv_number(csv, cell->mean.high);
    koksma__csv_number(csv, cell->sd);
    koksma__csv_number(csv, cell->max);
}

void koksma__table_open(koksma__html *h, const koksma__table *t)
{
    koksma__html_add(h, "<h3");
    koksma__html_id(h, "table", t->id);
    koksma__html_add(h, ">Table %s: ", t->id);
    koksma__html_text(h, t->title);
    koksma__html_add(
        h, "</h3>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"table %s\"><table>\n<thead>",
        t->id);
}

void koksma__table_begin(koksma__html *h, koksma__html *csv, const koksma__table *t)
{
    static const char *const names[] = {"row", "pattern", "published mean", "published SD", "published max"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        koksma__csv_text(csv, names[i]);
    }
    koksma__table_open(h, t);
}

void koksma__table_add_z(koksma__z_sums *sums, const koksma__verdict *v, const koksma__cell *cell)
{
    /* sets that are all the same differ by rounding alone */
    if (isfinite(v->z) && cell->sd > 0 && v->kind != KOKSMA_VERDICT_EXPLAINED) {
        sums->count++;
        sums->sum += v->z;
        sums->squares += v->z * v->z;
    }
}

void koksma__table_end_z(koksma__html *h, const koksma__z_sums *z)
{
    if (z->count > 1) {
        const double k = (double)z->count, limit = koksma__chi_squared_quantile(0.95, k);
        koksma__html_add(
            h,
            "<p class=\"note\">The %zu values of z taken together: their sum over &#8730;%zu is %+.1f (by "
            "chance between -2 and +2 in 95 %% of tables: beyond, all means are off to one side), and the "
            "sum of their squares %.1f (by chance below %.1f in 95 %%).</p>\n",
            z->count, z->count, z->sum / sqrt(k), z->squares, limit);
    }
}

/* ---- Discrepancy tables ------------------------------------------------------------------------------------ */

/* A mean and, where the rows differ in it, of how many sets. */
static void add_set_mean(koksma__html *h, const koksma__summary *mean, bool differ)
{
    koksma__html_add(h, "<td>");
    koksma__table_add_mean(h, mean, 4, false);
    if (differ && mean->n) {
        koksma__html_add(h, " <span class=\"pm\">(%zu set%s)</span>", mean->n, mean->n > 1 ? "s" : "");
    }
    koksma__html_add(h, "</td>");
}

static koksma_status add_discrepancy_row(koksma_study *study, koksma__html *h, koksma__html *csv,
                                         koksma__agreement *agreement, const koksma__table *t,
                                         const koksma__table_row *row, bool differ, koksma__z_sums *together)
{
    koksma__cell cell, also = {0};
    koksma_status status = koksma__table_discrepancy(study, t, t->measure, row->pattern, t->n.at[0], &cell);
    if (!status && t->also) {
        status = koksma__table_discrepancy(study, t, t->also, row->pattern, t->n.at[0], &also);
    }
    if (status) {
        return status;
    }
    koksma__table_begin_row(h, csv, t, row);
    koksma__table_csv_cell(csv, &cell);
    add_set_mean(h, &cell.mean, differ);
    koksma__table_add_number(h, cell.sd, 3, false);
    koksma__html_add(h, isnan(cell.max) ? "<td>&#8211;" : "<td>%.3g", cell.max);
    if (!isnan(cell.max_sd)) {
        koksma__html_add(h, " <span class=\"pm\">&#177; %.3f</span>", cell.max_sd);
    }
    koksma__html_add(h, "</td>");
    const koksma__verdict verdict = koksma__table_judge(t, row, 0, &cell);
    koksma__table_add_verdict(h, agreement, &verdict);
    koksma__table_add_z(together, &verdict, &cell);
    if (t->also) {
        add_set_mean(h, &also.mean, differ);
        koksma__table_csv_cell(csv, &also);
    }
    koksma__html_add(h, "</tr>\n");
    return KOKSMA_OK;
}

koksma_status koksma__report_discrepancy_table(koksma_study *study, koksma__html *h, koksma__agreement *agreement,
                                               const koksma__table *t)
{
    size_t sets;
    bool differ;
    koksma_status status = koksma__table_sets(study, t, &sets, &differ);
    if (status) {
        return status;
    }
    koksma__html csv = {0};
    koksma__z_sums together = {0};
    koksma__table_begin(h, &csv, t);
    koksma__table_csv_heads(&csv, t->measure);
    if (t->also) {
        koksma__table_csv_heads(&csv, t->also);
    }
    koksma__html_add(h, "<tr><th></th><th colspan=\"3\">published (100 sets)</th><th colspan=\"3\">");
    koksma__html_text(h, t->measure);
    koksma__html_add(h, ", %s%zu sets</th><th></th>%s</tr>\n", differ ? "up to " : "", sets,
                     t->also ? "<th>beside it</th>" : "");
    koksma__html_add(
        h,
        "<tr><th>pattern</th><th>ave</th><th>SD</th><th>max</th><th>mean <span class=\"pm\">95 %%</span></th>"
        "<th>SD</th><th>largest of %zu</th><th>mean agrees</th>",
        sets < 100 ? sets : (size_t)100);
    if (t->also) {
        koksma__html_add(h, "<th>");
        koksma__html_text(h, t->also);
        koksma__html_add(h, "</th>");
    }
    koksma__html_add(h, "</tr></thead>\n<tbody>\n");
    for (size_t r = 0; !status && r < t->n_rows; r++) {
        status = add_discrepancy_row(study, h, &csv, agreement, t, &t->rows[r], differ, &together);
    }
    koksma__html_add(h, "</tbody>");
    koksma__table_end(h, &csv, t);
    koksma__table_end_z(h, &together);
    return status;
}
