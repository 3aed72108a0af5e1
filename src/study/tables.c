/* SPDX-License-Identifier: Apache-2.0 */
/* The published tables beside what the store has. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/statistics.h"
#include "study/tables.h"
#include "study/tasks.h"

enum { RESULT_STRIDE = sizeof(koksma__result) / sizeof(double) };

/* Never NULL, so that no results are an array of length 0. */
koksma_status koksma__series_results(koksma_study *study, const koksma__series *series, long long trials,
                                     koksma__result **results, size_t *n)
{
    long long id;
    koksma_status status = koksma__store_series(study->store, series, false, &id);
    status = status ? status : koksma__store_results(study->store, id, trials, results, n);
    if (!status && !*results) {
        *results = calloc(1, sizeof **results);
        status = *results ? KOKSMA_OK : koksma__fail_memory(sizeof **results);
    }
    return status;
}

koksma__summary koksma__summarize_sets(const char *pattern, const koksma__result *results, size_t n)
{
    return n == 1 && koksma__has_one_set(pattern) ? koksma__exactly(results->values[0])
                                                  : koksma__summarize(results->values, n, RESULT_STRIDE);
}

const koksma__image_block *koksma__table_images(const koksma_study *study, const koksma__table *table)
{
    return &study->plan.images[table->images];
}

/* The block of the table's own plan that makes a row; of several the one with the most sets. */
static const koksma__discrepancy_block *discrepancies_of(const koksma_study *study, const koksma__table *table,
                                                         const char *measure, const char *pattern)
{
    const koksma__plan_part *part = &study->plan.parts[table->part];
    const koksma__discrepancy_block *most = NULL;
    for (size_t b = part->discrepancies[0]; b < part->discrepancies[1]; b++) {
        const koksma__discrepancy_block *block = &study->plan.discrepancies[b];
        if (koksma__plan_block_makes(block, measure, pattern, table->n, table->dim) &&
            (!most || block->trials > most->trials)) {
            most = block;
        }
    }
    return most;
}

koksma_status koksma__table_discrepancy(koksma_study *study, const koksma__table *table, const char *measure,
                                        const char *pattern, koksma__cell *cell)
{
    const koksma__discrepancy_block *block = discrepancies_of(study, table, measure, pattern);
    *cell = (koksma__cell){0};
    if (!block) {
        return koksma__fail(KOKSMA_MALFORMED, "plan '%s': table %s: no discrepancy block has %s at n = %lld",
                            study->plan.name, table->id, measure, table->n);
    }
    const koksma__series series = {.kind = "discrepancy",
                                   .scene = "",
                                   .scene_hash = "",
                                   .options = "",
                                   .pattern = pattern,
                                   .what = measure,
                                   .n = table->n,
                                   .dim = block->dim};
    koksma__result *results;
    size_t n;
    const koksma_status status = koksma__series_results(study, &series, block->trials, &results, &n);
    if (status) {
        return status;
    }
    cell->mean = koksma__summarize_sets(pattern, results, n);
    cell->sd = cell->mean.sd;
    koksma__largest_of(results->values, n, RESULT_STRIDE, 100, &cell->max, &cell->max_sd);
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
                             .n = table->n};
    int width, height;
    koksma__block_size(block, scene, &width, &height);
    series.width = width;
    series.height = height;
    const koksma_status status = koksma__series_results(study, &series, block->trials, &results, &n);
    if (status) {
        return status;
    }
    cell->mean = koksma__summarize(results->values, n, RESULT_STRIDE);
    cell->sd = koksma__summarize(results->values + 1, n, RESULT_STRIDE).mean;
    const koksma__summary max = koksma__summarize(results->values + 2, n, RESULT_STRIDE);
    cell->max = max.mean;
    cell->max_sd = max.sd;
    free(results);
    return KOKSMA_OK;
}

const char *koksma_study_table_at(const koksma_study *study, size_t i)
{
    return i < study->plan.n_tables ? study->plan.tables[i].id : NULL;
}

koksma_status koksma_study_table_row(koksma_study *study, const char *id, size_t i, koksma_study_row *row,
                                     bool *found)
{
    const koksma__table *table = NULL;
    *found = false;
    if (!study->store) {
        return koksma__fail(KOKSMA_ARGUMENT, "a study without a folder has no results");
    }
    for (size_t t = 0; !table && t < study->plan.n_tables; t++) {
        table = strcmp(study->plan.tables[t].id, id) ? NULL : &study->plan.tables[t];
    }
    if (!table) {
        return koksma__fail(KOKSMA_UNKNOWN, "plan '%s' has no table '%s'", study->plan.name, id);
    }
    if (i >= table->n_rows) {
        return KOKSMA_OK;
    }
    const koksma__table_row *from = &table->rows[i];
    koksma__cell cell, last;
    *row = (koksma_study_row){.pattern = from->pattern, .label = from->label, .converged = NAN};
    memcpy(row->published, from->published, sizeof row->published);
    koksma_status status;
    if (table->scene) {
        const koksma__image_block *block = koksma__table_images(study, table);
        status = koksma__table_image(study, table, &block->references[0], from->pattern, &cell);
        if (!status) {
            status =
                koksma__table_image(study, table, &block->references[block->n_references - 1], from->pattern, &last);
            row->converged = last.mean.mean;
        }
    } else {
        status = koksma__table_discrepancy(study, table, table->measure, from->pattern, &cell);
    }
    if (status) {
        return status;
    }
    row->mean = cell.mean.mean;
    row->low = cell.mean.low;
    row->high = cell.mean.high;
    row->sd = cell.sd;
    row->max = cell.max;
    row->trials = cell.mean.n;
    *found = true;
    return KOKSMA_OK;
}

koksma_status koksma__table_sets(koksma_study *study, const koksma__table *table, size_t *most, bool *differ)
{
    const char *const measures[] = {table->measure, table->also};
    koksma_status status = KOKSMA_OK;
    size_t least = SIZE_MAX, most_of_all = 0;
    *most = 0;
    for (size_t i = 0; !status && i < 2 * table->n_rows; i++) {
        const char *pattern = table->rows[i / 2].pattern;
        koksma__cell cell;
        if (!measures[i % 2]) {
            continue;
        }
        status = koksma__table_discrepancy(study, table, measures[i % 2], pattern, &cell);
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
