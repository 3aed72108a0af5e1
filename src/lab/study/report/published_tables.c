/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Compares published tables with the store: the cell of a row (mean, SD and maximum over trials), the verdict on the
 * published mean, and the rows that koksma_study_table_row returns. A published mean of a discrepancy agrees if |z|,
 * the difference divided by the sum of its standard error and half a unit of the last published digit, is below
 * KOKSMA__AGREEMENT_Z; a published mean of image errors agrees if it is within KOKSMA__IMAGE_TOLERANCE of ours.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "stats/stats.h"
#include "study/plan/plan.h"
#include "study/report/means.h"
#include "study/report/published_tables.h"
#include "study/run/references.h"
#include "study/run/tasks.h"

const koksma__image_block *koksma__table_images(const koksma_study *study, const koksma__table *table)
{
    return &study->plan.images[table->images];
}

/* The block of the table's plan that has the results of a row; if several blocks have them, the one with the most
   sets. */
static const koksma__discrepancy_block *discrepancies_of(const koksma_study *study, const koksma__table *table,
                                                         const char *measure, const char *pattern, long long n)
{
    const koksma__plan_part *part = &study->plan.parts[table->part];
    const koksma__discrepancy_block *most = NULL;
    for (size_t b = part->discrepancies[0]; b < part->discrepancies[1]; b++) {
        const koksma__discrepancy_block *block = &study->plan.discrepancies[b];
        if (koksma__plan_block_makes(block, measure, pattern, n, table->dim) &&
            (!most || block->trials > most->trials)) {
            most = block;
        }
    }
    return most;
}

koksma_status koksma__table_discrepancy(koksma_study *study, const koksma__table *table, const char *measure,
                                        const char *pattern, long long n, koksma__cell *cell)
{
    const koksma__discrepancy_block *block = discrepancies_of(study, table, measure, pattern, n);
    *cell = (koksma__cell){0};
    KOKSMA__FAIL_IF(!block, KOKSMA_MALFORMED,
                    "plan '%s': table %s: no discrepancy block of the plan measures %s at n = %lld", study->plan.name,
                    table->id, measure, n);
    const koksma__series series = {.kind = "discrepancy",
                                   .scene = "",
                                   .scene_hash = "",
                                   .options = "",
                                   .pattern = pattern,
                                   .what = measure,
                                   .n = n,
                                   .dim = block->dim};
    koksma__result *results;
    size_t sets;
    KOKSMA__TRY(koksma__series_results(study, &series, block->trials, &results, &sets));
    cell->mean = koksma__summarize_sets(pattern, results, sets);
    cell->sd = cell->mean.sd;
    koksma__largest_of(results->values, sets, KOKSMA__RESULT_STRIDE, 100, &cell->max, &cell->max_sd);
    if (isnan(cell->max)) {
        cell->max = cell->mean.max;
    }
    free(results);
    return KOKSMA_OK;
}

koksma_status koksma__table_image(koksma_study *study, const koksma__table *table, const koksma__reference *reference,
                                  const char *pattern, koksma__cell *cell)
{
    const koksma__image_block *block = koksma__table_images(study, table);
    const koksma__study_scene *scene = koksma__study_scene_of(study, table->scene);
    char name[KOKSMA__REFERENCE_NAME];
    koksma__result *results;
    size_t n;
    *cell = (koksma__cell){0};
    koksma__reference_name(reference, name);
    koksma__series series = {.kind = "image",
                             .scene = scene->name,
                             .scene_hash = scene->hash,
                             .options = "",
                             .pattern = pattern,
                             .what = name,
                             .n = table->n.at[0]};
    int width, height;
    koksma__block_size(block, scene, &width, &height);
    series.width = width;
    series.height = height;
    KOKSMA__TRY(koksma__series_results(study, &series, block->trials, &results, &n));
    cell->mean = koksma__summarize_sizes(results->values, n, KOKSMA__RESULT_STRIDE);
    cell->sd = koksma__summarize_sizes(results->values + 1, n, KOKSMA__RESULT_STRIDE).mean;
    const koksma__summary max = koksma__summarize_sizes(results->values + 2, n, KOKSMA__RESULT_STRIDE);
    cell->max = max.mean;
    cell->max_sd = max.sd;
    free(results);
    return KOKSMA_OK;
}

const char *koksma_study_table_at(const koksma_study *study, size_t i)
{
    KOKSMA__REQUIRE_OR(NULL, study);
    return i < study->plan.n_tables ? study->plan.tables[i].id : NULL;
}

/* ---- Agreement of a published mean with ours ------------------------------------------------------------- */

size_t koksma__table_note(const koksma__table *t, const char *pattern, long long n, int statistic)
{
    for (size_t i = 0; i < t->n_notes; i++) {
        const koksma__note *note = &t->notes[i];
        if (note->statistic == statistic && (!note->pattern || !strcmp(note->pattern, pattern)) &&
            (!note->n || note->n == n)) {
            return i + 1;
        }
    }
    return 0;
}

