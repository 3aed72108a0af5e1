/* SPDX-License-Identifier: Apache-2.0 */
#include "patterns/parts/dart_cover.h"

#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"

enum { BEFORE = 2, AFTER = 2, WORDS = 256, MOST = 16 };

#define NONE UINT32_MAX

#define FINEST ((uint64_t)1 << 30) /* squares a side; room smaller than that is none */

static const double far_away = 1e9;

static size_t place_of(const koksma__disks *s, uint32_t x, uint32_t y)
{
    return (y + BEFORE) * s->stride + x + BEFORE;
}

/* An empty grid for distance d. */
static koksma_status make_grid(koksma__disks *s, double d)
{
    s->d = d;
    s->cells = (uint32_t)ceil(sqrt(2) / d);
    s->stride = s->cells + BEFORE + AFTER;
    s->level = 0;
    s->n_squares = 0;
    const size_t places = s->stride * (s->cells + 2 * BEFORE) + AFTER, squares = (size_t)s->cells * s->cells;
    if (places > s->places) {
        free(s->gx);
        s->gx = malloc(2 * places * sizeof *s->gx);
        s->places = places;
    }
    if (squares > s->start_room) {
        free(s->starts);
        s->starts = malloc((squares + 1) * sizeof *s->starts);
        s->start_room = squares;
    }
    if (squares > s->square_room) {
        free(s->squares);
        s->squares = malloc(squares * sizeof *s->squares);
        s->square_room = squares;
    }
    if (!s->gx || !s->squares || !s->starts) {
        koksma__disks_fini(s);
        return koksma__fail_memory(2 * places * sizeof *s->gx);
    }
    s->gy = s->gx + places;
    for (size_t i = 0; i < 2 * places; i++) {
        s->gx[i] = far_away;
    }
    return KOKSMA_OK;
}

koksma_status koksma__disks_init(koksma__disks *s, uint64_t seed, double d)
{
    *s = (koksma__disks){.seed = seed, .room = 64 + (size_t)(0.72 / d / d)};
    s->xs = malloc(2 * s->room * sizeof *s->xs);
    if (!s->xs) {
        return koksma__fail_memory(2 * s->room * sizeof *s->xs);
    }
    const koksma_status status = make_grid(s, d);
    for (uint32_t y = 0; y < s->cells && !status; y++) {
        for (uint32_t x = 0; x < s->cells; x++) {
            s->squares[s->n_squares++] = (koksma__square){x, y};
        }
    }
    return status;
}

void koksma__disks_fini(koksma__disks *s)
{
    free(s->gx);
    free(s->squares);
    free(s->starts);
    free(s->darts);
    free(s->xs);
    *s = (koksma__disks){0};
}

/* The point goes into its cell and into the copies of the cell in the border. */
static void put_into_grid(koksma__disks *s, uint32_t cell_x, uint32_t cell_y, double x, double y)
{
    const int cells = (int)s->cells, cx = (int)cell_x, cy = (int)cell_y;
    for (int v = -((cy + BEFORE) / cells); v <= (cells + BEFORE - 1 - cy) / cells; v++) {
        for (int u = -((cx + BEFORE) / cells); u <= (cells + AFTER - 1 - cx) / cells; u++) {
            const size_t at = (size_t)(cy + v * cells + BEFORE) * s->stride + (size_t)(cx + u * cells + BEFORE);
            s->gx[at] = x + u;
            s->gy[at] = y + v;
        }
    }
}

/* The points of the cells that a point of the cell can be in reach of: 25 of them, with the corners, since the
   diagonal of a cell is a little shorter than d. */
typedef struct around {
    size_t count; /* rounded up to a multiple of 8 by places far away */
    double xs[32], ys[32];
} around;

static void look_around(const koksma__disks *s, uint32_t x, uint32_t y, around *a)
{
    const size_t place = place_of(s, x, y);
    size_t count = 0;
    for (size_t r = 0; r < 5; r++) {
        const size_t row = place + r * s->stride - 2 * s->stride;
        for (size_t at = row - 2; at <= row + 2; at++) {
            a->xs[count] = s->gx[at];
            a->ys[count] = s->gy[at];
            count += s->gx[at] < far_away;
        }
    }
    for (a->count = (count + 7) & ~(size_t)7; count < a->count; count++) {
        a->xs[count] = a->ys[count] = far_away;
    }
}

