/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The shrinking cover of dart throwing. darts.h describes the algorithm; dart_tiles.c stores points, cells and
 * tiles, dart_round.c throws a round of darts.
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
#include "patterns/darts/darts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/parallel.h"
#include "core/status.h"

#define NONE UINT32_MAX

/* The largest number of squares on a side of the torus; free areas smaller than such a square are ignored. */
#define FINEST ((uint64_t)1 << 30)

static const double far_away = 1e9;

/* The points in the 5 x 5 cells around a cell; the torus has side 1. Points in those of the 25 cells that lie beyond an
   edge of the torus have coordinates below 0 or above 1. The 25 cells contain all points that can be within d of a
   point of the cell; the corner cells are needed because the diagonal of a cell is a little shorter than d. `count` is
   a multiple of 8: points far away fill up the arrays. */
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

/* Finds the quarters of a tile's squares that have free area, in double arithmetic. The function is used for squares
   so small that the rounding of fixed-point positions matters. Larger squares without free area may be kept, because
   their quarters are examined later. */
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
    koksma_status status = koksma__disks_clear(s, d);
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
