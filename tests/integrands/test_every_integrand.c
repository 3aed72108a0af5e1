/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Walks the table of integrands, with each choice of a parameter and some of its numbers, in 1 to 3 dimensions: values
 * against the definitions below, integral and variance against sums over fine grids.
 */
#include <stdlib.h>
#include <string.h>

#include "integrands/integrands.h"
#include "test.h"

/* ---- Definitions, from the papers ----------------------------------------------------------------------------- */

/* B_r by the recursion B_r' = r B_{r-1} and mean 0, as sums of powers from Abramowitz & Stegun 1964, 23.1. */
static double bernoulli(int r, double x)
{
    switch (r) {
    case 1:
        return x - 0.5;
    case 2:
        return x * x - x + 1.0 / 6;
    case 3:
        return x * (x - 0.5) * (x - 1);
    case 4:
        return x * x * (x - 1) * (x - 1) - 1.0 / 30;
    default:
        fail_msg("no definition of B_%d", r);
        return 0;
    }
}

/* The normal number of probability p, by bisection. */
static double normal_of(double p)
{
    double low = -10, high = 10;
    for (int i = 0; i < 80; i++) {
        const double z = (low + high) / 2;
        *(erfc(-z / sqrt(2)) / 2 < p ? &low : &high) = z;
    }
    return low;
}

/* The path itself, price by price. */
static double asian(const koksma_integral *f, const double *x)
{
    double w[4] = {0}, sum = 0; /* W at step 0 .. d */
    const int d = f->dim;
    const double dt = 1.0 / d, v = f->params[1];
    if (f->params[2] == 1) {
        w[d] = normal_of(x[0]);
        if (d == 2) {
            w[1] = w[2] / 2 + normal_of(x[1]) / 2; /* sqrt(.5 .5 / 1) */
        } else if (d == 3) {
            w[1] = w[3] / 3 + sqrt(2.0 / 9) * normal_of(x[1]);
            w[2] = (w[1] + w[3]) / 2 + sqrt(1.0 / 6) * normal_of(x[2]);
        }
    } else {
        for (int k = 0; k < d; k++) {
            w[k + 1] = w[k] + sqrt(dt) * normal_of(x[k]);
        }
    }
    for (int k = 1; k <= d; k++) {
        sum += log(100 * exp((0.05 - v * v / 2) * k * dt + v * w[k])) / d;
    }
    return exp(-0.05) * fmax(exp(sum) - f->params[0], 0);
}

static double genz(const char *name, const koksma_integral *f, const double *x)
{
    const double *a = f->a, *u = f->b;
    double sum = 0, product = 1;
    for (int i = 0; i < f->dim; i++) {
        if (!strcmp(name, "gaussian")) {
            sum += a[i] * a[i] * (x[i] - u[i]) * (x[i] - u[i]);
        } else if (!strcmp(name, "continuous")) {
            sum += a[i] * fabs(x[i] - u[i]);
        } else {
            sum += a[i] * x[i];
        }
        product /= 1 / (a[i] * a[i]) + (x[i] - u[i]) * (x[i] - u[i]);
    }
    if (!strcmp(name, "oscillatory")) {
        return cos(2 * M_PI * u[0] + sum);
    }
    if (!strcmp(name, "product-peak")) {
        return product;
    }
    if (!strcmp(name, "corner-peak")) {
        return pow(1 + sum, -(f->dim + 1.0));
    }
    if (!strcmp(name, "discontinuous")) {
        return x[0] > u[0] || (f->dim > 1 && x[1] > u[1]) ? 0 : exp(sum);
    }
    return exp(-sum);
}

/* Whether 8 x 8 squares, or the diagonals' of side sqrt(2)/8, are white. */
static double checker(double u, double v)
{
    return (long)(floor(u) + floor(v) + 100) % 2;
}

