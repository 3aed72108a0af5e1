/* SPDX-License-Identifier: Apache-2.0 */
/*
 * References that are being rendered. A reference is cut into tiles of whole rows; the number of tiles depends on
 * its size. A tile holds the sums of all replicates of its rows, added in their order. So the picture has the same
 * bits whichever thread or rank renders which tile, and memory holds only the sums of references that are being
 * rendered.
 */
#ifndef KOKSMA_STUDY_RUN_REFERENCE_TILES_H
#define KOKSMA_STUDY_RUN_REFERENCE_TILES_H

#include "study/run/references.h"
#include "study/run/tasks.h"

typedef struct koksma__reference_tile {
    unsigned long long reference; /* index in study->references */
    long long first_row, rows;
} koksma__reference_tile;

typedef struct koksma__reference_tiles {
    koksma_study *study;
    size_t n;
    koksma__reference_tile *at;
    koksma__replicates *sums; /* one entry per reference of the study */
    long long *rows_left;     /* per reference: number of rows not yet rendered */
} koksma__reference_tiles;

/* Reads the references that the tasks' jobs need and that have a file; lists the tiles of the others. */
koksma_status koksma__tiles_open(const koksma__tasks *tasks, koksma__reference_tiles *tiles);
void koksma__tiles_close(koksma__reference_tiles *tiles);

/* Renders a tile into *out, the sums of its rows. The caller frees out->sum. */
koksma_status koksma__tile_do(const koksma_study *study, const koksma__reference_tile *tile, const koksma_run *run,
                              koksma__replicates *out);

/* Copies a tile's sums into those of its reference; *complete tells whether this was the reference's last tile. Calls
   must not overlap, and each tile must be put only once. */
koksma_status koksma__tiles_put(koksma__reference_tiles *tiles, const koksma__reference_tile *tile,
                                const koksma__replicates *sums, bool *complete);

/* Makes the pixels, the file and the store's row of a reference whose tiles are complete. */
koksma_status koksma__tiles_finish(koksma__reference_tiles *tiles, size_t reference);

#endif
