/* SPDX-License-Identifier: Apache-2.0 */
#include "patterns/parts/dart_cover.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/pages.h"
#include "core/parallel.h"
#include "core/status.h"

enum {
    BEFORE = KOKSMA__DART_BEFORE,
    AFTER = KOKSMA__DART_AFTER,
    WHOLE = 96, /* cells a side of the largest grid that is one tile */
    TILE = 64   /* the most of another tile */
};

#define NONE UINT32_MAX

#define FINEST ((uint64_t)1 << 30) /* squares a side; room smaller than that is none */

static const float far_away = 1e9F;

/* Room for `count` things of `size` bytes, whose contents may be lost. */
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

/* Cells and tiles for distance d; the margins are those of floats: places are below 8 cells, and off by 2^-22. */
static void choose_grid(koksma__disks *s, double d)
{
    s->d = d;
    s->cells = (uint32_t)ceil(sqrt(2) / d);
    s->tiles = s->cells <= WHOLE ? 1 : (s->cells + TILE - 1) / TILE;
    s->wide = (s->cells + s->tiles - 1) / s->tiles;
    s->stride = s->wide + BEFORE + AFTER;
    s->block = s->stride * (s->wide + 2 * BEFORE);
    s->level = 0;
    s->n_squares = 0;
    const double reach = d * s->cells;
    s->low = (float)(reach * reach - 1e-5);
    s->high = (float)(reach * reach + 1e-5);
}

/* An empty grid for distance d. */
static koksma_status make_grid(koksma__disks *s, double d)
{
    choose_grid(s, d);
    const size_t tiles = (size_t)s->tiles * s->tiles, squares = (size_t)s->cells * s->cells;
    const size_t places = tiles * s->block + AFTER, own = tiles * s->wide * s->wide;
    const size_t bytes = places * (2 * sizeof *s->gx) + own * sizeof *s->who + squares * sizeof *s->squares;
    void *grid = s->gx, *who = s->who, *list = s->squares, *first = s->first;
    size_t who_room = s->who_room;
    const bool ok = get_room(&grid, &s->grid_room, 2 * places, sizeof *s->gx) &&
                    get_room(&who, &who_room, own, sizeof *s->who) &&
                    get_room(&list, &s->square_room, squares, sizeof *s->squares) &&
                    get_room(&first, &s->first_room, tiles + 1, sizeof *s->first);
    s->gx = grid;
    s->who = who;
    s->who_room = who_room;
    s->squares = list;
    s->first = first;
    if (!ok) {
        return koksma__fail_memory(bytes);
    }
    s->gy = s->gx + places;
    for (size_t i = 0; i < 2 * places; i++) {
        s->gx[i] = far_away;
    }
    memset(s->who, 0xff, own * sizeof *s->who);
    if (s->tiles > 1 && !s->times) {
        s->times = malloc(s->room * sizeof *s->times);
    }
    return s->tiles == 1 || s->times ? KOKSMA_OK : koksma__fail_memory(s->room * sizeof *s->times);
}

koksma_status koksma__disks_init(koksma__disks *s, uint64_t seed, double d)
{
    *s = (koksma__disks){.kernels = koksma__kernels(), .seed = seed, .room = 64 + (size_t)(0.72 / d / d)};
    s->xs = malloc(2 * s->room * sizeof *s->xs);
    if (!s->xs) {
        return koksma__fail_memory(2 * s->room * sizeof *s->xs);
    }
    koksma__large_pages(s->xs, 2 * s->room * sizeof *s->xs);
    return make_grid(s, d);
}

void koksma__disks_fini(koksma__disks *s)
{
    free(s->gx);
    free(s->who);
    free(s->squares);
    free(s->spare);
    free(s->first);
    free(s->waiting);
    free(s->times);
    free(s->xs);
    *s = (koksma__disks){0};
}

/* Where a cell is on one axis: the tiles of the row, and its number in them, which is outside in borders. */
typedef struct axis {
    int count, at[BEFORE + AFTER + 1];
    uint32_t tile[BEFORE + AFTER + 1];
} axis;

