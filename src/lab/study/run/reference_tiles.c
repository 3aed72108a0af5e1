/* SPDX-License-Identifier: Apache-2.0 */
/* Cuts the missing references into tiles of whole rows. The number of tiles depends on the size of the reference,
   not on the number of threads. A tile is rendered as the sum of all replicates of its rows, added in their order;
   when the sums of all tiles of a reference have been copied into one array, the reference is complete. So the bits
   of a reference do not depend on which thread or rank renders which tile. */
#include "study/run/run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"

/* The size of a tile: about 20 ms of rendering for a simple scene, so that jobs do not wait long for the last tile of
   their reference. */
static const double SAMPLES_A_TILE = 1 << 19;

static koksma_status add_tile(koksma__reference_tiles *tiles, size_t reference, int first_row, int rows)
{
    koksma__reference_tile *at = koksma__add_one(&tiles->at, &tiles->n, sizeof *at);
    if (at) {
        *at = (koksma__reference_tile){reference, first_row, rows};
    }
    return at ? KOKSMA_OK : KOKSMA_MEMORY;
}

static koksma_status add_tiles(koksma__reference_tiles *tiles, size_t reference)
{
    const koksma__reference_image *r = &tiles->study->references[reference];
    const double row = (double)r->width * (double)r->reference->spp * (double)r->reference->replicates;
    bool alone;
    koksma_status status = koksma__reference_rows_stand_alone(r, &alone);
    int rows = r->height;
    if (alone && row * rows > SAMPLES_A_TILE) {
        rows = row < SAMPLES_A_TILE ? (int)(SAMPLES_A_TILE / row) : 1;
    }
    for (int y = 0; !status && y < r->height; y += rows) {
        status = add_tile(tiles, reference, y, r->height - y < rows ? r->height - y : rows);
    }
    tiles->rows_left[reference] = r->height;
    return status;
}

/* Finds whether the study's folder has the reference's file, and its store has the row with the file's hash and the
   reference's own error. If the database was removed, or predates the hashes, the reference is rendered again. */
static koksma_status find_kept(const koksma_study *study, const koksma__reference_image *reference, bool *kept)
{
    char name[KOKSMA__REFERENCE_NAME];
    const koksma__series key = koksma__reference_key(reference, name);
    koksma__reference_row row;
    const koksma_status status = koksma__reference_find(study, reference, kept);
    *kept = !status && *kept && !koksma__store_reference(study->store, &key, &row) && row.pixels[0];
    return status;
}

koksma_status koksma__tiles_open(const koksma__tasks *tasks, koksma__reference_tiles *tiles)
{
    koksma_study *study = tasks->study;
    koksma_status status = KOKSMA_OK;
    *tiles = (koksma__reference_tiles){.study = study};
    tiles->sums = calloc(study->n_references + 1, sizeof *tiles->sums);
    tiles->rows_left = calloc(study->n_references + 1, sizeof *tiles->rows_left);
    if (!tiles->sums || !tiles->rows_left) {
        status = koksma__fail_memory((study->n_references + 1) * sizeof *tiles->sums);
    }
    for (size_t i = 0; !status && i < tasks->n; i++) {
        const koksma__task *task = &tasks->at[i];
        const bool needed = task->image && (study->sink || task->done_before < task->trials);
        for (size_t r = 0; needed && !status && r < task->n_series; r++) {
            const size_t index = task->references[r];
            if (study->references[index].image.pixels || tiles->rows_left[index]) {
                continue;
            }
            bool kept = false;
            status = study->sink ? KOKSMA_OK : find_kept(study, &study->references[index], &kept);
            status = status ? status
                     : kept ? koksma__reference_read(study, &study->references[index])
                            : add_tiles(tiles, index);
        }
    }
    if (status) {
        koksma__tiles_close(tiles);
    }
    return status;
}

