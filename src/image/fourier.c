/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The power of a picture at its Fourier frequencies: first all rows, then those columns that are not mirrors of
 * others (the values are real), 16 lines at a time by the kernel fourier16, whose lengths are powers of two. Other
 * lengths n go by Bluestein's chirp (1970): with k j = (k^2 + j^2 - (k - j)^2) / 2,
 *
 *     X(k) = c(k) sum_j [x(j) c(j)] conj c(k - j),   c(k) = exp(-pi i k^2 / n),
 *
 * a convolution, for which a power of two m >= 2 n - 1 will do. k^2 is taken modulo 2 n before it is an angle, so
 * that primes and large sides lose no digits. Memory: 16 bytes for each of the frequencies and some 64 lines.
 */
#include "image/fourier.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "kernels/kernels.h"

enum { LANES = 16 };

/* Transforms of length n. */
typedef struct lines {
    size_t n, m;
    double *twiddles;              /* cos and sin of 2 pi p / m */
    double *chirp;                 /* re and im of c(k), k < n; NULL: n is a power of two */
    double *filter_re, *filter_im; /* the transform of conj c over m */
    double *work;                  /* re, im and the spare ones of 16 lines */
    double *re, *im;               /* where the lines are: number k of line l at [16 k + l] */
} lines;

static void fill_turns(double *turns, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        const double angle = 2 * M_PI * (double)k / (double)n;
        turns[2 * k] = cos(angle);
        turns[2 * k + 1] = sin(angle);
    }
}

static void rewind_lines(lines *l)
{
    l->re = l->work;
    l->im = l->work + LANES * l->m;
}

/* The transform of length m, which leaves re and im at the result. */
static void transform_power_of_two(lines *l)
{
    const size_t size = LANES * l->m;
    double *other = l->re == l->work ? l->work + 2 * size : l->work;
    if (koksma__kernels()->fourier16(l->m, l->twiddles, l->re, l->im, other, other + size)) {
        l->re = other;
        l->im = other + size;
    }
}

/* conj c around 0, by its transform. */
static void fill_filter(lines *l)
{
    rewind_lines(l);
    memset(l->work, 0, 2 * LANES * l->m * sizeof *l->work);
    for (size_t k = 0; k < l->n; k++) {
        const size_t at[] = {LANES * k, LANES * ((l->m - k) % l->m)};
        for (int side = 0; side < 2; side++) {
            l->re[at[side]] = l->chirp[2 * k];
            l->im[at[side]] = -l->chirp[2 * k + 1];
        }
    }
    transform_power_of_two(l);
    for (size_t k = 0; k < l->m; k++) {
        l->filter_re[k] = l->re[LANES * k] / (double)l->m;
        l->filter_im[k] = l->im[LANES * k] / (double)l->m;
    }
}

static koksma_status open_lines(size_t n, lines *l)
{
    *l = (lines){.n = n, .m = 1};
    const bool power_of_two = (n & (n - 1)) == 0;
    while (l->m < (power_of_two ? n : 2 * n - 1)) {
        l->m *= 2;
    }
    const size_t chirps = power_of_two ? 0 : n, filters = power_of_two ? 0 : l->m;
    const size_t doubles = 2 * l->m + 2 * chirps + 2 * filters + 4 * LANES * l->m;
    l->twiddles = malloc(doubles * sizeof *l->twiddles);
    if (!l->twiddles) {
        return koksma__fail_memory(doubles * sizeof *l->twiddles);
    }
    l->filter_re = l->twiddles + 2 * l->m;
    l->filter_im = l->filter_re + filters;
    l->chirp = power_of_two ? NULL : l->filter_im + filters;
    l->work = l->filter_im + filters + 2 * chirps;
    fill_turns(l->twiddles, l->m);
    for (size_t k = 0, square = 0; k < chirps; k++) { /* square = k^2 modulo 2 n */
        const double angle = M_PI * (double)square / (double)n;
        l->chirp[2 * k] = cos(angle);
        l->chirp[2 * k + 1] = -sin(angle);
        square = (square + 2 * k + 1) % (2 * n);
    }
    if (l->chirp) {
        fill_filter(l);
    }
    return KOKSMA_OK;
}