static double defined(const koksma_integral *f, const double *x)
{
    const char *name = f->integrand->name;
    const double r2 = f->dim > 1 ? x[0] * x[0] + x[1] * x[1] : 0,
                 c2 = f->dim > 1 ? pow(x[0] - 0.5, 2) + pow(x[1] - 0.5, 2) : 0;
    if (!strncmp(name, "genz-", 5)) {
        return genz(name + 5, f, x);
    }
    if (!strcmp(name, "asian")) {
        return asian(f, x);
    }
    if (!strcmp(name, "bernoulli")) {
        double product = 1;
        for (int j = 0; j < f->dim; j++) {
            product *= 1 + f->params[1] / pow(j + 1, f->params[2]) * bernoulli((int)f->params[0], x[j]);
        }
        return product;
    }
    if (!strcmp(name, "sum-exp") || !strcmp(name, "ridge")) {
        double sum = 0, z = 0;
        for (int j = 0; j < f->dim; j++) {
            sum += x[j] * exp(x[j]) - 1;
            z += normal_of(x[j]) / sqrt(f->dim);
        }
        const double g[] = {erfc(-(z + 1) / sqrt(2)) / 2, (z < -2 ? 0 : z > 1 ? 3 : z + 2) / 3, z >= 1};
        return *name == 's' ? sum : g[(int)f->params[0]];
    }
    const double y = f->dim > 1 ? x[1] : 0;
    const struct {
        const char *name;
        double value;
    } plane[] = {
        {"x", x[0]},
        {"x2", x[0] * x[0]},
        {"wave", sin(2 * M_PI * x[0])},
        {"step", x[0] < 1.0 / 3},
        {"step-pi", x[0] < 1 / M_PI},
        {"saddle", (x[0] - 0.5) * (y - 0.5)},
        {"exp", exp(x[0]) * exp(y)},
        {"corner", x[0] < 0.6 && y < 0.7},
        {"box", x[0] >= 0.2 && x[0] < 0.7 && y >= 0.3 && y < 0.9},
        {"checker", checker(8 * x[0], 8 * y)},
        {"edge", y - x[0] / 2 < 0.2},
        {"disk", sqrt(c2) < 0.4},
        {"turned", checker(4 * (x[0] + y), 4 * (x[0] - y))},
        {"quarter-disk", r2 < 2 / M_PI},
        {"triangle", y > x[0]},
        {"quarter-gaussian", exp(-r2)},
        {"bilinear", x[0] * y},
    };
    for (size_t i = 0; i < sizeof plane / sizeof *plane; i++) {
        if (!strcmp(plane[i].name, name)) {
            return plane[i].value;
        }
    }
    fail_msg("%s has no definition here", name);
    return 0;
}

/* ---- The walk -------------------------------------------------------------------------------------------------- */

static const char *const more[] = {"bernoulli:r=1",
                                   "bernoulli:r=3,w=3",
                                   "bernoulli:r=4,decay=0,w=10",
                                   "ridge:kind=smooth",
                                   "ridge:kind=jump",
                                   "asian:path=bridge",
                                   "asian:strike=120,volatility=0.5",
                                   "genz-oscillatory:seed=5,difficulty=3",
                                   "genz-corner-peak:seed=7,difficulty=6",
                                   "genz-product-peak:seed=2,difficulty=2",
                                   "genz-gaussian:seed=3,difficulty=2",
                                   "genz-continuous:seed=4,difficulty=3",
                                   "genz-discontinuous:seed=8,difficulty=1"};

typedef void visit(const char *spec, koksma_integral *f);

/* Calls visit with every integrand in 1 to 3 dimensions. */
static void walk(visit *look)
{
    const koksma_integrand *member;
    const size_t n_more = sizeof more / sizeof *more;
    size_t count = 0;
    for (size_t i = 0; i < n_more || koksma_integrand_at(i - n_more); i++) {
        const char *spec = i < n_more ? more[i] : koksma_integrand_at(i - n_more)->name;
        for (int dim = 1; dim <= 3; dim++) {
            koksma_integral *f;
            const koksma_status status = koksma_integral_open(spec, dim, &f);
            if (status == KOKSMA_DIM) {
                continue;
            }
            assert_ok(status);
            member = f->integrand;
            assert_true(dim >= member->min_dim && dim <= member->max_dim);
            look(spec, f);
            koksma_integral_close(f);
            count++;
        }
    }
    assert_true(count > 90);
}

static void look_at_values(const char *spec, koksma_integral *f)
{
    const koksma_points points = test_points("random", 500, f->dim, 11);
    double values[500];
    assert_ok(koksma_integral_values(f, &points, NULL, values));
    double sum = 0, mean;
    for (size_t i = 0; i < points.n; i++) {
        const double *x = points.xs + i * (size_t)f->dim, expected = defined(f, x);
        assert_that(fabs(values[i] - expected) <= 1e-11 * (1 + fabs(expected)) &&
                        values[i] >= f->lowest * (1 - 1e-14) - 1e-300 && values[i] <= f->highest * (1 + 1e-14),
                    "%s in %d dimensions at %.17g, ..: %.17g, by definition %.17g; range %g to %g", spec, f->dim,
                    x[0], values[i], expected, f->lowest, f->highest);
        sum += values[i] / 500;
    }
    assert_ok(koksma_integrate(f, &points, NULL, &mean));
    assert_near(mean, sum, 1e-13 * (1 + fabs(sum)));
    koksma_points dirty = points;
    dirty.xs[3] = 1.5;
    assert_int_equal(koksma_integrate(f, &dirty, NULL, &mean), KOKSMA_ARGUMENT);
    koksma_points_fini(&dirty);
}

TEST_CASE(values_are_those_of_the_definitions)
{
    walk(look_at_values);
}

/* Parameters of Genz's families: a of the given sum, all in range, others with another seed. */
TEST_CASE(genz_parameters_are_scaled)
{
    koksma_integral *f, *g;
    assert_ok(koksma_integral_open("genz-gaussian:difficulty=3", 7, &f));
    assert_ok(koksma_integral_open("genz-gaussian:difficulty=3,seed=1", 7, &g));
    double sum = 0;
    for (int i = 0; i < 7; i++) {
        sum += f->a[i];
        assert_true(f->a[i] > 0 && f->b[i] >= 0 && f->b[i] < 1 && f->b[i] != g->b[i]);
    }
    assert_near(sum, 3, 1e-14);
    koksma_integral_close(f);
    koksma_integral_close(g);
}

