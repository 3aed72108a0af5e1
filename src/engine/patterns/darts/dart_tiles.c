/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The grid of dart throwing, in tiles that fit into the cache: its memory, and where a point is stored. A cell is in one
 * tile; cells near the border of a tile are copied to its neighbours, so that kernels read one contiguous array.
 */
#include "patterns/darts/darts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/platform/system.h"
#include "core/status.h"

enum {
    BORDER = KOKSMA__DART_BORDER,
    SPARE = 3 /* number of extra elements after the last row, because kernels read beyond it */
};

/* Grows the array `things` to `count` elements of `size` bytes; its contents may be lost. False: no memory. */
static bool get_room(void **things, size_t *room, size_t count, size_t size)
{
    if (count > *room) {
        free(*things);
        *things = malloc(count * size);
        *room = *things ? count : 0;
        koksma__large_pages(*things, count * size);
    }
    return *things != NULL;
}

/* Chooses cells and tiles for distance d, and the limits on squared distances between fixed-point positions. The
   difference of two such positions has an error of less than a unit in each coordinate, and the difference of a
   position and the middle of a square one of less than half a unit. Distances thus have errors of less than sqrt(2)
   times as much: 1.42 and 0.71. */
static void choose_grid(koksma__disks *s, double d)
{
    s->d = d;
    s->cells = (uint32_t)ceil(sqrt(2) / d);
    s->tiles = (s->cells + KOKSMA__DART_TILE - 1) / KOKSMA__DART_TILE;
    s->wide = (s->cells + s->tiles - 1) / s->tiles;
    s->stride = s->wide + 2 * BORDER + SPARE;
    s->block = s->stride * (s->wide + 2 * BORDER);
    s->level = 0;
    s->n_squares = 0;
    const double reach = d * s->cells * KOKSMA__PLACE_UNITS;
    s->low = (int32_t)((reach - 1.42) * (reach - 1.42));
    s->high = (int32_t)((reach + 1.42) * (reach + 1.42)) + 1;
    s->cover = (int32_t)((reach - 0.71) * (reach - 0.71));
}

/* Empties the cells of all tiles. */
static void clear_grid(koksma__disks *s)
{
    const size_t tiles = (size_t)s->tiles * s->tiles;
    for (size_t i = 0; i < s->block; i++) {
        const uint32_t x = (uint32_t)(i % s->stride), y = (uint32_t)(i / s->stride);
        s->places[i] = koksma__no_place(x - BORDER, y - BORDER);
    }
    for (size_t t = 1; t < tiles; t++) {
        memcpy(s->places + t * s->block, s->places, s->block * sizeof *s->places);
    }
    memset(s->who, 0xff, tiles * s->wide * s->wide * sizeof *s->who);
}

koksma_status koksma__disks_clear(koksma__disks *s, double d)
{
    choose_grid(s, d);
    const size_t tiles = (size_t)s->tiles * s->tiles, squares = (size_t)s->cells * s->cells;
    const size_t places = tiles * s->block, own = tiles * s->wide * s->wide;
    const size_t bytes = places * sizeof *s->places + own * sizeof *s->who + squares * sizeof(uint32_t);
    void *grid = s->places, *who = s->who, *list = s->squares, *first = s->first;
    const bool ok = get_room(&grid, &s->places_room, places, sizeof *s->places) &&
                    get_room(&who, &s->who_room, own, sizeof *s->who) &&
                    get_room(&list, &s->square_room, squares * sizeof(uint32_t), 1) &&
                    get_room(&first, &s->first_room, tiles + 1, sizeof *s->first);
    s->places = grid;
    s->who = who;
    s->squares = list;
    s->first = first;
    KOKSMA__REQUIRE_MEMORY(ok, bytes);
    clear_grid(s);
    if (s->tiles > 1 && !s->times) {
        s->times = malloc(s->room * sizeof *s->times);
    }
    return s->tiles == 1 || s->times ? KOKSMA_OK : koksma__fail_memory(s->room * sizeof *s->times);
}

koksma_status koksma__disks_init(koksma__disks *s, uint64_t seed, double d)
{
    *s = (koksma__disks){.kernels = koksma__kernels(), .seed = seed, .room = 64 + (size_t)(0.72 / d / d)};
    s->xs = malloc(2 * s->room * sizeof *s->xs);
    KOKSMA__REQUIRE_MEMORY(s->xs, 2 * s->room * sizeof *s->xs);
    koksma__large_pages(s->xs, 2 * s->room * sizeof *s->xs);
    return koksma__disks_clear(s, d);
}

void koksma__disks_fini(koksma__disks *s)
{
    KOKSMA__FREE(s->places, s->who, s->squares, s->spare, s->first, s->waiting, s->times, s->xs);
    *s = (koksma__disks){0};
}

/* Lists, along one axis, the tiles that contain a cell or a copy of it, and the index of the cell in each of them.
   For a copy in the border of a tile this index is outside the tile. */
typedef struct axis {
    int count, at[2 * BORDER + 1];
    uint32_t tile[2 * BORDER + 1];
} axis;

static axis find_copies(const koksma__disks *s, uint32_t tile, int cell)
{
    axis a = {.count = 1, .at = {cell}, .tile = {tile}};
    uint32_t t = tile;
    for (int at = cell; at < BORDER; a.count++) {
        t = t ? t - 1 : s->tiles - 1;
        at += (int)(koksma__disks_start(s, t + 1) - koksma__disks_start(s, t));
        a.at[a.count] = at;
        a.tile[a.count] = t;
    }
    t = tile;
    for (int at = cell, size;
         size = (int)(koksma__disks_start(s, t + 1) - koksma__disks_start(s, t)), at >= size - BORDER; a.count++) {
        at -= size;
        t = t + 1 < s->tiles ? t + 1 : 0;
        a.at[a.count] = at;
        a.tile[a.count] = t;
    }
    return a;
}

void koksma__disks_put(koksma__disks *s, const koksma__tile *t, uint32_t cell_x, uint32_t cell_y, uint32_t place,
                       size_t i)
{
    s->who[koksma__disks_own(s, t->number, cell_x, cell_y)] = (uint32_t)i;
    if ((cell_x >= BORDER) & (cell_y >= BORDER) & (cell_x + BORDER < t->nx) & (cell_y + BORDER < t->ny)) {
        s->places[koksma__disks_corner(s, t->number, cell_x + BORDER, cell_y + BORDER)] = place;
        return;
    }
    const axis x = find_copies(s, t->number % s->tiles, (int)cell_x);
    const axis y = find_copies(s, t->number / s->tiles, (int)cell_y);
    for (int v = 0; v < y.count; v++) {
        for (int u = 0; u < x.count; u++) {
            const uint32_t at_x = (uint32_t)x.at[u], at_y = (uint32_t)y.at[v];
            const uint32_t move_x = (at_x - cell_x) << KOKSMA__PLACE_BITS, move_y = (at_y - cell_y)
                                                                                    << KOKSMA__PLACE_BITS;
            s->places[koksma__disks_corner(s, y.tile[v] * s->tiles + x.tile[u], at_x + BORDER, at_y + BORDER)] =
                koksma__place(place + move_x, (place >> 16) + move_y);
        }
    }
}