static axis find_copies(const koksma__disks *s, uint32_t tile, int cell)
{
    axis a = {.count = 1, .at = {cell}, .tile = {tile}};
    uint32_t t = tile;
    for (int at = cell; at < AFTER; a.count++) {
        t = t ? t - 1 : s->tiles - 1;
        at += (int)(koksma__disks_start(s, t + 1) - koksma__disks_start(s, t));
        a.at[a.count] = at;
        a.tile[a.count] = t;
    }
    t = tile;
    for (int at = cell, size;
         size = (int)(koksma__disks_start(s, t + 1) - koksma__disks_start(s, t)), at >= size - BEFORE; a.count++) {
        at -= size;
        t = t + 1 < s->tiles ? t + 1 : 0;
        a.at[a.count] = at;
        a.tile[a.count] = t;
    }
    return a;
}

void koksma__disks_put(koksma__disks *s, const koksma__tile *t, uint32_t cell_x, uint32_t cell_y, float in_x,
                       float in_y, size_t i)
{
    s->who[koksma__disks_own(s, t->number, cell_x, cell_y)] = (uint32_t)i;
    if ((cell_x >= AFTER) & (cell_y >= AFTER) & (cell_x + BEFORE < t->nx) & (cell_y + BEFORE < t->ny)) {
        const size_t place = koksma__disks_place(s, t->number, (int)cell_x, (int)cell_y);
        s->gx[place] = in_x;
        s->gy[place] = in_y;
        return;
    }
    const axis x = find_copies(s, t->number % s->tiles, (int)cell_x);
    const axis y = find_copies(s, t->number / s->tiles, (int)cell_y);
    for (int v = 0; v < y.count; v++) {
        for (int u = 0; u < x.count; u++) {
            if (y.at[v] < (int)s->wide + BEFORE) {
                const size_t place = koksma__disks_place(s, y.tile[v] * s->tiles + x.tile[u], x.at[u], y.at[v]);
                s->gx[place] = in_x;
                s->gy[place] = in_y;
            }
        }
    }
}

/* The points of the cells that a point of the cell can be in reach of: 25 of them, with the corners, since the
   diagonal of a cell is a little shorter than d. */
typedef struct around {
    size_t count;
    float xs[40], ys[40]; /* and at least eight places far away */
} around;

static inline void look_around(const koksma__disks *s, uint32_t tile, uint32_t x, uint32_t y, around *a)
{
    const size_t corner = koksma__disks_corner(s, tile, x, y);
    a->count = s->kernels->look_around(s->gx + corner, s->gy + corner, s->stride, a->xs, a->ys);
}

/* The same in doubles, in units of the torus. */
typedef struct around_exact {
    size_t count;
    double xs[32], ys[32];
} around_exact;

static void look_exactly(const koksma__disks *s, uint32_t cell_x, uint32_t cell_y, around_exact *a)
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
        a->xs[count] = a->ys[count] = (double)far_away;
    }
}

/* Which quarters of a square are covered, as the kernels say. Squares much larger than the errors of floats may be
   told not to be covered when they nearly are not: their quarters will be. */
typedef struct judge {
    const koksma__disks *s;
    bool exact;
    float h;     /* half of a quarter's side, in cells */
    double half; /* and on the torus */
    union {
        around few;
        around_exact all;
    } points;
} judge;

static inline unsigned covered(const judge *j, koksma__square square)
{
    const koksma__kernel_table *k = j->s->kernels;
    if (j->exact) {
        return k->covers(j->points.all.count, j->points.all.xs, j->points.all.ys,
                         (4 * (double)square.x + 2) * j->half, (4 * (double)square.y + 2) * j->half, j->half, j->half,
                         j->s->d * j->s->d);
    }
    const uint32_t inside = ((uint32_t)1 << (j->s->level - 1)) - 1;
    const float x = (float)(4 * (square.x & inside) + 2) * j->h, y = (float)(4 * (square.y & inside) + 2) * j->h;
    return k->covers_roughly(j->points.few.count, j->points.few.xs, j->points.few.ys, x, y, j->h, j->h, j->s->low);
}

/* The squares of a tile, those of a cell being neighbours in the list; the quarters with room are appended to the
   spare list. */
