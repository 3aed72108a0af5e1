/* SPDX-License-Identifier: Apache-2.0 */
/* Published tables of image errors, and what the choice of the reference changes. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "study/report/coherence_rows.h"
#include "study/report/report_tables.h"

static void add_image_cell(koksma__html *h, const koksma__cell *cell)
{
    koksma__html_add(h, "<td>");
    koksma__table_add_mean(h, &cell->mean, 5, true);
    koksma__html_add(h, "</td>");
    koksma__table_add_number(h, cell->sd, 4, true);
    koksma__table_add_number(h, cell->max, 3, true);
}

/* The rows' means against the first reference of the block and the last. */
typedef struct row_means {
    size_t *order[2]; /* the rows' places, best first */
    double *mean[2];
} row_means;

static koksma_status add_image_row(koksma_study *study, koksma__html *h, koksma__html *csv,
                                   koksma__agreement *agreement, const koksma__table *t, size_t r, row_means *means)
{
    const koksma__image_block *block = koksma__table_images(study, t);
    const koksma__table_row *row = &t->rows[r];
    koksma__cell cell, last = {0};
    koksma__row_coherence coherence;
    char bands[KOKSMA__COHERENCE_TEXT];
    koksma_status status = koksma__table_image(study, t, &block->references[0], row->pattern, &cell);
    if (!status) {
        status = koksma__table_image(study, t, &block->references[block->n_references - 1], row->pattern, &last);
    }
    status =
        status ? status : koksma__image_coherence(study, block, t->scene, "", row->pattern, t->n.at[0], &coherence);
    if (status) {
        return status;
    }
    means->mean[0][r] = cell.mean.mean;
    means->mean[1][r] = last.mean.mean;
    koksma__table_begin_row(h, csv, t, row);
    koksma__table_csv_cell(csv, &cell);
    koksma__table_csv_cell(csv, &last);
    add_image_cell(h, &cell);
    const koksma__verdict verdict = koksma__table_judge(t, row, 0, &cell);
    koksma__table_add_verdict(h, agreement, &verdict);
    add_image_cell(h, &last);
    koksma__coherence_text(&coherence, bands);
    koksma__csv_number(csv, coherence.mean.mean);
    koksma__csv_text(csv, coherence.mean.n ? koksma__in_bands(&coherence) ? "yes" : "no" : "");
    koksma__html_add(h, "<td>%s</td></tr>\n", bands);
    return KOKSMA_OK;
}

/* Insertion sort, ties by place. */
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

/* Says how the choice of the reference changes the table, once every row has a mean. */
static koksma_status add_reference_remark(koksma_study *study, koksma__html *h, const koksma__table *t,
                                          const row_means *means)
{
    const koksma__image_block *block = koksma__table_images(study, t);
    const koksma__study_scene *scene = koksma__study_scene_of(study, t->scene);
    double low = INFINITY, high = -INFINITY, smallest = INFINITY, error;
    for (size_t r = 0; r < t->n_rows; r++) {
        const double change = means->mean[1][r] / means->mean[0][r] - 1;
        if (isnan(means->mean[0][r]) || isnan(means->mean[1][r])) {
            koksma__html_add(h, "<p>Not every row has trials yet.</p>\n");
            return KOKSMA_OK;
        }
        low = fmin(low, change);
        high = fmax(high, change);
        smallest = fmin(smallest, means->mean[1][r]);
    }
    for (int k = 0; k < 2; k++) {
        order_rows(means->mean[k], t->n_rows, means->order[k]);
    }
    koksma__html_add(h, "<p>Best to worst against the converged reference: ");
    for (size_t r = 0; r < t->n_rows; r++) {
        koksma__html_text(h, t->rows[means->order[1][r]].label);
        koksma__html_add(h, "%s", r + 1 < t->n_rows ? ", " : ". ");
    }
    if (isfinite(low) && isfinite(high)) {
        koksma__html_add(
            h, "Taking the converged reference instead of the paper's changes the means by %+.1f to %+.1f %% and ",
            100 * low, 100 * high);
        koksma__html_add(h, "%s. ",
                         memcmp(means->order[0], means->order[1], t->n_rows * sizeof *means->order[0])
                             ? "changes the order of the patterns"
                             : "leaves the order of the patterns as it is");
    }
    char name[KOKSMA__REFERENCE_NAME];
    size_t index;
    koksma_status status = koksma__reference_index(study, block, scene, "", block->n_references - 1, &index);
    if (status) {
        return status;
    }
    const koksma__series key = koksma__reference_key(&study->references[index], name);
    status = koksma__store_reference(study->store, &key, &error);
    if (!status && isfinite(error)) {
        koksma__html_add(h,
                         "The converged reference's own mean error is %.2g: %.2g of the smallest error in the table.",
                         error, error / smallest);
    }
    koksma__html_add(h, "</p>\n");
    return status;
}

