/* SPDX-License-Identifier: Apache-2.0 */
#include "patterns/parts/dart_cover.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"

enum { BEFORE = 2, AFTER = 5, WORDS = 256, AHEAD = 8 };

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
    if (squares > s->square_room) {
        free(s->squares);
        s->squares = malloc(squares * sizeof *s->squares);
        s->square_room = squares;
    }
    if (!s->gx || !s->squares) {
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

static koksma_status add(koksma__disks *s, uint32_t cell_x, uint32_t cell_y, double x, double y)
{
    if (s->n == s->room) {
        const size_t room = s->room * 2;
        double *xs = realloc(s->xs, 2 * room * sizeof *xs);
        if (!xs) {
            return koksma__fail_memory(2 * room * sizeof *xs);
        }
        s->xs = xs;
        s->room = room;
    }
    s->xs[2 * s->n] = x;
    s->xs[2 * s->n + 1] = y;
    s->n++;
    put_into_grid(s, cell_x, cell_y, x, y);
    return KOKSMA_OK;
}

/* Asks for the memory that a dart in some turns will look at: first its square, then the grid around. A hint only. */
static void fetch(const koksma__disks *s, const uint32_t *word)
{
    __builtin_prefetch(&s->squares[koksma__below(word[4 * 2 * AHEAD], (uint32_t)s->n_squares)]);
    const koksma__square square = s->squares[koksma__below(word[4 * AHEAD], (uint32_t)s->n_squares)];
    const size_t corner = place_of(s, square.x >> s->level, square.y >> s->level) - 2 * s->stride - 2;
    for (size_t r = 0; r < 5; r++) {
        __builtin_prefetch(s->gx + corner + r * s->stride);
        __builtin_prefetch(s->gy + corner + r * s->stride);
        __builtin_prefetch(s->gx + corner + r * s->stride + 7);
        __builtin_prefetch(s->gy + corner + r * s->stride + 7);
    }
}

/* A dart at a random square. The square of a kept dart is taken out of the list. */
static koksma_status throw(koksma__disks * s, const koksma__kernel_table *kernels, const uint32_t *word)
{
    const size_t at = koksma__below(word[0], (uint32_t)s->n_squares);
    const koksma__square square = s->squares[at];
    const double size = 1 / ((double)s->cells * (double)((size_t)1 << s->level));
    const double x = (square.x + word[1] * 0x1p-32) * size, y = (square.y + word[2] * 0x1p-32) * size;
    const uint32_t cell_x = square.x >> s->level, cell_y = square.y >> s->level;
    const size_t corner = place_of(s, cell_x, cell_y) - 2 * s->stride - 2;
    if (x >= 1 || y >= 1 || kernels->near(s->gx + corner, s->gy + corner, s->stride, x, y, s->d * s->d)) {
        return KOKSMA_OK;
    }
    s->squares[at] = s->squares[--s->n_squares];
    return add(s, cell_x, cell_y, x, y);
}

/* Cuts the squares in four and keeps those with room. */
static koksma_status refine(koksma__disks *s, const koksma__kernel_table *kernels)
{
    const double half = 0.5 / ((double)s->cells * (double)((size_t)2 << s->level));
    size_t kept = 0, room = s->n_squares + s->n_squares / 2 + 64;
    koksma__square *squares = malloc(room * sizeof *squares);
    for (size_t i = 0; i < s->n_squares && squares; i++) {
        const koksma__square square = s->squares[i];
        const size_t place = place_of(s, square.x >> s->level, square.y >> s->level);
        if (s->gx[place] < 1) {
            continue; /* the cell has its point, and is smaller than d */
        }
        const size_t corner = place - 2 * s->stride - 2;
        if (kept + 4 > room) {
            room *= 2;
            koksma__square *more = realloc(squares, room * sizeof *squares);
            if (!more) {
                free(squares);
            }
            squares = more;
        }
        for (uint32_t q = 0; q < 4 && squares; q++) {
            const koksma__square part = {2 * square.x + (q & 1), 2 * square.y + (q >> 1)};
            squares[kept] = part;
            kept += !kernels->covers(s->gx + corner, s->gy + corner, s->stride, (2 * part.x + 1) * half,
                                     (2 * part.y + 1) * half, half, s->d * s->d);
        }
    }
    if (!squares) {
        return koksma__fail_memory(room * sizeof *squares);
    }
    free(s->squares);
    s->squares = squares;
    s->square_room = room;
    s->n_squares = kept;
    s->level++;
    return KOKSMA_OK;
}

koksma_status koksma__disks_fill(koksma__disks *s, size_t n, const koksma_run *run)
{
    const koksma__kernel_table *kernels = koksma__kernels();
    koksma_status status = KOKSMA_OK;
    uint32_t word[4 * WORDS];
    while (s->n < n && s->n_squares && (uint64_t)s->cells << s->level < FINEST && !status) {
        size_t darts = s->n_squares - s->n_squares / 4;
        darts = darts < 8 ? 8 : darts;
        for (size_t i = 0; i < darts && s->n_squares && s->n < n && !status; i++, s->dart++) {
            if (i % WORDS == 0) {
                kernels->words(s->seed, KOKSMA__PURPOSE_DART, s->dart, 0, darts - i < WORDS ? darts - i : WORDS,
                               word);
            }
            if (i % WORDS + 2 * AHEAD < WORDS) {
                fetch(s, word + 4 * (i % WORDS));
            }
            status = throw(s, kernels, word + 4 * (i % WORDS));
        }
        if (!status && s->n < n) {
            status = refine(s, kernels);
        }
        if (!status && !koksma__keep_going(run, n == SIZE_MAX ? 0.5 : (double)s->n / (double)n)) {
            status = koksma__fail_interrupted();
        }
    }
    return status;
}

double koksma__disks_distance(const koksma__disks *s)
{
    double best = 2;
    for (uint32_t y = 0; y < s->cells; y++) {
        for (uint32_t x = 0; x < s->cells; x++) {
            const size_t place = place_of(s, x, y);
            if (s->gx[place] >= 1) {
                continue;
            }
            for (size_t r = 0; r < 5; r++) {
                for (size_t c = 0; c < 5; c++) {
                    const size_t other = place + r * s->stride + c - 2 * s->stride - 2;
                    const double a = s->gx[other] - s->gx[place], b = s->gy[other] - s->gy[place];
                    best = other != place && a * a + b * b < best ? a * a + b * b : best;
                }
            }
        }
    }
    return sqrt(best);
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
    for (uint32_t y = 0; y < s->cells && !status; y++) {
        for (uint32_t x = 0; x < s->cells; x++) {
            const size_t place = place_of(s, x, y), corner = place - 2 * s->stride - 2;
            s->squares[s->n_squares] = (koksma__square){x, y};
            s->n_squares +=
                s->gx[place] >= 1 && !kernels->covers(s->gx + corner, s->gy + corner, s->stride, (2 * x + 1) * half,
                                                      (2 * y + 1) * half, half, d * d);
        }
    }
    return status;
}