/* A random number of darts, of the law of Poisson with the mean that the table of probabilities is for. */
static uint32_t how_many(const uint32_t *table, uint32_t word)
{
    uint32_t count = 0;
    while (count < MOST - 1 && word >= table[count]) {
        count++;
    }
    return count;
}

static void poisson_table(double mean, uint32_t *table)
{
    double p = exp(-mean), sum = p;
    for (int k = 0; k < MOST; k++, p *= mean / k, sum += p) {
        table[k] = sum < 1 - 0x1p-33 ? (uint32_t)(sum * 0x1p32) : UINT32_MAX;
    }
}

/* A round of darts. */
typedef struct thrower {
    const koksma__kernel_table *kernels;
    koksma__disks *s;
    double size, d2; /* of a square; of the distance */
    uint32_t table[MOST], word[4 * WORDS];
    size_t used; /* of the words, in fours */
} thrower;

static void start_round(thrower *t, koksma__disks *s, double mean)
{
    t->kernels = koksma__kernels();
    t->s = s;
    t->size = 1 / ((double)s->cells * (double)((size_t)1 << s->level));
    t->d2 = s->d * s->d;
    t->used = WORDS;
    poisson_table(mean, t->table);
}

/* The darts at a square: those that no point is near to wait for the end of the round. */
static koksma_status throw_at(thrower *t, koksma__square square, const around *points)
{
    koksma__disks *s = t->s;
    if (t->used == WORDS) {
        t->kernels->words(s->seed, KOKSMA__PURPOSE_DART, s->dart, 0, WORDS, t->word);
        t->used = 0;
    }
    const uint32_t *w = t->word + 4 * t->used++, count = how_many(t->table, w[0]);
    koksma__words more;
    for (uint32_t k = 0; k < count; k++) {
        const double x = (square.x + w[1] * 0x1p-32) * t->size, y = (square.y + w[2] * 0x1p-32) * t->size;
        if (x < 1 && y < 1 && !t->kernels->near(points->count, points->xs, points->ys, x, y, t->d2)) {
            const koksma__dart dart = {x, y, w[3], square.x >> s->level, square.y >> s->level, false, false};
            const koksma_status status = koksma__darts_push(s, dart);
            if (status) {
                return status;
            }
        }
        if (k + 1 < count) {
            more = koksma__random(s->seed, KOKSMA__PURPOSE_DART, s->dart, k + 1);
            w = more.w;
        }
    }
    s->dart++;
    return KOKSMA_OK;
}

/* Decides the round: its kept darts become points; of those only the first when there would be more than n. */
static koksma_status keep_darts(koksma__disks *s, size_t n)
{
    size_t kept = koksma__darts_decide(s);
    s->n_darts = 0;
    if (s->n + kept > n) {
        koksma__darts_sort(s, kept);
        kept = n - s->n;
    }
    if (s->n + kept > s->room) {
        const size_t room = 2 * (s->n + kept);
        double *xs = realloc(s->xs, 2 * room * sizeof *xs);
        if (!xs) {
            return koksma__fail_memory(2 * room * sizeof *xs);
        }
        s->xs = xs;
        s->room = room;
    }
    for (size_t i = 0; i < kept; i++, s->n++) {
        const koksma__dart *d = &s->darts[i];
        s->xs[2 * s->n] = d->x;
        s->xs[2 * s->n + 1] = d->y;
        put_into_grid(s, d->cell_x, d->cell_y, d->x, d->y);
    }
    return KOKSMA_OK;
}

static bool more_squares(koksma__square **squares, size_t *room)
{
    *room = *room * 2;
    koksma__square *more = realloc(*squares, *room * sizeof *more);
    if (!more) {
        free(*squares);
    }
    *squares = more;
    return more != NULL;
}

/* The next round: cuts the squares in four, keeps those with room and throws darts at them. Squares of a cell stay
   neighbours in the list. */
