/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The grid, the tiles and the shrinking cover of dart throwing. dart_cover.h describes the algorithm; dart_round.c
 * throws a round of darts.
 *
 * Cells are at most d / sqrt(2) wide, so that a cell has at most one point, and only the 5 x 5 cells around a dart
 * can contain points near it. The cover begins with all cells as squares. After a round each square is cut into four
 * (one level of a quadtree with all leaves at one depth), and a quarter is dropped if all of it, including its
 * farthest corner, is within d of one point, because no dart can be kept there. The remaining quarters are the cover
 * of the next round. The cover shrinks geometrically until no square is left or squares reach the resolution of
 * doubles: then the set is maximal.
 *
 * Each tile has a list of squares. Around its cells a tile has a border with copies of its neighbours' cells, which
 * are updated between rounds. Kernels thus read one contiguous array.
 */
#include "patterns/shared/dart_cover.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/pages.h"
#include "core/parallel.h"
#include "core/status.h"

enum {
    BORDER = KOKSMA__DART_BORDER,
    SPARE = 3 /* number of extra elements after the last row, because kernels read beyond it */
};

#define NONE UINT32_MAX

#define FINEST                                                                                                       \
    ((uint64_t)1 << 30) /* largest number of squares on a side of the torus; smaller free areas are ignored
                                      */

static const double far_away = 1e9;

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
   position and the middle of a square one of less than half a unit. 1.42 and 0.71 are these errors times sqrt(2). */
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

/* Makes an empty grid for distance d. */
static koksma_status make_grid(koksma__disks *s, double d)
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
    return make_grid(s, d);
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

/* Lists the points in the 5 x 5 cells around a cell, in units of the torus. These are all points that can be within d
   of a point of the cell; the corner cells are needed because the diagonal of a cell is a little shorter than d. */
typedef struct around {
    size_t count;
    double xs[32], ys[32];
} around;

static void look_around(const koksma__disks *s, uint32_t cell_x, uint32_t cell_y, around *a)
{
    const int cells = (int)s->cells;
    size_t count = 0;
    for (int r = -2; r <= 2; r++) {
        const int v = (int)cell_y + r + 2 * cells, y = v % cells;
        for (int c = -2; c <= 2; c++) {
            const int u = (int)cell_x + c + 2 * cells, x = u % cells;
            const uint32_t who = koksma__disks_who(s, (uint32_t)x, (uint32_t)y);
            if (who != NONE) {
                a->xs[count] = s->xs[2 * (size_t)who] + (u / cells - 2);
                a->ys[count++] = s->xs[2 * (size_t)who + 1] + (v / cells - 2);
            }
        }
    }
    for (a->count = (count + 7) & ~(size_t)7; count < a->count; count++) {
        a->xs[count] = a->ys[count] = far_away;
    }
}

/* Finds the quarters of a tile's squares that have free area, in double arithmetic. It is used for squares so small
   that the rounding of fixed-point positions matters. Larger squares without free area may be kept, because their
   quarters are examined later. */
static size_t refine_exactly(const koksma__disks *s, const koksma__tile *t, size_t first, size_t end,
                             koksma__square *out)
{
    const double half = 0.25 / ((double)((uint32_t)1 << s->level) * s->cells); /* half of the side of a quarter */
    uint32_t cell_x = NONE, cell_y = NONE;
    size_t kept = 0;
    around points;
    for (size_t i = first; i < end; i++) {
        const koksma__square square = koksma__disks_square(s, t, i);
        if (cell_x != square.x >> s->level || cell_y != square.y >> s->level) {
            cell_x = square.x >> s->level;
            cell_y = square.y >> s->level;
            look_around(s, cell_x, cell_y, &points);
        }
        if (s->who[koksma__disks_own(s, t->number, cell_x - t->x, cell_y - t->y)] != NONE) {
            continue; /* the point in this cell covers the cell */
        }
        const unsigned covered =
            s->kernels->covers(points.count, points.xs, points.ys, (4 * (double)square.x + 2) * half,
                               (4 * (double)square.y + 2) * half, half, half, s->d * s->d);
        for (uint32_t q = 0; q < 4; q++) {
            out[kept] = (koksma__square){2 * square.x + (q & 1), 2 * square.y + (q >> 1)};
            kept += ~covered >> q & 1;
        }
    }
    return kept;
}

