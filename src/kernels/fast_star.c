/* SPDX-License-Identifier: Apache-2.0 */
/* The sweep of the star discrepancy: the counts after an insertion serve the excess at this x and the deficit at the
   next. Maxima are kept in lanes; a maximum is the same in any order. */
#include <math.h>

#include "kernels/kernels.h"

enum { LANES = 16 };

void KERNEL_NAME(star_sweep)(size_t n, const double *x, const uint32_t *rank, const double *y, double *count,
                             double best[2], size_t at[2]);
void KERNEL_NAME(star_extremes)(size_t na, const double *const a[2], size_t nb, const double *const b[2],
                                double *const out[2]);
void KERNEL_NAME(star_pairs)(size_t na, const double *const a[2], size_t nb, const double *const b[2], double n,
                             double inside, double best[2]);

typedef struct step {
    double here, next; /* n x of this point and of the next */
    double best[2];
} step;

/* Excess of ranks 0 .. n-1 and deficit of ranks 0 .. n. */
static void maxima(size_t n, const double *restrict y, const double *restrict count, step *s)
{
    double excess[LANES], deficit[LANES];
    for (int l = 0; l < LANES; l++) {
        excess[l] = deficit[l] = -INFINITY;
    }
    size_t j = 0;
    for (; j + LANES <= n; j += LANES) {
        for (int l = 0; l < LANES; l++) {
            const double e = count[j + 1 + (size_t)l] - s->here * y[j + (size_t)l];
            const double d = s->next * y[j + (size_t)l] - count[j + (size_t)l];
            excess[l] = e > excess[l] ? e : excess[l];
            deficit[l] = d > deficit[l] ? d : deficit[l];
        }
    }
    for (; j <= n; j++) {
        const double e = j < n ? count[j + 1] - s->here * y[j] : -(double)INFINITY, d = s->next * y[j] - count[j];
        excess[0] = e > excess[0] ? e : excess[0];
        deficit[0] = d > deficit[0] ? d : deficit[0];
    }
    s->best[0] = s->best[1] = -INFINITY;
    for (int l = 0; l < LANES; l++) {
        s->best[0] = excess[l] > s->best[0] ? excess[l] : s->best[0];
        s->best[1] = deficit[l] > s->best[1] ? deficit[l] : s->best[1];
    }
}

void KERNEL_NAME(star_sweep)(size_t n, const double *x, const uint32_t *rank, const double *y, double *count,
                             double best[2], size_t at[2])
{
    const double scale = (double)n;
    for (size_t j = 0; j <= n; j++) {
        count[j] = 0;
    }
    at[0] = at[1] = 0;
    best[0] = -INFINITY;
    best[1] = scale * x[0]; /* nothing before the first point: the whole height */
    for (size_t i = 0; i < n; i++) {
        step s = {.here = scale * x[i], .next = scale * (i + 1 < n ? x[i + 1] : 1)};
        for (size_t j = (size_t)rank[i] + 1; j <= n; j++) {
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

void KERNEL_NAME(star_extremes)(size_t na, const double *const a[2], size_t nb, const double *const b[2],
                                double *const out[2])
{
    const double *restrict high = b[0], *restrict low = b[1];
    for (size_t c = 0; c < na + nb - 1; c++) {
        out[0][c] = 0;
        out[1][c] = 1;
    }
    for (size_t i = 0; i < na; i++) {
        const double h = a[0][i], l = a[1][i];
        double *restrict most = out[0] + i, *restrict least = out[1] + i;
        for (size_t j = 0; j < nb; j++) {
            const double p = h * high[j], q = l * low[j];
            most[j] = p > most[j] ? p : most[j];
            least[j] = q < least[j] ? q : least[j];
        }
    }
}

void KERNEL_NAME(star_pairs)(size_t na, const double *const a[2], size_t nb, const double *const b[2], double n,
                             double inside, double best[2])
{
    enum { WIDTH = 8 };
    const double *restrict high = b[0], *restrict low = b[1];
    double deficit[WIDTH], excess[WIDTH], shares[WIDTH];
    for (int l = 0; l < WIDTH; l++) {
        deficit[l] = excess[l] = -1;
        shares[l] = (double)l / n;
    }
    for (size_t i = 0; i < na; i++) {
        const double h = a[0][i], q = a[1][i];
        size_t j = 0;
        for (; j + WIDTH <= nb; j += WIDTH) {
            const double share = (inside + (double)(i + j)) / n;
            for (int l = 0; l < WIDTH; l++) {
                const double here = share + shares[l];
                const double d = h * high[j + (size_t)l] - here, e = here - q * low[j + (size_t)l];
                deficit[l] = d > deficit[l] ? d : deficit[l];
                excess[l] = e > excess[l] ? e : excess[l];
            }
        }
        for (; j < nb; j++) {
            const double here = (inside + (double)(i + j)) / n;
            const double d = h * high[j] - here, e = here - q * low[j];
            deficit[0] = d > deficit[0] ? d : deficit[0];
            excess[0] = e > excess[0] ? e : excess[0];
        }
    }
    best[0] = best[1] = -1;
    for (int l = 0; l < WIDTH; l++) {
        best[0] = deficit[l] > best[0] ? deficit[l] : best[0];
        best[1] = excess[l] > best[1] ? excess[l] : best[1];
    }
}
