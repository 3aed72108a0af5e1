/* SPDX-License-Identifier: Apache-2.0 */
/*
 * edge-sampled: an estimate of l2-edge from random lines, as in Mitchell 1992.
 *
 * Formula: the root of the mean, over `lines` random lines, of (#{x_i above the line}/n - area above)^2; its standard
 * error is the standard error of the mean of the squares, divided by twice the value.
 * Source: Mitchell 1992, section 5, which uses 10,000 lines. With skip=1 the first point is never counted, although n
 * includes it. This reproduces table 4 of the paper to within the noise of 10,000 lines; presumably the loop of the
 * paper's program began at 1.
 * Known exactly: with skip=0 the expectation of the squared value is l2-edge squared.
 * Limits: the value is random; equal seeds
 * give equal bits. In 3 dimensions random planes through the cube replace the lines, with the isotropic distribution
 * only.
 */
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "measures/edge/edge.h"
#include "measures/measures.h"
#include "measures/shared/shared.h"

enum { LANES = 16, LINES_PER_BLOCK = 512 };

typedef struct job {
    koksma__line_law law;
    size_t lines, n, skip;
    uint64_t seed;
    const double *points; /* the points; used only in 3 dimensions */
    double *x, *y;
    double *squares;
} job;

static koksma_status sample_block(void *context, size_t block)
{
    const job *j = context;
    const size_t end = (block + 1) * LINES_PER_BLOCK < j->lines ? (block + 1) * LINES_PER_BLOCK : j->lines;
    for (size_t first = block * LINES_PER_BLOCK; first < end; first += LANES) {
        double a[LANES], b[LANES], c[LANES], counts[LANES];
        for (size_t l = 0; l < LANES; l++) {
            koksma__random_line(j->law, j->seed, first + l, &a[l], &b[l], &c[l]);
        }
        koksma__kernels()->count_below(j->n - j->skip, j->x + j->skip, j->y + j->skip, a, b, c, counts);
        for (size_t l = 0; l < LANES && first + l < end; l++) {
            /* The fraction of points below the line minus the area below it is the negative of the same difference
               above the line. Skipped points are never counted above the line, so they count as below. */
            const double below = counts[l] + (double)j->skip;
            const double deviation = below / (double)j->n - koksma__area_below(a[l], b[l], c[l]);
            j->squares[first + l] = deviation * deviation;
        }
    }
    return KOKSMA_OK;
}

static koksma_status sample_planes(void *context, size_t block)
{
    const job *j = context;
    const size_t end = (block + 1) * LINES_PER_BLOCK < j->lines ? (block + 1) * LINES_PER_BLOCK : j->lines;
    for (size_t plane = block * LINES_PER_BLOCK; plane < end; plane++) {
        double a[3], c, below = (double)j->skip;
        koksma__random_plane(j->seed, plane, a, &c);
        for (size_t i = j->skip; i < j->n; i++) {
            const double *p = j->points + 3 * i;
            below += a[0] * p[0] + a[1] * p[1] + a[2] * p[2] <= c ? 1.0 : 0.0;
        }
        const double deviation = below / (double)j->n - koksma__volume_below(a, c);
        j->squares[plane] = deviation * deviation;
    }
    return KOKSMA_OK;
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const size_t n = points->n, lines = (size_t)args->params[0];
    job j = {.law = (koksma__line_law)args->params[1], .lines = lines, .n = n, .seed = (uint64_t)args->params[2]};
    j.skip = (size_t)args->params[3] < n ? (size_t)args->params[3] : n;
    j.points = points->xs;
    const bool cube = points->dim == 3;
    if (cube && j.law != KOKSMA__LINES_ISOTROPIC) {
        return koksma__fail_law_of_plane("edge-sampled");
    }
    const size_t bytes = (2 * n + lines) * sizeof(double);
    j.x = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(j.x, bytes);
    j.y = j.x + n;
    j.squares = j.y + n;
    for (size_t i = 0; i < n && !cube; i++) {
        j.x[i] = points->xs[2 * i];
        j.y[i] = points->xs[2 * i + 1];
    }
    const koksma_status status = koksma__parallel(args->run, (lines + LINES_PER_BLOCK - 1) / LINES_PER_BLOCK,
                                                  cube ? sample_planes : sample_block, &j);
    if (!status) {
        koksma__sampled_root(j.squares, lines, out);
    }
    free(j.x);
    return status;
}

static const koksma_param params[] = {
    {"lines", "number of random lines (in 3D: planes)", 10000, 1, 1e8, NULL, true},
    {"law", "distribution of the lines: isotropic, or as in Mitchell 1992", 0, 0, 1, koksma__line_laws, true},
    {"seed", "seed of the lines", 1, 0, 9007199254740992.0, NULL, true},
    {"skip", "number of points at the start that are not counted", 0, 0, 1e9, NULL, true},
    {0},
};

const koksma_measure koksma__measure_edge_sampled = {
    .name = "edge-sampled",
    .title = "L2 discrepancy of half-planes or half-spaces (root mean square), estimated from random lines or planes",
    .cite = "mitchell1992",
    .revision = 1, /* own elementary functions */
    .cost = "lines n",
    .family = KOKSMA_FAMILY_EDGES,
    .min_dim = 2,
    .max_dim = 3,
    .params = params,
    .eval = eval,
    .answer = KOKSMA_ANSWER_SAMPLED,
};
