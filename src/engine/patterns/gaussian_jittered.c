/* SPDX-License-Identifier: Apache-2.0 */
/*
 * gaussian-jittered: one point in each cell of a grid, normally distributed about the cell's centre and truncated at
 * the cell's sides (the conditional distribution given that the point is in the cell, so that no probability is
 * concentrated on the sides).
 *
 *     x_k = (c_k + 1/2 + sigma z_k) / m,   z normal given |sigma z| < 1/2, by inverting its distribution function
 *
 * Source: Cook 1986, after Shirley 1991, section 5.5.3. The inverse of the distribution function is from Giles 2012.
 * With a small sigma the points are nearly a regular grid, with a large sigma nearly jittered.
 */
#include <math.h>

#include "core/elementary.h"
#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/grids/grids.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

typedef struct bell {
    double scale, reach; /* scale is sqrt(2) sigma, reach is erf(0.5 / scale) */
} bell;

/* Turns the uniform numbers of `count` points into truncated normal positions in a cell. */
static void bend(const void *context, size_t first, size_t count, bool stream, koksma_points *out)
{
    const bell *b = context;
    const size_t dim = (size_t)out->dim;
    (void)stream;
    koksma__kernels()->truncated_normals(b->reach, b->scale, count * dim, out->xs + first * dim);
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const double scale = sqrt(2) * args->params[1];
    const bell b = {scale, koksma__erf(0.5 / scale)};
    size_t along_x, along_rest;
    KOKSMA__TRY(koksma__cells("gaussian-jittered", out, args->params[0], &along_x, &along_rest));
    KOKSMA__TRY(koksma__fill_uniform(seed, KOKSMA__PURPOSE_POINT, args->run, out->n * (size_t)out->dim, out->xs));
    KOKSMA__TRY(koksma__fill_rows(args->run, out, bend, &b));
    koksma__place_in_cells(args, 0, 1, along_x, along_rest, out);
    return KOKSMA_OK;
}

static const koksma_param params[] = {
    KOKSMA__PARAM_COLUMNS,
    {"sigma", "standard deviation before truncation, in cell widths", 0.25, 0.001, 1000, NULL, false},
    {0},
};

const koksma_pattern koksma__pattern_gaussian_jittered = {
    .name = "gaussian-jittered",
    .title = "one point in each cell of a grid, normally distributed about the centre of the cell",
    .cite = "cook1986 shirley1991 giles2012",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_STRATIFIED,
    .params = params,
    .generate = generate,
    .revision = 1, /* inverse erf by polynomials alone: other last bits */
};