koksma__verdict koksma__table_judge(const koksma__table *t, const koksma__table_row *row, size_t column,
                                    const koksma__cell *cell)
{
    const koksma__printed *printed = &row->published[column];
    const double n = (double)cell->mean.n;
    koksma__verdict v = {.z = NAN, .ratio = NAN};
    v.note = koksma__table_note(t, row->pattern, koksma__table_is_over_n(t) ? t->n.at[column] : 0, 0);
    if (isnan(printed->value)) {
        v.kind = KOKSMA_VERDICT_NEW;
        return v;
    }
    bool agrees;
    if (t->scene) {
        v.ratio = cell->mean.mean == printed->value ? 0 : cell->mean.mean / printed->value - 1; /* both may be 0 */
        agrees = fabs(v.ratio) <= KOKSMA__IMAGE_TOLERANCE;
    } else { /* the published mean was taken over 100 sets */
        v.z = (printed->value - cell->mean.mean) / (sqrt(cell->sd * cell->sd * (0.01 + 1 / n)) + printed->half_digit);
        agrees = fabs(v.z) < KOKSMA__AGREEMENT_Z;
    }
    v.kind = cell->mean.n == 0 || (!t->scene && isnan(v.z)) ? KOKSMA_VERDICT_WAITING
             : agrees && t->scene && t->fitted              ? KOKSMA_VERDICT_FITTED
             : agrees                                       ? KOKSMA_VERDICT_AGREES
             : v.note && t->notes[v.note - 1].explained     ? KOKSMA_VERDICT_EXPLAINED
                                                            : KOKSMA_VERDICT_UNEXPLAINED;
    return v;
}

double koksma__table_printed_slope(const koksma__table *t, const koksma__table_row *row)
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

/* ---- The public interface -------------------------------------------------------------------------------- */

const char *koksma_study_verdict_name(koksma_study_verdict verdict)
{
    static const char *const names[] = {[KOKSMA_VERDICT_NEW] = "new",
                                        [KOKSMA_VERDICT_WAITING] = "waiting",
                                        [KOKSMA_VERDICT_AGREES] = "agrees",
                                        [KOKSMA_VERDICT_FITTED] = "fitted",
                                        [KOKSMA_VERDICT_EXPLAINED] = "explained",
                                        [KOKSMA_VERDICT_UNEXPLAINED] = "unexplained"};
    return (unsigned)verdict < sizeof names / sizeof *names ? names[verdict] : NULL;
}

static koksma_status image_row(koksma_study *study, const koksma__table *table, const char *pattern,
                               koksma__cell *cell, double *converged)
{
    const koksma__image_block *block = koksma__table_images(study, table);
    koksma__cell last;
    koksma_status status = koksma__table_image(study, table, &block->references[0], pattern, cell);
    if (!status) {
        status = koksma__table_image(study, table, &block->references[block->n_references - 1], pattern, &last);
        *converged = last.mean.mean;
    }
    return status;
}

static void publish(const koksma__table *table, const koksma__table_row *from, size_t column, koksma_study_row *row)
{
    const bool over_n = koksma__table_is_over_n(table);
    *row = (koksma_study_row){
        .pattern = from->pattern, .label = from->label, .n = table->n.at[column], .converged = NAN};
    for (size_t s = 0; s < 3; s++) {
        row->published[s] = over_n ? (s ? (double)NAN : from->published[column].value) : from->published[s].value;
    }
}

koksma_status koksma_study_table_row(koksma_study *study, const char *id, size_t i, koksma_study_row *row,
                                     bool *found)
{
    KOKSMA__REQUIRE(study, id, row, found);
    const koksma__table *table = NULL;
    *found = false;
    for (size_t t = 0; !table && t < study->plan.n_tables; t++) {
        table = strcmp(study->plan.tables[t].id, id) ? NULL : &study->plan.tables[t];
    }
    KOKSMA__FAIL_IF(!table, KOKSMA_UNKNOWN, "plan '%s' has no table '%s'", study->plan.name, id);
    if (i / table->n.n >= table->n_rows) {
        return KOKSMA_OK;
    }
    KOKSMA__FAIL_IF(!study->store, KOKSMA_ARGUMENT, "a study without a folder has no results");
    const koksma__table_row *from = &table->rows[i / table->n.n];
    const size_t column = i % table->n.n;
    koksma__cell cell;
    publish(table, from, column, row);
    const koksma_status status =
        table->scene ? image_row(study, table, from->pattern, &cell, &row->converged)
                     : koksma__table_discrepancy(study, table, table->measure, from->pattern, row->n, &cell);
    if (status) {
        return status;
    }
    row->mean = cell.mean.mean;
    row->low = cell.mean.low;
    row->high = cell.mean.high;
    row->sd = cell.sd;
    row->max = cell.max;
    row->trials = cell.mean.n;
    row->verdict = koksma__table_judge(table, from, column, &cell).kind;
    *found = true;
    return KOKSMA_OK;
}

koksma_status koksma__table_sets(koksma_study *study, const koksma__table *table, size_t *most, bool *differ)
{
    const char *const measures[] = {table->measure, table->also};
    koksma_status status = KOKSMA_OK;
    size_t least = SIZE_MAX, most_of_all = 0;
    *most = 0;
    for (size_t i = 0; !status && i < 2 * table->n_rows * table->n.n; i++) {
        const char *pattern = table->rows[i / 2 / table->n.n].pattern;
        koksma__cell cell;
        if (!measures[i % 2]) {
            continue;
        }
        status =
            koksma__table_discrepancy(study, table, measures[i % 2], pattern, table->n.at[i / 2 % table->n.n], &cell);
        const size_t sets = cell.mean.n;
        *most = !status && i % 2 == 0 && sets > *most ? sets : *most;
        if (!koksma__has_one_set(pattern)) {
            least = sets < least ? sets : least;
            most_of_all = sets > most_of_all ? sets : most_of_all;
        }
    }
    *differ = least < most_of_all;
    return status;
}
