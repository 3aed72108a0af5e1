/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The published tables beside our numbers. A row has its label, the published numbers, each with the number of its note,
 * and then our numbers with the verdict on the published mean; below a table are its notes.
 *
 * Discrepancies at one number of points (Shirley 1991): our mean, SD and largest of 100, and the means of a second measure.
 * Discrepancies over several numbers of points (Mitchell 1992): two or three rows per pattern with the published means, our
 * means with their verdicts, and our means of a second measure. Each of these rows ends with its log-log slope, computed by
 * least squares over all columns (koksma__trend_of) of published means and of ours alike, and with what theory predicts:
 * the exponent, and the multiple of random points' mean. A chart of the means follows.
 *
 * Errors of images: our means against the block's first reference (the paper's), the coherence of the error and, if the
 * block has several references, our means against the last one (the converged image).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/status.h"
#include "study/plan/plan.h"
#include "study/report/report.h"

/* The next table of the report's plan, of images or of points, from table *i on; *i becomes the index after it. NULL: there
   is no further one. */
static const koksma__table *next_table(const koksma__report *r, bool images, size_t *i)
{
    const koksma__plan *plan = &r->study->plan;
    while (*i < plan->n_tables) {
        const koksma__table *t = &plan->tables[(*i)++];
        if (t->part == r->part && (t->scene != NULL) == images) {
            return t;
        }
    }
    return NULL;
}

/* ---- Parts of all tables ----------------------------------------------------------------------------------- */

/* Begins the section of a table, with the heading "Table 1: title", and the table itself. */
static void begin_table(koksma__document *d, const koksma__table *t)
{
    char id[96];
    snprintf(id, sizeof id, "table-%.80s", t->id);
    koksma__doc_section(d, id, "Table %s: %s", t->id, t->title);
    koksma__doc_table(d, "%s", id);
}

/* Ends the table and writes its notes. The section stays open for further paragraphs. */
static void end_table(koksma__document *d, const koksma__table *t)
{
    if (t->n_notes) {
        koksma__doc_list(d, NULL, true);
        for (size_t i = 0; i < t->n_notes; i++) {
            koksma__doc_item(d, "%s", t->notes[i].reason);
        }
    }
}

/* Writes the columns for the label, the pattern, the verdict on the published mean, which is read first, and the published
   mean, SD and maximum. */
static void add_published_columns(koksma__document *d, const char *verdict, const char *group)
{
    koksma__doc_columns(d,
                        "t row#pattern;th pattern;v verdict#%s;n4 published mean#ave#%s;n4 published SD#SD#%s;n4 "
                        "published max#max#%s",
                        verdict, group, group, group);
}

/* Writes a cell with a number as published, and its note; a dash if the paper has no number there. */
static void add_published(koksma__document *d, const koksma__printed *printed, size_t note)
{
    koksma__cell_data cell = koksma__cell_of(printed->value);
    cell.text = printed->text;
    cell.note = note;
    if (isnan(printed->value)) {
        koksma__doc_cells(d, "n", (double)NAN);
    } else {
        koksma__doc_cell(d, &cell);
    }
}

/* Writes a cell with our mean, the number of sets over which it is taken (0: not shown), and the verdict on the
   published mean (NULL: no verdict). */
static void add_mean(koksma__document *d, const koksma__summary *mean, size_t sets, const koksma__verdict *v)
{
    koksma__cell_data cell = koksma__cell_of(mean->mean);
    cell.low = mean->low;
    cell.high = mean->high;
    cell.sets = sets;
    if (v) {
        cell.note = v->kind == KOKSMA_VERDICT_EXPLAINED || v->kind == KOKSMA_VERDICT_UNTESTED ? v->note : 0;
        cell.verdict = koksma_study_verdict_name(v->kind);
        cell.z = v->z;
        cell.change = v->ratio;
    }
    koksma__doc_cell(d, &cell);
}

static void begin_row(koksma__document *d, const koksma__table *t, const koksma__table_row *row,
                      const koksma__verdict *verdict)
{
    koksma__doc_row(d, "tt", row->label, row->pattern);
    add_mean(d, &(koksma__summary){.mean = NAN, .low = NAN, .high = NAN}, 0, verdict);
    for (int s = 0; s < 3; s++) {
        add_published(d, &row->published[s], koksma__table_note(t, row->pattern, 0, s));
    }
}

/* ---- Discrepancies at one number of points ----------------------------------------------------------------- */