static size_t refine_tile(judge *j, uint32_t number, size_t first, size_t end, koksma__square *out)
{
    const koksma__disks *s = j->s;
    const koksma__tile tile = koksma__disks_tile(s, number);
    const int level = s->level - 1;
    uint32_t cell_x = NONE, cell_y = NONE;
    bool full = false;
    size_t kept = 0;
    for (size_t i = first; i < end; i++) {
        const koksma__square square = s->squares[i];
        if (cell_x != square.x >> level || cell_y != square.y >> level) {
            cell_x = square.x >> level;
            cell_y = square.y >> level;
            const uint32_t x = cell_x - tile.x, y = cell_y - tile.y;
            full = s->who[koksma__disks_own(s, number, x, y)] != NONE; /* its point covers it */
            if (!full && j->exact) {
                look_exactly(s, cell_x, cell_y, &j->points.all);
            } else if (!full) {
                look_around(s, number, x, y, &j->points.few);
            }
        }
        if (full) {
            continue;
        }
        const unsigned without = ~covered(j, square);
        for (uint32_t q = 0; q < 4; q++) {
            out[kept] = (koksma__square){2 * square.x + (q & 1), 2 * square.y + (q >> 1)};
            kept += without >> q & 1;
        }
    }
    return kept;
}

koksma_status koksma__disks_refine(koksma__disks *s)
{
    enum { EXACT = 10 }; /* the first level where it matters */
    s->level++;
    const float h = 0.5F / (float)((uint32_t)1 << s->level);
    judge j = {.s = s, .exact = s->level >= EXACT, .h = h, .half = (double)h / s->cells};
    size_t kept = 0, first = 0;
    for (uint32_t t = 0; t < s->tiles * s->tiles; t++) {
        const size_t end = s->first[t + 1], most = kept + 4 * (end - first);
        if (most + 1 > s->spare_room) {
            const size_t room = most + most / 2 + s->n_squares + 1;
            koksma__square *spare = realloc(s->spare, room * sizeof *spare);
            if (!spare) {
                return koksma__fail_memory(room * sizeof *spare);
            }
            s->spare = spare;
            s->spare_room = room;
        }
        s->first[t] = kept;
        kept += refine_tile(&j, t, first, end, s->spare + kept);
        first = end;
    }
    koksma__square *squares = s->squares;
    s->squares = s->spare;
    s->spare = squares;
    const size_t room = s->square_room;
    s->square_room = s->spare_room;
    s->spare_room = room;
    s->first[(size_t)s->tiles * s->tiles] = s->n_squares = kept;
    return KOKSMA_OK;
}

/* The list of whole cells: all, or those that points do not cover. */
static void list_cells(koksma__disks *s, bool all)
{
    around points;
    for (uint32_t i = 0; i < s->tiles * s->tiles; i++) {
        const koksma__tile t = koksma__disks_tile(s, i);
        s->first[i] = s->n_squares;
        for (uint32_t y = 0; y < t.ny; y++) {
            for (uint32_t x = 0; x < t.nx; x++) {
                s->squares[s->n_squares] = (koksma__square){t.x + x, t.y + y};
                if (all) {
                    s->n_squares++;
                } else if (s->who[koksma__disks_own(s, i, x, y)] == NONE) {
                    look_around(s, i, x, y, &points);
                    s->n_squares +=
                        !s->kernels->covers_roughly(points.count, points.xs, points.ys, 0.5F, 0.5F, 0, 0.5F, s->low);
                }
            }
        }
    }
    s->first[(size_t)s->tiles * s->tiles] = s->n_squares;
}

koksma_status koksma__disks_fill(koksma__disks *s, size_t n, const koksma_run *run)
{
    koksma_status status = KOKSMA_OK;
    if (!s->n) {
        list_cells(s, true);
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
    const koksma_status status = make_grid(s, d);
    s->n = n;
    for (size_t i = 0; i < n && !status; i++) {
        const double x = s->xs[2 * i] * s->cells, y = s->xs[2 * i + 1] * s->cells;
        const uint32_t cell_x = (uint32_t)fmin(x, s->cells - 1.0), cell_y = (uint32_t)fmin(y, s->cells - 1.0);
        const uint32_t tx = koksma__disks_tile_of(s, cell_x), ty = koksma__disks_tile_of(s, cell_y);
        const koksma__tile t = koksma__disks_tile(s, ty * s->tiles + tx);
        koksma__disks_put(s, &t, cell_x - t.x, cell_y - t.y, (float)(x - cell_x), (float)(y - cell_y), i);
    }
    if (!status) {
        list_cells(s, false);
    }
    return status;
}
