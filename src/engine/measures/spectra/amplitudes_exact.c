/* SPDX-License-Identifier: Apache-2.0 */
/* Computes the power spectrum by direct sums. The factor exp(-2 pi i k.x) is a product over the coordinates: with C,
   S the cosine and sine of 2 pi kx x, and c, s the cosine and sine of 2 pi ky y, the sums over the points of Cc, Cs,
   Sc and Ss give the power at (kx, ky) and at (-kx, ky). These sums for all frequencies are one matrix product,
   computed in tiles of 8 x 16 numbers. Rows 2k and 2k+1 of the product belong to the cosine and the sine of 2 pi k x,
   columns 2k and 2k+1 to those of 2 pi k y. The factor for the columns is computed for one chunk of the points at a
   time and used for a band of rows, so that memory does not grow with the number of points. */
#include "measures/spectra/spectra.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "kernels/kernels.h"

enum { ROWS = 8, COLUMNS = 16, GROUP = 8, POINTS_PER_PANEL = 128, BLOCKS_PER_BAND = 32, CHUNK_NUMBERS = 1 << 22 };

typedef struct job {
    const koksma_points *points;
    int half;
    size_t n_columns;              /* counted in tiles */
    size_t room, from, count;      /* capacity of a chunk in points; first point and size of this chunk */
    size_t first_block;            /* index of the first block of rows in this band */
    double *y_panels;              /* for each tile of columns: 16 numbers for each point of the chunk */
    double (*sums)[ROWS][COLUMNS]; /* one tile of sums for each tile of rows in the band and each tile of columns */
    double *power;
    const koksma_run *run;
    double done, share; /* fraction of all work that was done before this step; fraction that this step makes up */
} job;

static bool keep_going(void *context, double fraction)
{
    const job *j = context;
    return koksma__keep_going(j->run, j->done + j->share * fraction);
}

/* Writes for each point from + j, j < count, and each r < width the number out[width j + r]: the cosine (even r) or
   sine (odd r) of 2 pi f x, where x is coordinate k of the point and f = first/2 + r/2, in integer division. */
static void fill_panel(const koksma_points *p, int k, size_t first, int width, size_t from, size_t count, double *out)
{
    for (size_t j = 0; j < count; j++) {
        const double x = p->xs[(from + j) * (size_t)p->dim + (size_t)k], turn = 2 * M_PI * x;
        const double start = fmod((double)(first / 2) * x, 1) * 2 * M_PI;
        double c, s, dc, ds;
        koksma__cos_sin(start, &c, &s);
        koksma__cos_sin(turn, &dc, &ds);
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

static koksma_status fill_columns(void *context, size_t column)
{
    const job *j = context;
    fill_panel(j->points, 1, column * COLUMNS, COLUMNS, j->from, j->count, j->y_panels + column * j->room * COLUMNS);
    return KOKSMA_OK;
}

/* Adds the sums of the chunk for one block, which consists of GROUP tiles of rows and all columns. A panel of columns
   stays in the cache while it is used for all rows of the block. */
static koksma_status row_block(void *context, size_t block)
{
    const job *j = context;
    const size_t columns = j->n_columns, panel = ROWS * POINTS_PER_PANEL, bytes = GROUP * panel * sizeof(double);
    const size_t first_row = (j->first_block + block) * GROUP * ROWS;
    double(*sums)[ROWS][COLUMNS] = j->sums + block * GROUP * columns;
    double *x_panels = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(x_panels, bytes);
    for (size_t at = 0; at < j->count; at += POINTS_PER_PANEL) {
        const size_t points = j->count - at < POINTS_PER_PANEL ? j->count - at : POINTS_PER_PANEL;
        for (size_t g = 0; g < GROUP; g++) {
            fill_panel(j->points, 0, first_row + g * ROWS, ROWS, j->from + at, points, x_panels + g * panel);
        }
        for (size_t c = 0; c < columns; c++) {
            for (size_t g = 0; g < GROUP; g++) {
                koksma__kernels()->outer_sums(points, x_panels + g * panel,
                                              j->y_panels + (c * j->room + at) * COLUMNS, sums[g * columns + c]);
            }
        }
    }
    free(x_panels);
    for (size_t g = 0; g < GROUP && j->from + j->count == j->points->n; g++) {
        for (size_t c = 0; c < columns; c++) {
            put_tile(j, first_row + g * ROWS, c * COLUMNS, sums[g * columns + c]);
        }
    }
    return KOKSMA_OK;
}

/* Computes the sums over all chunks of points for the blocks of a band. steps: the number of chunks in all bands, for
   the progress report. */
static koksma_status add_band(job *j, size_t n_blocks, double steps)
{
    const size_t n = j->points->n;
    koksma_run run = j->run ? *j->run : (koksma_run){0};
    run.keep_going = keep_going;
    run.context = j;
    memset(j->sums, 0, n_blocks * GROUP * j->n_columns * sizeof *j->sums);
    koksma_status status = KOKSMA_OK;
    for (j->from = 0; j->from < n && !status; j->from += j->room) {
        j->count = n - j->from < j->room ? n - j->from : j->room;
        j->share = 0;
        status = koksma__parallel(&run, j->n_columns, fill_columns, j);
        j->share = 1 / steps;
        status = status ? status : koksma__parallel(&run, n_blocks, row_block, j);
        j->done += j->share;
    }
    return status;
}

koksma_status koksma__power_exact(const koksma_points *points, int half, const koksma_run *run, double *power)
{
    const size_t n = points->n, rows = 2 * ((size_t)half + 1), n_blocks = (rows + GROUP * ROWS - 1) / (GROUP * ROWS);
    job j = {.points = points, .half = half, .n_columns = (rows + COLUMNS - 1) / COLUMNS, .power = power, .run = run};
    const size_t wide = j.n_columns * COLUMNS, panels = CHUNK_NUMBERS / wide / POINTS_PER_PANEL;
    j.room = (panels > 0 ? panels : 1) * POINTS_PER_PANEL;
    j.room = j.room < n ? j.room : n;
    const size_t band = n_blocks < BLOCKS_PER_BAND ? n_blocks : BLOCKS_PER_BAND;
    const size_t bytes = (wide * j.room + band * GROUP * ROWS * wide) * sizeof(double);
    j.y_panels = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(j.y_panels, bytes);
    j.sums = (double(*)[ROWS][COLUMNS])(j.y_panels + wide * j.room);
    const size_t chunks = (n + j.room - 1) / j.room, bands = (n_blocks + band - 1) / band;
    koksma_status status = KOKSMA_OK;
    for (; j.first_block < n_blocks && !status; j.first_block += band) {
        const size_t left = n_blocks - j.first_block;
        status = add_band(&j, left < band ? left : band, (double)(bands * chunks));
    }
    free(j.y_panels);
    return status;
}