/* *most: the largest number of sets that a pattern of the table has; *differ: whether the patterns that are not
   deterministic have different numbers of sets. */
static void count_sets(koksma__report *r, const koksma__table *t, size_t *most, bool *differ)
{
    const char *const measures[] = {t->measure, t->also};
    size_t least = SIZE_MAX, most_of_all = 0;
    *most = 0;
    for (size_t i = 0; i < 2 * t->n_rows * t->n.n; i++) {
        const char *pattern = t->rows[i / 2 / t->n.n].pattern;
        if (!measures[i % 2]) {
            continue;
        }
        const size_t sets = koksma__points_cell(r, t, measures[i % 2], pattern, t->n.at[i / 2 % t->n.n]).mean.n;
        *most = i % 2 == 0 && sets > *most ? sets : *most;
        if (!koksma__has_one_set(pattern)) {
            least = sets < least ? sets : least;
            most_of_all = sets > most_of_all ? sets : most_of_all;
        }
    }
    *differ = least < most_of_all;
}

/* Adds the columns for the mean, SD and largest value of a measure. beside: whether the measure is the table's second
   one, of which the page shows only the mean. */
static void add_measure_columns(koksma__document *d, const char *measure, const char *group, size_t sets, bool beside)
{
    koksma__doc_columns(d,
                        beside ? "i4 %s, mean#%s#%s;n3h %s, SD#SD#%s;s3h %s, max#largest of %lld#%s"
                               : "i4 %s, mean#%s#%s;n3 %s, SD#SD#%s;s3 %s, max#largest of %lld#%s",
                        measure, beside ? measure : "mean 95 %", group, measure, group, measure,
                        sets < 100 ? (long long)sets : 100LL, group);
}

static void add_measure_cells(koksma__document *d, const koksma__cell *cell, bool differ)
{
    koksma__cell_data largest = koksma__cell_of(cell->max);
    largest.sd = cell->max_sd;
    add_mean(d, &cell->mean, differ ? cell->mean.n : 0, NULL);
    koksma__doc_cells(d, "n", cell->sd);
    koksma__doc_cell(d, &largest);
}

static void add_table(koksma__report *r, koksma__document *d, const koksma__table *t)
{
    char group[KOKSMA_MAX_SPEC + 64];
    size_t sets;
    bool differ;
    count_sets(r, t, &sets, &differ);
    snprintf(group, sizeof group, "%s, %s%zu set%s", t->measure, differ ? "up to " : "", sets,
             koksma__plural((double)sets));
    begin_table(d, t);
    add_published_columns(d, "mean agrees, z", "published");
    add_measure_columns(d, t->measure, group, sets, false);
    if (t->also) {
        add_measure_columns(d, t->also, "beside it", sets, true);
    }
    for (size_t i = 0; i < t->n_rows; i++) {
        const koksma__table_row *row = &t->rows[i];
        const koksma__cell cell = koksma__table_cell(r, t, row->pattern, 0);
        const koksma__verdict verdict = koksma__table_judge(t, row, 0, &cell);
        begin_row(d, t, row, &verdict);
        add_measure_cells(d, &cell, differ);
        if (t->also) {
            const koksma__cell also = koksma__points_cell(r, t, t->also, row->pattern, t->n.at[0]);
            add_measure_cells(d, &also, differ);
        }
    }
    end_table(d, t);
    koksma__doc_end(d);
}

/* ---- Discrepancies over several numbers of points ---------------------------------------------------------- */

/* The log-log slope of the published numbers of a row, by least squares as ours; NaN if one of them is missing. */
static double printed_slope(const koksma__table *t, const koksma__table_row *row)
{
    double x[KOKSMA__TABLE_PRINTED];
    koksma__summary means[KOKSMA__TABLE_PRINTED];
    for (size_t i = 0; i < t->n.n; i++) {
        if (!(row->published[i].value > 0)) {
            return NAN;
        }
        x[i] = (double)t->n.at[i];
        means[i] = koksma__exactly(row->published[i].value);
    }
    return koksma__trend_of(x, means, t->n.n).slope.value;
}