static koksma_status refine(koksma__disks *s, double mean)
{
    const double half = 0.5 / ((double)s->cells * (double)((size_t)2 << s->level));
    const int level = s->level++;
    size_t kept = 0, room = s->n_squares + s->n_squares / 2 + 64;
    koksma__square *squares = malloc(room * sizeof *squares);
    uint32_t cell_x = NONE, cell_y = NONE;
    bool full = false;
    around points;
    thrower t;
    start_round(&t, s, mean);
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < s->n_squares && squares && !status; i++) {
        const koksma__square square = s->squares[i];
        if (cell_x != square.x >> level || cell_y != square.y >> level) {
            cell_x = square.x >> level;
            cell_y = square.y >> level;
            full = s->gx[place_of(s, cell_x, cell_y)] < far_away; /* its point covers it: it is smaller than d */
            if (!full) {
                look_around(s, cell_x, cell_y, &points);
            }
        }
        if (full || (kept + 4 > room && !more_squares(&squares, &room))) {
            continue;
        }
        const unsigned covered = t.kernels->covers(points.count, points.xs, points.ys, (4 * square.x + 2) * half,
                                                   (4 * square.y + 2) * half, half, half, t.d2);
        for (uint32_t q = 0; q < 4 && !status; q++) {
            if (!(covered >> q & 1)) {
                squares[kept] = (koksma__square){2 * square.x + (q & 1), 2 * square.y + (q >> 1)};
                status = throw_at(&t, squares[kept++], &points);
            }
        }
    }
    free(s->squares);
    s->squares = squares;
    s->square_room = room;
    s->n_squares = kept;
    return squares ? status : koksma__fail_memory(room * sizeof *squares);
}

/* The first round, at whole cells. */
static koksma_status throw_first(koksma__disks *s, double mean)
{
    koksma_status status = KOKSMA_OK;
    around points = {0};
    thrower t;
    start_round(&t, s, mean);
    for (size_t i = 0; i < s->n_squares && !status; i++) {
        if (s->n) {
            look_around(s, s->squares[i].x, s->squares[i].y, &points);
        }
        status = throw_at(&t, s->squares[i], &points);
    }
    return status;
}

koksma_status koksma__disks_fill(koksma__disks *s, size_t n, const koksma_run *run)
{
    koksma_status status = KOKSMA_OK;
    for (bool first = true; s->n < n && s->n_squares && (uint64_t)s->cells << s->level < FINEST / 2 && !status;
         first = false) {
        const double enough = n == SIZE_MAX ? 1 : 1.5 * (double)(n - s->n) / (double)s->n_squares + 0.01;
        const double mean = fmin(enough, 0.5);
        status = first ? throw_first(s, mean) : refine(s, mean);
        if (!status) {
            status = keep_darts(s, n);
        }
        if (!status && !koksma__keep_going(run, n == SIZE_MAX ? 0.5 : (double)s->n / (double)n)) {
            status = koksma__fail_interrupted();
        }
    }
    return status;
}

koksma_status koksma__disks_shrink(koksma__disks *s, size_t n, double d)
{
    const koksma__kernel_table *kernels = koksma__kernels();
    const koksma_status status = make_grid(s, d);
    s->n = n;
    for (size_t i = 0; i < n && !status; i++) {
        const double x = s->xs[2 * i], y = s->xs[2 * i + 1];
        const uint32_t cell_x = (uint32_t)(x * s->cells), cell_y = (uint32_t)(y * s->cells);
        put_into_grid(s, cell_x < s->cells ? cell_x : s->cells - 1, cell_y < s->cells ? cell_y : s->cells - 1, x, y);
    }
    const double half = 0.5 / s->cells;
    around points;
    for (uint32_t y = 0; y < s->cells && !status; y++) {
        for (uint32_t x = 0; x < s->cells; x++) {
            if (s->gx[place_of(s, x, y)] < far_away) {
                continue;
            }
            look_around(s, x, y, &points);
            s->squares[s->n_squares] = (koksma__square){x, y};
            s->n_squares += !kernels->covers(points.count, points.xs, points.ys, (2 * x + 1) * half,
                                             (2 * y + 1) * half, 0, half, d * d);
        }
    }
    return status;
}
