/* SPDX-License-Identifier: Apache-2.0 */
/*
 * bernoulli: prod (1 + w j^-decay B_r(x_j)) over the coordinates j = 1 .. d, B_r being Bernoulli's polynomial (Dick &
 * Pillichshammer 2010). Its integral is 1. Continued with period 1, it has r - 2 continuous derivatives; for r = 1 it
 * has a jump. r is the smoothness. The mean of B_r^2 is (r!)^2 |B_2r| / (2 r)!.
 *
 * Variation of B_r over [0,1]: B_r' = r B_{r-1}. For even r the only extremum inside (0, 1) is at 1/2. For odd r >= 3
 * there are two extrema, at the roots of B_{r-1}, and B_r(0) = B_r(1/2) = B_r(1) = 0.
 */
#include <math.h>

#include "core/elementary.h"
#include "core/status.h"
#include "integrands/closed_forms.h"

enum { MOST = 8 };

/* B_r(x) = sum binomial(r, k) B_k x^(r - k), evaluated by Horner's rule. */
static double polynomial(int r, double x)
{
    static const double numbers[] = {1, -0.5, 1.0 / 6, 0, -1.0 / 30, 0, 1.0 / 42, 0, -1.0 / 30};
    double value = 0, binomial = 1;
    for (int k = 0; k <= r; k++) {
        value = value * x + binomial * numbers[k];
        binomial = binomial * (r - k) / (k + 1);
    }
    return value;
}

/* Returns the root of B_r in (0, 1/2) for even r, by bisection: B_r is monotone on [0, 1/2]. */
static double root(int r)
{
    double low = 0, high = 0.5;
    const double sign = polynomial(r, 0) > 0 ? 1 : -1;
    while (high - low > 0x1p-52) {
        const double middle = (low + high) / 2;
        *(sign * polynomial(r, middle) > 0 ? &low : &high) = middle;
    }
    return low;
}

static double mean_square(int r)
{
    static const double numbers[] = {1,        1.0 / 6,      1.0 / 30, 1.0 / 42,    1.0 / 30,
                                     5.0 / 66, 691.0 / 2730, 7.0 / 6,  3617.0 / 510}; /* |B_2r| */
    double ratio = 1;
    for (int k = 1; k <= r; k++) {
        ratio *= (double)k / (r + k);
    }
    return ratio * numbers[r];
}

static koksma_status prepare(koksma_integral *f)
{
    const int r = (int)f->params[0];
    KOKSMA__TRY(koksma__integral_factors(f));
    const double top = r == 1 ? 0.5 : r % 2 ? polynomial(r, root(r - 1)) : polynomial(r, 0.5);
    const double other = r % 2 ? -top : polynomial(r, 0);
    const double variation = r == 1 ? 1 : r % 2 ? 4 * fabs(top) : 2 * fabs(top - other);
    for (int j = 0; j < f->axes; j++) {
        const double w = f->params[1] * koksma__pow(j + 1, -f->params[2]);
        f->factors[j] = (koksma__factor){.mean = 1,
                                         .square = 1 + w * w * mean_square(r),
                                         .variation = w * variation,
                                         .end = fabs(1 + w * polynomial(r, 1)),
                                         .lowest = 1 + w * fmin(top, other),
                                         .highest = 1 + w * fmax(top, other)};
    }
    koksma__integral_of_product(f);
    return KOKSMA_OK;
}

static double at(const koksma_integral *f, const double *x)
{
    double product = 1;
    for (int j = 0; j < f->dim; j++) {
        product *= 1 + f->params[1] * koksma__pow(j + 1, -f->params[2]) * polynomial((int)f->params[0], x[j]);
    }
    return product;
}

static const koksma_param params[] = {
    {"r", "degree r of the polynomial, which is the smoothness", 2, 1, MOST, NULL, true},
    {"w", "weight w of the first coordinate", 1, 1e-6, 100, NULL, false},
    {"decay", "coordinate j has the weight w j^-decay", 2, 0, 10, NULL, false},
    {0},
};

const koksma_integrand koksma__integrand_bernoulli = {
    .name = "bernoulli",
    .title = "prod (1 + w j^-decay B_r(x_j))",
    .cite = "dick2010",
    .revision = 1, /* own elementary functions */
    .known = "closed form",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .params = params,
    .prepare = prepare,
    .at = at,
};
