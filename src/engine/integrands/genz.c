/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Genz's six families (1984), each with one property that makes integration hard:
 *
 *     oscillatory     cos(2 pi u_1 + sum a_i x_i)
 *     product peak    prod 1 / (a_i^-2 + (x_i - u_i)^2)
 *     corner peak     (1 + sum a_i x_i)^-(d + 1)
 *     Gaussian        exp(-sum a_i^2 (x_i - u_i)^2)
 *     continuous      exp(-sum a_i |x_i - u_i|)
 *     discontinuous   exp(sum a_i x_i) for x_1 <= u_1 and x_2 <= u_2, else 0
 *
 * u and a are random numbers in (0,1) that depend on the seed; the a_i are then scaled such that their sum is the
 * parameter `difficulty`. The default difficulties are those of Barthelmann, Novak and Ritter (2000); Genz's own
 * program takes h / d^e as the sum, with constants h and e for each family.
 *
 * Four of the families are products, and the properties of their factors have closed forms. For the oscillatory
 * family, with s(t) = sin(t) / t,
 *
 *     E(f | x_v)          r cos(2 pi u_1 + sum_v a x + theta),
 *                         r = prod_{i not in v} s(a_i / 2), theta = sum_{not v} a / 2
 *     E(E(f | x_v)^2)     r^2 / 2 (1 + cos(4 pi u_1 + sum a) prod_v s(a_i))
 *
 * The corner peak is 1/d! times the integral over t of t^d exp(-t - t sum a_i x_i). Its integral is therefore an
 * integral over t that contains the product of (1 - exp(-a_i t)) / (a_i t); the same holds for the square of the
 * corner peak, with 2 d + 1 in place of d. Both integrals over t are computed by the trapezoidal rule in log t, which
 * converges exponentially and avoids the cancellation of the closed form, a sum over the 2^d corners of the cube. The
 * integral over t also gives the variation of the corner peak, f(0) - f(1, .., 1).
 */
#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/random.h"
#include "core/status.h"
#include "core/sum.h"
#include "integrands/closed_forms.h"

/* Draws a and u from the seed. */
static koksma_status draw(koksma_integral *f)
{
    const size_t d = (size_t)f->dim;
    f->a = malloc(2 * d * sizeof *f->a);
    KOKSMA__REQUIRE_MEMORY(f->a, 2 * d * sizeof *f->a);
    f->b = f->a + d;
    double sum = 0;
    for (size_t i = 0; i < d; i++) {
        double pair[2];
        koksma__random_pair((uint64_t)f->params[1], KOKSMA__PURPOSE_SEED, i, 0, pair);
        f->a[i] = pair[0] + 0x1p-54; /* not 0 */
        f->b[i] = pair[1];
        sum += f->a[i];
    }
    for (size_t i = 0; i < d; i++) {
        f->a[i] *= f->params[0] / sum;
    }
    return KOKSMA_OK;
}

/* ---- Products: mean, square and variation of a factor with a and u ----------------------------------------- */

typedef koksma__factor factor_of(double a, double u, bool cut);

static koksma_status prepare_product(koksma_integral *f, factor_of *factor)
{
    koksma_status status = draw(f);
    status = status ? status : koksma__integral_factors(f);
    for (int i = 0; !status && i < f->axes; i++) {
        f->factors[i] = factor(f->a[i], f->b[i], i < 2);
    }
    if (!status) {
        koksma__integral_of_product(f);
    }
    return status;
}

/* Describes a factor with a peak of height `top` at u and the values at_0 and at_1 at the ends. */
static koksma__factor peak(double mean, double square, double top, double at_0, double at_1)
{
    return (koksma__factor){.mean = mean,
                            .square = square,
                            .variation = (top - at_0) + (top - at_1),
                            .end = at_1,
                            .lowest = fmin(at_0, at_1),
                            .highest = top};
}

/* Returns the integral of 1 / (1 + s^2)^2 from 0 to t. */
static double square_of_peak(double t)
{
    return (t / (1 + t * t) + koksma__atan(t)) / 2;
}

