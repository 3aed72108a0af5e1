/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Published tables whose columns are numbers of points, as Mitchell 1992 prints them. Each pattern has a line of the
 * printed means, one of ours with intervals and verdicts, and, where the table has a second measure, one of that. At
 * the end of a line is its slope in log-log: of the printed ends, and of our means by least squares over all columns
 * (koksma__trend_of); theory's exponent follows. A chart of the same means follows.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "stats/slopes.h"
#include "study/report/report_chart.h"
#include "study/report/report_tables.h"

/* What is being written, and where to. */
typedef struct sizes_page {
    koksma_study *study;
    koksma__html *html, csv;
    const koksma__table *table;
    koksma__agreement *agreement;
    koksma__z_sums together;
    koksma__chart chart;
} sizes_page;

static void add_heads(sizes_page *p)
{
    const koksma__wholes *n = &p->table->n;
    char text[40];
    static const char *const names[] = {"row", "pattern", "values"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        koksma__csv_text(&p->csv, names[i]);
    }
    koksma__table_open(p->html, p->table);
    koksma__html_add(p->html, "<tr><th scope=\"col\">pattern</th><th scope=\"col\" class=\"name\">mean</th>");
    for (size_t i = 0; i < n->n; i++) {
        snprintf(text, sizeof text, "%lld points", n->at[i]);
        koksma__csv_text(&p->csv, text);
        koksma__html_add(p->html, "<th scope=\"col\">%s</th>", text);
    }
    koksma__csv_text(&p->csv, "slope");
    koksma__csv_text(&p->csv, "slope low");
    koksma__csv_text(&p->csv, "slope high");
    koksma__csv_text(&p->csv, "theory");
    koksma__html_add(p->html, "<th scope=\"col\">slope <span class=\"pm\">95 %%</span></th><th scope=\"col\">theory"
                              "</th></tr></thead>\n");
}

static void begin_csv_line(sizes_page *p, const koksma__table_row *row, const char *values)
{
    koksma__csv_row(&p->csv);
    koksma__csv_text(&p->csv, row->label);
    koksma__csv_text(&p->csv, row->pattern);
    koksma__csv_text(&p->csv, values);
}

static void add_slope(sizes_page *p, koksma__estimate slope, double rate)
{
    koksma__csv_number(&p->csv, slope.value);
    koksma__csv_number(&p->csv, slope.low);
    koksma__csv_number(&p->csv, slope.high);
    koksma__csv_number(&p->csv, rate);
    koksma__html_add(p->html, isnan(slope.value) ? "<td>&#8211;" : "<td>%.3f", slope.value);
    if (!isnan(slope.low)) {
        koksma__html_add(p->html, " <span class=\"pm\">(%.3f to %.3f)</span>", slope.low, slope.high);
    }
    koksma__html_add(p->html, "</td>");
}

static koksma__chart_series *add_series(sizes_page *p, const char *label, const char *more)
{
    if (p->chart.n == KOKSMA__CHART_SERIES) {
        p->chart.left_out++;
        return NULL;
    }
    koksma__chart_series *series = &p->chart.series[p->chart.n++];
    snprintf(series->label, sizeof series->label, "%.60s%s", label, more);
    return series;
}

static void add_point(koksma__chart_series *series, double n, double mean, double low, double high)
{
    if (series && series->n < KOKSMA__CHART_POINTS) {
        series->x[series->n] = n;
        series->y[series->n] = mean;
        series->low[series->n] = low;
        series->high[series->n++] = high;
    }
}

static void add_printed_line(sizes_page *p, const koksma__table_row *row)
{
    const koksma__wholes *n = &p->table->n;
    const double slope = koksma__table_printed_slope(p->table, row);
    begin_csv_line(p, row, "printed");
    koksma__html_add(p->html, "<td class=\"name\">printed</td>");
    for (size_t i = 0; i < n->n; i++) {
        const koksma__printed *printed = &row->published[i];
        koksma__table_add_printed(p->html, printed, koksma__table_note(p->table, row->pattern, n->at[i], 0));
        koksma__csv_number(&p->csv, printed->value);
    }
    add_slope(p, (koksma__estimate){slope, NAN, NAN}, row->rate);
    koksma__html_add(p->html, isnan(row->rate) ? "<td>&#8211;</td></tr>\n" : "<td>%.3g</td></tr>\n", row->rate);
}

