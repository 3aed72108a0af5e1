/* SPDX-License-Identifier: Apache-2.0 */
/* The L2 measures of disks on the torus: published sets, the definition by Monte Carlo, cells against plain pairs,
   means over random sets, and the sampled form against the exact one. */
#include "sets.h"

static double radical_inverse(size_t i, size_t base)
{
    double value = 0, digit = 1;
    for (; i; i /= base) {
        digit /= (double)base;
        value += digit * (double)(i % base);
    }
    return value;
}

/* The second Sobol' coordinate: direction numbers of the polynomial x + 1. */
static double sobol_second(size_t i)
{
    uint32_t direction = 1u << 31, value = 0;
    for (; i; i /= 2) {
        value ^= i % 2 ? direction : 0;
        direction ^= direction >> 1;
    }
    return value * 0x1p-32;
}

/* Digit k of i becomes digit + k modulo 2 before they are mirrored, for the endless zeros in front as well. */
static double zaremba_second(size_t i)
{
    double value = 0, digit = 0.5;
    for (size_t k = 0; k < 60; k++, digit /= 2, i /= 2) {
        value += digit * (double)((i + k) % 2);
    }
    return value;
}

enum { HAMMERSLEY, HALTON, SOBOL, ZAREMBA, R2, FIBONACCI };

static void known_point(int set, size_t i, size_t n, double *x)
{
    static const double plastic = 1.32471795724474602596;
    const double index = (double)i, count = (double)n;
    double whole;
    switch (set) {
    case HAMMERSLEY:
    case ZAREMBA:
        x[0] = index / count;
        x[1] = set == ZAREMBA ? zaremba_second(i) : radical_inverse(i, 2);
        return;
    case HALTON:
    case SOBOL:
        x[0] = radical_inverse(i, 2);
        x[1] = set == SOBOL ? sobol_second(i) : radical_inverse(i, 3);
        return;
    case R2:
        x[0] = modf(0.5 + (index + 1) / plastic, &whole);
        x[1] = modf(0.5 + (index + 1) / plastic / plastic, &whole);
        return;
    default: {
        size_t before = 1, last = 1;
        while (last < n) {
            last += before;
            before = last - before;
        }
        x[0] = index / count;
        x[1] = (double)(i * before % n) / count;
    }
    }
}

static const struct {
    int set;
    size_t n;
    double value;
} known[] = {
    {HAMMERSLEY, 16, 0.038524690},   {HAMMERSLEY, 64, 0.015990670}, {HAMMERSLEY, 256, 0.005644857},
    {HAMMERSLEY, 1024, 0.001837093}, {HALTON, 16, 0.049153486},     {HALTON, 64, 0.020493534},
    {HALTON, 256, 0.006892608},      {HALTON, 1024, 0.002698212},   {SOBOL, 16, 0.083883754},
    {SOBOL, 64, 0.021502459},        {SOBOL, 256, 0.007080195},     {SOBOL, 1024, 0.002632568},
    {R2, 16, 0.041913260},           {R2, 64, 0.016971792},         {R2, 256, 0.005779698},
    {R2, 1024, 0.002105413},         {ZAREMBA, 16, 0.037753440},    {ZAREMBA, 64, 0.015989741},
    {ZAREMBA, 256, 0.005580022},     {ZAREMBA, 1024, 0.001860184},  {FIBONACCI, 13, 0.060138451},
    {FIBONACCI, 55, 0.015795337},    {FIBONACCI, 233, 0.006632747}, {FIBONACCI, 987, 0.001941825},
};

/* At r = 1/4, to the nine printed digits. */
TEST_CASE(known_sets)
{
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        koksma_points p;
        assert_ok(koksma_points_init(&p, known[k].n, 2));
        for (size_t i = 0; i < p.n; i++) {
            known_point(known[k].set, i, p.n, p.xs + 2 * i);
        }
        const double value = test_measure("l2-disk:r=0.25", &p).value;
        assert_that(fabs(value - known[k].value) <= 6e-10, "set %d of %zu points: %.12f, not %.9f", known[k].set, p.n,
                    value, known[k].value);
        koksma_points_fini(&p);
    }
}

static bool in_disk(const double *x, const double *centre, double r)
{
    const double dx = x[0] - centre[0], dy = x[1] - centre[1], a = dx - round(dx), b = dy - round(dy);
    return a * a + b * b < r * r;
}

/* The mean over a lattice of centres and radii with a random shift, and its standard error over shifts. */
static void monte_carlo(const koksma_points *p, int law, double top, uint64_t seed, double *mean, double *error)
{
    enum { SHIFTS = 16, DISKS = 1597, STEP = 987 };
    double sum = 0, squares = 0;
    for (uint64_t s = seed; s < seed + SHIFTS; s++) {
        double part = 0, whole;
        for (size_t m = 0; m < DISKS; m++) {
            const double u = modf((double)m / DISKS + sets_unit(s, 7000), &whole);
            const double v = modf((double)(m * STEP % DISKS) / DISKS + sets_unit(s, 7001), &whole);
            const double w = modf((double)(m * 612 % DISKS) / DISKS + sets_unit(s, 7002), &whole);
            const double r = law == 0 ? top : law == 1 ? top * w : top * sqrt(w), centre[2] = {u, v};
            size_t inside = 0;
            for (size_t i = 0; i < p->n; i++) {
                inside += in_disk(p->xs + 2 * i, centre, r);
            }
            const double delta = (double)inside / (double)p->n - M_PI * r * r;
            part += delta * delta / DISKS;
        }
        sum += part / SHIFTS;
        squares += part * part / SHIFTS;
    }
    *mean = sum;
    *error = sqrt(fmax(squares - sum * sum, 0) / (SHIFTS - 1));
}

