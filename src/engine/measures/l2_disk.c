/* SPDX-License-Identifier: Apache-2.0 */
/*
 * l2-disk: the root mean square, over disks on the torus with a random centre, of the difference between the share of
 * points in the disk and its area. The radius is fixed at r, or random up to r: uniform in the radius or in the area.
 *
 * Formula: square = n^-2 sum_ij sum_k W(|x_i - x_j + k|) - c, where k runs over the integer shifts of the torus and
 * W(d) is the area of the overlap of two disks whose centres are d apart, or its mean over the radius. For the three
 * laws of the radius, with h = d/2 < r and s = sqrt((r - h) (r + h)), W(d) and c are
 *
 *   fixed   2 r^2 acos(h/r) - 2 h s,                                           c = pi^2 r^4
 *   radius  ((2/3) r^3 acos(h/r) - (4/3) h r s + (2/3) h^3 ln((r+s)/h)) / r,   c = pi^2 r^4 / 5
 *   area    (r^4 acos(h/r) - (5/3) h s^3 - h^3 s) / r^2,                       c = pi^2 r^4 / 3
 *
 * In 3 dimensions, for balls and the volume of their overlap, with t = r - h:
 *
 *   fixed   (2 pi/3) (2 t + 3 h) t^2,                                          c = (16/9) pi^2 r^6
 *   radius  pi t^3 (r + h) / (3 r),                                            c = (16/63) pi^2 r^6
 *   area    (2 pi/r^3) t^3 (t^3/3 + 7 h t^2/5 + 2 h^2 t + h^3),                c = (16/27) pi^2 r^6
 *
 * where law=area makes the volume uniform.
 * Source: Mitchell 1992, section 4, which samples disks; the closed forms are derived from the area of the lens in
 * which two disks overlap.
 * Known exactly: random points, the mean of the square is pi r^2 (1 - pi r^2)/n for a fixed radius. With r = 1/2 it
 * is (pi/12 - pi^2/80)/n for law=radius and (pi/8 - pi^2/48)/n for law=area. One point and a fixed radius: the square
 * is pi r^2 (1 - pi r^2). For balls and random points, with v the volume of the largest ball, the mean of the square
 * is v (1 - v)/n for law=fixed, (v/4 - v^2/7)/n for law=radius and (v/2 - v^2/3)/n for law=area.
 * Limits: the two terms are near c and cancel. Sums over rows are compensated and have errors of about 1e-15 c; for
 * 10^5 evenly spread points the value has 9 correct digits. For r <= 1/8 a grid of cells skips pairs of points that
 * are too far apart to overlap.
 */
#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "core/sum.h"
#include "core/torus_rows.h"
#include "kernels/kernels.h"
#include "measures/disk/disk.h"
#include "measures/distances/distances.h"
#include "measures/measures.h"

enum { BLOCK = 64, MIN_COLUMNS = 4 };

typedef struct pairs {
    koksma__torus_rows cells; /* the points in 2D */
    const double *points;     /* the points in 3D; NULL in 2D */
    size_t n;
    int law;
    double r;
    koksma__sum *blocks;
} pairs;

/* Returns the sum of the overlaps of disk i with disks first .. last-1, in the order of the cells. */
static double span(const pairs *p, size_t i, size_t first, size_t last)
{
    const double *xs = p->cells.xs, *ys = p->cells.ys;
    return koksma__kernels()->disk_overlaps(p->law, p->r, xs[i], ys[i], last - first, xs + first, ys + first);
}

/* Returns the sum of the overlaps of ball i with balls 0 .. i - 1 and their periodic copies. Along each axis only the
   two nearest copies of a point can be less than 1 away. */
static double balls_before(const pairs *p, size_t i)
{
    koksma__sum sum = {0};
    const double reach2 = 4 * p->r * p->r;
    for (size_t j = 0; j < i; j++) {
        double ways2[3][2];
        for (size_t k = 0; k < 3; k++) {
            const double way = fabs(p->points[3 * i + k] - p->points[3 * j + k]);
            ways2[k][0] = way * way;
            ways2[k][1] = (1 - way) * (1 - way);
        }
        for (int copy = 0; copy < 8; copy++) {
            const double distance2 = ways2[0][copy & 1] + ways2[1][copy >> 1 & 1] + ways2[2][copy >> 2];
            if (distance2 < reach2) {
                koksma__sum_add(&sum, koksma__ball_overlap((koksma__disk_law)p->law, p->r, distance2));
            }
        }
    }
    return koksma__sum_value(&sum);
}

/* Adds the overlaps of disk i with nearby disks: those before it in its own cell, those in the next cell of the row,
   and those in three cells of the next row. Thus each pair is counted once. */
static void add_near(const pairs *p, size_t i, size_t cell, koksma__sum *sum)
{
    const uint32_t *start = p->cells.start;
    const size_t columns = p->cells.cells;
    const size_t column = cell % columns, row = cell / columns, above = (row + 1) % columns * columns;
    const size_t right = (column + 1) % columns, left = (column + columns - 1) % columns;
    koksma__sum_add(sum, span(p, i, start[cell], i));
    koksma__sum_add(sum, span(p, i, start[row * columns + right], start[row * columns + right + 1]));
    if (left < right) {
        koksma__sum_add(sum, span(p, i, start[above + left], start[above + right + 1]));
        return;
    }
    const size_t three[3] = {above + left, above + column, above + right};
    for (int k = 0; k < 3; k++) {
        koksma__sum_add(sum, span(p, i, start[three[k]], start[three[k] + 1]));
    }
}

