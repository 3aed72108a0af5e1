/* SPDX-License-Identifier: Apache-2.0 */
/* Throws the darts of one round of koksma__disks_fill and decides which are kept (the algorithm is in
   darts.h). */
#include "patterns/darts/darts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"

enum { MOST_CELLS = KOKSMA__DART_TILE };

#define NONE UINT32_MAX

/* The darts of this round that wait in one tile, by cell. */
typedef struct queue {
    uint8_t rows[MOST_CELLS][MOST_CELLS / 8 + 1];
    uint32_t last[MOST_CELLS * MOST_CELLS]; /* last waiting dart in each cell whose bit in rows is set */
} queue;

/* Returns the random words of darts that were drawn but not thrown yet, four words for each dart. Draws more words if
   there are none. The first batch is small, because small sets need few darts. */
static size_t draw(koksma__disks *s, const uint32_t **words)
{
    if (s->used == s->drawn) {
        s->drawn = s->drawn ? KOKSMA__DART_WORDS : KOKSMA__DART_WORDS / 8;
        s->kernels->words(s->seed, KOKSMA__PURPOSE_DART, s->dart, 0, s->drawn, s->words);
        s->dart += s->drawn;
        s->used = 0;
    }
    *words = s->words + 4 * s->used;
    return s->drawn - s->used;
}

/* Returns whether a point is nearer than d, in double arithmetic, for points whose fixed-point distance does not
   decide. */
static bool near_in_doubles(const koksma__disks *s, const koksma__dart *d)
{
    const koksma__tile t = koksma__disks_tile(s, d->tile);
    const uint32_t *places = s->places + koksma__disks_corner(s, d->tile, d->cell_x, d->cell_y);
    for (uint32_t cell = 0; cell < 25; cell++) {
        const uint32_t r = cell / 5, c = cell % 5;
        const int32_t least = koksma__place_distance(d->place, places[r * s->stride + c]);
        if (least < s->high) {
            const uint32_t x = (t.x + d->cell_x + c + 2 * s->cells - 2) % s->cells;
            const uint32_t y = (t.y + d->cell_y + r + 2 * s->cells - 2) % s->cells;
            const size_t who = koksma__disks_who(s, x, y);
            double a = fabs(s->xs[2 * who] - d->x), b = fabs(s->xs[2 * who + 1] - d->y);
            a = fmin(a, 1 - a);
            b = fmin(b, 1 - b);
            if (a * a + b * b < s->d * s->d) {
                return true;
            }
        }
    }
    return false;
}

/* Returns whether there is a point nearer to the dart than d. */
static inline bool is_near(const koksma__disks *s, const koksma__dart *d)
{
    const size_t corner = koksma__disks_corner(s, d->tile, d->cell_x, d->cell_y);
    const int32_t least = s->kernels->nearest_place(s->places + corner, s->stride, d->place);
    return least < s->high && (least < s->low || near_in_doubles(s, d));
}

/* A tile whose squares darts are thrown at. */
typedef struct target {
    koksma__tile tile;
    koksma__dart_cells cells;
    size_t first;
    double side; /* side of a square if the torus has side 1 */
} target;

static target target_of(const koksma__disks *s, uint32_t number)
{
    target a = {.tile = koksma__disks_tile(s, number), .first = s->first[number]};
    a.cells = koksma__disks_cells(s, &a.tile);
    a.side = 1 / ((double)((uint32_t)1 << s->level) * s->cells);
    return a;
}

/* Lists in `far` the numbers of the darts that may be far enough from all points; returns how many there are. */
static size_t choose_far(const koksma__disks *s, const target *a, size_t count, const uint32_t *words, uint32_t *far)
{
    if (s->level <= KOKSMA__PACKED_LEVEL) {
        return s->kernels->far_darts(&a->cells, s->low, count, words, far);
    }
    for (uint32_t i = 0; i < count; i++) {
        far[i] = i;
    }
    return count;
}

