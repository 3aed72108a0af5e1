/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The published tables of discrepancies. A table of one number of points (Shirley 1991) has one row per pattern: the
 * published numbers, our mean (with the verdict on the published mean), SD and largest of 100, and the means of a
 * second measure. A table over several numbers of points (Mitchell 1992) has two or three rows per pattern: the
 * published means, our means with their verdicts, and our means of a second measure. Each of these rows ends with
 * its log-log slope, computed by least squares over all columns (koksma__trend_of) of published means and of ours alike,
 * and with what theory predicts: the exponent, and the multiple of random points' mean. A chart of the means follows.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/status.h"
#include "stats/stats.h"
#include "study/report/published_columns.h"
#include "study/report/report.h"

static bool is_here(const koksma__report_scope *scope, const koksma__table *t)
{
    return t->part == scope->plan && !t->scene;
}

static bool is_shown(const koksma__report_scope *scope)
{
    bool found = false;
    for (size_t i = 0; i < scope->study->plan.n_tables; i++) {
        found |= is_here(scope, &scope->study->plan.tables[i]);
    }
    return found;
}

/* ---- Tables of one number of points ------------------------------------------------------------------------ */

/* Adds the columns for the mean, SD and largest value of a measure. beside: whether the measure is the table's second
   one, of which the page shows only the mean. */
static void add_cell_columns(koksma__document *d, const char *measure, const char *group, size_t sets, bool beside)
{
    char name[KOKSMA_MAX_SPEC + 64], largest[64];
    snprintf(name, sizeof name, "%s, mean", measure);
    koksma__doc_column(
        d, &(koksma__column){name, beside ? measure : "mean 95 %", group, KOKSMA__COLUMN_INTERVAL, .digits = 4});
    snprintf(name, sizeof name, "%s, SD", measure);
    koksma__doc_column(d, &(koksma__column){name, "SD", group, KOKSMA__COLUMN_NUMBER, .digits = 3, .hidden = beside});
    snprintf(name, sizeof name, "%s, max", measure);
    snprintf(largest, sizeof largest, "largest of %zu", sets < 100 ? sets : (size_t)100);
    koksma__doc_column(d,
                       &(koksma__column){name, largest, group, KOKSMA__COLUMN_SPREAD, .digits = 3, .hidden = beside});
}

static void add_columns(koksma__document *d, const koksma__table *t, size_t sets, bool differ)
{
    char group[KOKSMA_MAX_SPEC + 64];
    snprintf(group, sizeof group, "%s, %s%zu set%s", t->measure, differ ? "up to " : "", sets,
             koksma__plural((double)sets));
    koksma__published_columns(d, "published (100 sets)");
    add_cell_columns(d, t->measure, group, sets, false);
    koksma__doc_column(d,
                       &(koksma__column){.name = "verdict", .title = "mean agrees", .type = KOKSMA__COLUMN_VERDICT});
    if (t->also) {
        add_cell_columns(d, t->also, "beside it", sets, true);
    }
}

static void add_cell(koksma__document *d, const koksma__cell *cell, bool differ)
{
    koksma__published_mean(d, &cell->mean, differ ? cell->mean.n : 0, NULL);
    koksma__doc_number(d, cell->sd);
    koksma__doc_cell(d,
                     &(koksma__cell_data){
                         .value = cell->max, .low = NAN, .high = NAN, .sd = cell->max_sd, .z = NAN, .change = NAN});
}

static koksma_status add_row(koksma_study *study, koksma__document *d, const koksma__table *t,
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
    const koksma__verdict verdict = koksma__table_judge(t, row, 0, &cell);
    koksma__published_row(d, t, row);
    add_cell(d, &cell, differ);
    koksma__published_verdict(d, &verdict);
    koksma__published_add_z(together, &verdict, &cell);
    if (t->also) {
        add_cell(d, &also, differ);
    }
    return KOKSMA_OK;
}

static koksma_status add_table(koksma_study *study, koksma__document *d, const koksma__table *t)
{
    size_t sets;
    bool differ;
    koksma__z_sums together = {0};
    koksma_status status = koksma__table_sets(study, t, &sets, &differ);
    if (status) {
        return status;
    }
    koksma__published_begin(d, t);
    add_columns(d, t, sets, differ);
    for (size_t r = 0; !status && r < t->n_rows; r++) {
        status = add_row(study, d, t, &t->rows[r], differ, &together);
    }
    koksma__published_end(d, t);
    koksma__published_say_z(d, &together);
    koksma__doc_end(d);
    return status;
}

