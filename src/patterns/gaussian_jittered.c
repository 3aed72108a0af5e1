/* SPDX-License-Identifier: Apache-2.0 */
/*
 * gaussian-jittered: one point in each cell of a grid, Gaussian about the cell's centre and cut off at the cell's
 * sides (the normal law given that the point is in the cell; no mass piles up on the sides).
 *
 *     x_k = (c_k + 1/2 + sigma z_k) / m,   z normal given |sigma z| < 1/2, by inverting its distribution function
 *
 * Source: Cook 1986, after Shirley 1991, section 5.5.3. Small sigma is nearly regular, large sigma nearly jittered.
 */
#include <math.h>

#include "core/elementary.h"
#include "core/random.h"
#include "patterns/parts/cells.h"
#include "patterns/parts/fill.h"
#include "patterns/patterns.h"

/* t in [-a, a] with erf(t) = p erf(a): Newton's iteration kept inside a bracket that is halved when it strays. */
static double inverse_erf(double p, double a)
{
    const double target = p * koksma__erf(a), slope = 1.1283791670955126; /* 2 / sqrt(pi) */
    double low = -a, high = a, t = fmax(-a, fmin(a, target / slope));
    for (int i = 0; i < 80 && high - low > 1e-16 * a; i++) {
        const double excess = koksma__erf(t) - target;
        if (excess > 0) {
            high = t;
        } else {
            low = t;
        }
        const double next = t - excess / (slope * koksma__exp(-t * t));
        const double last = t;
        t = next > low && next < high ? next : (low + high) / 2;
        if (fabs(t - last) <= 1e-15 * a) {
            break;
        }
    }
    return t;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    size_t along_x, along_rest;
    koksma_status status = koksma__cells("gaussian-jittered", out, args->params[0], &along_x, &along_rest);
    if (!status) {
        status = koksma__fill_uniform(seed, KOKSMA__PURPOSE_POINT, args->run, out->n * (size_t)out->dim, out->xs);
    }
    if (status) {
        return status;
    }
    const double scale = sqrt(2) * args->params[1], a = 0.5 / scale;
    size_t cell[KOKSMA_MAX_DIM] = {0};
    for (size_t i = 0; i < out->n; i++) {
        double *x = out->xs + i * (size_t)out->dim;
        for (int k = 0; k < out->dim; k++) {
            const double u = fmin(fmax(0.5 + scale * inverse_erf(2 * x[k] - 1, a), 0), 1);
            x[k] = koksma__in_cell((double)cell[k], u, (double)(k ? along_rest : along_x));
        }
        for (int k = out->dim - 1; k >= 0 && ++cell[k] == (k ? along_rest : along_x); k--) {
            cell[k] = 0;
        }
    }
    return KOKSMA_OK;
}

static const koksma_param params[] = {
    KOKSMA__PARAM_COLUMNS,
    {"sigma", "standard deviation before the cut, in cell widths", 0.25, 0.001, 1000, NULL, false},
    {0},
};

const koksma_pattern koksma__pattern_gaussian_jittered = {
    .name = "gaussian-jittered",
    .title = "a Gaussian point about the centre of each cell of a grid",
    .cite = "cook1986 shirley1991",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_STRATIFIED,
    .params = params,
    .generate = generate,
};