/* Returns a coordinate of a dart as a fixed-point number, measured from the corner of the grid. */
static inline uint32_t place_of(uint32_t square, uint32_t word, int level)
{
    return (uint32_t)((((uint64_t)square << 32 | word) >> (level + 31 - KOKSMA__PLACE_BITS)) + 1) >> 1;
}

/* Makes a dart in a random square of a tile. Returns false if rounding puts it outside the unit square. */
static inline bool aim(const koksma__disks *s, const target *a, const uint32_t *w, koksma__dart *d)
{
    const koksma__tile *t = &a->tile;
    const koksma__square square = koksma__disks_square(s, t, a->first + koksma__below(w[0], a->cells.count));
    d->place = koksma__place(place_of(square.x, w[1], s->level) - (t->x << KOKSMA__PLACE_BITS),
                             place_of(square.y, w[2], s->level) - (t->y << KOKSMA__PLACE_BITS));
    d->cell_x = (uint16_t)((square.x >> s->level) - t->x);
    d->cell_y = (uint16_t)((square.y >> s->level) - t->y);
    d->tile = t->number;
    d->x = (square.x + w[1] * 0x1p-32) * a->side;
    d->y = (square.y + w[2] * 0x1p-32) * a->side;
    return (d->x < 1) & (d->y < 1);
}

static koksma_status more_points(koksma__disks *s)
{
    const size_t room = 2 * s->room;
    double *xs = realloc(s->xs, 2 * room * sizeof *xs);
    s->xs = xs ? xs : s->xs;
    double *times = xs && s->times ? realloc(s->times, room * sizeof *times) : s->times;
    s->times = times ? times : s->times;
    if (!xs || (s->times && !times)) {
        return koksma__fail_memory(2 * room * sizeof *xs);
    }
    s->room = room;
    return KOKSMA_OK;
}

static inline koksma_status keep(koksma__disks *s, const koksma__tile *t, const koksma__dart *d)
{
    if (s->n == s->room) {
        KOKSMA__TRY(more_points(s));
    }
    s->xs[2 * s->n] = d->x;
    s->xs[2 * s->n + 1] = d->y;
    if (s->times) {
        s->times[s->n] = d->time;
    }
    koksma__disks_put(s, t, d->cell_x, d->cell_y, d->place, s->n++);
    return KOKSMA_OK;
}

/* Throws a round of darts if there is only one tile: darts come in order of time and are decided at once. First the
   darts of a batch that are near points of earlier batches are dropped. */
static koksma_status throw_at_all(koksma__disks *s, size_t darts, size_t n)
{
    const target a = target_of(s, 0);
    koksma_status status = KOKSMA_OK;
    while (darts && s->n < n && !status) {
        uint32_t far[KOKSMA__DART_WORDS];
        const uint32_t *words;
        const size_t drawn = draw(s, &words), some = drawn < darts ? drawn : darts;
        const size_t left = choose_far(s, &a, some, words, far);
        for (size_t i = 0; i < left && s->n < n && !status; i++) {
            koksma__dart d = {.time = 0};
            if (aim(s, &a, words + 4 * far[i], &d) && !is_near(s, &d)) {
                status = keep(s, &a.tile, &d);
            }
        }
        s->used += some;
        darts -= some;
    }
    return status;
}

/* Returns whether the dart has to wait: cells within d of it are outside the tile, or an earlier dart near it waits.
   */
static inline bool must_wait(const koksma__disks *s, const koksma__tile *t, const queue *q, const koksma__dart *d)
{
    const uint32_t x = d->cell_x, y = d->cell_y;
    if ((x < 2) | (y < 2) | (x + 2 >= t->nx) | (y + 2 >= t->ny)) {
        return true;
    }
    for (uint32_t r = y - 2; r <= y + 2; r++) {
        const uint8_t *bits = &q->rows[r][(x - 2) / 8];
        for (uint32_t some = (bits[0] | (uint32_t)bits[1] << 8) >> (x - 2) % 8 & 31; some; some &= some - 1) {
            const uint32_t c = x - 2 + (uint32_t)__builtin_ctz(some);
            for (uint32_t i = q->last[r * MOST_CELLS + c]; i != NONE; i = s->waiting[i].next) {
                const double a = s->waiting[i].x - d->x, b = s->waiting[i].y - d->y;
                if (a * a + b * b < s->d * s->d) {
                    return true;
                }
            }
        }
    }
    return false;
}

