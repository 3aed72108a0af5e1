/* SPDX-License-Identifier: Apache-2.0 */
#include "study/run/reference_tiles.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"

/* About 20 ms of a plain scene, so that those who wait for the last part don't wait long. */
static const double SAMPLES_A_PART = 1 << 19;

static koksma_status add_part(koksma__parts *parts, size_t reference, int first_row, int rows)
{
    koksma__part *at = koksma__room_for_one(parts->at, parts->n, &parts->room, 64, sizeof *at);
    if (!at) {
        return KOKSMA_MEMORY;
    }
    parts->at = at;
    parts->at[parts->n++] = (koksma__part){reference, first_row, rows};
    return KOKSMA_OK;
}

static koksma_status add_parts(koksma__parts *parts, size_t reference)
{
    const koksma__reference_image *r = &parts->study->references[reference];
    const double row = (double)r->width * (double)r->reference->spp * (double)r->reference->replicates;
    bool alone;
    koksma_status status = koksma__reference_rows_stand_alone(r, &alone);
    int rows = r->height;
    if (alone && row * rows > SAMPLES_A_PART) {
        rows = row < SAMPLES_A_PART ? (int)(SAMPLES_A_PART / row) : 1;
    }
    for (int y = 0; !status && y < r->height; y += rows) {
        status = add_part(parts, reference, y, r->height - y < rows ? r->height - y : rows);
    }
    parts->rows_left[reference] = r->height;
    return status;
}

/* The picture, and the row with its own error: where the database was moved away, both are made anew. */
static bool is_kept(const koksma_study *study, const koksma__reference_image *reference)
{
    char name[KOKSMA__REFERENCE_NAME];
    const koksma__series key = koksma__reference_key(reference, name);
    double error;
    return koksma__reference_exists(study, reference) &&
           (reference->reference->replicates < 2 ||
            (!koksma__store_reference(study->store, &key, &error) && !isnan(error)));
}

koksma_status koksma__parts_open(const koksma__tasks *tasks, koksma__parts *parts)
{
    koksma_study *study = tasks->study;
    koksma_status status = KOKSMA_OK;
    *parts = (koksma__parts){.study = study};
    parts->sums = calloc(study->n_references + 1, sizeof *parts->sums);
    parts->rows_left = calloc(study->n_references + 1, sizeof *parts->rows_left);
    if (!parts->sums || !parts->rows_left) {
        status = koksma__fail_memory((study->n_references + 1) * sizeof *parts->sums);
    }
    for (size_t i = 0; !status && i < tasks->n; i++) {
        const koksma__task *task = &tasks->at[i];
        for (size_t r = 0; task->image && !status && r < task->n_series && task->done_before < task->trials; r++) {
            const size_t index = task->references[r];
            if (study->references[index].image.pixels || parts->rows_left[index]) {
                continue;
            }
            status = is_kept(study, &study->references[index])
                         ? koksma__reference_read(study, &study->references[index])
                         : add_parts(parts, index);
        }
    }
    if (status) {
        koksma__parts_close(parts);
    }
    return status;
}

void koksma__parts_close(koksma__parts *parts)
{
    for (size_t i = 0; parts->sums && i < parts->study->n_references; i++) {
        free(parts->sums[i].sum);
    }
    free(parts->sums);
    free(parts->rows_left);
    free(parts->at);
    *parts = (koksma__parts){0};
}

static koksma_status fail_reference(const koksma__reference_image *r, koksma_status status)
{
    char name[KOKSMA__REFERENCE_NAME], text[KOKSMA__REFERENCE_NAME + 96];
    koksma__reference_name(r->reference, name);
    snprintf(text, sizeof text, "reference %s of %.64s", name, r->scene->name);
    return koksma__fail_in(status, text);
}

koksma_status koksma__part_do(const koksma_study *study, const koksma__part *part, const koksma_run *run,
                              koksma__replicates *out)
{
    const koksma__reference_image *r = &study->references[part->reference];
    koksma_status status = KOKSMA_OK;
    *out = (koksma__replicates){0};
    for (long long i = 0; !status && i < r->reference->replicates; i++) {
        koksma_image image;
        status = koksma__reference_replicate(r, i, (int)part->first_row, (int)part->rows, run, &image);
        if (!status) {
            status = koksma__replicates_add(out, &image);
            koksma_image_fini(&image);
        }
    }
    if (status) {
        free(out->sum);
        *out = (koksma__replicates){0};
    }
    return status == KOKSMA_IMPOSSIBLE ? fail_reference(r, status) : status;
}

koksma_status koksma__parts_put(koksma__parts *parts, const koksma__part *part, const koksma__replicates *from,
                                bool *complete)
{
    const koksma__reference_image *r = &parts->study->references[part->reference];
    koksma__replicates *all = &parts->sums[part->reference];
    const size_t width = from->pixels / (size_t)part->rows, first = (size_t)part->first_row * width;
    const koksma_status status =
        all->sum ? KOKSMA_OK : koksma__replicates_init(all, width * (size_t)r->height, from->channels);
    if (status) {
        return status;
    }
    all->n = r->reference->replicates;
    memcpy(all->sum + first * from->channels, from->sum, from->pixels * from->channels * sizeof *from->sum);
    memcpy(all->luminance + first, from->luminance, from->pixels * sizeof *from->sum);
    memcpy(all->squares + first, from->squares, from->pixels * sizeof *from->sum);
    parts->rows_left[part->reference] -= part->rows;
    *complete = parts->rows_left[part->reference] == 0;
    return KOKSMA_OK;
}

koksma_status koksma__parts_finish(koksma__parts *parts, size_t reference)
{
    return koksma__replicates_finish(&parts->sums[reference], parts->study, &parts->study->references[reference]);
}
