/* SPDX-License-Identifier: Apache-2.0 */
/*
 * l2-disk-in-disk: the points are mapped to the unit disk D; the root mean square, over disks of radius r that meet
 * D, of the difference between the share of points in the disk and the share of D's area in it.
 *
 * Formula: centres are uniform within 1 + r of the origin. With lens(d) the area that two disks of radius r at
 * distance d share, L(p) the area of D in a disk with centre at p from the origin, and A = pi (1+r)^2, the square is
 *   (n^-2 sum_ij lens(|x_i - x_j|) - (2/n) sum_i a(|x_i|) + c)/A,
 *   a(s) = integral of L(p)/pi over the centres within r of a point at s,  c = integral of 2 pi p (L(p)/pi)^2.
 * Source: the second paper's disks (Mitchell 1992, section 4), clipped by the domain instead of wrapped; derived.
 * Known exactly: random points, the mean of the square is (r^2 - c/pi)/((1+r)^2 n), whose c comes from the same
 * integral. Limits: a and c are integrated to about 1e-14 of their size; the square is good to about 1e-15.
 */
#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "core/sum.h"
#include "kernels/kernels.h"
#include "measures/measures.h"
#include "measures/parts/quadrature.h"
#include "measures/parts/warped.h"

enum { BLOCK = 64 };

typedef struct ring {
    double r, s; /* radius of the disks; distance of the point from the origin */
} ring;

typedef struct rows {
    const koksma__warped *points;
    double r;
    koksma__sum *pairs, *linear; /* by block */
} rows;

static double angle_of(double cosine)
{
    return acos(fmax(fmin(cosine, 1), -1));
}

/* The area that D shares with a disk of radius r <= 1 at distance p. */
static double shared_area(double p, double r)
{
    if (p >= 1 + r) {
        return 0;
    }
    if (p <= 1 - r) {
        return M_PI * r * r;
    }
    const double product = (1 + r - p) * (p + r - 1) * (p - r + 1) * (p + r + 1);
    return r * r * angle_of((p * p + r * r - 1) / (2 * p * r)) + angle_of((p * p + 1 - r * r) / (2 * p)) -
           sqrt(fmax(product, 0)) / 2;
}

static double whole_circle(double p, const void *context)
{
    const ring *g = context;
    return 2 * M_PI * p * shared_area(p, g->r) / M_PI;
}

/* The arc of the circle of radius p about the origin that is within r of the point. */
static double arc(double p, const void *context)
{
    const ring *g = context;
    return 2 * p * angle_of((p * p + g->s * g->s - g->r * g->r) / (2 * g->s * p)) * shared_area(p, g->r) / M_PI;
}

static double square_of_share(double p, const void *context)
{
    const ring *g = context;
    const double share = shared_area(p, g->r) / M_PI;
    return 2 * M_PI * p * share * share;
}

/* In two pieces, as the integrand has a corner where the disk begins to stick out. */
static double in_pieces(double (*f)(double, const void *), const ring *g, double a, double b)
{
    const double corner = fmax(fmin(1 - g->r, b), a);
    return koksma__integral(f, g, a, corner) + koksma__integral(f, g, corner, b);
}

/* a(s) */
static double linear_term(double r, double s)
{
    const ring g = {r, s};
    if (s < 1e-12) {
        return in_pieces(whole_circle, &g, 0, r);
    }
    return in_pieces(whole_circle, &g, 0, r - s) + in_pieces(arc, &g, fabs(r - s), fmin(r + s, 1 + r));
}

/* Points are shrunk to a quarter, where disks of radius r / 4 don't meet around the torus of the kernel. */
static koksma_status block(void *context, size_t index)
{
    rows *t = context;
    const koksma__warped *w = t->points;
    const double *xs = w->xs, *ys = w->xs + w->n;
    for (size_t i = index * BLOCK; i < w->n && i < (index + 1) * BLOCK; i++) {
        koksma__sum_add(&t->linear[index], linear_term(t->r, 4 * hypot(xs[i], ys[i])));
        koksma__sum_add(&t->pairs[index],
                        16 * koksma__kernels()->disk_overlaps(0, t->r / 4, xs[i], ys[i], i, xs, ys));
    }
    return KOKSMA_OK;
}

static void add_up(const rows *t, size_t n_blocks, koksma_value *out)
{
    const double n = (double)t->points->n, r = t->r;
    const ring g = {r, 0};
    koksma__sum pairs = {0}, linear = {0}, total = {0};
    for (size_t b = 0; b < n_blocks; b++) {
        koksma__sum_add(&pairs, t->pairs[b].total);
        koksma__sum_add(&pairs, t->pairs[b].lost);
        koksma__sum_add(&linear, t->linear[b].total);
        koksma__sum_add(&linear, t->linear[b].lost);
    }
    koksma__sum_add(&total, M_PI * r * r / n);
    koksma__sum_add(&total, 2 * koksma__sum_value(&pairs) / n / n);
    koksma__sum_add(&total, -2 * koksma__sum_value(&linear) / n);
    koksma__sum_add(&total, in_pieces(square_of_share, &g, 0, 1 + r));
    out->square = fmax(koksma__sum_value(&total) / (M_PI * (1 + r) * (1 + r)), 0);
    out->value = sqrt(out->square);
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const size_t n_blocks = (points->n + BLOCK - 1) / BLOCK;
    koksma__warped w;
    rows t = {.points = &w, .r = args->params[1]};
    koksma_status status = koksma__warped_init(&w, points, koksma__warps_to_disk, args->params[0]);
    t.pairs = calloc(2 * n_blocks, sizeof *t.pairs);
    if (!status && !t.pairs) {
        status = koksma__fail_memory(2 * n_blocks * sizeof *t.pairs);
    }
    if (!status) {
        t.linear = t.pairs + n_blocks;
        for (size_t c = 0; c < 2 * w.n; c++) {
            w.xs[c] /= 4;
        }
        status = koksma__parallel(args->run, n_blocks, block, &t);
    }
    if (!status) {
        add_up(&t, n_blocks, out);
    }
    free(t.pairs);
    koksma__warped_fini(&w);
    return status;
}

static const koksma_param params[] = {
    KOKSMA__WARP_PARAM(koksma__warps_to_disk, 1),
    {"r", "the radius of the disks, where the domain's is 1", 0.25, 1e-6, 1, NULL, false},
    {0},
};

const koksma_measure koksma__measure_l2_disk_in_disk = {
    .name = "l2-disk-in-disk",
    .title = "L2 over disks of a radius on the points mapped to the unit disk",
    .cite = "mitchell1992 shirley1997",
    .cost = "n^2",
    .min_dim = 2,
    .max_dim = 2,
    .params = params,
    .eval = eval,
};
