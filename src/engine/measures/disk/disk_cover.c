/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The discrepancy of disks, or bounds for it, by branch and bound over square cells of centres. Let c be the centre
 * of a cell, rho the distance of its corners from c, and d_1 <= d_2 <= .. the distances of the points from c. A disk
 * of radius s about any centre in the cell contains at most the points within s + rho of c and at least those within
 * s - rho, so that
 *
 *     excess  <= max_i i/n - pi max(0, d_i - rho)^2          over d_i <= r + rho,
 *     deficit <= max_i pi min(r, d_i + rho)^2 - (i - 1)/n    over d_i - rho <= r, and d_(n+1) = infinity;
 *
 * with rho = 0 these are the values of the best disks about c itself. Cells that may contain the centre of a better
 * disk than the best so far are cut into four, level by level, so that the result is the same for any number of
 * threads. The points on the rim of a disk of radius s about a centre in the cell are between s - rho and s + rho
 * away from c. If the disk is better than the best so far, these distances are close to a d_i whose bound exceeds the
 * best value. When few points are at such distances, the disks through all pairs of them are tried, and the cell is
 * finished.
 */
#include "measures/disk/disk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/shared/shared.h"

enum {
    FIRST_COLUMNS = 16,
    CELLS_PER_BLOCK = 16,
    MAX_CELLS = 1 << 20,
    FEW_PAIRS = 6,
    MANY_PAIRS = 64,
    LOOKS_A_PAIR = 16
};

static const double max_work = 0x1p28; /* limit of point tests (some seconds) if there is no time limit */
static const double slack = 1e-12;     /* larger than the rounding errors of a bound */

typedef struct cell {
    double x, y, upper;
} cell;

typedef struct cover {
    const koksma__disk_set *set;
    double rho, deadline_s, work;
    koksma__disk_best start, *best; /* best disk of all earlier levels; best disk of each block */
    size_t *pairs;                  /* number of pairs tried in each block */
    cell *cells;
    size_t n_cells;
} cover;

/* A point near a cell: its distance from the centre of the cell, and the bounds for disks whose rim is near this
   point. */
typedef struct neighbour {
    double square, distance, excess, deficit;
    size_t index;
} neighbour;

/* The scratch memory of a block: the neighbours, and space to sort them. */
typedef struct desk {
    neighbour *found, *sorted;
    size_t *starts, n_pairs; /* n_pairs: number of pairs that have been tried */
} desk;

/* Finds the points up to `reach` away from (x, y), sorts them by distance (into bins of equal area, and by insertion
   within the bins), and returns their number. */
static size_t find_neighbours(const koksma__disk_set *set, double x, double y, double reach, desk *d)
{
    const double limit = reach * reach, scale = (double)set->m / limit;
    size_t count = 0;
    memset(d->starts, 0, (set->m + 1) * sizeof *d->starts);
    for (size_t k = 0; k < set->m; k++) {
        const double ax = fabs(set->xs[k] - x), ay = fabs(set->ys[k] - y);
        const double dx = ax < 1 - ax ? ax : 1 - ax, dy = ay < 1 - ay ? ay : 1 - ay, square = dx * dx + dy * dy;
        if (square <= limit) {
            d->found[count++] = (neighbour){.square = square, .index = k};
            d->starts[(size_t)(square * scale * 0.999999)]++;
        }
    }
    size_t total = 0;
    for (size_t bin = 0; bin <= set->m; bin++) {
        const size_t items = d->starts[bin];
        d->starts[bin] = total;
        total += items;
    }
    for (size_t i = 0; i < count; i++) {
        d->sorted[d->starts[(size_t)(d->found[i].square * scale * 0.999999)]++] = d->found[i];
    }
    for (size_t i = 1; i < count; i++) {
        const neighbour moving = d->sorted[i];
        size_t j = i;
        for (; j > 0 && d->sorted[j - 1].square > moving.square; j--) {
            d->sorted[j] = d->sorted[j - 1];
        }
        d->sorted[j] = moving;
    }
    return count;
}