/* Our means of a measure; judged, and drawn, where it is the table's own. */
static koksma_status add_our_line(sizes_page *p, const koksma__table_row *row, const char *measure, bool own)
{
    const koksma__wholes *n = &p->table->n;
    koksma__summary means[KOKSMA__TABLE_PRINTED];
    double x[KOKSMA__TABLE_PRINTED];
    size_t known = 0;
    koksma__chart_series *series = own ? add_series(p, row->label, "") : NULL;
    koksma_status status = KOKSMA_OK;
    if (series) {
        series->line = true;
    }
    begin_csv_line(p, row, measure);
    koksma__html_add(p->html, "<tr><td class=\"name\">");
    koksma__html_text(p->html, measure);
    koksma__html_add(p->html, "</td>");
    for (size_t i = 0; !status && i < n->n; i++) {
        koksma__cell cell;
        status = koksma__table_discrepancy(p->study, p->table, measure, row->pattern, n->at[i], &cell);
        if (status) {
            break;
        }
        koksma__html_add(p->html, "<td>");
        koksma__table_add_mean(p->html, &cell.mean, 4, false);
        if (own) {
            const koksma__verdict verdict = koksma__table_judge(p->table, row, i, &cell);
            koksma__html_add(p->html, " ");
            koksma__table_add_judgement(p->html, p->agreement, &verdict, false);
            koksma__table_add_z(&p->together, &verdict, &cell);
        }
        koksma__html_add(p->html, "</td>");
        koksma__csv_number(&p->csv, cell.mean.mean);
        add_point(series, (double)n->at[i], cell.mean.mean, cell.mean.low, cell.mean.high);
        if (cell.mean.n && cell.mean.mean > 0) {
            x[known] = (double)n->at[i];
            means[known++] = cell.mean;
        }
    }
    add_slope(p, koksma__trend_of(x, means, known).slope, row->rate);
    koksma__html_add(p->html, "<td></td></tr>\n");
    return status;
}

/* The printed means of a row as hollow marks, in the colour of our line. */
static void add_printed_marks(sizes_page *p, const koksma__table_row *row, size_t like)
{
    const koksma__wholes *n = &p->table->n;
    koksma__chart_series *series = row->n_published ? add_series(p, row->label, ", printed") : NULL;
    for (size_t i = 0; series && i < n->n; i++) {
        series->hollow = true;
        series->like = like;
        add_point(series, (double)n->at[i], row->published[i].value, NAN, NAN);
    }
}

static koksma_status add_row(sizes_page *p, const koksma__table_row *row)
{
    koksma__html_add(p->html, "<tbody><tr><th scope=\"rowgroup\" rowspan=\"%d\">", p->table->also ? 3 : 2);
    koksma__html_text(p->html, row->label);
    koksma__html_add(p->html, "</th>");
    add_printed_line(p, row);
    koksma_status status = add_our_line(p, row, p->table->measure, true);
    if (!status && p->table->also) {
        status = add_our_line(p, row, p->table->also, false);
    }
    koksma__html_add(p->html, "</tbody>\n");
    return status;
}

/* The fewest and the most sets behind a mean of the table's measure, those of patterns with a single set left out. */
static koksma_status add_sets_sentence(sizes_page *p)
{
    size_t most;
    bool differ;
    const koksma_status status = koksma__table_sets(p->study, p->table, &most, &differ);
    koksma__html_add(
        p->html,
        "<p>Printed means are of 100 sets, ours of %s%zu. A slope is that of the printed ends, and of our "
        "means by least squares; theory is the exponent that is known for the pattern.</p>\n",
        differ ? "up to " : "", most);
    return status;
}

koksma_status koksma__report_sizes_table(koksma_study *study, koksma__html *h, koksma__agreement *agreement,
                                         const koksma__table *t)
{
    char title[200];
    snprintf(title, sizeof title, "Table %.60s: %.110s%s", t->id, t->title,
             t->rows[0].n_published ? ". Hollow: printed" : "");
    sizes_page p = {.study = study,
                    .html = h,
                    .table = t,
                    .agreement = agreement,
                    .chart = {.title = title,
                              .x_title = "points",
                              .y_title = t->measure,
                              .log_x = true,
                              .log_y = true,
                              .series = calloc(KOKSMA__CHART_SERIES, sizeof *p.chart.series)}};
    koksma_status status =
        p.chart.series ? KOKSMA_OK : koksma__fail_memory(KOKSMA__CHART_SERIES * sizeof *p.chart.series);
    add_heads(&p);
    for (size_t r = 0; !status && r < t->n_rows; r++) {
        status = add_row(&p, &t->rows[r]);
    }
    for (size_t r = 0, lines = p.chart.n; !status && r < lines; r++) {
        add_printed_marks(&p, &t->rows[r], r + 1);
    }
    koksma__table_end(h, &p.csv, t);
    koksma__table_end_z(h, &p.together);
    status = status ? status : add_sets_sentence(&p);
    if (!status) {
        koksma__html_chart(h, &p.chart);
    }
    free(p.chart.series);
    return status;
}
