/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The published tables of image errors. A row has the published numbers, our means against the block's first
 * reference (the paper's) with the verdict on the published mean, the coherence of the error and, if the block has
 * several references, our means against the last one (the converged image). The text below a table reports the
 * effect of the choice of the reference. The text below all tables gives the order of the patterns by their mean
 * rank over the tables, and the overall order that the paper gives.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/report/mean_coherence.h"
#include "study/report/means.h"
#include "study/report/published_columns.h"
#include "study/report/report.h"

/* The next image table of the scope's plan, from table *i on; *i becomes the index after it. NULL: the plan has no
   further image table. */
static const koksma__table *next_table(const koksma__report_scope *scope, size_t *i)
{
    const koksma__plan *plan = &scope->study->plan;
    for (; *i < plan->n_tables; (*i)++) {
        if (plan->tables[*i].part == scope->plan && plan->tables[*i].scene) {
            return &plan->tables[(*i)++];
        }
    }
    return NULL;
}

static bool is_shown(const koksma__report_scope *scope)
{
    return next_table(scope, &(size_t){0}) != NULL;
}

/* ---- Tables ------------------------------------------------------------------------------------------------ */

/* Adds the columns for the mean, SD and maximum of the error against a reference. */
static void add_cell_columns(koksma__document *d, const char *of, const char *group)
{
    static const koksma__column columns[] = {{"mean", "mean 95 %", .type = KOKSMA__COLUMN_INTERVAL, .digits = 5},
                                             {"SD", "SD", .type = KOKSMA__COLUMN_NUMBER, .digits = 4},
                                             {"max", "max", .type = KOKSMA__COLUMN_NUMBER, .digits = 3}};
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++) {
        char name[KOKSMA_MAX_SPEC + 64];
        koksma__column column = columns[i];
        snprintf(name, sizeof name, "%s, %s", of, column.name);
        column.name = name;
        column.group = group;
        column.fixed = true;
        koksma__doc_column(d, &column);
    }
}

static void add_columns(koksma__document *d, const koksma__image_block *block)
{
    const koksma__reference *first = &block->references[0], *last = &block->references[block->n_references - 1];
    char group[2 * KOKSMA_MAX_SPEC + 160];
    koksma__published_columns(d, "published");
    snprintf(group, sizeof group, "against %lld %s samples (%s), %lld trial%s", first->spp * first->replicates,
             first->pattern, first->name, block->trials, koksma__plural((double)block->trials));
    add_cell_columns(d, first->name, group);
    koksma__doc_column(
        d, &(koksma__column){
               .name = "verdict", .title = "mean within 25 %", .group = group, .type = KOKSMA__COLUMN_VERDICT});
    koksma__bands_columns(d);
    if (block->n_references > 1) {
        snprintf(group, sizeof group, "against %lld × %lld %s samples (%s)", last->replicates, last->spp,
                 last->pattern, last->name);
        add_cell_columns(d, last->name, group);
    }
}

static void add_cell(koksma__document *d, const koksma__cell *cell)
{
    koksma__doc_interval(d, koksma__estimate_of(&cell->mean));
    koksma__doc_number(d, cell->sd);
    koksma__doc_number(d, cell->max);
}

/* The means of a table's rows against the first [0] and the last [1] reference of the block. */
typedef struct row_means {
    size_t *order[2]; /* indices of the rows in ascending order of their means */
    double *mean[2];
} row_means;

static koksma_status add_row(koksma_study *study, koksma__document *d, const koksma__table *t, size_t r,
                             row_means *means)
{
    const koksma__image_block *block = koksma__table_images(study, t);
    const koksma__table_row *row = &t->rows[r];
    koksma__cell cell, last = {0};
    koksma_coherence_values coherence;
    const koksma__image_mean images = {block, t->scene, "", row->pattern, t->n.at[0]};
    koksma_status status = koksma__table_image(study, t, &block->references[0], row->pattern, &cell);
    if (!status) {
        status = koksma__table_image(study, t, &block->references[block->n_references - 1], row->pattern, &last);
    }
    status = status ? status : koksma__mean_coherence(study, &images, &coherence);
    if (status) {
        return status;
    }
    means->mean[0][r] = cell.mean.mean;
    means->mean[1][r] = last.mean.mean;
    const koksma__verdict verdict = koksma__table_judge(t, row, 0, &cell);
    koksma__published_row(d, t, row);
    add_cell(d, &cell);
    koksma__published_verdict(d, &verdict);
    koksma__bands_cells(d, &coherence);
    if (block->n_references > 1) {
        add_cell(d, &last);
    }
    return KOKSMA_OK;
}