/* ---- Tables over several numbers of points ----------------------------------------------------------------- */

/* The table over several numbers of points that is being written, and the chart that follows this table. */
typedef struct sizes_table {
    koksma_study *study;
    koksma__document *document, chart;
    const koksma__table *table;
    koksma__z_sums together;
} sizes_table;

static void add_size_columns(koksma__document *d, const koksma__table *t)
{
    char name[40];
    koksma__doc_column(d, &(koksma__column){.name = "row", .title = "pattern", .merged = true});
    koksma__doc_column(d, &(koksma__column){.name = "pattern", .hidden = true});
    koksma__doc_column(d, &(koksma__column){.name = "values", .title = "mean"});
    for (size_t i = 0; i < t->n.n; i++) {
        snprintf(name, sizeof name, "%lld point%s", t->n.at[i], koksma__plural((double)t->n.at[i]));
        koksma__doc_head_interval(d, name, 4);
    }
    koksma__doc_column(
        d, &(koksma__column){
               .name = "slope", .title = "slope 95 %", .type = KOKSMA__COLUMN_INTERVAL, .digits = 3, .fixed = true});
    koksma__doc_head_number(d, "theory", 3);
    koksma__doc_head_number(d, "× random", 2);
}

static void begin_line(sizes_table *s, const koksma__table_row *row, const char *values)
{
    koksma__doc_row(s->document);
    koksma__doc_text(s->document, row->label);
    koksma__doc_text(s->document, row->pattern);
    koksma__doc_text(s->document, values);
}

static void add_printed_line(sizes_table *s, const koksma__table_row *row)
{
    const koksma__wholes *n = &s->table->n;
    const double slope = koksma__table_printed_slope(s->table, row);
    begin_line(s, row, "printed");
    for (size_t i = 0; i < n->n; i++) {
        koksma__published_cell(s->document, &row->published[i],
                               koksma__table_note(s->table, row->pattern, n->at[i], 0));
    }
    koksma__doc_interval(s->document, (koksma__estimate){slope, slope, slope});
    koksma__doc_number(s->document, row->rate);
    koksma__doc_number(s->document, row->of_random);
}

/* Adds a row with our means of a measure. own: whether it is the table's first measure, whose means get verdicts and
   a curve. */
static koksma_status add_our_line(sizes_table *s, const koksma__table_row *row, const char *measure, bool own)
{
    const koksma__wholes *n = &s->table->n;
    koksma__summary means[KOKSMA__TABLE_PRINTED];
    double x[KOKSMA__TABLE_PRINTED];
    size_t known = 0;
    begin_line(s, row, measure);
    if (own) {
        koksma__doc_series_begin(&s->chart, row->label, KOKSMA__SERIES_LINE);
    }
    for (size_t i = 0; i < n->n; i++) {
        koksma__cell cell;
        const koksma_status status =
            koksma__table_discrepancy(s->study, s->table, measure, row->pattern, n->at[i], &cell);
        if (status) {
            return status;
        }
        const koksma__verdict verdict = koksma__table_judge(s->table, row, i, &cell);
        koksma__published_mean(s->document, &cell.mean, 0, own ? &verdict : NULL);
        if (own) {
            koksma__published_add_z(&s->together, &verdict, &cell);
            koksma__doc_point(&s->chart, (double)n->at[i], cell.mean.mean, cell.mean.low, cell.mean.high);
        }
        if (cell.mean.n && cell.mean.mean > 0) {
            x[known] = (double)n->at[i];
            means[known++] = cell.mean;
        }
    }
    if (own) {
        koksma__doc_end(&s->chart);
    }
    koksma__doc_interval(s->document, koksma__trend_of(x, means, known).slope);
    return KOKSMA_OK;
}

/* Adds the published means of a row to the chart, as hollow marks in the style of our curve. */
static void add_printed_marks(sizes_table *s, const koksma__table_row *row)
{
    if (row->n_published) {
        koksma__doc_series_begin(&s->chart, row->label, KOKSMA__SERIES_HOLLOW);
        for (size_t i = 0; i < s->table->n.n; i++) {
            koksma__doc_point(&s->chart, (double)s->table->n.at[i], row->published[i].value, NAN, NAN);
        }
        koksma__doc_end(&s->chart);
    }
}