/* Adds the row with the printed means; with `chart` their hollow marks, in the style of our curve, instead. */
static void add_printed_line(koksma__document *d, koksma__document *chart, const koksma__table *t,
                             const koksma__table_row *row)
{
    const double slope = printed_slope(t, row);
    if (chart) {
        koksma__doc_series(chart, row->label, row->pattern, KOKSMA__SERIES_HOLLOW);
    } else {
        koksma__doc_row(d, "ttt", row->label, row->pattern, "printed");
    }
    for (size_t i = 0; i < t->n.n; i++) {
        if (chart) {
            koksma__doc_point(chart, (double)t->n.at[i], row->published[i].value, NAN, NAN);
        } else {
            add_published(d, &row->published[i], koksma__table_note(t, row->pattern, t->n.at[i], 0));
        }
    }
    if (!chart) {
        koksma__doc_cells(d, "inn", (koksma__estimate){slope, slope, slope}, row->rate, row->of_random);
    }
}

/* Adds a row with our means of a measure. Those of the table's first measure get verdicts and a curve; of the second one
   `chart` is NULL. */
static void add_our_line(koksma__report *r, koksma__document *d, const koksma__table *t, const koksma__table_row *row,
                         const char *measure, koksma__document *chart)
{
    koksma__curve curve = koksma__curve_of(r, t->n.n);
    koksma__doc_row(d, "ttt", row->label, row->pattern, measure);
    if (chart) {
        koksma__doc_series(chart, row->label, row->pattern, KOKSMA__SERIES_LINE);
    }
    for (size_t i = 0; i < t->n.n; i++) {
        const koksma__cell cell = koksma__points_cell(r, t, measure, row->pattern, t->n.at[i]);
        const koksma__verdict verdict = koksma__table_judge(t, row, i, &cell);
        add_mean(d, &cell.mean, 0, chart ? &verdict : NULL);
        if (chart) {
            koksma__doc_point(chart, (double)t->n.at[i], cell.mean.mean, cell.mean.low, cell.mean.high);
        }
        koksma__curve_add(&curve, t->n.at[i], cell.mean);
    }
    koksma__doc_cells(d, "i", koksma__trend_of(curve.x, curve.y, curve.n).slope);
}

static void add_sizes_table(koksma__report *r, koksma__document *d, const koksma__table *t)
{
    char title[200];
    size_t sets;
    bool differ, published = false;
    koksma__document chart = {0};
    snprintf(title, sizeof title, "Table %.60s: %.110s%s", t->id, t->title,
             t->rows[0].n_published ? ". Hollow: printed" : "");
    koksma__doc_chart(&chart, &(koksma__chart){title, "points", t->measure, true, true, 0});
    begin_table(d, t);
    koksma__doc_columns(d, "tm row#pattern;th pattern;t values#mean");
    for (size_t i = 0; i < t->n.n; i++) {
        koksma__doc_columns(d, "i4 %lld point%s", t->n.at[i], koksma__plural((double)t->n.at[i]));
    }
    koksma__doc_columns(d, "i3f slope#slope 95 %%;n3 theory;n2 × random");
    for (size_t i = 0; i < t->n_rows; i++) {
        add_printed_line(d, NULL, t, &t->rows[i]);
        add_our_line(r, d, t, &t->rows[i], t->measure, &chart);
        if (t->also) {
            add_our_line(r, d, t, &t->rows[i], t->also, NULL);
        }
    }
    for (size_t i = 0; i < t->n_rows; i++) {
        if (t->rows[i].n_published) {
            published = true;
            add_printed_line(d, &chart, t, &t->rows[i]);
        }
    }
    end_table(d, t);
    count_sets(r, t, &sets, &differ);
    koksma__doc_paragraph(d,
                          published ? "Published means are taken to be over 100 sets, ours are over %s%zu"
                                    : "Means are over %s%zu sets",
                          differ ? "up to " : "", sets);
    koksma__doc_say(d, ". Slopes are least squares over all columns; _theory_ is the exponent of the pattern for "
                       "large N, which a slope over these columns need not have reached, and _× random_ the factor, "
                       "where known, of its mean there to that of random points.");
    koksma__doc_append(d, &chart);
    koksma__doc_end(d);
}

static void write_point_tables(koksma__report *r, koksma__document *d)
{
    size_t i = 0;
    const koksma__table *t = next_table(r, false, &i);
    if (!t) {
        return;
    }
    koksma__doc_paragraph(
        d,
        "The numbers are means over point sets, by the measure that heads the column. z is the published mean minus "
        "ours, divided by the sum of SD √(1/100 + 1/T) and half of the last published digit, where SD and T are the "
        "standard deviation and the number of our sets: it accounts for the errors of both means, the published one "
        "taken to be over 100 sets, and for the rounding. A single |z| below %.1f is attributed to chance (✓ and z); "
        "the section _Agreement with the published means_ tests all of a table together. _Largest of 100_ is the "
        "mean of the largest "
        "values in blocks of 100 sets; its ±, from five blocks on, is the SD of these largest values, whereas the "
        "other intervals are " KOKSMA__MEAN_INTERVALS ". With fewer than 100 sets it is the largest value of all.",
        KOKSMA__AGREEMENT_Z);
    for (; !r->status && t; t = next_table(r, false, &i)) {
        (koksma__table_is_over_n(t) ? add_sizes_table : add_table)(r, d, t);
    }
}