static koksma_status block(void *context, size_t index)
{
    const pairs *p = context;
    const size_t first = index * BLOCK, last = first + BLOCK < p->n ? first + BLOCK : p->n;
    koksma__sum sum = {0};
    size_t cell = 0;
    for (size_t i = first; i < last; i++) {
        if (p->points) {
            koksma__sum_add(&sum, balls_before(p, i));
            continue;
        }
        if (p->cells.cells < MIN_COLUMNS) {
            koksma__sum_add(&sum, span(p, i, 0, i));
            continue;
        }
        while (p->cells.start[cell + 1] <= i) {
            cell++;
        }
        add_near(p, i, cell, &sum);
    }
    p->blocks[index] = sum;
    return KOKSMA_OK;
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const koksma__disk_law law = (koksma__disk_law)(int)args->params[1];
    const bool cube = points->dim == 3;
    pairs p = {.law = (int)law, .n = points->n, .r = koksma__disk_radius(law, args->params[0])};
    const size_t n_blocks = (points->n + BLOCK - 1) / BLOCK;
    koksma_status status = KOKSMA_OK;
    if (cube) {
        p.points = points->xs;
    } else {
        /* The cells are no narrower than a disk and have one point or more on average. */
        const double columns = fmin(floor(1 / (2 * p.r)), floor(sqrt((double)points->n)));
        status = koksma__torus_rows_init(&p.cells, points->n, columns > 1 ? (size_t)columns : 1);
        if (!status) {
            koksma__torus_rows_sort(&p.cells, points->n, points->xs, true);
        }
    }
    p.blocks = calloc(n_blocks, sizeof *p.blocks);
    if (!status && !p.blocks) {
        status = koksma__fail_memory(n_blocks * sizeof *p.blocks);
    }
    status = status ? status : koksma__parallel(args->run, n_blocks, block, &p);
    if (!status) {
        const double n = (double)points->n;
        koksma__sum sum = {0}, total = {0};
        for (size_t b = 0; b < n_blocks; b++) {
            koksma__sum_add(&sum, p.blocks[b].total);
            koksma__sum_add(&sum, p.blocks[b].lost);
        }
        koksma__sum_add(&total, (cube ? koksma__ball_overlap(law, p.r, 0) : koksma__disk_area(law, p.r)) / n);
        koksma__sum_add(&total, 2 * koksma__sum_value(&sum) / n / n);
        koksma__sum_add(&total, -(cube ? koksma__ball_square(law, p.r) : koksma__disk_square(law, p.r)));
        out->square = koksma__not_below_0(koksma__sum_value(&total));
        out->value = sqrt(out->square);
    }
    free(p.blocks);
    koksma__torus_rows_fini(&p.cells);
    return status;
}

/* Sums over all pairs of points, with the two nearest periodic copies along each axis; all other copies are at least
   1 away. */
static koksma_status gradient(const koksma_points *points, const koksma_args *args, double *square, double *out)
{
    const koksma__disk_law law = (koksma__disk_law)(int)args->params[1];
    const size_t n = points->n, dim = (size_t)points->dim;
    const double r = koksma__disk_radius(law, args->params[0]), *xs = points->xs;
    koksma_value value;
    koksma_status status = eval(points, args, &value);
    const size_t asked = KOKSMA__ASKED / points->n + 1; /* points between two questions */
    *square = value.square;
    for (size_t i = 0; i < n && !status; i++) {
        double sum[3] = {0};
        status = i % asked ? KOKSMA_OK : koksma__ask(args->run);
        for (size_t c = 0; c < n << dim; c++) {
            const size_t j = c >> dim;
            double d[3] = {0};
            for (size_t k = 0; k < dim; k++) {
                const double plain = xs[i * dim + k] - xs[j * dim + k];
                d[k] = plain - (c >> k & 1 ? (plain > 0 ? 1 : -1) : 0);
            }
            const double distance = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            const double slope = j == i ? 0 : koksma__overlap_slope(law, points->dim, r, distance);
            for (size_t k = 0; k < dim && slope != 0 && distance > 0; k++) {
                sum[k] += slope * d[k] / distance;
            }
        }
        for (size_t k = 0; k < dim; k++) {
            out[i * dim + k] = 2 * sum[k] / ((double)n * (double)n);
        }
    }
    return status;
}

static const koksma_param params[] = {
    {"r", "radius of the disks, or the largest radius if it is random; 0: 1/4 if fixed, else 1/2", 0, 0, 0.5, NULL,
     false},
    {"law", "law of the radius: fixed, uniform, or such that the area (volume) is uniform", 0, 0, 2,
     koksma__disk_laws, true},
    {0},
};

const koksma_measure koksma__measure_l2_disk = {
    .name = "l2-disk",
    .title = "L2 discrepancy of disks or balls on the torus (root mean square over them)",
    .cite = "mitchell1992",
    .revision = 1, /* own elementary functions */
    .cost = "n^2; in 2D with r <= 1/8, n times the mean number of points within 2r",
    .family = KOKSMA_FAMILY_DISKS,
    .min_dim = 2,
    .max_dim = 3,
    .params = params,
    .eval = eval,
    .on_torus = true,
    .gradient = gradient,
};