static void multiply(double *re, double *im, double c, double s)
{
    for (size_t i = 0; i < LANES; i++) {
        const double x = re[i], y = im[i];
        re[i] = c * x - s * y;
        im[i] = c * y + s * x;
    }
}

/* The lines that begin at work, transformed: re and im say where. */
static void transform(lines *l)
{
    rewind_lines(l);
    if (!l->chirp) {
        transform_power_of_two(l);
        return;
    }
    for (size_t k = 0; k < l->n; k++) {
        multiply(l->re + LANES * k, l->im + LANES * k, l->chirp[2 * k], l->chirp[2 * k + 1]);
    }
    const size_t rest = LANES * (l->m - l->n) * sizeof *l->re;
    memset(l->re + LANES * l->n, 0, rest);
    memset(l->im + LANES * l->n, 0, rest);
    transform_power_of_two(l);
    for (size_t k = 0; k < l->m; k++) {
        multiply(l->re + LANES * k, l->im + LANES * k, l->filter_re[k], l->filter_im[k]);
    }
    for (size_t i = 0; i < LANES * l->m; i++) { /* the inverse is the transform between two conjugations */
        l->im[i] = -l->im[i];
    }
    transform_power_of_two(l);
    for (size_t k = 0; k < l->n; k++) {
        double *im = l->im + LANES * k;
        for (size_t i = 0; i < LANES; i++) {
            im[i] = -im[i];
        }
        multiply(l->re + LANES * k, im, l->chirp[2 * k], l->chirp[2 * k + 1]);
    }
}

/* rows[2 (y * columns + u)], [+ 1]: the transform of row y. */
static void transform_rows(lines *l, size_t width, size_t height, const double *values, double *rows)
{
    const size_t columns = width / 2 + 1;
    for (size_t first = 0; first < height; first += LANES) {
        const size_t count = height - first < LANES ? height - first : LANES;
        memset(l->work, 0, 2 * LANES * l->m * sizeof *l->work);
        for (size_t i = 0; i < count; i++) {
            for (size_t x = 0; x < width; x++) {
                l->work[LANES * x + i] = values[(first + i) * width + x];
            }
        }
        transform(l);
        for (size_t i = 0; i < count; i++) {
            for (size_t u = 0; u < columns; u++) {
                double *to = rows + 2 * ((first + i) * columns + u);
                to[0] = l->re[LANES * u + i];
                to[1] = l->im[LANES * u + i];
            }
        }
    }
}

static void transform_columns(lines *l, size_t columns, size_t height, const double *rows, double *power)
{
    for (size_t first = 0; first < columns; first += LANES) {
        const size_t count = columns - first < LANES ? columns - first : LANES;
        memset(l->work, 0, 2 * LANES * l->m * sizeof *l->work);
        for (size_t y = 0; y < height; y++) {
            for (size_t i = 0; i < count; i++) {
                const double *from = rows + 2 * (y * columns + first + i);
                l->work[LANES * y + i] = from[0];
                l->work[LANES * (l->m + y) + i] = from[1];
            }
        }
        transform(l);
        for (size_t v = 0; v < height; v++) {
            for (size_t i = 0; i < count; i++) {
                const double re = l->re[LANES * v + i], im = l->im[LANES * v + i];
                power[v * columns + first + i] = re * re + im * im;
            }
        }
    }
}

koksma_status koksma__fourier_power(int width, int height, const double *values, double *power)
{
    const size_t columns = koksma__fourier_columns(width), doubles = 2 * columns * (size_t)height;
    lines along_x = {0}, along_y = {0};
    double *rows = malloc(doubles * sizeof *rows);
    koksma_status status = rows ? KOKSMA_OK : koksma__fail_memory(doubles * sizeof *rows);
    status = status ? status : open_lines((size_t)width, &along_x);
    if (!status) {
        transform_rows(&along_x, (size_t)width, (size_t)height, values, rows);
    }
    free(along_x.twiddles);
    status = status ? status : open_lines((size_t)height, &along_y);
    if (!status) {
        transform_columns(&along_y, columns, (size_t)height, rows, power);
    }
    free(along_y.twiddles);
    free(rows);
    return status;
}