koksma_status koksma__disks_refine(koksma__disks *s)
{
    const bool packed = s->level < KOKSMA__PACKED_LEVEL;
    const size_t size = packed ? sizeof(uint32_t) : sizeof(koksma__square);
    size_t kept = 0, first = 0;
    for (uint32_t t = 0; t < s->tiles * s->tiles; t++) {
        const size_t end = s->first[t + 1], most = (kept + 4 * (end - first) + 1) * size;
        if (most > s->spare_room) {
            const size_t room = most + most / 2 + s->n_squares * size;
            void *spare = realloc(s->spare, room);
            KOKSMA__REQUIRE_MEMORY(spare, room);
            s->spare = spare;
            s->spare_room = room;
        }
        const koksma__tile tile = koksma__disks_tile(s, t);
        const koksma__dart_cells cells = koksma__disks_cells(s, &tile);
        s->first[t] = kept;
        kept += packed ? s->kernels->open_quarters(&cells, s->cover, (uint32_t *)s->spare + kept)
                       : refine_exactly(s, &tile, first, end, (koksma__square *)s->spare + kept);
        first = end;
    }
    s->level++;
    void *squares = s->squares;
    s->squares = s->spare;
    s->spare = squares;
    const size_t room = s->square_room;
    s->square_room = s->spare_room;
    s->spare_room = room;
    s->first[(size_t)s->tiles * s->tiles] = s->n_squares = kept;
    return KOKSMA_OK;
}

/* Makes the first cover: the lists of all cells. */
static void list_cells(koksma__disks *s)
{
    uint32_t *squares = s->squares;
    for (uint32_t i = 0; i < s->tiles * s->tiles; i++) {
        const koksma__tile t = koksma__disks_tile(s, i);
        s->first[i] = s->n_squares;
        for (uint32_t y = 0; y < t.ny; y++) {
            for (uint32_t x = 0; x < t.nx; x++) {
                squares[s->n_squares++] = koksma__place(x, y);
            }
        }
    }
    s->first[(size_t)s->tiles * s->tiles] = s->n_squares;
}

koksma_status koksma__disks_fill(koksma__disks *s, size_t n, const koksma_run *run)
{
    koksma_status status = KOKSMA_OK;
    if (!s->n) {
        list_cells(s);
    }
    while (s->n < n && s->n_squares && !status) {
        const double enough = n == SIZE_MAX ? 1 : 1.5 * (double)(n - s->n) / (double)s->n_squares + 0.01;
        status = koksma__darts_throw(s, fmin(enough, 0.75), n, run);
        if (!status && s->n < n) {
            status = koksma__disks_refine(s);
        }
        if ((uint64_t)s->cells << s->level >= FINEST / 2) {
            break;
        }
        if (!status && !koksma__keep_going(run, n == SIZE_MAX ? 0.5 : (double)s->n / (double)n)) {
            status = koksma__fail_interrupted();
        }
    }
    return status;
}

koksma_status koksma__disks_shrink(koksma__disks *s, size_t n, double d)
{
    koksma_status status = make_grid(s, d);
    s->n = n;
    for (size_t i = 0; i < n && !status; i++) {
        const double x = s->xs[2 * i] * s->cells, y = s->xs[2 * i + 1] * s->cells;
        const uint32_t cell_x = (uint32_t)fmin(x, s->cells - 1.0), cell_y = (uint32_t)fmin(y, s->cells - 1.0);
        const uint32_t tx = koksma__disks_tile_of(s, cell_x), ty = koksma__disks_tile_of(s, cell_y);
        const koksma__tile t = koksma__disks_tile(s, ty * s->tiles + tx);
        const uint32_t place = koksma__place((uint32_t)((x - t.x) * KOKSMA__PLACE_UNITS + 0.5),
                                             (uint32_t)((y - t.y) * KOKSMA__PLACE_UNITS + 0.5));
        koksma__disks_put(s, &t, cell_x - t.x, cell_y - t.y, place, i);
    }
    if (!status) {
        list_cells(s);
        status = koksma__disks_refine(s);
    }
    return status;
}
