/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Computes the power of a picture at its Fourier frequencies: transforms first all rows, then those columns that are
 * not mirrors of others (the values are real). The kernel fourier16 transforms lines whose length is a power of two,
 * 16 at a time; core/dft.c transforms other lines one by one. This takes O(n log n) for n pixels, whatever the width
 * and the height, and memory of 16 bytes for each frequency and for about 64 lines.
 */
#include "image/fourier.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/dft.h"
#include "core/elementary.h"
#include "core/status.h"
#include "kernels/kernels.h"

enum { LANES = 16 };

/* Transforms of length n, LANES of them side by side: number k of line l is at index LANES k + l. */
typedef struct lines {
    size_t n;
    bool power_of_two;
    koksma__fourier fourier; /* for lengths that are not powers of two */
    koksma__dft dft;
    double *twiddles; /* for powers of two: cos and sin of 2 pi p / n */
    double *work;     /* real and imaginary parts of the lines, and scratch of the same size */
    double *re, *im;  /* where the real and the imaginary parts of the lines are now, within work */
} lines;

static void close_lines(lines *l)
{
    koksma__dft_fini(&l->dft);
    koksma__fourier_fini(&l->fourier);
    free(l->twiddles);
}

static koksma_status open_lines(size_t n, lines *l)
{
    *l = (lines){.n = n, .power_of_two = (n & (n - 1)) == 0};
    const size_t doubles = 2 * n + 4 * LANES * n;
    l->twiddles = malloc(doubles * sizeof *l->twiddles);
    KOKSMA__REQUIRE_MEMORY(l->twiddles, doubles * sizeof *l->twiddles);
    l->work = l->twiddles + 2 * n;
    for (size_t k = 0; k < n; k++) {
        const double angle = 2 * M_PI * (double)k / (double)n;
        l->twiddles[2 * k] = koksma__cos(angle);
        l->twiddles[2 * k + 1] = koksma__sin(angle);
    }
    const size_t padded = koksma__dft_padded(n);
    koksma_status status = l->power_of_two ? KOKSMA_OK : koksma__fourier_init(&l->fourier, padded ? padded : 1);
    return status || l->power_of_two ? status : koksma__dft_init(&l->dft, &l->fourier, n);
}

/* Transforms the first `count` of the lines in `work`; re and im then point to the results. */
static void transform(lines *l, size_t count)
{
    const size_t size = LANES * l->n;
    double *spare = l->work + 2 * size;
    l->re = l->work;
    l->im = l->work + size;
    if (!l->power_of_two) {
        for (size_t i = 0; i < count; i++) { /* uses less than 4 n of the LANES n numbers of each half of `spare` */
            koksma__dft_transform(&l->dft, &l->fourier, LANES, l->re + i, l->im + i, spare, spare + size);
        }
    } else if (koksma__kernels()->fourier16(l->n, l->twiddles, l->re, l->im, spare, spare + size)) {
        l->re = spare;
        l->im = spare + size;
    }
}

/* Transforms the rows: entry u of row y is at rows[2 (y * columns + u)] (real part) and at the next number (imaginary
   part). */
static void transform_rows(lines *l, size_t width, size_t height, const double *values, double *rows)
{
    const size_t columns = width / 2 + 1;
    for (size_t first = 0; first < height; first += LANES) {
        const size_t count = height - first < LANES ? height - first : LANES;
        memset(l->work, 0, 2 * LANES * l->n * sizeof *l->work);
        for (size_t i = 0; i < count; i++) {
            for (size_t x = 0; x < width; x++) {
                l->work[LANES * x + i] = values[(first + i) * width + x];
            }
        }
        transform(l, count);
        for (size_t i = 0; i < count; i++) {
            for (size_t u = 0; u < columns; u++) {
                double *to = rows + 2 * ((first + i) * columns + u);
                to[0] = l->re[LANES * u + i];
                to[1] = l->im[LANES * u + i];
            }
        }
    }
}

/* Transforms the columns in place. */
static void transform_columns(lines *l, size_t columns, size_t height, double *rows)
{
    for (size_t first = 0; first < columns; first += LANES) {
        const size_t count = columns - first < LANES ? columns - first : LANES;
        memset(l->work, 0, 2 * LANES * l->n * sizeof *l->work);
        for (size_t y = 0; y < height; y++) {
            for (size_t i = 0; i < count; i++) {
                const double *from = rows + 2 * (y * columns + first + i);
                l->work[LANES * y + i] = from[0];
                l->work[LANES * (l->n + y) + i] = from[1];
            }
        }
        transform(l, count);
        for (size_t v = 0; v < height; v++) {
            for (size_t i = 0; i < count; i++) {
                double *to = rows + 2 * (v * columns + first + i);
                to[0] = l->re[LANES * v + i];
                to[1] = l->im[LANES * v + i];
            }
        }
    }
}

koksma_status koksma__fourier_transform(int width, int height, const double *values, double *complex)
{
    lines along_x = {0}, along_y = {0};
    koksma_status status = open_lines((size_t)width, &along_x);
    if (!status) {
        transform_rows(&along_x, (size_t)width, (size_t)height, values, complex);
    }
    close_lines(&along_x);
    status = status ? status : open_lines((size_t)height, &along_y);
    if (!status) {
        transform_columns(&along_y, koksma__fourier_columns(width), (size_t)height, complex);
    }
    close_lines(&along_y);
    return status;
}

koksma_status koksma__fourier_power(int width, int height, const double *values, double *power)
{
    const size_t frequencies = koksma__fourier_columns(width) * (size_t)height;
    double *complex = malloc(2 * frequencies * sizeof *complex);
    koksma_status status = complex ? KOKSMA_OK : koksma__fail_memory(2 * frequencies * sizeof *complex);
    status = status ? status : koksma__fourier_transform(width, height, values, complex);
    for (size_t i = 0; i < frequencies && !status; i++) {
        power[i] = complex[2 * i] * complex[2 * i] + complex[2 * i + 1] * complex[2 * i + 1];
    }
    free(complex);
    return status;
}
