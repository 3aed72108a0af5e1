/* SPDX-License-Identifier: Apache-2.0 */
/*
 * uniform-jittered: a random position that is the same in all cells of a grid. This is the regular grid shifted by a
 * random offset. The points are unbiased like jittered ones, but have the even spacing and the aliasing of the
 * regular grid.
 *
 *     x_k = (c_k + u_k) / m,   c in {0 .. m-1}^dim, one u for all cells, uniform in [0,1)^dim
 *
 * Source: Ramamoorthi, Anderson, Meyer & Nowrouzezahrai 2012, who find that it is the best stratified pattern for
 * shadows of linear lights, and worse than jittering for planar lights. Known exactly: any two points are at least
 * 1/m apart, on the torus too.
 */
#include "core/random.h"
#include "patterns/grids/grids.h"
#include "patterns/patterns.h"

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    size_t along_x, along_rest, cell[KOKSMA_MAX_DIM] = {0};
    double u[KOKSMA_MAX_DIM + 1];
    const koksma_status status = koksma__cells("uniform-jittered", out, args->params[0], &along_x, &along_rest);
    for (int k = 0; !status && k < out->dim; k += 2) {
        koksma__random_pair(seed, KOKSMA__PURPOSE_POINT, (uint64_t)k / 2, 0, u + k);
    }
    for (size_t i = 0; !status && i < out->n; i++) {
        for (int k = 0; k < out->dim; k++) {
            const double m = (double)(k ? along_rest : along_x);
            out->xs[i * (size_t)out->dim + (size_t)k] = koksma__in_cell((double)cell[k], u[k], m);
        }
        for (int k = out->dim - 1; k >= 0 && ++cell[k] == (k ? along_rest : along_x); k--) {
            cell[k] = 0;
        }
    }
    return status;
}

static const koksma_param params[] = {KOKSMA__PARAM_COLUMNS, {0}};

const koksma_pattern koksma__pattern_uniform_jittered = {
    .name = "uniform-jittered",
    .title = "the same random point in each cell of a grid",
    .cite = "ramamoorthi2012",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_STRATIFIED | KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
};