static koksma_status put_off(koksma__disks *s, queue *q, const koksma__dart *d)
{
    KOKSMA__TRY(koksma__reserve(&s->waiting, &s->waiting_room, s->n_waiting + 1, sizeof *s->waiting));
    const uint32_t x = d->cell_x, y = d->cell_y;
    uint32_t *last = &q->last[y * MOST_CELLS + x];
    s->waiting[s->n_waiting] = *d;
    s->waiting[s->n_waiting].next = q->rows[y][x / 8] >> x % 8 & 1 ? *last : NONE;
    *last = (uint32_t)s->n_waiting++;
    q->rows[y][x / 8] |= (uint8_t)(1 << x % 8);
    return KOKSMA_OK;
}

/* The current time in a Poisson process on [0, 1) with the given rate. Time multiplied by the rate is minus the
   logarithm of a product of uniform numbers; the logarithm is computed only for darts whose time is needed. */
typedef struct stopwatch {
    double rate, before, product;
    int factors;
    double last; /* the process ends when `product` is at most this number */
} stopwatch;

static bool tick(stopwatch *c, uint32_t word)
{
    if (!c->factors) {
        c->before -= koksma__log(c->product);
        c->product = 1;
        c->factors = 16; /* each factor is at least 2^-33, so the product is at least exp(-366) */
        c->last = c->rate - c->before > 400 ? 0 : koksma__exp(c->before - c->rate);
    }
    c->factors--;
    c->product *= (word + 0.5) * 0x1p-32;
    return c->product > c->last;
}

/* Prefetches a tile into the cache. Darts hit it in random order, so without this each dart would wait for its cache
   lines. */
static void fetch(const koksma__disks *s, const target *a)
{
    for (size_t i = 0; i < s->block; i += 16) {
        __builtin_prefetch(a->cells.places + i, 1);
    }
    for (size_t i = 0; i < s->wide * s->wide; i += 16) {
        __builtin_prefetch(s->who + a->tile.number * s->wide * s->wide + i, 1);
    }
    for (size_t i = 0; i < a->cells.count; i += 16) {
        __builtin_prefetch(a->cells.squares + i);
    }
}

/* Throws a round of darts at one of several tiles; with `timed` it stores the arrival times of the kept points. */
static koksma_status throw_at_tile(koksma__disks *s, uint32_t number, queue *q, double mean, bool timed)
{
    const target a = target_of(s, number);
    if (!a.cells.count) {
        return KOKSMA_OK;
    }
    memset(q->rows, 0, sizeof q->rows);
    stopwatch clock = {.rate = mean * a.cells.count, .product = 1};
    if (clock.rate > 256) {
        fetch(s, &a);
    }
    koksma_status status = KOKSMA_OK;
    for (bool more = true; more && !status;) {
        uint32_t far[KOKSMA__DART_WORDS];
        double before[KOKSMA__DART_WORDS], products[KOKSMA__DART_WORDS];
        const uint32_t *words;
        const size_t drawn = draw(s, &words);
        size_t some = 0;
        for (; some < drawn && (more = tick(&clock, words[4 * some + 3])); some++) {
            before[some] = clock.before;
            products[some] = clock.product;
        }
        const size_t left = choose_far(s, &a, some, words, far);
        for (size_t i = 0; i < left && !status; i++) {
            koksma__dart d;
            if (aim(s, &a, words + 4 * far[i], &d) && !is_near(s, &d)) {
                const bool waits = must_wait(s, &a.tile, q, &d);
                d.time = waits || timed
                             ? fmin((before[far[i]] - koksma__log(products[far[i]])) / clock.rate, 1 - 0x1p-53)
                             : 0;
                status = waits ? put_off(s, q, &d) : keep(s, &a.tile, &d);
            }
        }
        s->used += some + !more;
    }
    return status;
}

