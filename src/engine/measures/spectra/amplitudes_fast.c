/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Computes the power spectrum by a nonuniform fast Fourier transform of type 1 (Dutt and Rokhlin 1993; with the
 * kernel of Barnett, Magland and af Klinteberg 2019). Each point is spread over WIDTH x WIDTH cells of a grid of m x
 * m cells, where m >= 1.5 (2 half + 1) is a power of two, by the kernel exp(beta (sqrt(1 - z^2) - 1)). The Fourier
 * transform of the points is the transform of the grid divided by the transform of the kernel. All columns are
 * transformed along y first, two real columns as one complex column, then the rows with 0 <= ky <= half along x.
 */
#include "measures/spectra/spectra.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/platform/system.h"
#include "core/status.h"
#include "kernels/kernels.h"

enum { WIDTH = 14, LANES = 16, NODES = 48 };

typedef struct job {
    size_t m, n_points;
    int half;
    double *grid; /* [y][x] */
    double *twiddles;
    double *re, *im;     /* real and imaginary parts after the transform along y, row by row for ky = 0 .. half */
    double *corrections; /* 1 / (Fourier transform of the kernel at frequency |k|) */
    double *power;
} job;

static double beta(const job *j)
{
    const double over = (double)j->m / (2 * j->half + 1);
    return 0.98 * M_PI * WIDTH * (1 - 1 / (2 * over));
}

/* Computes the kernel's transform by the midpoint rule in the angle, which converges geometrically. */
static void find_corrections(job *j)
{
    const double b = beta(j);
    double z[NODES], height[NODES], slope[NODES];
    for (int i = 0; i < NODES; i++) {
        koksma__cos_sin(M_PI * (i + 0.5) / NODES, &z[i], &slope[i]);
        height[i] = koksma__exp(b * (slope[i] - 1));
    }
    for (int k = 0; k <= j->half; k++) {
        double sum = 0;
        for (int i = 0; i < NODES; i++) {
            double cosine, sine;
            koksma__cos_sin(M_PI * WIDTH * k * z[i] / (double)j->m, &cosine, &sine);
            sum += height[i] * cosine * slope[i];
        }
        j->corrections[k] = 1 / (sum * M_PI / NODES * WIDTH / 2);
    }
}

static void spread(job *j, const double *point)
{
    const double b = beta(j), m = (double)j->m;
    double weights[2][WIDTH];
    size_t first[2];
    for (int k = 0; k < 2; k++) {
        const double at = point[k] * m, start = ceil(at - WIDTH / 2.0);
        first[k] = (size_t)(start + m) & (j->m - 1);
        for (int i = 0; i < WIDTH; i++) {
            const double z = (start + i - at) * (2.0 / WIDTH), inside = (1 - z) * (1 + z);
            weights[k][i] = inside > 0 ? koksma__exp(b * (sqrt(inside) - 1)) : 0;
        }
    }
    for (size_t y = 0; y < WIDTH; y++) {
        double *row = j->grid + ((first[1] + y) & (j->m - 1)) * j->m;
        if (first[0] + WIDTH <= j->m) { /* in vectors */
            for (size_t x = 0; x < WIDTH; x++) {
                row[first[0] + x] += weights[1][y] * weights[0][x];
            }
        } else {
            for (size_t x = 0; x < WIDTH; x++) {
                row[(first[0] + x) & (j->m - 1)] += weights[1][y] * weights[0][x];
            }
        }
    }
}

