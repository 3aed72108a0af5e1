/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sums of Gaussian forces on the torus in 3 to 6 dimensions. The standard deviation s selects one of two methods:
 *
 *   s <= 1/10   Only the nearest image of a point can be within the cut-off 5 s. Points are sorted into cells that are
 *               5 s / 2 wide, and 5^dim cells are visited; if fewer than 5 cells fit along an axis, there is only one
 *               cell.
 *
 *   s > 1/10    All images act. The sum over the images is a product over the axes of the periodic Gaussian
 *                   g(t) = sum over m of exp(-(t + m)^2 / (2 s^2)),
 *               so that the force along axis k is -s^2 g'(t_k) product over j != k of g(t_j), without a cut-off. 1,024
 *               cubic Hermite pieces from 0 to 1/2 replace g; the error of the derivative is below 1e-7 of its maximum.
 *
 * Sums run in the order of the sorted points for any number of threads. Computing all n forces takes O(n^2) with one
 * cell or with the table, else O(n).
 */
#include "patterns/spacing/spacing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/status.h"
#include "core/vector.h"

enum { PIECES = 1024 };

/* Computes the periodic Gaussian and its derivative. */
static void periodic(double t, double s, double out[2])
{
    const int images = (int)ceil(9 * s) + 1;
    out[0] = out[1] = 0;
    for (int m = -images; m <= images; m++) {
        const double x = t + m, w = koksma__exp(-x * x / (2 * s * s));
        out[0] += w;
        out[1] -= x / (s * s) * w;
    }
}

static void make_table(double s, double *table)
{
    const double h = 0.5 / PIECES;
    double here[2], next[2];
    periodic(0, s, here);
    for (int i = 0; i < PIECES; i++) {
        periodic((i + 1) * h, s, next);
        const double rise = next[0] - here[0], a = h * here[1], b = h * next[1];
        const double piece[] = {here[0], a, 3 * rise - 2 * a - b, a + b - 2 * rise};
        memcpy(table + 4 * (size_t)i, piece, sizeof piece);
        memcpy(here, next, sizeof here);
    }
}

koksma_status koksma__space_forces_init(koksma__space_forces *f, size_t n, int dim, double s)
{
    *f = (koksma__space_forces){.dim = dim, .n = n, .s = s, .side = 1};
    const bool tabled = s > 0.1;
    size_t cells = 1;
    while (!tabled && koksma__pow((double)f->side + 1, dim) <= (double)n && 2.5 * s * (double)(f->side + 1) <= 1) {
        f->side++;
    }
    f->side = f->side < 5 ? 1 : f->side;
    for (int k = 0; k < dim; k++) {
        cells *= f->side;
    }
    const size_t numbers = n * (size_t)dim + (tabled ? 4 * PIECES : 0), words = n + cells + 1;
    f->sorted = malloc(numbers * sizeof *f->sorted + words * sizeof *f->start);
    KOKSMA__REQUIRE_MEMORY(f->sorted, numbers * sizeof *f->sorted + words * sizeof *f->start);
    f->table = tabled ? f->sorted + n * (size_t)dim : NULL;
    f->order = (uint32_t *)(f->sorted + numbers);
    f->start = f->order + n;
    if (tabled) {
        make_table(s, f->table);
    }
    return KOKSMA_OK;
}

void koksma__space_forces_fini(koksma__space_forces *f)
{
    free(f->sorted);
    *f = (koksma__space_forces){0};
}

void koksma__space_forces_sort(koksma__space_forces *f, const double *xs)
{
    const size_t dim = (size_t)f->dim;
    size_t cells = 1;
    for (int k = 0; k < f->dim; k++) {
        cells *= f->side;
    }
    memset(f->start, 0, (cells + 1) * sizeof *f->start);
    for (size_t i = 0; i < f->n; i++) {
        f->start[koksma__cell_index(xs + i * dim, f->dim, f->side)]++;
    }
    for (size_t c = 0, sum = 0; c <= cells; c++) {
        sum += f->start[c];
        f->start[c] = (uint32_t)sum;
    }
    for (size_t i = f->n; i-- > 0;) { /* the loop runs backwards, so that points of a cell keep their order */
        const uint32_t at = --f->start[koksma__cell_index(xs + i * dim, f->dim, f->side)];
        memcpy(f->sorted + at * dim, xs + i * dim, dim * sizeof *xs);
        f->order[at] = (uint32_t)i;
    }
}

/* Adds the forces of the points of one cell, cut off at 5 s. */
static void add_cell(const koksma__space_forces *f, size_t cell, const double *x, double *force)
{
    const size_t dim = (size_t)f->dim;
    const double scale = -0.5 / (f->s * f->s), cut2 = 25 * f->s * f->s;
    for (size_t j = f->start[cell]; j < f->start[cell + 1]; j++) {
        const double *y = f->sorted + j * dim;
        double t[KOKSMA__FORCE_DIMS], square = 0;
        for (size_t k = 0; k < dim; k++) {
            t[k] = koksma__torus_difference(y[k], x[k]);
            square += t[k] * t[k];
        }
        if (square < cut2) { /* the point itself contributes 0 */
            const double w = koksma__exp(scale * square);
            for (size_t k = 0; k < dim; k++) {
                force[k] += t[k] * w;
            }
        }
    }
}

static void add_cells(const koksma__space_forces *f, int k, size_t row, const double *x, double *force)
{
    if (k == f->dim) {
        add_cell(f, row, x, force);
        return;
    }
    const size_t some = f->side == 1 ? 1 : 5;
    size_t cell = some == 1 ? 0 : (koksma__cell_along(x[k], f->side) + f->side - 2) % f->side;
    for (size_t c = 0; c < some; c++) {
        add_cells(f, k + 1, row * f->side + cell, x, force);
        cell = cell + 1 < f->side ? cell + 1 : 0;
    }
}

/* Adds the force of all images of the point y. */
static void add_images(const koksma__space_forces *f, const double *x, const double *y, double *force)
{
    double value[KOKSMA__FORCE_DIMS], slope[KOKSMA__FORCE_DIMS], before[KOKSMA__FORCE_DIMS], product = 1;
    for (int k = 0; k < f->dim; k++) {
        const double t = koksma__torus_difference(y[k], x[k]), place = fabs(t) * (2 * PIECES);
        const int piece = place < PIECES ? (int)place : PIECES - 1;
        const double u = place - piece, *c = f->table + 4 * (size_t)piece;
        value[k] = ((c[3] * u + c[2]) * u + c[1]) * u + c[0];
        slope[k] = ((3 * c[3] * u + 2 * c[2]) * u + c[1]) * (t < 0 ? -2 * PIECES : 2 * PIECES);
        before[k] = product;
        product *= value[k];
    }
    product = -f->s * f->s;
    for (int k = f->dim - 1; k >= 0; k--) {
        force[k] += slope[k] * before[k] * product;
        product *= value[k];
    }
}

void koksma__space_force(const koksma__space_forces *f, size_t at, double *force)
{
    const size_t dim = (size_t)f->dim;
    const double *x = f->sorted + at * dim;
    memset(force, 0, dim * sizeof *force);
    if (!f->table) {
        add_cells(f, 0, 0, x, force);
        return;
    }
    for (size_t j = 0; j < f->n; j++) {
        if (j != at) {
            add_images(f, x, f->sorted + j * dim, force);
        }
    }
}