/* Tries the disks through each pair of the neighbours first .. last. */
static koksma_status try_pairs(const cover *c, const cell *at, const desk *d, size_t first, size_t last,
                               koksma__disk_best *best)
{
    const koksma__disk_set *set = c->set;
    koksma_status status = KOKSMA_OK;
    for (size_t a = first; a <= last; a++) {
        for (size_t b = first; b < a && !status; b++) {
            const size_t i = d->sorted[b].index, j = d->sorted[a].index;
            const double ix = set->xs[i] - at->x, iy = set->ys[i] - at->y, jx = set->xs[j] - at->x,
                         jy = set->ys[j] - at->y;
            status = koksma__disk_pair(set, i, j, (jx - round(jx)) - (ix - round(ix)),
                                       (jy - round(jy)) - (iy - round(iy)), best);
        }
    }
    return status;
}

/* If few pairs of points can be on the rim of a disk better than the best so far, tries them and marks the cell as
   finished. */
static koksma_status settle(const cover *c, cell *at, desk *d, size_t count, koksma__disk_best *best)
{
    const double margin = 2 * c->rho + 1e-9;
    const size_t most = c->rho < 1e-5 ? MANY_PAIRS : FEW_PAIRS;
    size_t n_pairs = 0;
    for (int trying = 0; trying < 2; trying++) {
        for (size_t i = 0; i < count; i++) {
            size_t first = i, last = i;
            while (d->sorted[i].excess > c->start.value && first > 0 &&
                   d->sorted[first - 1].distance >= d->sorted[i].distance - margin) {
                first--;
            }
            while (d->sorted[i].deficit > c->start.value && last + 1 < count &&
                   d->sorted[last + 1].distance <= d->sorted[i].distance + margin) {
                last++;
            }
            const size_t others = last - first;
            n_pairs += trying ? 0 : others * (others + 1) / 2;
            if (n_pairs > most) {
                return KOKSMA_OK;
            }
            KOKSMA__TRY(trying ? try_pairs(c, at, d, first, last, best) : KOKSMA_OK);
        }
    }
    d->n_pairs += n_pairs;
    at->upper = 0;
    return KOKSMA_OK;
}

/* Computes the bound of a cell and tries the disks about its centre: closed disks contain the points on their rim,
   open disks do not. */
static koksma_status look(const cover *c, cell *at, desk *d, koksma__disk_best *best)
{
    const koksma__disk_set *set = c->set;
    const double n = (double)set->n, r = set->r, rho = c->rho, centre[2] = {at->x, at->y};
    const size_t count = find_neighbours(set, at->x, at->y, r + rho, d);
    size_t up_to = 0, at_r = 0;
    double upper = 0;
    for (size_t i = 0; i < count; i++) {
        neighbour *p = &d->sorted[i];
        p->distance = sqrt(p->square);
        const double outer = fmin(p->distance + rho, r), inner = fmax(p->distance - rho, 0);
        p->deficit = M_PI * outer * outer - (double)up_to / n + slack;
        if (p->square < r * r) {
            koksma__disk_try(set, best, false, up_to, centre, p->square);
            at_r += set->weights[p->index];
        }
        up_to += set->weights[p->index];
        p->excess = (double)up_to / n - M_PI * inner * inner + slack;
        if (p->square <= r * r) {
            koksma__disk_try(set, best, true, up_to, centre, p->square);
        }
        upper = fmax(upper, fmax(p->deficit, p->excess));
    }
    /* Finally it tries the open disk of the largest radius about the centre, and computes the deficit bound for
       d_(n+1) = infinity. */
    koksma__disk_try(set, best, false, at_r, centre, r * r);
    upper = fmax(upper, M_PI * r * r - (double)up_to / n + slack);
    at->upper = fmin(at->upper, upper);
    /* For r + rho >= 1/2 more than one periodic image of a point may be on the rim; the cell is then not finished by
       trying pairs. */
    return at->upper > c->start.value && r + rho < 0.5 ? settle(c, at, d, count, best) : KOKSMA_OK;
}

