/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions whose integral and variation are known: smooth ones, whose mixed derivative integrates to Vitali's
 * variation; boxes along the axes, with 1 for each corner inside the square and for each end of a side at x = 1 or
 * y = 1; and edges that are not along an axis, of which any grid's rectangles see more the finer it is. With k x k
 * squares of a checkerboard (k - 1)^2 corners have 2 each, and 2(k - 1) ends 1.
 */
#include "study/report/integrands.h"

#include <math.h>

static double linear(const double *x)
{
    return x[0];
}

static double square(const double *x)
{
    return x[0] * x[0];
}

static double wave(const double *x)
{
    return sin(2 * M_PI * x[0]);
}

static double below_third(const double *x)
{
    return x[0] < 1.0 / 3 ? 1 : 0;
}

static double saddle(const double *x)
{
    return (x[0] - 0.5) * (x[1] - 0.5);
}

static double exponential(const double *x)
{
    return exp(x[0] + x[1]);
}

static double corner_box(const double *x)
{
    return x[0] < 0.6 && x[1] < 0.7 ? 1 : 0;
}

static double inner_box(const double *x)
{
    return x[0] >= 0.2 && x[0] < 0.7 && x[1] >= 0.3 && x[1] < 0.9 ? 1 : 0;
}

static int cell(double x)
{
    return x < 1 ? (int)(8 * x) : 7;
}

static double checkerboard(const double *x)
{
    return (cell(x[0]) + cell(x[1])) % 2;
}

static double slanted_edge(const double *x)
{
    return x[1] < 0.2 + x[0] / 2 ? 1 : 0;
}

static double disk(const double *x)
{
    const double u = x[0] - 0.5, v = x[1] - 0.5;
    return u * u + v * v < 0.16 ? 1 : 0;
}

static double turned_checkerboard(const double *x)
{
    return (int)(floor(4 * (x[0] + x[1])) + floor(4 * (x[0] - x[1])) + 8) % 2;
}

static const koksma__integrand integrands[] = {
    {"x", "x", 1, linear, 1.0 / 2, 1, 1},
    {"x2", "x^2", 1, square, 1.0 / 3, 1, 1},
    {"wave", "sin 2 pi x", 1, wave, 0, 4, 2},
    {"step", "1 for x < 1/3, else 0", 1, below_third, 1.0 / 3, 1, 1},
    {"saddle", "(x - 1/2)(y - 1/2)", 2, saddle, 0, 2, 0.5},
    {"exp", "exp(x + y)", 2, exponential, (M_E - 1) * (M_E - 1), (M_E - 1) * (3 * M_E - 1), M_E *M_E - 1},
    {"corner", "1 in the box [0, .6) x [0, .7)", 2, corner_box, 0.42, 1, 1},
    {"box", "1 in the box [.2, .7) x [.3, .9)", 2, inner_box, 0.3, 4, 1},
    {"checker", "a checkerboard of 8 x 8 squares", 2, checkerboard, 0.5, 112, 1},
    {"edge", "1 below the line y = .2 + x/2", 2, slanted_edge, 0.45, HUGE_VAL, 1},
    {"disk", "1 in the disk of radius .4", 2, disk, 0.16 * M_PI, HUGE_VAL, 1},
    {"turned", "a checkerboard turned by 45 degrees", 2, turned_checkerboard, 0.5, HUGE_VAL, 1},
};

const koksma__integrand *koksma__integrand_at(size_t i)
{
    return i < sizeof integrands / sizeof *integrands ? &integrands[i] : NULL;
}