void koksma__tiles_close(koksma__reference_tiles *tiles)
{
    for (size_t i = 0; tiles->sums && i < tiles->study->n_references; i++) {
        free(tiles->sums[i].sum);
    }
    KOKSMA__FREE(tiles->sums, tiles->rows_left, tiles->at);
    *tiles = (koksma__reference_tiles){0};
}

static koksma_status fail_reference(const koksma__reference_image *r, koksma_status status)
{
    char name[KOKSMA__REFERENCE_NAME], text[KOKSMA__REFERENCE_NAME + 96];
    koksma__reference_name(r->reference, name);
    snprintf(text, sizeof text, "reference %s of %.64s", name, r->scene->name);
    return koksma__fail_in(status, text);
}

/* Renders a tile of another picture of the same scene in place of one that cannot be rendered. So a reference that fails
   in an audit ends neither the audit of the others nor that of images which do not need it. */
static koksma_status do_substitute(const koksma__reference_image *r, const koksma__reference_tile *tile,
                                   const koksma_run *run, koksma__replicates *out)
{
    char name[] = "substitute", pattern[] = "random";
    const koksma__reference plain = {name, pattern, 1, 1};
    koksma__reference_image other = *r;
    koksma_image image;
    other.reference = &plain;
    KOKSMA__TRY(koksma__reference_replicate(&other, 0, (int)tile->first_row, (int)tile->rows, run, &image));
    const koksma_status status = image.height == tile->rows
                                     ? koksma__replicates_add(out, &image)
                                     : koksma__fail(KOKSMA_UNSUPPORTED, "its rows can't be rendered alone");
    koksma_image_fini(&image);
    return status;
}

koksma_status koksma__tile_do(const koksma_study *study, const koksma__reference_tile *tile, const koksma_run *run,
                              koksma__replicates *out)
{
    koksma__reference_image *r = &study->references[tile->reference];
    koksma_status status = KOKSMA_OK;
    *out = (koksma__replicates){0};
    for (long long i = 0; !status && i < r->reference->replicates; i++) {
        koksma_image image;
        status = koksma__reference_replicate(r, i, (int)tile->first_row, (int)tile->rows, run, &image);
        if (!status) {
            status = koksma__replicates_add(out, &image);
            koksma_image_fini(&image);
        }
    }
    if (status) {
        free(out->sum);
        *out = (koksma__replicates){0};
    }
    if (status && study->sink && !koksma__ends_all(status)) {
        fail_reference(r, status);
        study->sink->fail_reference(study->sink->context, r, koksma_error_text());
        return do_substitute(r, tile, run, out);
    }
    return koksma__is_impossible(status) ? fail_reference(r, KOKSMA_IMPOSSIBLE) : status;
}

koksma_status koksma__tiles_put(koksma__reference_tiles *tiles, const koksma__reference_tile *tile,
                                const koksma__replicates *from, bool *complete)
{
    const koksma__reference_image *r = &tiles->study->references[tile->reference];
    koksma__replicates *all = &tiles->sums[tile->reference];
    const size_t width = from->pixels / (size_t)tile->rows, first = (size_t)tile->first_row * width;
    KOKSMA__TRY(all->sum ? KOKSMA_OK : koksma__replicates_init(all, width * (size_t)r->height, from->channels));
    all->n = r->reference->replicates;
    memcpy(all->sum + first * from->channels, from->sum, from->pixels * from->channels * sizeof *from->sum);
    memcpy(all->luminance + first, from->luminance, from->pixels * sizeof *from->sum);
    memcpy(all->squares + first, from->squares, from->pixels * sizeof *from->sum);
    tiles->rows_left[tile->reference] -= tile->rows;
    *complete = tiles->rows_left[tile->reference] == 0;
    return KOKSMA_OK;
}

koksma_status koksma__tiles_finish(koksma__reference_tiles *tiles, size_t reference)
{
    return koksma__replicates_finish(&tiles->sums[reference], tiles->study, &tiles->study->references[reference]);
}
