/* SPDX-License-Identifier: Apache-2.0 */
/* exp(-2 pi i k.x) is a product over the coordinates: with C, S the cosine and sine of 2 pi kx x and c, s those of
   2 pi ky y, the four sums over points of Cc, Cs, Sc and Ss serve kx and -kx. They are one matrix product, done in
   tiles of 8 x 16 numbers: rows 2k, 2k+1 are the cosine and the sine at frequency k. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "measures/parts/amplitudes.h"

enum { ROWS = 8, COLUMNS = 16, GROUP = 8, POINTS_PER_PANEL = 128 };

typedef struct job {
    const koksma_points *points;
    int half;
    double *y_panels; /* by tile of columns and panel of points: [j][16] */
    size_t n_columns; /* tiles */
    double *power;
} job;

/* out[width j + r] for r < width: cosine and sine at frequencies first/2 + r/2 of points from .. from + count - 1. */
static void fill_panel(const koksma_points *p, int k, size_t first, int width, size_t from, size_t count, double *out)
{
    for (size_t j = 0; j < count; j++) {
        const double x = p->xs[(from + j) * (size_t)p->dim + (size_t)k], turn = 2 * M_PI * x;
        const double start = fmod((double)(first / 2) * x, 1) * 2 * M_PI;
        double c = cos(start), s = sin(start);
        const double dc = cos(turn), ds = sin(turn);
        for (int r = 0; r < width; r += 2) {
            out[(size_t)width * j + (size_t)r] = c;
            out[(size_t)width * j + (size_t)r + 1] = s;
            const double next = c * dc - s * ds;
            s = c * ds + s * dc;
            c = next;
        }
    }
}

static void put_tile(const job *j, size_t row, size_t column, double sums[ROWS][COLUMNS])
{
    const double n = (double)j->points->n;
    const int side = 2 * j->half + 1;
    for (int r = 0; r < ROWS; r += 2) {
        for (int c = 0; c < COLUMNS; c += 2) {
            const int kx = (int)row / 2 + r / 2, ky = (int)column / 2 + c / 2;
            if (kx <= j->half && ky <= j->half) {
                const double cc = sums[r][c], cs = sums[r][c + 1], sc = sums[r + 1][c], ss = sums[r + 1][c + 1];
                double *at = j->power + (size_t)ky * (size_t)side + (size_t)j->half;
                at[kx] = ((cc - ss) * (cc - ss) + (cs + sc) * (cs + sc)) / n;
                at[-kx] = ((cc + ss) * (cc + ss) + (cs - sc) * (cs - sc)) / n;
            }
        }
    }
}

/* Block: GROUP tiles of rows times all columns; a panel of columns in the cache serves all rows. */
static koksma_status row_block(void *context, size_t block)
{
    const job *j = context;
    const size_t n = j->points->n, columns = j->n_columns;
    const size_t panel = ROWS * POINTS_PER_PANEL, count = GROUP * (columns * ROWS * COLUMNS + panel);
    double *memory = calloc(count, sizeof *memory);
    if (!memory) {
        return koksma__fail_memory(count * sizeof *memory);
    }
    double(*sums)[ROWS][COLUMNS] = (double(*)[ROWS][COLUMNS])memory;
    double *x_panels = memory + GROUP * columns * ROWS * COLUMNS;
    for (size_t from = 0; from < n; from += POINTS_PER_PANEL) {
        const size_t points = n - from < POINTS_PER_PANEL ? n - from : POINTS_PER_PANEL;
        for (size_t g = 0; g < GROUP; g++) {
            fill_panel(j->points, 0, (block * GROUP + g) * ROWS, ROWS, from, points, x_panels + g * panel);
        }
        for (size_t c = 0; c < columns; c++) {
            for (size_t g = 0; g < GROUP; g++) {
                koksma__kernels()->outer_sums(points, x_panels + g * panel, j->y_panels + (c * n + from) * COLUMNS,
                                              sums[g * columns + c]);
            }
        }
    }
    for (size_t g = 0; g < GROUP; g++) {
        for (size_t c = 0; c < columns; c++) {
            put_tile(j, (block * GROUP + g) * ROWS, c * COLUMNS, sums[g * columns + c]);
        }
    }
    free(memory);
    return KOKSMA_OK;
}

koksma_status koksma__power_exact(const koksma_points *points, int half, const koksma_run *run, double *power)
{
    const size_t rows = 2 * ((size_t)half + 1);
    job j = {.points = points, .half = half, .n_columns = (rows + COLUMNS - 1) / COLUMNS, .power = power};
    const size_t wide = j.n_columns * COLUMNS, bytes = points->n * sizeof(double);
    j.y_panels = calloc(wide, bytes); /* which looks whether the product is a size */
    if (!j.y_panels) {
        return koksma__fail(KOKSMA_MEMORY, "out of memory: %zu times %zu bytes could not be had", wide, bytes);
    }
    for (size_t c = 0; c < j.n_columns; c++) {
        fill_panel(points, 1, c * COLUMNS, COLUMNS, 0, points->n, j.y_panels + c * points->n * COLUMNS);
    }
    const koksma_status status = koksma__parallel(run, (rows + GROUP * ROWS - 1) / (GROUP * ROWS), row_block, &j);
    free(j.y_panels);
    return status;
}
