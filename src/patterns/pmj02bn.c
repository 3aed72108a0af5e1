/* SPDX-License-Identifier: Apache-2.0 */
/*
 * pmj02bn: pmj02 with blue noise: each new point is the best of some candidates in the place that the nets leave for
 * it, a rectangle of 1/(2n) x 1/(2n) when n are placed: the one furthest from the points before it, on the torus.
 * Prefixes of 2^m stay (0,m,2)-nets.
 *
 * Source: Christensen, Kensler & Kilpatrick 2018; candidates inside the stratum as in Helmer, Christensen & Kensler
 * 2021.
 *
 * Not unbiased, for the best candidate's law depends on where its rectangle lies: of 4 points 7.5 % are in the bands
 * of width 0.04 at the axes' ends in the mean, in place of 4 %, of 256 points 4.03 %. pmj02 is.
 */
#include <koksma/sampler.h>

#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/parts/torus_grid.h"
#include "patterns/patterns.h"

enum { NEAR = 128, REACH = 2 };

typedef struct net {
    uint64_t seed;
    size_t candidates;
    uint32_t cells; /* a side; one point each, or none yet */
    uint32_t *cell; /* the point in it */
    double *xs;
} net;

static uint32_t *cell_of(const net *s, double x, double y)
{
    return &s->cell[(size_t)(y * s->cells) * s->cells + (size_t)(x * s->cells)];
}

/* The points around a place, as offsets from it. */
static int gather(const net *s, double x, double y, double *dx, double *dy)
{
    const long cells = (long)s->cells, reach = cells < 2 * REACH + 1 ? cells / 2 : REACH;
    const long cx = (long)(x * (double)cells), cy = (long)(y * (double)cells);
    int count = 0;
    for (long v = -reach; v <= reach; v++) {
        for (long u = -reach; u <= reach; u++) {
            const uint32_t i = s->cell[(cy + v + cells) % cells * cells + (cx + u + cells) % cells];
            if (i != KOKSMA__NO_POINT && count < NEAR) {
                dx[count] = koksma__way(x, s->xs[2 * (size_t)i]);
                dy[count++] = koksma__way(y, s->xs[2 * (size_t)i + 1]);
            }
        }
    }
    return count;
}

/* The best place in the square of side `width` at (x, y) for point i. */
static void choose(const net *s, size_t i, double x, double y, double width, double *point)
{
    enum { MOST = 128 };
    double dx[NEAR], dy[NEAR], pairs[2 * MOST], least[MOST], best = -1;
    const int count = gather(s, x, y, dx, dy);
    const double scale = (1 - 0x1p-24) * width;
    for (size_t first = 0; first < s->candidates; first += MOST) {
        const size_t some = s->candidates - first < MOST ? s->candidates - first : MOST;
        koksma__kernels()->uniform(s->seed, KOKSMA__PURPOSE_DART, (uint64_t)i << 16 | first, 0, some, pairs);
        koksma__kernels()->nearest_offset((size_t)count, dx, dy, some, pairs, scale, least);
        for (size_t c = 0; c < some; c++) {
            if (least[c] > best) {
                best = least[c];
                point[0] = x + pairs[2 * c] * scale;
                point[1] = y + pairs[2 * c + 1] * scale;
            }
        }
    }
}

/* The grid for n points: cells of about 1/sqrt(2n). */
static void make_cells(net *s, size_t n)
{
    s->cells = 1;
    while ((size_t)s->cells * s->cells < 2 * n) {
        s->cells *= 2;
    }
    for (size_t c = 0; c < (size_t)s->cells * s->cells; c++) {
        s->cell[c] = KOKSMA__NO_POINT;
    }
    for (size_t i = 0; i < n; i++) {
        *cell_of(s, s->xs[2 * i], s->xs[2 * i + 1]) = (uint32_t)i;
    }
}

static koksma_status place_all(net *s, const koksma_run *run, koksma_points *out)
{
    koksma__random_pair(s->seed, KOKSMA__PURPOSE_POINT, 0, 0, out->xs);
    for (uint32_t level = 0; (size_t)1 << level < out->n; level++) {
        const size_t n = (size_t)1 << level, end = out->n - n < n ? out->n - n : n;
        const double strata = 2 * (double)n;
        make_cells(s, n);
        for (size_t i = 0; i < end; i++) {
            double corner[2];
            for (int k = 0; k < 2; k++) {
                const size_t j = i ^ koksma_pmj02_partner(k, level);
                corner[k] = (double)((uint64_t)(out->xs[2 * j + (size_t)k] * strata) ^ 1) / strata;
            }
            choose(s, n + i, corner[0], corner[1], 1 / strata, out->xs + 2 * (n + i));
            *cell_of(s, out->xs[2 * (n + i)], out->xs[2 * (n + i) + 1]) = (uint32_t)(n + i);
            if (i % 1024 == 1023 && !koksma__keep_going(run, (double)(n + i) / (double)out->n)) {
                return koksma__fail_interrupted();
            }
        }
    }
    return KOKSMA_OK;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    net s = {.seed = seed, .candidates = (size_t)args->params[0], .xs = out->xs};
    uint32_t few[1024];
    size_t cells = 4;
    while (cells < 2 * out->n) {
        cells *= 4;
    }
    s.cell = cells <= 1024 ? few : malloc(cells * sizeof *s.cell);
    if (!s.cell) {
        return koksma__fail_memory(cells * sizeof *s.cell);
    }
    const koksma_status status = place_all(&s, args->run, out);
    if (s.cell != few) {
        free(s.cell);
    }
    return status;
}

static const koksma_param params[] = {
    {"candidates", "places to choose from for each point", 20, 1, 1000, NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_pmj02bn = {
    .name = "pmj02bn",
    .title = "pmj02 with the best of some candidates in each stratum",
    .cite = "christensen2018 helmer2021",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_NET2 | KOKSMA_CLAIM_NET2_PREFIXES,
    .params = params,
    .generate = generate,
};
