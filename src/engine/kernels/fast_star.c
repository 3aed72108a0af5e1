/* SPDX-License-Identifier: Apache-2.0 */
/* Kernels of two algorithms for the star discrepancy. The sweep of the plane uses the counts after each insertion of
   a point twice: for the excess at this x and for the deficit at the next x. Each lane has its own maximum, because a
   maximum does not depend on the order of the numbers. The steps of the partition are convolutions in which maxima or
   minima replace the sums. Each vector of results stays in registers while one list slides along the other. */
#include <math.h>
#include <string.h>

#include "kernels/kernels.h"
#include "kernels/lanes64.h"

typedef struct step {
    double here, next; /* n times the x coordinate of this point and of the next one */
    double best[2];
} step;

/* Computes the largest excess over ranks 0 .. n-1 and the largest deficit over ranks 0 .. n. The last vector reads
   past the end, where y is 1. Boxes of this height have the deficit of rank n, and at most the excess of rank n-1, so
   that they change no result. */
static void maxima(size_t n, const double *y, const double *count, step *s)
{
    lanes64_d excess = lanes64_splat_d(-INFINITY), deficit = excess;
    for (size_t j = 0; j <= n; j += LANES64) {
        const lanes64_d height = lanes64_load_d(y + j);
        excess = lanes64_max(lanes64_load_d(count + j + 1) - s->here * height, excess);
        deficit = lanes64_max(s->next * height - lanes64_load_d(count + j), deficit);
    }
    s->best[0] = lanes64_largest(excess);
    s->best[1] = lanes64_largest(deficit);
}

void KERNEL_NAME(star_sweep)(size_t n, const double *x, const uint32_t *rank, const double *y, double *count,
                             double best[2], size_t at[2])
{
    const double scale = (double)n;
    for (size_t j = 0; j <= n + 8; j++) {
        count[j] = 0;
    }
    at[0] = at[1] = 0;
    best[0] = -INFINITY;
    best[1] = scale * x[0]; /* start with the empty box of full height to the left of the first point */
    for (size_t i = 0; i < n; i++) {
        step s = {.here = scale * x[i], .next = scale * (i + 1 < n ? x[i + 1] : 1)};
        for (size_t j = (size_t)rank[i] + 1; j <= n + 8; j++) {
            count[j] += 1;
        }
        maxima(n, y, count, &s);
        if (s.best[0] > best[0]) {
            best[0] = s.best[0];
            at[0] = i;
        }
        if (s.best[1] > best[1]) {
            best[1] = s.best[1];
            at[1] = i + 1;
        }
    }
}

enum { WIDTH = 8, VECTORS = WIDTH / LANES64, ROOM = 256 };

/* longs: up to ROOM numbers of the longer list, padded at both ends with WIDTH numbers that change no result: 0 when
   the largest product is wanted, infinity for the smallest (0 times infinity is NaN, which is not below any number).
   shorts: the shorter list, not copied. */
typedef struct convolution {
    bool smallest;
    size_t n_short, n_long, first, count;
    const double *shorts, *all_longs;
    double longs[ROOM + 2 * WIDTH];
} convolution;

static inline void begin(convolution *s, size_t na, const double *a, size_t nb, const double *b, bool smallest)
{
    s->smallest = smallest;
    s->n_short = na > nb ? nb : na;
    s->n_long = na > nb ? na : nb;
    s->shorts = na > nb ? b : a;
    s->all_longs = na > nb ? a : b;
}

/* Updates the extremes of the products short[i] long[j] with i + j = c .. c + WIDTH - 1. */
static inline void extremes(const convolution *s, size_t c, lanes64_d best[VECTORS])
{
    const size_t past = s->first + s->count, begin = c >= past ? c - past + 1 : 0;
    const size_t end = c + WIDTH - s->first < s->n_short ? c + WIDTH - s->first : s->n_short;
    for (size_t i = begin; i < end; i++) {
        const size_t j = c + WIDTH - i - s->first;
        for (size_t v = 0; v < VECTORS; v++) {
            const lanes64_d product = s->shorts[i] * lanes64_load_d(s->longs + j + v * LANES64);
            best[v] = s->smallest ? lanes64_min(product, best[v]) : lanes64_max(product, best[v]);
        }
    }
}

/* Copies the chunk of the longer list that begins at `first`. Returns 1 + the largest sum of indices i + j of this
   chunk. */
static inline size_t take_chunk(convolution *s, size_t first)
{
    s->first = first;
    s->count = s->n_long - first < ROOM ? s->n_long - first : ROOM;
    for (int l = 0; l < WIDTH; l++) {
        s->longs[l] = s->longs[WIDTH + s->count + (size_t)l] = s->smallest ? INFINITY : 0;
    }
    memcpy(s->longs + WIDTH, s->all_longs + first, s->count * sizeof(double));
    return first + s->count + s->n_short - 1;
}

static inline void all_extremes(size_t na, const double *a, size_t nb, const double *b, bool smallest, double *out)
{
    convolution s; /* without an initialiser, which would clear all of it */
    begin(&s, na, a, nb, b, smallest);
    for (size_t c = 0; c < na + nb - 1 + WIDTH; c++) {
        out[c] = smallest;
    }
    for (size_t first = 0; first < s.n_long; first += ROOM) {
        const size_t end = take_chunk(&s, first);
        for (size_t c = first; c < end; c += WIDTH) {
            lanes64_d best[VECTORS];
            memcpy(best, out + c, sizeof best);
            extremes(&s, c, best);
            memcpy(out + c, best, sizeof best);
        }
    }
}

/* All pairs with the same i + j subtract the same share of points. Because rounding is monotonic, it is enough to
   subtract this share from the extreme products. */
static inline double all_pairs(size_t na, const double *a, size_t nb, const double *b, bool smallest, double n,
                               double inside)
{
    convolution s;
    begin(&s, na, a, nb, b, smallest);
    const lanes64_d none = lanes64_splat_d(-1);
    lanes64_d most = none;
    for (size_t first = 0; first < s.n_long; first += ROOM) {
        const size_t end = take_chunk(&s, first);
        for (size_t c = first; c < end; c += WIDTH) {
            lanes64_d best[VECTORS];
            for (int v = 0; v < VECTORS; v++) {
                best[v] = lanes64_splat_d(smallest);
            }
            extremes(&s, c, best);
            for (size_t v = 0; v < VECTORS; v++) {
                const lanes64_u sum = lanes64_count() + (c + v * LANES64);
                const lanes64_d share = (inside + lanes64_whole(sum)) / n;
                most = lanes64_max(
                    lanes64_chosen((lanes64_i)(sum < end), smallest ? share - best[v] : best[v] - share, none), most);
            }
        }
    }
    return lanes64_largest(most);
}

void KERNEL_NAME(star_extremes)(size_t na, const double *a, size_t nb, const double *b, bool smallest, double *out)
{
    smallest ? all_extremes(na, a, nb, b, true, out) : all_extremes(na, a, nb, b, false, out);
}

double KERNEL_NAME(star_pairs)(size_t na, const double *a, size_t nb, const double *b, bool smallest, double n,
                               double inside)
{
    return smallest ? all_pairs(na, a, nb, b, true, n, inside) : all_pairs(na, a, nb, b, false, n, inside);
}
