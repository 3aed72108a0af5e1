/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions of the line and the plane whose integral and variation are known. Smooth functions: Vitali's variation is
 * the integral of the absolute mixed derivative. Boxes parallel to the axes: the variation is the number of corners
 * inside the square plus the number of points on x = 1 or y = 1 where a side of the box ends. Regions with edges that
 * are not parallel to an axis have infinite variation. The checkerboard of 8 x 8 squares is (1 - c(x) c(y)) / 2,
 * where c jumps 7 times between 1 and -1. docs/findings/koksma-inequality.md uses these functions.
 */
#include <math.h>

#include "core/elementary.h"
#include "integrands/closed_forms.h"

#define MEMBER(id, text, says, n_axes, function, ...)                                                                \
    KOKSMA__CLOSED_MEMBER(id, text, says, "niederreiter1992", n_axes, function, __VA_ARGS__)

static double linear(const koksma_integral *f, const double *x)
{
    (void)f;
    return x[0];
}

static double square(const koksma_integral *f, const double *x)
{
    (void)f;
    return x[0] * x[0];
}

static double wave(const koksma_integral *f, const double *x)
{
    (void)f;
    return koksma__sin(2 * M_PI * x[0]);
}

static double below_third(const koksma_integral *f, const double *x)
{
    (void)f;
    return x[0] < 1.0 / 3 ? 1 : 0;
}

static double saddle(const koksma_integral *f, const double *x)
{
    (void)f;
    return (x[0] - 0.5) * (x[1] - 0.5);
}

static double exponential(const koksma_integral *f, const double *x)
{
    (void)f;
    return koksma__exp(x[0] + x[1]);
}

static double corner_box(const koksma_integral *f, const double *x)
{
    (void)f;
    return x[0] < 0.6 && x[1] < 0.7 ? 1 : 0;
}

static double inner_box(const koksma_integral *f, const double *x)
{
    (void)f;
    return x[0] >= 0.2 && x[0] < 0.7 && x[1] >= 0.3 && x[1] < 0.9 ? 1 : 0;
}

static int cell(double x)
{
    return x < 1 ? (int)(8 * x) : 7;
}

static double checkerboard(const koksma_integral *f, const double *x)
{
    (void)f;
    return (cell(x[0]) + cell(x[1])) % 2;
}

static koksma_status prepare_checkerboard(koksma_integral *f)
{
    f->offset = 0.5;
    const koksma_status status = koksma__integral_of_rows(f);
    f->scale = -0.5;
    if (!status) {
        koksma__integral_of_product(f);
    }
    return status;
}

static double slanted_edge(const koksma_integral *f, const double *x)
{
    (void)f;
    return x[1] < 0.2 + x[0] / 2 ? 1 : 0;
}

static double disk(const koksma_integral *f, const double *x)
{
    const double u = x[0] - 0.5, v = x[1] - 0.5;
    (void)f;
    return u * u + v * v < 0.16 ? 1 : 0;
}

static double turned_checkerboard(const koksma_integral *f, const double *x)
{
    (void)f;
    return (int)(floor(4 * (x[0] + x[1])) + floor(4 * (x[0] - x[1])) + 8) % 2;
}

MEMBER(x, "x", "x", 1, linear, KOKSMA__ROWS({1.0 / 2, 1.0 / 3, 1, 1, 0, 1}));
MEMBER(x2, "x2", "x^2", 1, square, KOKSMA__ROWS({1.0 / 3, 1.0 / 5, 1, 1, 0, 1}));
MEMBER(wave, "wave", "sin 2 pi x", 1, wave, KOKSMA__ROWS({0, 1.0 / 2, 4, 0, -1, 1}));
MEMBER(step, "step", "1 for x < 1/3, else 0", 1, below_third, KOKSMA__ROWS({1.0 / 3, 1.0 / 3, 1, 0, 0, 1}));
MEMBER(saddle, "saddle", "(x - 1/2)(y - 1/2)", 2, saddle,
       KOKSMA__ROWS({0, 1.0 / 12, 1, 0.5, -0.5, 0.5}, {0, 1.0 / 12, 1, 0.5, -0.5, 0.5}));
#define EXP                                                                                                          \
    {                                                                                                                \
        M_E - 1, (M_E * M_E - 1) / 2, M_E - 1, M_E, 1, M_E                                                           \
    }
MEMBER(exp, "exp", "exp(x + y)", 2, exponential, KOKSMA__ROWS(EXP, EXP));
MEMBER(corner, "corner", "1 in the box [0, .6) x [0, .7)", 2, corner_box,
       KOKSMA__ROWS({0.6, 0.6, 1, 0, 0, 1}, {0.7, 0.7, 1, 0, 0, 1}));
MEMBER(box, "box", "1 in the box [.2, .7) x [.3, .9)", 2, inner_box,
       KOKSMA__ROWS({0.5, 0.5, 2, 0, 0, 1}, {0.6, 0.6, 2, 0, 0, 1}));
MEMBER(checker, "checker", "a checkerboard of 8 x 8 squares", 2, checkerboard, .prepare = prepare_checkerboard,
       .constants = (const koksma__factor[]){{0, 1, 14, 1, -1, 1}, {0, 1, 14, 1, -1, 1}});
MEMBER(edge, "edge", "1 below the line y = .2 + x/2", 2, slanted_edge, KOKSMA__PLANE(0.45, 0.45));
MEMBER(disk, "disk", "1 in the disk of radius .4", 2, disk, KOKSMA__PLANE(0.16 * M_PI, 0.16 * M_PI));
MEMBER(turned, "turned", "a checkerboard turned by 45 degrees", 2, turned_checkerboard, KOKSMA__PLANE(0.5, 0.5));