/* Transforms 32 columns along y: 16 of them as real parts, the next 16 as imaginary parts. */
static koksma_status transform_columns(void *context, size_t block)
{
    job *j = context;
    const size_t m = j->m, room = LANES * m;
    double *memory = koksma__aligned(4 * room * sizeof *memory); /* aligned so that no vector crosses a cache line
                                                                      */
    KOKSMA__REQUIRE_MEMORY(memory, 4 * room * sizeof *memory);
    double *re = memory, *im = re + room;
    for (size_t y = 0; y < m; y++) {
        memcpy(re + LANES * y, j->grid + y * m + 2 * LANES * block, LANES * sizeof *re);
        memcpy(im + LANES * y, j->grid + y * m + 2 * LANES * block + LANES, LANES * sizeof *im);
    }
    if (koksma__kernels()->fourier16(m, j->twiddles, re, im, re + 2 * room, im + 2 * room)) {
        re += 2 * room;
        im += 2 * room;
    }
    for (size_t k = 0; k <= (size_t)j->half; k++) {
        const double *x = re + LANES * k, *y = im + LANES * k;
        const double *other_x = re + LANES * ((m - k) & (m - 1)), *other_y = im + LANES * ((m - k) & (m - 1));
        double *to_re = j->re + k * m + 2 * LANES * block, *to_im = j->im + k * m + 2 * LANES * block;
        for (size_t l = 0; l < LANES;
             l++) { /* separate the transforms of the two real columns: (Z(k) + conj Z(-k))/2 and (Z(k) - conj
                       Z(-k))/2i */
            to_re[l] = (x[l] + other_x[l]) / 2;
            to_im[l] = (y[l] - other_y[l]) / 2;
            to_re[LANES + l] = (y[l] + other_y[l]) / 2;
            to_im[LANES + l] = (other_x[l] - x[l]) / 2;
        }
    }
    koksma__aligned_free(memory);
    return KOKSMA_OK;
}

static koksma_status transform_rows(void *context, size_t block)
{
    job *j = context;
    const size_t m = j->m, room = LANES * m;
    double *memory = koksma__aligned(4 * room * sizeof *memory);
    KOKSMA__REQUIRE_MEMORY(memory, 4 * room * sizeof *memory);
    double *re = memory, *im = re + room;
    const size_t first = LANES * block, left = (size_t)j->half + 1 - first, count = left < LANES ? left : LANES;
    if (count < LANES) {
        memset(memory, 0, 2 * room * sizeof *memory);
    }
    for (size_t l = 0; l < count; l++) {
        for (size_t x = 0; x < m; x++) {
            re[LANES * x + l] = j->re[(first + l) * m + x];
            im[LANES * x + l] = j->im[(first + l) * m + x];
        }
    }
    if (koksma__kernels()->fourier16(m, j->twiddles, re, im, re + 2 * room, im + 2 * room)) {
        re += 2 * room;
        im += 2 * room;
    }
    const int side = 2 * j->half + 1;
    for (size_t l = 0; l < count; l++) {
        double *row = j->power + (first + l) * (size_t)side + (size_t)j->half;
        for (int k = -j->half; k <= j->half; k++) {
            const size_t at = LANES * ((size_t)(k + (int)m) & (m - 1)) + l;
            const double scale = j->corrections[abs(k)] * j->corrections[first + l];
            row[k] = (re[at] * re[at] + im[at] * im[at]) * scale * scale / (double)j->n_points;
        }
    }
    koksma__aligned_free(memory);
    return KOKSMA_OK;
}

koksma_status koksma__power_fast(const koksma_points *points, int half, const koksma_run *run, double *power)
{
    job j = {.m = 2 * LANES, .n_points = points->n, .half = half, .power = power};
    while (2 * j.m < 3 * (2 * (size_t)half + 1)) {
        j.m *= 2;
    }
    const size_t rows = (size_t)half + 1, doubles = j.m * j.m + 2 * rows * j.m + 2 * j.m + rows;
    j.grid = calloc(doubles, sizeof(double));
    KOKSMA__REQUIRE_MEMORY(j.grid, doubles * sizeof(double));
    j.re = j.grid + j.m * j.m;
    j.im = j.re + rows * j.m;
    j.twiddles = j.im + rows * j.m;
    j.corrections = j.twiddles + 2 * j.m;
    for (size_t p = 0; p < j.m; p++) {
        koksma__cos_sin(2 * M_PI * (double)p / (double)j.m, &j.twiddles[2 * p], &j.twiddles[2 * p + 1]);
    }
    find_corrections(&j);
    koksma__phases phases = {.share = 0};
    koksma_run phase = koksma__phase_run(&phases, run, 0.5);
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < points->n; i++) {
        spread(&j, points->xs + i * (size_t)points->dim);
        status = koksma__look(&phase, i, (double)i / (double)points->n);
    }
    phase = koksma__phase_run(&phases, run, 0.25);
    status = status ? status : koksma__parallel(&phase, j.m / (2 * LANES), transform_columns, &j);
    phase = koksma__phase_run(&phases, run, 0.25);
    status = status ? status : koksma__parallel(&phase, (rows + LANES - 1) / LANES, transform_rows, &j);
    free(j.grid);
    return status;
}