static int earlier(const void *a, const void *b)
{
    const koksma__dart *d = a, *e = b;
    return (d->time > e->time) - (d->time < e->time);
}

/* The points of this round begin at number `before`. Drops those that arrived last until n points are left. */
static koksma_status drop_last(koksma__disks *s, size_t before, size_t n)
{
    const size_t count = s->n - before;
    koksma__dart *darts = malloc(count * sizeof *darts);
    KOKSMA__REQUIRE_MEMORY(darts, count * sizeof *darts);
    for (size_t i = 0; i < count; i++) {
        darts[i] = (koksma__dart){
            .x = s->xs[2 * (before + i)], .y = s->xs[2 * (before + i) + 1], .time = s->times[before + i]};
    }
    qsort(darts, count, sizeof *darts, earlier);
    for (s->n = before; s->n < n; s->n++) {
        s->xs[2 * s->n] = darts[s->n - before].x;
        s->xs[2 * s->n + 1] = darts[s->n - before].y;
    }
    free(darts);
    return KOKSMA_OK;
}

/* Sorts the waiting darts by time: a bucket sort by floor(n * time), which leaves n uniform times nearly sorted,
   then an insertion sort. */
static koksma_status sort_waiting(koksma__disks *s)
{
    const size_t n = s->n_waiting;
    if (!n) {
        return KOKSMA_OK;
    }
    if (2 * n > s->waiting_room) {
        koksma__dart *waiting = realloc(s->waiting, 2 * n * sizeof *waiting);
        KOKSMA__REQUIRE_MEMORY(waiting, 2 * n * sizeof *waiting);
        s->waiting = waiting;
        s->waiting_room = 2 * n;
    }
    size_t *starts = calloc(n + 1, sizeof *starts);
    KOKSMA__REQUIRE_MEMORY(starts, (n + 1) * sizeof *starts);
    koksma__dart *to = s->waiting, *from = s->waiting + n;
    for (size_t i = 0; i < n; i++) {
        from[i] = to[i];
        starts[(size_t)(to[i].time * (double)n) + 1]++;
    }
    for (size_t i = 0; i < n; i++) {
        starts[i + 1] += starts[i];
    }
    for (size_t i = 0; i < n; i++) {
        to[starts[(size_t)(from[i].time * (double)n)]++] = from[i];
    }
    for (size_t i = 1; i < n; i++) {
        const koksma__dart d = to[i];
        size_t at = i;
        for (; at && to[at - 1].time > d.time; at--) {
            to[at] = to[at - 1];
        }
        to[at] = d;
    }
    free(starts);
    return KOKSMA_OK;
}

koksma_status koksma__darts_throw(koksma__disks *s, double mean, size_t n, const koksma_run *run)
{
    if (s->tiles == 1) {
        return throw_at_all(s, (size_t)ceil(mean * (double)s->n_squares) + 4, n);
    }
    const size_t before = s->n;
    koksma_status status = KOKSMA_OK;
    queue q;
    s->n_waiting = 0;
    for (uint32_t i = 0; i < s->tiles * s->tiles && !status; i++) {
        status = throw_at_tile(s, i, &q, mean, n < SIZE_MAX);
        status = status ? status : koksma__look(run, i, n == SIZE_MAX ? 0.5 : (double)s->n / (double)n);
    }
    status = status ? status : sort_waiting(s);
    for (size_t i = 0; i < s->n_waiting && !status; i++) {
        if (!is_near(s, &s->waiting[i])) {
            const koksma__tile t = koksma__disks_tile(s, s->waiting[i].tile);
            status = keep(s, &t, &s->waiting[i]);
        }
    }
    return !status && s->n > n ? drop_last(s, before, n) : status;
}
