/* SPDX-License-Identifier: Apache-2.0 */
#include "measures/parts/energy.h"

#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "core/sum.h"
#include "kernels/kernels.h"
#include "measures/parts/quadrature.h"

enum { BLOCK = 64 };

typedef struct rows {
    const koksma__warped *points;
    const koksma__energy *energy;
    koksma__sum *pairs, *linear; /* by block */
} rows;

static koksma_status block(void *context, size_t index)
{
    rows *r = context;
    const koksma__warped *w = r->points;
    for (size_t i = index * BLOCK; i < w->n && i < (index + 1) * BLOCK; i++) {
        double x[3] = {0};
        for (int k = 0; k < w->dim; k++) {
            x[k] = w->xs[(size_t)k * w->n + i];
        }
        koksma__sum_add(&r->linear[index], r->energy->potential(x, r->energy->context));
        koksma__sum_add(&r->pairs[index], koksma__kernels()->distances(w->dim, x, i, w->n, w->xs));
    }
    return KOKSMA_OK;
}

koksma_status koksma__energy_measure(const koksma__warped *points, const koksma__energy *energy,
                                     const koksma_run *run, koksma_value *out)
{
    const size_t n_blocks = (points->n + BLOCK - 1) / BLOCK;
    rows r = {.points = points, .energy = energy, .pairs = calloc(2 * n_blocks, sizeof *r.pairs)};
    if (!r.pairs) {
        return koksma__fail_memory(2 * n_blocks * sizeof *r.pairs);
    }
    r.linear = r.pairs + n_blocks;
    const koksma_status status = koksma__parallel(run, n_blocks, block, &r);
    if (!status) {
        const double n = (double)points->n;
        koksma__sum pairs = {0}, linear = {0}, total = {0};
        for (size_t b = 0; b < n_blocks; b++) {
            koksma__sum_add(&pairs, r.pairs[b].total);
            koksma__sum_add(&pairs, r.pairs[b].lost);
            koksma__sum_add(&linear, r.linear[b].total);
            koksma__sum_add(&linear, r.linear[b].lost);
        }
        koksma__sum_add(&total, koksma__sum_value(&linear) / n);
        koksma__sum_add(&total, -koksma__sum_value(&pairs) / n / n);
        koksma__sum_add(&total, -energy->self / 2);
        out->square = fmax(energy->factor * koksma__sum_value(&total), 0);
        out->value = sqrt(out->square);
    }
    free(r.pairs);
    return status;
}

/* (4 / 9 pi) ((7 + a^2) E(a) - 4 (1 - a^2) K(a)), a = |x|: rays from x, cubed chord by chord. */
double koksma__disk_potential(const double *x, const void *context)
{
    (void)context;
    const double a2 = fmin(x[0] * x[0] + x[1] * x[1], 1);
    double first, second;
    koksma__elliptic(sqrt(1 - a2), &first, &second);
    return 4 / (9 * M_PI) * ((7 + a2) * second - 4 * (1 - a2) * first);
}

/* The integral of the distance from the apex over a triangle whose opposite side is at distance h and reaches from s
   to t along its line: rays, cubed. */
static double apex_integral(double h, double s, double t)
{
    if (h <= 0) {
        return 0;
    }
    return h * (t * sqrt(h * h + t * t) - s * sqrt(h * h + s * s) + h * h * (asinh(t / h) - asinh(s / h))) / 6;
}

double koksma__triangle_potential(const double *x, const void *context)
{
    (void)context;
    const double height = sqrt(0.75), corners[3][2] = {{0, 0}, {1, 0}, {0.5, height}};
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        const double *a = corners[k], *b = corners[(k + 1) % 3];
        const double ux = b[0] - a[0], uy = b[1] - a[1], dx = a[0] - x[0], dy = a[1] - x[1];
        const double start = ux * dx + uy * dy;
        sum += apex_integral(dx * uy - dy * ux, start, start + 1);
    }
    return sum / (height / 2);
}

typedef struct ring {
    double angle; /* of the point, from the pole */
    bool cosine;
} ring;

/* The distance summed over the circle at angle b from the pole, by its length: a complete elliptic integral. */
static double ring_distance(double b, const void *context)
{
    const ring *r = context;
    const double far = sin((r->angle + b) / 2), near = fabs(sin((r->angle - b) / 2));
    double first, second;
    koksma__elliptic(far > 0 ? fmin(near / far, 1) : 1, &first, &second);
    return 4 / M_PI * far * second * sin(b) * (r->cosine ? 2 * cos(b) : 1);
}

double koksma__hemisphere_potential(const double *x, const void *context)
{
    const ring r = {.angle = atan2(hypot(x[0], x[1]), x[2]), .cosine = context != NULL};
    return koksma__integral(ring_distance, &r, 0, r.angle) + koksma__integral(ring_distance, &r, r.angle, M_PI / 2);
}
