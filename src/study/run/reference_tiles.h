/* SPDX-License-Identifier: Apache-2.0 */
/*
 * References in the making. A reference is cut into tiles of whole rows, as many as its size says; a tile is all
 * replicates of its rows, added in their order, so that the picture has the same bits whoever makes which tile, and
 * the sums of no more than the references in the making are held.
 */
#ifndef KOKSMA_STUDY_RUN_REFERENCE_TILES_H
#define KOKSMA_STUDY_RUN_REFERENCE_TILES_H

#include "study/run/references.h"
#include "study/run/tasks.h"

typedef struct koksma__reference_tile {
    unsigned long long reference; /* its index in study->references */
    long long first_row, rows;
} koksma__reference_tile;

typedef struct koksma__reference_tiles {
    koksma_study *study;
    size_t n;
    koksma__reference_tile *at;
    koksma__replicates *sums; /* of every reference of the study */
    long long *rows_left;
} koksma__reference_tiles;

/* Reads the references that the tasks' jobs need and that have a file; lists the tiles of the others. */
koksma_status koksma__tiles_open(const koksma__tasks *tasks, koksma__reference_tiles *tiles);
void koksma__tiles_close(koksma__reference_tiles *tiles);

/* Renders a tile: the sums of its rows, which the caller frees (out->sum). */
koksma_status koksma__tile_do(const koksma_study *study, const koksma__reference_tile *tile, const koksma_run *run,
                              koksma__replicates *out);

/* Takes a tile's sums; *complete: they were the reference's last. One call at a time, each tile once. */
koksma_status koksma__tiles_put(koksma__reference_tiles *tiles, const koksma__reference_tile *tile,
                                const koksma__replicates *sums, bool *complete);

/* The pixels, file and row in the store of a reference that is complete. */
koksma_status koksma__tiles_finish(koksma__reference_tiles *tiles, size_t reference);

#endif