/* Sorts the rows by mean, by insertion; rows with equal means keep their order. */
static void order_rows(const double *means, size_t n, size_t *order)
{
    for (size_t r = 0; r < n; r++) {
        size_t at = r;
        for (; at > 0 && means[order[at - 1]] > means[r]; at--) {
            order[at] = order[at - 1];
        }
        order[at] = r;
    }
}

/* Writes how much the choice of the reference changes the means, and whether it changes the order. */
static void say_changes(koksma__document *d, const koksma__table *t, const row_means *means)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t r = 0; r < t->n_rows; r++) {
        const double change = means->mean[1][r] / means->mean[0][r] - 1;
        low = fmin(low, change);
        high = fmax(high, change);
    }
    koksma__doc_say(d, "Best to worst against the converged reference: ");
    for (size_t r = 0; r < t->n_rows; r++) {
        koksma__doc_say(d, "%s%s", t->rows[means->order[1][r]].label, r + 1 < t->n_rows ? "; " : ". ");
    }
    if (isfinite(low) && isfinite(high)) {
        const bool differ = memcmp(means->order[0], means->order[1], t->n_rows * sizeof *means->order[0]) != 0;
        koksma__doc_say(
            d,
            "Taking the converged reference instead of the paper's changes the means by %+.1f to %+.1f %% "
            "and %s the order of the patterns. ",
            100 * low, 100 * high, differ ? "changes" : "does not change");
    }
}

/* Writes the effect of the choice of the reference if every row has a mean. */
static koksma_status add_reference_remark(koksma_study *study, koksma__document *d, const koksma__table *t,
                                          const row_means *means)
{
    const koksma__image_block *block = koksma__table_images(study, t);
    double smallest = INFINITY, error;
    for (size_t r = 0; r < t->n_rows; r++) {
        if (isnan(means->mean[0][r]) || isnan(means->mean[1][r])) {
            koksma__doc_paragraph(d, "Some rows have no trials yet.");
            return KOKSMA_OK;
        }
        smallest = fmin(smallest, means->mean[1][r]);
    }
    for (int k = 0; k < 2; k++) {
        order_rows(means->mean[k], t->n_rows, means->order[k]);
    }
    const koksma_status status = koksma__reference_error(study, block, t->scene, "", &error);
    koksma__doc_paragraph_begin(d);
    say_changes(d, t, means);
    if (!status && isfinite(error)) {
        koksma__doc_say(d,
                        "The mean error of the converged reference itself is %.2g, which is %.2g times the smallest "
                        "error in the table.",
                        error, error / smallest);
    }
    koksma__doc_paragraph_end(d);
    return status;
}

static koksma_status add_table(koksma_study *study, koksma__document *d, const koksma__table *t)
{
    const size_t n = t->n_rows;
    double *numbers = malloc(2 * n * sizeof *numbers);
    size_t *positions = malloc(2 * n * sizeof *positions);
    row_means means = {{positions, positions + n}, {numbers, numbers + n}};
    koksma_status status = numbers && positions ? KOKSMA_OK : koksma__fail_memory(4 * n * sizeof *numbers);
    if (!status) {
        koksma__published_begin(d, t);
        add_columns(d, koksma__table_images(study, t));
        for (size_t r = 0; !status && r < n; r++) {
            status = add_row(study, d, t, r, &means);
        }
        koksma__published_end(d, t);
        status = status ? status : add_reference_remark(study, d, t, &means);
        koksma__doc_end(d);
    }
    free(numbers);
    free(positions);
    return status;
}

/* ---- The overall order ------------------------------------------------------------------------------------- */