const koksma__section koksma__section_point_tables = {"Irregularity of the patterns", true, write_point_tables};

/* ---- Errors of images -------------------------------------------------------------------------------------- */

/* Adds the columns for the mean, SD and maximum of the error against a reference. */
static void add_error_columns(koksma__document *d, const char *of, const char *group)
{
    koksma__doc_columns(d, "i5f %s, mean#mean 95 %%#%s;n4f %s, SD#SD#%s;n3f %s, max#max#%s", of, group, of, group, of,
                        group);
}

static void add_image_columns(koksma__document *d, const koksma__image_block *block)
{
    const koksma__reference *first = &block->references[0], *last = &block->references[block->n_references - 1];
    char group[2 * KOKSMA_MAX_SPEC + 160];
    add_published_columns(d, "mean within 25 %", "published");
    snprintf(group, sizeof group, "against %lld %s samples (%s), %lld trial%s", first->spp * first->replicates,
             first->pattern, first->name, block->trials, koksma__plural((double)block->trials));
    add_error_columns(d, first->name, group);
    koksma__doc_columns(d, "n3 coherence;n3 noise below;n2 p;t coherent");
    if (block->n_references > 1) {
        snprintf(group, sizeof group, "against %lld × %lld %s samples (%s)", last->replicates, last->spp,
                 last->pattern, last->name);
        add_error_columns(d, last->name, group);
    }
}

static void add_image_row(koksma__report *r, koksma__document *d, const koksma__table *t,
                          const koksma__table_row *row)
{
    const koksma__subject s = koksma__table_images(r->study, t);
    const koksma__cell cell = koksma__table_cell(r, t, row->pattern, 0),
                       last = koksma__image_cell(r, t, s.reference, row->pattern);
    const koksma_coherence_values v = koksma__mean_coherence(r, &s, row->pattern, t->n.at[0]);
    const koksma__verdict verdict = koksma__table_judge(t, row, 0, &cell);
    const double none = NAN;
    begin_row(d, t, row, &verdict);
    koksma__doc_cells(d, "innnnnt", koksma__estimate_of(&cell.mean), cell.sd, cell.max, v.images ? v.coherence : none,
                      v.images ? v.noise_high : none, v.images ? v.p : none,
                      !v.images    ? "not known"
                      : v.coherent ? "yes"
                                   : "no");
    if (s.images->n_references > 1) {
        koksma__doc_cells(d, "inn", koksma__estimate_of(&last.mean), last.sd, last.max);
    }
}

static void add_image_table(koksma__report *r, koksma__document *d, const koksma__table *t)
{
    begin_table(d, t);
    add_image_columns(d, &r->study->plan.images[t->images]);
    for (size_t i = 0; i < t->n_rows; i++) {
        add_image_row(r, d, t, &t->rows[i]);
    }
    end_table(d, t);
    koksma__doc_end(d);
}

static void write_image_tables(koksma__report *r, koksma__document *d)
{
    size_t i = 0;
    const koksma__table *t = next_table(r, true, &i);
    if (!t) {
        return;
    }
    koksma__doc_paragraph(
        d,
        "Absolute error in luminance over the pixels, with a box filter one pixel wide. Intervals "
        "are " KOKSMA__MEAN_INTERVALS ". A maximum is the error of one pixel; maxima get no verdict. Coherence, the "
        "peak of the mean power spectrum over the mean power (of frequencies as high if that is larger), "
        "is that of the errors of the first %d trials: that of white noise is below _noise below_ in 97.5 %% of "
        "cases, and as large as here with probability p. An error with p below %g is coherent: in bands, a slow "
        "shade or another pattern that the eye sees.",
        KOKSMA__SPECTRUM_TRIALS, KOKSMA_COHERENT_P);
    for (; !r->status && t; t = next_table(r, true, &i)) {
        add_image_table(r, d, t);
    }
}

const koksma__section koksma__section_image_tables = {"Errors of images", true, write_image_tables};
