/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The functions with which Christensen et al. (2018) and later papers compare sequences: a quarter of a disk, a
 * triangle, a step, a quarter of a Gaussian and a bilinear function.
 * The square of the quarter disk's radius is 2/pi, which makes the integral 1/2.
 */
#include <math.h>

#include "core/elementary.h"
#include "integrands/closed_forms.h"

static double quarter_disk(const koksma_integral *f, const double *x)
{
    (void)f;
    return x[0] * x[0] + x[1] * x[1] < M_2_PI ? 1 : 0;
}

static double triangle(const koksma_integral *f, const double *x)
{
    (void)f;
    return x[1] > x[0] ? 1 : 0;
}

static double step_pi(const koksma_integral *f, const double *x)
{
    (void)f;
    return x[0] < M_1_PI ? 1 : 0;
}

static double quarter_gaussian(const koksma_integral *f, const double *x)
{
    (void)f;
    return koksma__exp(-(x[0] * x[0] + x[1] * x[1]));
}

/* exp(-x^2) has the mean sqrt(pi) erf(1) / 2; its square has the mean sqrt(pi / 2) erf(sqrt 2) / 2. */
static koksma_status prepare_gaussian(koksma_integral *f)
{
    const koksma_status status = koksma__integral_factors(f);
    for (int i = 0; !status && i < 2; i++) {
        f->factors[i] = (koksma__factor){.mean = sqrt(M_PI) * koksma__erf(1) / 2,
                                         .square = sqrt(M_PI / 2) * koksma__erf(M_SQRT2) / 2,
                                         .variation = 1 - 1 / M_E,
                                         .end = 1 / M_E,
                                         .lowest = 1 / M_E,
                                         .highest = 1};
    }
    if (!status) {
        koksma__integral_of_product(f);
    }
    return status;
}

static double bilinear(const koksma_integral *f, const double *x)
{
    (void)f;
    return x[0] * x[1];
}

#define MEMBER(id, text, says, n_axes, function, ...)                                                                \
    KOKSMA__CLOSED_MEMBER(id, text, says, "christensen2018", n_axes, function, __VA_ARGS__)

MEMBER(quarter_disk, "quarter-disk", "1 for x^2 + y^2 < 2/pi, else 0", 2, quarter_disk, KOKSMA__PLANE(0.5, 0.5));
MEMBER(triangle, "triangle", "1 for y > x, else 0", 2, triangle, KOKSMA__PLANE(0.5, 0.5));
MEMBER(step_pi, "step-pi", "1 for x < 1/pi, else 0", 1, step_pi, KOKSMA__ROWS({M_1_PI, M_1_PI, 1, 0, 0, 1}));
MEMBER(quarter_gaussian, "quarter-gaussian", "exp(-x^2 - y^2)", 2, quarter_gaussian, .prepare = prepare_gaussian);
MEMBER(bilinear, "bilinear", "x y", 2, bilinear,
       KOKSMA__ROWS({1.0 / 2, 1.0 / 3, 1, 1, 0, 1}, {1.0 / 2, 1.0 / 3, 1, 1, 0, 1}));