/* Adds the rank of every row of table t, by its mean against the first reference, to ranks[k], where row k of the
   table `first` is the row with the same pattern. Sets *whole to false if a row has no trials yet or no row of
   `first` has its pattern. */
static koksma_status add_ranks(koksma_study *study, const koksma__table *t, const koksma__table *first, double *ranks,
                               bool *whole)
{
    double *means = malloc(t->n_rows * sizeof *means);
    koksma_status status = means ? KOKSMA_OK : koksma__fail_memory(t->n_rows * sizeof *means);
    for (size_t r = 0; !status && r < t->n_rows; r++) {
        koksma__cell cell;
        status =
            koksma__table_image(study, t, &koksma__table_images(study, t)->references[0], t->rows[r].pattern, &cell);
        means[r] = cell.mean.mean;
        *whole &= !status && cell.mean.n > 0;
    }
    for (size_t r = 0; !status && r < t->n_rows; r++) {
        size_t at = 0, below = 0;
        for (size_t k = 0; k < t->n_rows; k++) {
            below += means[k] < means[r];
        }
        while (at < first->n_rows && strcmp(first->rows[at].pattern, t->rows[r].pattern) != 0) {
            at++;
        }
        *whole &= at < first->n_rows;
        if (at < first->n_rows) {
            ranks[at] += (double)below + 1;
        }
    }
    free(means);
    return status;
}

static void say_order(const koksma__report_scope *scope, koksma__document *d, const koksma__table *first,
                      const double *ranks, const size_t *order, size_t tables)
{
    koksma__doc_paragraph_begin(d);
    koksma__doc_say(d, "Best to worst over the %zu tables, by mean rank against the paper's reference: ", tables);
    for (size_t r = 0; r < first->n_rows; r++) {
        koksma__doc_say(d, "%s (%.4g)%s", first->rows[order[r]].label, ranks[order[r]] / (double)tables,
                        r + 1 < first->n_rows ? "; " : ".");
    }
    if (koksma__plan_of(scope)->order) {
        koksma__doc_say(d, " The overall order that the paper's text gives: %s.", koksma__plan_of(scope)->order);
    }
    koksma__doc_paragraph_end(d);
}

/* Writes the order of the patterns by their mean rank over the tables, if there are several tables of the same
   patterns. */
static koksma_status add_order(const koksma__report_scope *scope, koksma__document *d)
{
    size_t i = 0, tables = 0;
    bool whole = true;
    const koksma__table *first = next_table(scope, &i);
    double *ranks = calloc(first->n_rows, sizeof *ranks);
    size_t *order = calloc(first->n_rows, sizeof *order);
    koksma_status status = ranks && order ? KOKSMA_OK : koksma__fail_memory(2 * first->n_rows * sizeof *ranks);
    for (const koksma__table *t = first; !status && t; t = next_table(scope, &i)) {
        whole &= t->n_rows == first->n_rows;
        status = add_ranks(scope->study, t, first, ranks, &whole);
        tables++;
    }
    if (!status && whole && tables > 1) {
        order_rows(ranks, first->n_rows, order);
        say_order(scope, d, first, ranks, order, tables);
    }
    free(ranks);
    free(order);
    return status;
}

static koksma_status write(const koksma__report_scope *scope, koksma__document *d)
{
    size_t i = 0;
    koksma_status status = KOKSMA_OK;
    koksma__doc_paragraph(d,
                          "Absolute error in luminance over the pixels, with a box filter one pixel wide. Intervals "
                          "are " KOKSMA__MEAN_INTERVALS ". A maximum is the error of one pixel; maxima get "
                          "no verdict. Coherence is the peak of the mean power spectrum of the errors of the first "
                          "%d trials over its mean: white noise stays below the next column in 97.5 %% of cases, and "
                          "an error above 99.5 %% of noise is in bands or another pattern that the eye sees "
                          "(section _Pictures_).",
                          KOKSMA__SPECTRUM_TRIALS);
    for (const koksma__table *t = next_table(scope, &i); !status && t; t = next_table(scope, &i)) {
        status = add_table(scope->study, d, t);
    }
    return status ? status : add_order(scope, d);
}

const koksma__section koksma__section_image_tables = {"Errors of images", true, is_shown, write};