static koksma_status look_at_block(void *context, size_t block)
{
    cover *c = context;
    const size_t m = c->set->m, bytes = 2 * m * sizeof(neighbour) + (m + 1) * sizeof(size_t);
    const size_t first = block * CELLS_PER_BLOCK,
                 end = first + CELLS_PER_BLOCK < c->n_cells ? first + CELLS_PER_BLOCK : c->n_cells;
    desk d = {.found = malloc(bytes)};
    c->best[block] = c->start;
    KOKSMA__REQUIRE_MEMORY(d.found, bytes);
    d.sorted = d.found + m;
    d.starts = (size_t *)(d.sorted + m);
    koksma_status status = KOKSMA_OK;
    for (size_t i = first; i < end && !status && koksma__now_s() < c->deadline_s; i++) {
        status = look(c, &c->cells[i], &d, &c->best[block]);
    }
    c->pairs[block] = d.n_pairs;
    free(d.found);
    return status;
}

static koksma_status look_at_level(cover *c, const koksma_run *run)
{
    const size_t n_blocks = (c->n_cells + CELLS_PER_BLOCK - 1) / CELLS_PER_BLOCK;
    const size_t bytes = n_blocks * (sizeof *c->best + sizeof *c->pairs);
    c->best = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(c->best, bytes);
    c->pairs = (size_t *)(c->best + n_blocks);
    const koksma_status status = koksma__parallel(run, n_blocks, look_at_block, c);
    for (size_t block = 0; block < n_blocks && !status; block++) {
        c->start = c->best[block].value > c->start.value ? c->best[block] : c->start;
        c->work += (double)(LOOKS_A_PAIR * c->pairs[block] * c->set->m);
    }
    c->work += (double)c->n_cells * (double)c->set->m;
    free(c->best);
    return status;
}

/* Removes the cells whose bound does not exceed the best value. */
static void drop_cells(cover *c)
{
    size_t kept = 0;
    for (size_t i = 0; i < c->n_cells; i++) {
        if (c->cells[i].upper > c->start.value) {
            c->cells[kept++] = c->cells[i];
        }
    }
    c->n_cells = kept;
}

/* Cuts each cell into four. */
static koksma_status cut_cells(cover *c, double half)
{
    cell *quarters = malloc(4 * c->n_cells * sizeof *quarters);
    KOKSMA__REQUIRE_MEMORY(quarters, 4 * c->n_cells * sizeof *quarters);
    for (size_t i = 0; i < 4 * c->n_cells; i++) {
        const cell *whole = &c->cells[i / 4];
        quarters[i] =
            (cell){whole->x + (i & 1 ? half : -half) / 2, whole->y + (i & 2 ? half : -half) / 2, whole->upper};
    }
    free(c->cells);
    c->cells = quarters;
    c->n_cells *= 4;
    return KOKSMA_OK;
}

koksma_status koksma__disk_cover(const koksma__disk_set *set, const koksma_run *run, double deadline_s,
                                 koksma__disk_best *best, double *upper)
{
    cover c = {.set = set, .deadline_s = deadline_s, .start = *best, .n_cells = FIRST_COLUMNS * FIRST_COLUMNS};
    double half = 0.5 / FIRST_COLUMNS;
    c.cells = malloc(c.n_cells * sizeof *c.cells);
    KOKSMA__REQUIRE_MEMORY(c.cells, c.n_cells * sizeof *c.cells);
    for (size_t i = 0; i < c.n_cells; i++) {
        c.cells[i] =
            (cell){(double)(2 * (i % FIRST_COLUMNS) + 1) * half, (double)(2 * (i / FIRST_COLUMNS) + 1) * half, 1};
    }
    koksma_status status = KOKSMA_OK;
    for (;;) {
        c.rho = half * M_SQRT2 * (1 + 1e-15);
        status = look_at_level(&c, run);
        drop_cells(&c);
        const double next = 4 * (double)c.n_cells * (double)set->m;
        const bool enough = isinf(deadline_s) ? c.work + next > max_work : koksma__now_s() >= deadline_s;
        if (status || c.n_cells == 0 || c.n_cells > MAX_CELLS / 4 || enough || half < 1e-9) {
            break;
        }
        status = cut_cells(&c, half);
        half /= 2;
        if (status) {
            break;
        }
    }
    *best = c.start;
    *upper = c.start.value;
    for (size_t i = 0; i < c.n_cells; i++) {
        *upper = fmax(*upper, c.cells[i].upper);
    }
    free(c.cells);
    return status;
}