static koksma_status add_rows(sizes_table *s)
{
    const koksma__table *t = s->table;
    koksma_status status = KOKSMA_OK;
    for (size_t r = 0; !status && r < t->n_rows; r++) {
        add_printed_line(s, &t->rows[r]);
        status = add_our_line(s, &t->rows[r], t->measure, true);
        if (!status && t->also) {
            status = add_our_line(s, &t->rows[r], t->also, false);
        }
    }
    for (size_t r = 0; r < t->n_rows; r++) {
        add_printed_marks(s, &t->rows[r]);
    }
    return status;
}

static bool has_published(const koksma__table *t)
{
    for (size_t r = 0; r < t->n_rows; r++) {
        if (t->rows[r].n_published) {
            return true;
        }
    }
    return false;
}

/* Says over how many sets the means are, and how slopes are computed: of published means, too, if the table has some. */
static void say_means(koksma__document *d, const koksma__table *t, size_t sets, bool differ)
{
    const bool published = has_published(t);
    koksma__doc_paragraph(
        d,
        published
            ? "Published means are over 100 sets, ours over %s%zu. Slopes are least squares over all columns; "
              "_theory_ "
              "is the exponent of the pattern for large N, which a slope over these columns need not have reached, "
              "and "
              "_× random_ the known factor of its mean there to that of random points."
            : "Means are over %s%zu sets. Slopes are least squares over all columns; _theory_ is the exponent of the "
              "pattern for large N, which a slope over these columns need not have reached, and _× random_ the known "
              "factor of its mean there to that of random points.",
        differ ? "up to " : "", sets);
}

static koksma_status add_sizes_table(koksma_study *study, koksma__document *d, const koksma__table *t)
{
    char title[200];
    size_t sets;
    bool differ;
    sizes_table s = {.study = study, .document = d, .table = t};
    snprintf(title, sizeof title, "Table %.60s: %.110s%s", t->id, t->title,
             t->rows[0].n_published ? ". Hollow: printed" : "");
    koksma__doc_chart_begin(&s.chart, &(koksma__chart){title, "points", t->measure, true, true, 0});
    koksma__published_begin(d, t);
    add_size_columns(d, t);
    koksma_status status = add_rows(&s);
    koksma__published_end(d, t);
    koksma__published_say_z(d, &s.together);
    status = status ? status : koksma__table_sets(study, t, &sets, &differ);
    if (!status) {
        say_means(d, t, sets, differ);
    }
    koksma__doc_end(&s.chart);
    koksma__doc_append(d, &s.chart);
    koksma__doc_end(d);
    return status;
}

static koksma_status write(const koksma__report_scope *scope, koksma__document *d)
{
    koksma_status status = KOKSMA_OK;
    koksma__doc_paragraph(
        d,
        "The numbers are means, over point sets, of exact values. z is the published mean minus ours, divided by "
        "the sum of SD √(1/100 + 1/T) and half of the last published digit, where SD and T are the standard "
        "deviation and the number of our sets: it accounts for the errors of both means and for the rounding. A "
        "single |z| below %.1f is attributed to chance; in tables over several numbers of points, z is the "
        "tooltip of each mark. The text below each table tests its values of z together: by chance the largest "
        "|z| of k independent values exceeds 2 with probability 1 - 0.954^k^ (25 %% for six), and six values of "
        "-0.8 are as rare as one of -2. _Largest of 100_ is the mean of the largest values in blocks of 100 sets; "
        "its ± is the SD of these largest values, whereas the other intervals are " KOKSMA__MEAN_INTERVALS
        ". With fewer than 100 sets it is the largest value of all.",
        KOKSMA__AGREEMENT_Z);
    for (size_t i = 0; !status && i < scope->study->plan.n_tables; i++) {
        const koksma__table *t = &scope->study->plan.tables[i];
        if (is_here(scope, t)) {
            status = (koksma__table_is_over_n(t) ? add_sizes_table : add_table)(scope->study, d, t);
        }
    }
    return status;
}

const koksma__section koksma__section_point_tables = {"Irregularity of the patterns", true, is_shown, write};