static void add_heads(koksma__html *h, const koksma__image_block *block)
{
    const koksma__reference *first = &block->references[0], *last = &block->references[block->n_references - 1];
    koksma__html_add(h, "<tr><th></th><th colspan=\"3\">published</th><th colspan=\"4\">against %lld ",
                     first->spp * first->replicates);
    koksma__html_text(h, first->pattern);
    koksma__html_add(h, " samples (");
    koksma__html_text(h, first->name);
    koksma__html_add(h, "), %lld trials</th><th colspan=\"3\">against %lld &#215; %lld ", block->trials,
                     last->replicates, last->spp);
    koksma__html_text(h, last->pattern);
    koksma__html_add(h, " samples (");
    koksma__html_text(h, last->name);
    koksma__html_add(h, ")</th><th>coherence of the error</th></tr>\n");
    koksma__html_add(
        h,
        "<tr><th>pattern</th><th>ave</th><th>SD</th><th>max</th>"
        "<th>mean <span class=\"pm\">95 %%</span></th><th>SD</th><th>max</th><th>mean within 25 %%</th>"
        "<th>mean <span class=\"pm\">95 %%</span></th><th>SD</th><th>max</th><th>mean</th></tr></thead>\n<tbody>\n");
}

koksma_status koksma__report_image_table(koksma_study *study, koksma__html *h, koksma__agreement *agreement,
                                         const koksma__table *t)
{
    const size_t n = t->n_rows;
    double *numbers = malloc(2 * n * sizeof *numbers);
    size_t *places = malloc(2 * n * sizeof *places);
    row_means means = {{places, places + n}, {numbers, numbers + n}};
    koksma__html csv = {0};
    koksma_status status = numbers && places ? KOKSMA_OK : koksma__fail_memory(4 * n * sizeof *numbers);
    if (!status) {
        const koksma__image_block *block = koksma__table_images(study, t);
        koksma__table_begin(h, &csv, t);
        koksma__table_csv_heads(&csv, block->references[0].name);
        koksma__table_csv_heads(&csv, block->references[block->n_references - 1].name);
        koksma__csv_text(&csv, "coherence");
        koksma__csv_text(&csv, "in bands");
        add_heads(h, block);
    }
    for (size_t r = 0; !status && r < n; r++) {
        status = add_image_row(study, h, &csv, agreement, t, r, &means);
    }
    koksma__html_add(h, "</tbody>");
    koksma__table_end(h, &csv, t);
    if (!status) {
        status = add_reference_remark(study, h, t, &means);
    }
    free(numbers);
    free(places);
    return status;
}

/* ---- The overall order ----------------------------------------------------------------------------------- */

/* Adds the rank of every row of the table, by its mean against the first reference, to that of the row of `first`
   with its pattern. False: a row has no trials yet, or no such row. */
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

koksma_status koksma__report_order(koksma_study *study, koksma__html *h, size_t part)
{
    const koksma__table *first = NULL;
    double *ranks = NULL;
    size_t tables = 0, *order = NULL;
    bool whole = true;
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < study->plan.n_tables; i++) {
        const koksma__table *t = &study->plan.tables[i];
        if (t->part != part || !t->scene) {
            continue;
        }
        if (!first) {
            first = t;
            ranks = calloc(t->n_rows, sizeof *ranks);
            order = calloc(t->n_rows, sizeof *order);
            status = ranks && order ? KOKSMA_OK : koksma__fail_memory(2 * t->n_rows * sizeof *ranks);
        }
        whole &= t->n_rows == first->n_rows;
        status = status ? status : add_ranks(study, t, first, ranks, &whole);
        tables++;
    }
    if (!status && whole && tables > 1) {
        order_rows(ranks, first->n_rows, order);
        koksma__html_add(
            h, "<p>Best to worst over the %zu tables, by mean rank against the paper's reference: ", tables);
        for (size_t r = 0; r < first->n_rows; r++) {
            koksma__html_text(h, first->rows[order[r]].label);
            koksma__html_add(h, " (%.4g)%s", ranks[order[r]] / (double)tables, r + 1 < first->n_rows ? ", " : ".");
        }
        if (study->plan.parts[part].order) {
            koksma__html_add(h, " The overall order in the text: ");
            koksma__html_text(h, study->plan.parts[part].order);
            koksma__html_add(h, ".");
        }
        koksma__html_add(h, "</p>\n");
    }
    free(ranks);
    free(order);
    return status;
}