TEST_CASE(definition_by_monte_carlo)
{
    static const struct {
        const char *spec;
        int law;
        double top;
    } cases[] = {
        {"l2-disk", 0, 0.25},         {"l2-disk:r=0.5", 0, 0.5}, {"l2-disk:law=radius", 1, 0.5},
        {"l2-disk:law=area", 2, 0.5}, {"l2-disk:r=0.1", 0, 0.1}, {"l2-disk:law=radius,r=0.3", 1, 0.3},
    };
    double chi = 0;
    int count = 0;
    for (size_t c = 0; c < 6; c++) {
        for (int kind = 0; kind < SETS_KINDS; kind++) {
            koksma_points p = sets_points(11, 2, kind, c);
            double mean, error;
            monte_carlo(&p, cases[c].law, cases[c].top, 100 * (uint64_t)count, &mean, &error);
            const double z = (test_measure(cases[c].spec, &p).square - mean) / error;
            assert_true(fabs(z) < 5); /* 15 degrees of freedom */
            chi += z * z;
            count++;
            koksma_points_fini(&p);
        }
    }
    assert_near(chi / count, 1, 0.8);
}

/* Cells leave out only pairs that don't overlap. */
TEST_CASE(cells_change_nothing)
{
    static const double radii[] = {0.03, 0.06, 0.1, 0.125};
    for (size_t c = 0; c < 4; c++) {
        char text[64];
        koksma_points p = sets_points(400, 2, c % 2 ? 4 : 0, c);
        long double sum = 0;
        const long double r = radii[c];
        for (size_t i = 0; i < p.n * p.n * 9; i++) {
            const double *x = p.xs + 2 * (i / 9 / p.n), *y = p.xs + 2 * (i / 9 % p.n);
            const long double dx = (long double)x[0] - y[0] + (int)(i % 3) - 1,
                              dy = (long double)x[1] - y[1] + (int)(i / 3 % 3) - 1, h = hypotl(dx, dy) / 2;
            if (h < r) {
                sum += 2 * r * r * acosl(h / r) - 2 * h * sqrtl(r * r - h * h);
            }
        }
        const long double area = acosl(-1) * r * r, n = (long double)p.n, square = sum / n / n - area * area;
        snprintf(text, sizeof text, "l2-disk:r=%.17g", radii[c]);
        assert_near(test_measure(text, &p).square, (double)square, 1e-16);
        koksma_points_fini(&p);
    }
}

/* The means of the square over random sets, within 4 standard errors. */
TEST_CASE(random_sets)
{
    enum { SETS = 600, N = 12 };
    static const char *const specs[] = {"l2-disk", "l2-disk:law=radius", "l2-disk:law=area"};
    const double area = M_PI / 16;
    const double expected[] = {area * (1 - area), M_PI / 12 - M_PI * M_PI / 80, M_PI / 8 - M_PI * M_PI / 48};
    for (int c = 0; c < 3; c++) {
        double sum = 0, squares = 0;
        for (uint64_t seed = 0; seed < SETS; seed++) {
            koksma_points p = test_points("random", N, 2, 100 + seed);
            const double value = test_measure(specs[c], &p).square * N;
            sum += value / SETS;
            squares += value * value / SETS;
            koksma_points_fini(&p);
        }
        assert_near(sum, expected[c], 4 * sqrt((squares - sum * sum) / SETS));
    }
}

/* Scores of the sampled form against the exact one spread as a unit normal does. */
TEST_CASE(sampled_agrees)
{
    static const char *const laws[] = {"law=fixed", "law=radius,r=0.4", "law=area"};
    double sum = 0, squares = 0;
    enum { RUNS = 90 };
    for (int run = 0; run < RUNS; run++) {
        char exact[64], sampled[96];
        koksma_points p = sets_points(9, 2, run % SETS_KINDS, 3);
        snprintf(exact, sizeof exact, "l2-disk:%s", laws[run % 3]);
        snprintf(sampled, sizeof sampled, "disk-sampled:%s,disks=2000,seed=%d", laws[run % 3], run);
        const koksma_value v = test_measure(sampled, &p);
        assert_false(v.exact);
        assert_true(isnan(v.lower) && isnan(v.upper));
        const double z = (v.value - test_measure(exact, &p).value) / v.standard_error;
        sum += z / RUNS;
        squares += z * z / RUNS;
        koksma_points_fini(&p);
    }
    assert_near(sum, 0, 4 / sqrt(RUNS));
    assert_near(squares, 1, 4 * sqrt(2.0 / RUNS));
}
