/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions on which intervals for integrals are tested: a sum of functions of one coordinate, and ridge functions g(z)
 * of z = (Phi^-1(x_1) + .. + Phi^-1(x_d)) / sqrt d, which is standard normal for every d, so that integral and variance
 * are those of g(z), while the effective dimension rises with d for a kink and a jump (Hoyt & Owen 2020). The forms and
 * parameters of sum-exp and of the jump: L'Ecuyer, Nakayama, Owen & Tuffin 2023; of kink and smooth: Jain et al. 2025.
 *
 *     smooth   Phi(z + 1)                          integral Phi(1 / sqrt 2)
 *     kink     (min(max(z, -2), 1) + 2) / 3        a Phi(a) + b Phi(-b) + phi(a) - phi(b) of the clamped z, a = -2, b = 1
 *     jump     1 if z >= 1, else 0                 Phi(-1)
 *
 * The mean square of a smooth g is the integral of g^2 phi by the trapezoidal rule on [-10, 10], whose error is below
 * 1e-15 here.
 */
#include <math.h>

#include "core/elementary.h"
#include "integrands/integrands.h"

enum { SMOOTH, KINK, JUMP };

static double normal(double z)
{
    return koksma__erfc(-z * M_SQRT1_2) / 2;
}

static double density(double z)
{
    return koksma__exp(-z * z / 2) / sqrt(2 * M_PI);
}

/* ---- sum-exp ----------------------------------------------------------------------------------------------------- */

static koksma_status prepare_sum(koksma_integral *f)
{
    f->value = 0;
    f->variance = f->dim * ((koksma__exp(2) - 1) / 4 - 1); /* the mean of x^2 e^2x is (e^2 - 1) / 4 */
    f->variation = f->dim * koksma__exp(1);                /* each term rises from 0 to e */
    f->lowest = -f->dim;
    f->highest = f->dim * (koksma__exp(1) - 1);
    return KOKSMA_OK;
}

static double sum_at(const koksma_integral *f, const double *x)
{
    double sum = -f->dim;
    for (int k = 0; k < f->dim; k++) {
        sum += x[k] * koksma__exp(x[k]);
    }
    return sum;
}

const koksma_integrand koksma__integrand_sum_exp = {
    .name = "sum-exp",
    .title = "x_1 e^x_1 + .. + x_d e^x_d - d",
    .cite = "lecuyer2023",
    .known = "closed form",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .prepare = prepare_sum,
    .at = sum_at,
};

/* ---- ridge ------------------------------------------------------------------------------------------------------- */

static double profile(const koksma_integral *f, double z)
{
    switch ((int)f->params[0]) {
    case SMOOTH:
        return normal(z + 1);
    case KINK:
        return (fmin(fmax(z, -2), 1) + 2) / 3;
    default:
        return z >= 1 ? 1 : 0;
    }
}

static koksma_status prepare_ridge(koksma_integral *f)
{
    const double a = -2, b = 1, between = normal(b) - normal(a);
    const double clamped = a * normal(a) + b * normal(-b) + density(a) - density(b),
                 square = a * a * normal(a) + b * b * normal(-b) + between - b * density(b) + a * density(a);
    double smooth = 0;
    for (int i = -160; i <= 160; i++) {
        smooth += normal(i / 16.0 + 1) * normal(i / 16.0 + 1) * density(i / 16.0) / 16;
    }
    const double values[] = {[SMOOTH] = normal(M_SQRT1_2), [KINK] = (clamped + 2) / 3, [JUMP] = normal(-1)},
                 variances[] = {[SMOOTH] = smooth - values[SMOOTH] * values[SMOOTH],
                                [KINK] = (square - clamped * clamped) / 9,
                                [JUMP] = values[JUMP] * (1 - values[JUMP])};
    f->value = values[(int)f->params[0]];
    f->variance = variances[(int)f->params[0]];
    f->lowest = 0;
    f->highest = 1;
    return KOKSMA_OK;
}

static double ridge_at(const koksma_integral *f, const double *x)
{
    double sum = 0;
    for (int k = 0; k < f->dim; k++) {
        sum += M_SQRT2 * koksma__inverse_erf(2 * x[k] - 1);
    }
    return profile(f, sum / sqrt(f->dim));
}

static const char *const kinds[] = {"smooth", "kink", "jump", NULL};

static const koksma_param params[] = {
    {"kind", "form of g: Phi(z + 1), (min(max(z, -2), 1) + 2) / 3, or 1 from z = 1 on", KINK, SMOOTH, JUMP, kinds,
     true},
    {0},
};

const koksma_integrand koksma__integrand_ridge = {
    .name = "ridge",
    .title = "g(z) of the normalised sum z of normal numbers, one for each coordinate",
    .cite = "hoyt2020 jain2025",
    .known = "closed form",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .params = params,
    .prepare = prepare_ridge,
    .at = ridge_at,
};