static koksma__factor product_peak(double a, double u, bool cut)
{
    (void)cut;
    const double right = a * (1 - u), left = a * u, top = a * a;
    return peak(a * (koksma__atan(right) + koksma__atan(left)),
                a * a * a * (square_of_peak(right) + square_of_peak(left)), top, top / (1 + left * left),
                top / (1 + right * right));
}

static koksma__factor gaussian(double a, double u, bool cut)
{
    (void)cut;
    const double right = a * (1 - u), left = a * u;
    return peak(sqrt(M_PI) / 2 / a * (koksma__erf(right) + koksma__erf(left)),
                sqrt(M_PI / 8) / a * (koksma__erf(M_SQRT2 * right) + koksma__erf(M_SQRT2 * left)), 1,
                koksma__exp(-left * left), koksma__exp(-right * right));
}

static koksma__factor continuous(double a, double u, bool cut)
{
    (void)cut;
    const double right = -a * (1 - u), left = -a * u;
    return peak(-(koksma__expm1(right) + koksma__expm1(left)) / a,
                -(koksma__expm1(2 * right) + koksma__expm1(2 * left)) / (2 * a), 1, koksma__exp(left),
                koksma__exp(right));
}

static koksma__factor discontinuous(double a, double u, bool cut)
{
    const double to = cut ? a * u : a, rise = koksma__expm1(to);
    return (koksma__factor){.mean = rise / a,
                            .square = koksma__expm1(2 * to) / (2 * a),
                            .variation = cut ? rise + koksma__exp(to) : rise,
                            .end = cut ? 0 : koksma__exp(to),
                            .lowest = cut ? 0 : 1,
                            .highest = koksma__exp(to)};
}

static koksma_status prepare_product_peak(koksma_integral *f)
{
    return prepare_product(f, product_peak);
}

static koksma_status prepare_gaussian(koksma_integral *f)
{
    return prepare_product(f, gaussian);
}

static koksma_status prepare_continuous(koksma_integral *f)
{
    return prepare_product(f, continuous);
}

static koksma_status prepare_discontinuous(koksma_integral *f)
{
    return prepare_product(f, discontinuous);
}

static double product_peak_at(const koksma_integral *f, const double *x)
{
    double product = 1;
    for (int i = 0; i < f->dim; i++) {
        const double t = f->a[i] * (x[i] - f->b[i]);
        product *= f->a[i] * f->a[i] / (1 + t * t);
    }
    return product;
}

static double gaussian_at(const koksma_integral *f, const double *x)
{
    double sum = 0;
    for (int i = 0; i < f->dim; i++) {
        const double t = f->a[i] * (x[i] - f->b[i]);
        sum += t * t;
    }
    return koksma__exp(-sum);
}

static double continuous_at(const koksma_integral *f, const double *x)
{
    double sum = 0;
    for (int i = 0; i < f->dim; i++) {
        sum += f->a[i] * fabs(x[i] - f->b[i]);
    }
    return koksma__exp(-sum);
}

static double sum_at(const koksma_integral *f, const double *x)
{
    double sum = 0;
    for (int i = 0; i < f->dim; i++) {
        sum += f->a[i] * x[i];
    }
    return sum;
}

static double discontinuous_at(const koksma_integral *f, const double *x)
{
    return x[0] > f->b[0] || (f->dim > 1 && x[1] > f->b[1]) ? 0 : koksma__exp(sum_at(f, x));
}

/* ---- The oscillatory family -------------------------------------------------------------------------------- */

static double sine_ratio(double t)
{
    return t == 0 ? 1 : koksma__sin(t) / t;
}

static double oscillatory_mean(const koksma_integral *f)
{
    double angle = 2 * M_PI * f->b[0], r = 1;
    for (int i = 0; i < f->dim; i++) {
        angle += f->a[i] / 2;
        r *= sine_ratio(f->a[i] / 2);
    }
    return r * koksma__cos(angle);
}

static double oscillatory_at(const koksma_integral *f, const double *x)
{
    return koksma__cos(2 * M_PI * f->b[0] + sum_at(f, x));
}

