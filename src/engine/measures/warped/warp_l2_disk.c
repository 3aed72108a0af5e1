/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The measure l2-disk for points in the unit disk: the root mean square over disks of radius r whose centres are
 * uniform within 1 + r of the origin. The square expands into a sum over pairs of points (overlaps of two disks), a
 * sum over points and a constant. The sum over points and the constant consist of integrals over rings about the
 * origin (quadrature.c). O(n^2).
 */
#include "measures/warped/warped.h"

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "core/sum.h"
#include "kernels/kernels.h"
#include "measures/shared/shared.h"

enum { BLOCK = 64 };

typedef struct ring {
    double r, s; /* radius of the disks; distance of the point from the origin */
} ring;

typedef struct rows {
    size_t n;
    double r, *xs, *ys;          /* the coordinates of the points divided by 4 */
    koksma__sum *pairs, *linear; /* the sum of each block */
} rows;

static double whole_circle(double p, const void *context)
{
    const ring *g = context;
    return 2 * M_PI * p * koksma__disks_share(g->r, p) / M_PI;
}

/* Returns the product of two numbers: the length of the arc, of the circle of radius p about the origin, that is
   within r of the point; and the share of the unit disk in a disk of radius r about a point of this arc. */
static double arc(double p, const void *context)
{
    const ring *g = context;
    const double near = fmax((g->r - p + g->s) * (g->r + p - g->s), 0),
                 far = fmax((p + g->s - g->r) * (p + g->s + g->r), 0); /* near / far is tan^2 of half the angle of the
                                                                          arc */
    return 4 * p * koksma__atan2(sqrt(near), sqrt(far)) * koksma__disks_share(g->r, p) / M_PI;
}

static double square_of_share(double p, const void *context)
{
    const ring *g = context;
    const double share = koksma__disks_share(g->r, p) / M_PI;
    return 2 * M_PI * p * share * share;
}

/* Integrates f in two pieces, because its derivative jumps at p = 1 - r, where the disk of radius r begins to leave
   the unit disk. */
static double in_pieces(double (*f)(double, const void *), const ring *g, double a, double b)
{
    const double corner = fmax(fmin(1 - g->r, b), a);
    return koksma__integral(f, g, a, corner) + koksma__integral(f, g, corner, b);
}

/* Returns the term a(s) of the formula in warp_l2_disk.h. */
static double linear_term(double r, double s)
{
    const ring g = {r, s};
    if (s < 1e-12) {
        return in_pieces(whole_circle, &g, 0, r);
    }
    return in_pieces(whole_circle, &g, 0, r - s) + in_pieces(arc, &g, fabs(r - s), fmin(r + s, 1 + r));
}

/* The kernel is for disks on the unit torus. Coordinates are divided by 4, so that disks of radius r / 4 about these
   points do not overlap across the border of the torus. */
static koksma_status block(void *context, size_t index)
{
    rows *t = context;
    const double *xs = t->xs, *ys = t->ys;
    for (size_t i = index * BLOCK; i < t->n && i < (index + 1) * BLOCK; i++) {
        koksma__sum_add(&t->linear[index], linear_term(t->r, 4 * koksma__hypot(xs[i], ys[i])));
        koksma__sum_add(&t->pairs[index],
                        16 * koksma__kernels()->disk_overlaps(0, t->r / 4, xs[i], ys[i], i, xs, ys));
    }
    return KOKSMA_OK;
}

static void add_up(const rows *t, size_t n_blocks, koksma_value *out)
{
    const double n = (double)t->n, r = t->r;
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
    out->square = koksma__not_below_0(koksma__sum_value(&total) / (M_PI * (1 + r) * (1 + r)));
    out->value = sqrt(out->square);
}

koksma_status koksma__warp_l2_disk(size_t n, const double *xs, double r, const koksma_run *run, koksma_value *out)
{
    const size_t n_blocks = (n + BLOCK - 1) / BLOCK;
    rows t = {.n = n, .r = r, .xs = malloc(2 * n * sizeof *t.xs), .pairs = calloc(2 * n_blocks, sizeof *t.pairs)};
    koksma_status status = KOKSMA_OK;
    if (!t.xs || !t.pairs) {
        status = koksma__fail_memory(2 * n * sizeof *t.xs + 2 * n_blocks * sizeof *t.pairs);
    } else {
        t.ys = t.xs + n;
        t.linear = t.pairs + n_blocks;
        for (size_t i = 0; i < n; i++) {
            t.xs[i] = xs[2 * i] / 4;
            t.ys[i] = xs[2 * i + 1] / 4;
        }
        status = koksma__parallel(run, n_blocks, block, &t);
    }
    if (!status) {
        add_up(&t, n_blocks, out);
    }
    free(t.pairs);
    free(t.xs);
    return status;
}
