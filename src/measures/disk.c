/* SPDX-License-Identifier: Apache-2.0 */
/*
 * disk: the largest difference, over all disks on the unit torus of radius up to r, between the share of points in
 * the disk and its area.
 *
 * Formula: sup over disks D of |#{x_i in D}/n - area of D|. An excess is reached at the smallest closed disk that
 * holds some points: a single point, two points on a diameter or three on the rim. A deficit is reached at an open
 * disk with three points on its rim or, at radius r, with two or (about which it can turn freely) one. Source:
 * Mitchell 1992, section 4, for disks; the critical disks are ours. Brute force: O(n^4). Known exactly: n copies of
 * one point: 1; one point, r = 1/4: 1. Limits: r < 1/2, so that no disk holds a point twice. Points within 1e-12 of a
 * rim count as on it.
 */
#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/measures.h"

enum { MAX_N = 256 };

typedef struct disk {
    double x, y, r2;
} disk;

typedef struct job {
    const koksma_points *points;
    double r;
    koksma_value *values; /* one a point */
} job;

static size_t count(const koksma_points *p, const disk *d, bool closed)
{
    const double limit = d->r2 * (closed ? 1 + 2e-12 : 1 - 2e-12) + (closed ? 1e-24 : 0);
    size_t inside = 0;
    for (size_t i = 0; i < p->n; i++) {
        double dx = fabs(p->xs[2 * i] - d->x), dy = fabs(p->xs[2 * i + 1] - d->y);
        dx -= floor(dx);
        dy -= floor(dy);
        dx = dx < 1 - dx ? dx : 1 - dx;
        dy = dy < 1 - dy ? dy : 1 - dy;
        inside += closed ? dx * dx + dy * dy <= limit : dx * dx + dy * dy < limit;
    }
    return inside;
}

static void consider(const koksma_points *p, disk d, bool closed, koksma_value *out)
{
    const double area = M_PI * d.r2, n = (double)p->n;
    if ((closed ? 1 - area : area) <= out->value) {
        return;
    }
    const size_t inside = count(p, &d, closed);
    const double value = closed ? (double)inside / n - area : area - (double)inside / n;
    if (value > out->value) {
        out->value = value;
        out->witness = (koksma_witness){.kind = KOKSMA_WITNESS_DISK,
                                        .dim = 2,
                                        .closed = closed,
                                        .count = inside,
                                        .volume = area,
                                        .lo = {d.x - floor(d.x), d.y - floor(d.y)},
                                        .hi = {sqrt(d.r2)}};
    }
}

/* Disks with the origin (x, y) and one or two other points, relative to it, on the rim. */
static void try_pair(const job *j, const double *p, const double *a, koksma_value *out)
{
    const double r2 = j->r * j->r, half2 = (a[0] * a[0] + a[1] * a[1]) / 4;
    if (half2 > r2) {
        return;
    }
    consider(j->points, (disk){p[0] + a[0] / 2, p[1] + a[1] / 2, half2}, true, out);
    const double t = half2 > 0 ? sqrt((r2 - half2) / (4 * half2)) : 0;
    for (int side = -1; side <= 1 && half2 > 0; side += 2) {
        consider(j->points, (disk){p[0] + a[0] / 2 - side * t * a[1], p[1] + a[1] / 2 + side * t * a[0], r2}, false,
                 out);
    }
}

static void try_triple(const job *j, const double *p, const double *a, const double *b, koksma_value *out)
{
    const double cross = 2 * (a[0] * b[1] - a[1] * b[0]);
    const double a2 = a[0] * a[0] + a[1] * a[1], b2 = b[0] * b[0] + b[1] * b[1];
    if (fabs(cross) < 1e-15) {
        return;
    }
    const double x = (b[1] * a2 - a[1] * b2) / cross, y = (a[0] * b2 - b[0] * a2) / cross, r2 = x * x + y * y;
    if (r2 <= j->r * j->r) {
        const disk d = {p[0] + x, p[1] + y, r2};
        consider(j->points, d, true, out);
        consider(j->points, d, false, out);
    }
}

/* Points of higher index and their images within 2r of point i, relative to it. */
static size_t neighbours(const job *j, size_t i, double (*out)[2])
{
    const double *xs = j->points->xs;
    size_t found = 0;
    for (size_t k = i + 1; k < j->points->n; k++) {
        for (int image = 0; image < 9; image++) {
            const double dx = xs[2 * k] - xs[2 * i] + image % 3 - 1,
                         dy = xs[2 * k + 1] - xs[2 * i + 1] + image / 3 - 1;
            if (dx * dx + dy * dy <= 4 * j->r * j->r * (1 + 1e-14)) {
                out[found][0] = dx;
                out[found++][1] = dy;
            }
        }
    }
    return found;
}

static koksma_status try_point(void *context, size_t i)
{
    const job *j = context;
    const size_t n = j->points->n;
    const double *p = j->points->xs + 2 * i;
    double(*others)[2] = malloc((9 * n + 1) * sizeof *others);
    if (!others) {
        return koksma__fail_memory((9 * n + 1) * sizeof *others);
    }
    koksma_value value = {.value = -1};
    const size_t found = neighbours(j, i, others);
    consider(j->points, (disk){p[0], p[1], 0}, true, &value);
    consider(j->points, (disk){p[0] + j->r, p[1], j->r * j->r}, false, &value);
    for (size_t a = 0; a < found; a++) {
        try_pair(j, p, others[a], &value);
        for (size_t b = 0; b < a; b++) {
            try_triple(j, p, others[a], others[b], &value);
        }
    }
    j->values[i] = value;
    free(others);
    return KOKSMA_OK;
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const size_t n = points->n;
    if (n > MAX_N) {
        return koksma__fail(KOKSMA_N, "disk: n = %zu: up to %d points; l2-disk takes more", n, MAX_N);
    }
    job j = {.points = points, .r = args->params[0], .values = malloc(n * sizeof *j.values)};
    if (!j.values) {
        return koksma__fail_memory(n * sizeof *j.values);
    }
    const koksma_status status = koksma__parallel(args->run, n, try_point, &j);
    out->value = -1;
    for (size_t i = 0; i < n && !status; i++) {
        if (j.values[i].value > out->value) {
            out->value = j.values[i].value;
            out->witness = j.values[i].witness;
        }
    }
    free(j.values);
    return status;
}

static const koksma_param params[] = {
    {"r", "the largest radius", 0.25, 0.001, 0.499, NULL, false},
    {0},
};

const koksma_measure koksma__measure_disk = {
    .name = "disk",
    .title = "L-infinity discrepancy of disks on the torus",
    .cite = "mitchell1992",
    .cost = "n^4",
    .min_dim = 2,
    .max_dim = 2,
    .params = params,
    .eval = eval,
};