static koksma_status prepare_oscillatory(koksma_integral *f)
{
    KOKSMA__TRY(draw(f));
    double angle = 4 * M_PI * f->b[0], product = 1;
    for (int i = 0; i < f->dim; i++) {
        angle += f->a[i];
        product *= sine_ratio(f->a[i]);
    }
    f->value = oscillatory_mean(f);
    f->variance = (1 + koksma__cos(angle) * product) / 2 - f->value * f->value;
    f->lowest = -1;
    f->highest = 1;
    return KOKSMA_OK;
}

/* ---- The corner peak ---------------------------------------------------------------------------------------- */

/* Returns the integral over the cube of (1 + sum a x)^-(k + 1): 1/k! times the integral over y = log t of t^(k+1)
   exp(-t) prod (1 - exp(-a t)) / (a t). The peak of t^(k+1) exp(-t) at t = k + 1 has width 1 / sqrt(k + 1) in y. */
static double peak_integral(const koksma_integral *f, double k)
{
    const double step = 0.2 / sqrt(k + 1), middle = koksma__log(k + 1);
    const int below = (int)ceil((40 / (k + 1) + 4) / step), above = (int)ceil(5 / step);
    koksma__sum sum = {0};
    for (int j = -below; j <= above; j++) {
        const double y = middle + j * step, t = koksma__exp(y);
        double weight = koksma__exp((k + 1) * y - t - koksma__log_gamma(k + 1));
        for (int i = 0; i < f->dim && weight > 0; i++) {
            weight *= -koksma__expm1(-f->a[i] * t) / (f->a[i] * t);
        }
        koksma__sum_add(&sum, step * weight);
    }
    return koksma__sum_value(&sum);
}

static double corner_peak(int dim, double sum)
{
    double power = 1;
    for (int i = 0; i <= dim; i++) {
        power *= 1 + sum;
    }
    return 1 / power;
}

static double corner_peak_at(const koksma_integral *f, const double *x)
{
    return corner_peak(f->dim, sum_at(f, x));
}

static koksma_status prepare_corner_peak(koksma_integral *f)
{
    KOKSMA__TRY(draw(f));
    f->value = peak_integral(f, f->dim);
    f->variance = peak_integral(f, 2 * f->dim + 1) - f->value * f->value;
    f->highest = 1;
    f->lowest = corner_peak(f->dim, f->params[0]);
    f->variation = 1 - f->lowest;
    return KOKSMA_OK;
}

#define MEMBER(id, text, says, how, sum, preparation, function)                                                      \
    const koksma_integrand koksma__integrand_genz_##id = {                                                           \
        .name = "genz-" text,                                                                                        \
        .title = says,                                                                                               \
        .cite = "genz1984 barthelmann2000",                                                                          \
        .revision = 1, /* own elementary functions */                                                                \
        .known = how,                                                                                                \
        .min_dim = 1,                                                                                                \
        .max_dim = KOKSMA_MAX_DIM,                                                                                   \
        .params = (const koksma_param[]){{"difficulty", "sum of all a", sum, 1e-3, 1000, NULL, false},               \
                                         {"seed", "seed of the random a and u", 0, 0, 0x1p53, NULL, true},           \
                                         {0}},                                                                       \
        .prepare = preparation,                                                                                      \
        .at = function,                                                                                              \
    }

MEMBER(oscillatory, "oscillatory", "cos(2 pi u + sum a x)", "closed form", 9, prepare_oscillatory, oscillatory_at);
MEMBER(product_peak, "product-peak", "prod 1 / (a^-2 + (x - u)^2)", "closed form", 7.25, prepare_product_peak,
       product_peak_at);
MEMBER(corner_peak, "corner-peak", "(1 + sum a x)^-(d + 1)",
       "trapezoidal rule in one dimension, correct to 14 digits", 1.85, prepare_corner_peak, corner_peak_at);
MEMBER(gaussian, "gaussian", "exp(-sum a^2 (x - u)^2)", "closed form", 7.03, prepare_gaussian, gaussian_at);
MEMBER(continuous, "continuous", "exp(-sum a |x - u|)", "closed form", 20.4, prepare_continuous, continuous_at);
MEMBER(discontinuous, "discontinuous", "exp(sum a x) for x_1 <= u_1, x_2 <= u_2, else 0", "closed form", 4.3,
       prepare_discontinuous, discontinuous_at);