enum { CELLS_3 = 96, CELLS_2 = 800, CELLS_1 = 400000 };

/* Mean and mean square by the midpoint rule. */
typedef struct sums {
    double mean, square;
} sums;

static sums sums_of(const koksma_integral *f)
{
    const int cells = f->dim == 1 ? CELLS_1 : f->dim == 2 ? CELLS_2 : CELLS_3;
    double x[3];
    sums s = {0};
    int at[3] = {0};
    const double volume = pow(cells, -f->dim);
    for (bool more_cells = true; more_cells;) {
        for (int k = 0; k < f->dim; k++) {
            x[k] = (at[k] + 0.5) / cells;
        }
        const double value = f->integrand->at(f, x);
        s.mean += value * volume;
        s.square += value * value * volume;
        int k = 0;
        while (k < f->dim && ++at[k] == cells) {
            at[k++] = 0;
        }
        more_cells = k < f->dim;
    }
    return s;
}

/* A cut cell of an edge is wrong by half at most. */
static void look_at_sums(const char *spec, koksma_integral *f)
{
    const sums s = sums_of(f);
    const double tail = isinf(f->highest) ? 10 : 1; /* the grid ends half a cell before the singularity */
    const double sd = sqrt(f->variance), part = tail * (f->dim == 1 ? 2e-5 : f->dim == 2 ? 3e-3 : 2e-2);
    assert_that(fabs(s.mean - f->value) <= part * sd &&
                    fabs(s.square - s.mean * s.mean - f->variance) <= 2 * part * f->variance,
                "%s in %d dimensions: integral %.10g, on a grid %.10g; variance %.10g, on a grid %.10g", spec, f->dim,
                f->value, s.mean, f->variance, s.square - s.mean * s.mean);
}

TEST_CASE(integrals_and_variances_hold)
{
    walk(look_at_sums);
}

/* ---- Numbers that others have published ------------------------------------------------------------------------ */

TEST_CASE(known_numbers)
{
    const struct {
        const char *spec;
        int dim;
        double value;
    } all[] = {
        {"asian", 1, 10.450583572185565},           /* Black & Scholes, S = K = 100, r = .05, v = .2, T = 1 */
        {"quarter-gaussian", 2, 0.557746285351034}, /* pi / 4 erf(1)^2 */
        {"quarter-disk", 2, 0.5},
        {"bernoulli:r=6,w=2", 5, 1},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        koksma_integral *f;
        assert_ok(koksma_integral_open(all[i].spec, all[i].dim, &f));
        assert_near(f->value, all[i].value, 1e-13 * fmax(1, all[i].value));
        koksma_integral_close(f);
    }
}

/* In many dimensions, where sums over corners would cancel: by random points, within four standard errors. */
static void look_in_high_dimensions(const char *spec, int dim)
{
    koksma_integral *f;
    koksma_spec pattern;
    koksma_integration result;
    const koksma_integration_options options = {.sizes = {4096}, .n_sizes = 1, .seed = 5, .trials = 16};
    assert_ok(koksma_integral_open(spec, dim, &f));
    assert_ok(koksma_pattern_spec("random", &pattern));
    assert_ok(koksma_integration_errors(f, &pattern, &options, NULL, &result));
    const koksma_integration_row *row = &result.rows[0];
    assert_that(fabs(row->mean - f->value) <= 4 * sqrt(f->variance / 4096 / 16) && row->gain > 0.3 && row->gain < 3,
                "%s in %d dimensions: %g, estimated %g; gain of random points %g", spec, dim, f->value, row->mean,
                row->gain);
    koksma_integral_close(f);
}

TEST_CASE(many_dimensions_hold)
{
    static const char *const specs[] = {"genz-corner-peak:difficulty=0.5",
                                        "genz-oscillatory:difficulty=3",
                                        "genz-gaussian:difficulty=3",
                                        "genz-continuous:difficulty=3",
                                        "asian",
                                        "asian:path=bridge",
                                        "bernoulli",
                                        "disk"};
    for (size_t i = 0; i < sizeof specs / sizeof *specs; i++) {
        look_in_high_dimensions(specs[i], 20);
        look_in_high_dimensions(specs[i], 64);
    }
}

/* The bridge's path and that by steps have one distribution. */
TEST_CASE(paths_of_asian_options_agree)
{
    for (int dim = 1; dim <= 4096; dim = dim * 2 + dim % 7) {
        koksma_integral *steps, *bridge;
        assert_ok(koksma_integral_open("asian", dim, &steps));
        assert_ok(koksma_integral_open("asian:path=bridge", dim, &bridge));
        assert_near(steps->value, bridge->value, 1e-10);
        assert_near(steps->variance, bridge->variance, 1e-8);
        koksma_integral_close(steps);
        koksma_integral_close(bridge);
    }
}
