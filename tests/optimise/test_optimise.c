/* SPDX-License-Identifier: Apache-2.0 */
/* Searches: gradients against differences of the measure, sets that do not depend on threads, what is kept, optima that are
   proven. All methods and all measures with a gradient are walked. Long because all searches share one table. */
#include <koksma/optimise.h>
#include <koksma/spectrum.h>

#include <stdlib.h>
#include <string.h>

#include "core/spec.h"
#include "optimise/search.h"
#include "test.h"

/* Calls f for each measure with a gradient, with each choice of its law, in its first dimensions. */
static void each_gradient(void (*f)(const koksma_spec *measure, int dim))
{
    size_t n = 0;
    const koksma_measure *m;
    for (size_t i = 0; (m = koksma_measure_at(i)); i++) {
        for (int law = 0; m->gradient && law < 3; law++) {
            static const char *const laws[2][3] = {{":law=isotropic", ":law=mitchell", NULL},
                                                   {":law=fixed", ":law=radius", ":law=area"}};
            const char *text = laws[m->family == KOKSMA_FAMILY_DISKS][law];
            for (int dim = m->min_dim; m->params ? text && dim <= 3 : law == 0 && dim <= 3; dim++) {
                char name[64];
                koksma_spec spec;
                snprintf(name, sizeof name, "%s%s", m->name, m->params ? text : "");
                assert_ok(koksma_measure_spec(name, &spec));
                if (!strstr(name, "mitchell") || dim == 2) {
                    f(&spec, dim);
                    n++;
                }
            }
        }
    }
    assert_true(n > 30);
}

/* (f(x + h) - f(x - h)) / 2h, with f the square that koksma_evaluate gives. */
static void expect_differences(const koksma_spec *measure, int dim)
{
    enum { N = 9 };
    const double h = 1e-5;
    koksma_points points = test_points("random", N, dim, 5);
    const koksma_args args = koksma__spec_arguments(measure, NULL);
    double square, gradient[3 * N];
    koksma_value value, up, down;
    assert_ok(measure->measure->gradient(&points, &args, &square, gradient));
    assert_ok(koksma_evaluate(measure, &points, NULL, &value));
    assert_near(square, value.square, 1e-12);
    for (size_t c = 0; c < N * (size_t)dim; c++) {
        const double x = points.xs[c];
        points.xs[c] = x + h;
        assert_ok(koksma_evaluate(measure, &points, NULL, &up));
        points.xs[c] = x - h;
        assert_ok(koksma_evaluate(measure, &points, NULL, &down));
        points.xs[c] = x;
        assert_near(gradient[c], (up.square - down.square) / (2 * h), 1e-7);
    }
    koksma_points_fini(&points);
}

/* The same for the weighted mean of the squares over projections, each evaluated by itself. */
static void expect_differences_of_projections(const koksma_spec *measure, int dim)
{
    enum { N = 6 };
    const double h = 1e-5, weights[] = {3, 1};
    if (dim < 2 || measure->measure->min_dim > 1) {
        return;
    }
    const uint64_t projections[] = {1, (UINT64_C(1) << dim) - 2};
    const koksma_optimise_options o = {
        .n = N, .dim = dim, .projections = projections, .weights = weights, .n_projections = 2};
    koksma_points points = test_points("random", N, dim, 6);
    double square, gradient[3 * N], ends[2];
    assert_ok(koksma__search_square(measure, &o, &points, NULL, &square, gradient));
    for (size_t c = 0; c < N * (size_t)dim; c++) {
        const double x = points.xs[c];
        for (int end = 0; end < 2; end++) {
            double first[N], rest[2 * N];
            points.xs[c] = x + (end ? h : -h);
            for (size_t i = 0; i < N; i++) {
                first[i] = points.xs[i * (size_t)dim];
                memcpy(rest + i * (size_t)(dim - 1), points.xs + i * (size_t)dim + 1,
                       (size_t)(dim - 1) * sizeof *rest);
            }
            koksma_value one, other;
            assert_ok(koksma_evaluate(measure, &(koksma_points){N, 1, first}, NULL, &one));
            assert_ok(koksma_evaluate(measure, &(koksma_points){N, dim - 1, rest}, NULL, &other));
            ends[end] = (3 * one.square + other.square) / 4;
        }
        points.xs[c] = x;
        assert_near(gradient[c], (ends[1] - ends[0]) / (2 * h), 1e-7);
    }
    koksma_points_fini(&points);
}

TEST_CASE(gradients_are_differences)
{
    each_gradient(expect_differences);
    each_gradient(expect_differences_of_projections);
}

/* D^2 of a target power from its definition: the mean of |sum_j exp(-2 pi i k.x_j)|^2 / n over the frequencies whose
   length rounds to r, its difference from the target squared, ring r counted r times. */
static double power_square(const double *power, int rings, const koksma_points *points)
{
    double square = 0, weights = 0;
    for (int r = 1; r <= rings; r++) {
        double mean = 0, count = 0;
        for (int kx = -rings; kx <= rings; kx++) {
            for (int ky = -rings; ky <= rings; ky++) {
                if (lround(hypot(kx, ky)) == r) {
                    double re = 0, im = 0;
                    for (size_t i = 0; i < points->n; i++) {
                        const double angle = 2 * M_PI * (kx * points->xs[2 * i] + ky * points->xs[2 * i + 1]);
                        re += cos(angle);
                        im += sin(angle);
                    }
                    mean += (re * re + im * im) / (double)points->n;
                    count++;
                }
            }
        }
        const double off = mean / count - power[r - 1];
        square += r * off * off;
        weights += r;
    }
    return square / weights;
}

TEST_CASE(gradients_of_powers_are_differences)
{
    enum { MOST = 19, RINGS = 9 };
    static const char *const targets[] = {"step", "gaussian", "latin-hypercube"};
    static const char *const patterns[] = {"random", "regular", "gaussian-blue-noise"};
    static const koksma_spec to_power = {.measure = &koksma__measure_radial_power};
    const double h = 1e-5;
    for (int t = 0; t < 3; t++) {
        for (size_t n = t == 1 ? 16 : 1; n <= MOST; n += t == 1 ? MOST : 9) { /* regular takes squares */
            for (int rings = 1; rings <= RINGS; rings += 4) {
                koksma_points points = test_points(patterns[t], n, 2, 5);
                double power[RINGS], square, gradient[2 * MOST];
                assert_ok(koksma_radial_power(targets[t], n, rings, NULL, power));
                const koksma_optimise_options o = {.n = n, .dim = 2, .power = power, .rings = rings};
                assert_ok(koksma__search_square(&to_power, &o, &points, NULL, &square, gradient));
                assert_near(square, power_square(power, rings, &points), 1e-11);
                for (size_t c = 0; c < 2 * n; c++) {
                    const double x = points.xs[c];
                    points.xs[c] = x + h;
                    const double up = power_square(power, rings, &points);
                    points.xs[c] = x - h;
                    const double down = power_square(power, rings, &points);
                    points.xs[c] = x;
                    assert_near(gradient[c], (up - down) / (2 * h), 1e-5 * fmax(1, fabs(gradient[c])));
                }
                koksma_points_fini(&points);
            }
        }
    }
}

/* A shift on the torus changes the value of those that are not on it. */
static void expect_torus(const koksma_spec *measure, int dim)
{
    koksma_points points = test_points("random", 9, dim, 5);
    koksma_value before, after;
    assert_ok(koksma_evaluate(measure, &points, NULL, &before));
    for (size_t c = 0; c < 9 * (size_t)dim; c++) {
        points.xs[c] = fmod(points.xs[c] + 0.375, 1);
    }
    assert_ok(koksma_evaluate(measure, &points, NULL, &after));
    if (dim > 1 || measure->measure->on_torus) { /* on the line l2-extreme and l2-symmetric are, too */
        assert_int_equal(fabs(after.value - before.value) < 1e-12, measure->measure->on_torus);
    }
    koksma_points_fini(&points);
}

TEST_CASE(torus_is_where_it_is_said)
{
    each_gradient(expect_torus);
}

/* With KOKSMA_KEEP_SEQUENCE the root of order m of the product of the values of the first 2, 4, ..., 2^m points, with
   KOKSMA_KEEP_PREFIXES that of all numbers of points from 8 on. */
static double kept_value(const char *measure, const koksma_points *points, koksma_keep keep)
{
    double product = 1, m = 0;
    for (size_t n = keep == KOKSMA_KEEP_PREFIXES ? 8 : 2; n <= points->n && keep >= KOKSMA_KEEP_SEQUENCE; m++) {
        product *= test_measure(measure, &(koksma_points){n, points->dim, points->xs}).value;
        n += keep == KOKSMA_KEEP_PREFIXES ? 1 : n;
    }
    return keep >= KOKSMA_KEEP_SEQUENCE ? pow(product, 1 / m) : test_measure(measure, points).value;
}

/* A run with sanitizers makes one of the eight searches of a step. */
enum { SEARCHES = test_repeats(8, 1) };

__attribute__((constructor)) static void make_few_searches(void)
{
    koksma__searches_made = SEARCHES;
}

static koksma_optimum optimised(const char *measure, koksma_optimise_options options, int threads)
{
    koksma_spec spec;
    koksma_optimum best;
    const koksma_run run = {.threads = threads};
    assert_ok(koksma_measure_spec(measure, &spec));
    assert_ok(koksma_optimise(&spec, &options, &run, &best));
    assert_near(best.value, kept_value(measure, &best.points, options.keep),
                options.keep >= KOKSMA_KEEP_SEQUENCE ? 1e-14 : 0);
    assert_true(best.steps == options.steps && best.last_gain <= best.steps);
    for (size_t c = 0; c < best.points.n * (size_t)best.points.dim; c++) {
        assert_true(best.points.xs[c] >= 0 && best.points.xs[c] < 1);
    }
    return best;
}

/* One search that each method does best, and what it gains. */
static const struct {
    const char *method, *measure;
    size_t n;
    int dim;
    koksma_keep keep;
} searches[] = {
    {"star-plane", "star", 9, 2, KOKSMA_KEEP_NONE},       {"descent", "l2-star", 8, 3, KOKSMA_KEEP_NONE},
    {"descent", "l2-disk", 8, 2, KOKSMA_KEEP_NONE},       {"descent", "l2-centered", 8, 2, KOKSMA_KEEP_NET},
    {"exchange", "l2-centered", 8, 3, KOKSMA_KEEP_LATIN}, {"exchange", "l2-wraparound", 8, 2, KOKSMA_KEEP_LATIN},
    {"star-space", "star", 8, 3, KOKSMA_KEEP_NONE},       {"witness", "extreme", 8, 3, KOKSMA_KEEP_NONE},
    {"perturb", "star", 8, 2, KOKSMA_KEEP_NET},           {"perturb", "star", 8, 2, KOKSMA_KEEP_LATIN},
    {"anneal", "l2-star", 12, 2, KOKSMA_KEEP_NONE},       {"anneal", "l2-centered", 11, 3, KOKSMA_KEEP_NONE},
    {"perturb", "min-distance", 8, 2, KOKSMA_KEEP_NONE},  {"witness", "edge", 8, 2, KOKSMA_KEEP_NONE},
    {"witness", "disk", 8, 2, KOKSMA_KEEP_NONE},          {"digital", "star", 16, 2, KOKSMA_KEEP_SEQUENCE},
    {"digital", "l2-star", 8, 3, KOKSMA_KEEP_SEQUENCE},   {"digital", "min-distance", 16, 2, KOKSMA_KEEP_SEQUENCE},
    {"perturb", "l2-star", 16, 2, KOKSMA_KEEP_PREFIXES},  {"perturb", "min-distance", 11, 3, KOKSMA_KEEP_PREFIXES},
};

/* A grid hides the lower bound of all boxes: 16 points, one in each cell, have no discrepancy on it. */
TEST_CASE(lower_bounds_hold)
{
    static const char *const measures[] = {"extreme", "extreme:grid=4", "star"};
    for (int m = 0; m < 3; m++) {
        koksma_points from = test_points("jittered", 16, 2, 0);
        koksma_spec measure;
        koksma_optimum best;
        const koksma_optimise_options options = {.n = 16, .dim = 2, .first = &from, .steps = 1};
        assert_ok(koksma_measure_spec(measures[m], &measure));
        assert_ok(koksma_optimise(&measure, &options, NULL, &best));
        assert_true(m == 1 ? best.lower != best.lower && best.value == 0
                           : best.lower > 0 && best.lower <= best.value);
        koksma_optimum_fini(&best);
        koksma_points_fini(&from);
    }
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Coordinate k of all points, in order of size. */
static void sorted(const koksma_points *points, int k, double *out)
{
    for (size_t i = 0; i < points->n; i++) {
        out[i] = points->xs[i * (size_t)points->dim + (size_t)k];
    }
    qsort(out, points->n, sizeof *out, by_value);
}

/* Coordinate k is that of a (0,1)-sequence in base 2: each 2^m points from a multiple of 2^m on have one in each
   interval of length 2^-m. It is digital: the digits of points i and j without a common digit add up to those of point i
   + j. */
static void expect_sequence(const koksma_points *points, int k)
{
    const size_t n = points->n, dim = (size_t)points->dim;
    const double *xs = points->xs + k;
    for (size_t m = 1; m <= n; m *= 2) {
        for (size_t first = 0; first < n; first += m) {
            uint64_t seen = 0;
            for (size_t i = first; i < first + m; i++) {
                seen |= UINT64_C(1) << (int)(xs[i * dim] * (double)m);
            }
            assert_true(seen == (m == 64 ? UINT64_MAX : (UINT64_C(1) << m) - 1));
        }
    }
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) {
            if (!(i & j)) {
                const uint64_t sum = (uint64_t)(xs[i * dim] * 0x1p53) ^ (uint64_t)(xs[j * dim] * 0x1p53);
                assert_true(xs[(i + j) * dim] == (double)sum * 0x1p-53);
            }
        }
    }
}

static void expect_kept(const koksma_points *before, const koksma_points *after, koksma_keep keep)
{
    double a[16], b[16];
    for (int k = 0; k < before->dim && keep == KOKSMA_KEEP_LATIN; k++) {
        sorted(before, k, a);
        sorted(after, k, b);
        assert_memory_equal(a, b, before->n * sizeof *a);
    }
    for (size_t c = 0; c < before->n * (size_t)before->dim && keep == KOKSMA_KEEP_NET; c++) {
        assert_true(floor(before->xs[c] * (double)before->n) == floor(after->xs[c] * (double)after->n));
    }
    for (int k = 0; k < after->dim && keep == KOKSMA_KEEP_SEQUENCE; k++) {
        expect_sequence(after, k);
    }
}

TEST_CASE(methods_gain_and_keep)
{
    for (size_t i = 0; i < sizeof searches / sizeof *searches; i++) {
        const koksma_keep keep = searches[i].keep;
        const char *pattern = keep == KOKSMA_KEEP_NET || keep == KOKSMA_KEEP_SEQUENCE ? "sobol" : "latin-hypercube";
        koksma_points from = test_points(pattern, searches[i].n, searches[i].dim, 3);
        const koksma_optimise_options options = {.n = searches[i].n,
                                                 .dim = searches[i].dim,
                                                 .first = &from,
                                                 .keep = keep,
                                                 .seed = 4,
                                                 .steps = test_repeats(2, 1)};
        const double before = kept_value(searches[i].measure, &from, keep);
        koksma_optimum one = optimised(searches[i].measure, options, 1);
        assert_string_equal(one.method, searches[i].method);
        if (!strcmp(searches[i].measure, "min-distance") ? one.value <= before : one.value >= before) {
            fail_msg("%s of %zu points, %s, keep %d: from %g to %g", searches[i].measure, one.points.n, one.method,
                     (int)keep, before, one.value);
        }
        expect_kept(&from, &one.points, keep);
        koksma_optimum many = optimised(searches[i].measure, options, 3);
        assert_memory_equal(one.points.xs, many.points.xs, from.n * (size_t)from.dim * sizeof(double));
        koksma_optimum_fini(&many);
        koksma_optimum_fini(&one);
        koksma_points_fini(&from);
    }
    for (size_t m = 0; koksma_method_at(m); m++) {
        size_t found = 0;
        for (size_t i = 0; i < sizeof searches / sizeof *searches; i++) {
            found += !strcmp(searches[i].method, koksma_method_at(m)->name);
        }
        assert_that(found != 0, "no search of this test is done by %s", koksma_method_at(m)->name);
    }
}

/* Latin hypercubes of both sizes, with stored kernels and too large for them, lose a good part of their discrepancy
   and keep their coordinates. */
TEST_CASE(latin_hypercubes_of_all_sizes)
{
    static const struct {
        size_t n;
        int dim;
        double share; /* of the first value, that remains at most */
    } sets[] = {{50, 5, 0.7}, {840, 3, 0.95}};
    for (size_t i = 0; i < test_repeats(2, 1); i++) {
        koksma_points from = test_points("latin-hypercube", sets[i].n, sets[i].dim, 3);
        const koksma_optimise_options options = {
            .n = from.n, .dim = from.dim, .first = &from, .keep = KOKSMA_KEEP_LATIN, .steps = 1};
        koksma__searches_made = 1;
        koksma_optimum best = optimised("l2-centered", options, 1);
        koksma__searches_made = SEARCHES;
        assert_true(best.value < sets[i].share * test_measure("l2-centered", &from).value);
        double *axes[2] = {malloc(from.n * sizeof(double)), malloc(from.n * sizeof(double))};
        for (int k = 0; k < from.dim; k++) {
            sorted(&from, k, axes[0]);
            sorted(&best.points, k, axes[1]);
            assert_memory_equal(axes[0], axes[1], from.n * sizeof(double));
        }
        free(axes[0]);
        free(axes[1]);
        koksma_optimum_fini(&best);
        koksma_points_fini(&from);
    }
}

/* Nothing is below: tools/prove_star.c proves it, and the test star_optima checks its proofs for up to 12 points. */
TEST_CASE(optima_of_the_star_discrepancy)
{
    static const double optima[] = {0.6180339887, 0.3660254038, 0.2847006554, 1.0 / 4, 1.0 / 5,      1.0 / 6,
                                    3.0 / 20,     17.0 / 128,   10.0 / 81,    1.0 / 9, 0.1030276927, 2.0 / 21};
    for (size_t n = 1; n <= sizeof optima / sizeof *optima; n += test_repeats(1, 7)) {
        koksma_optimum best = optimised("star", (koksma_optimise_options){.n = n, .dim = 2, .steps = 1}, 3);
        assert_near(best.value, optima[n - 1], 1e-9);
        koksma_optimum_fini(&best);
    }
}

/* The value over projections, and what net-file reads of the matrices. */
TEST_CASE(sequences_of_projections)
{
    enum { N = 32 };
    const uint64_t pairs[] = {3, 6};
    const char path[] = "optimised-net.txt";
    koksma_spec measure;
    koksma_optimum best;
    koksma_optimise_options options = {
        .n = N, .dim = 3, .keep = KOKSMA_KEEP_SEQUENCE, .steps = 1, .projections = pairs, .n_projections = 2};
    assert_ok(koksma_measure_spec("l2-star", &measure));
    assert_ok(koksma_optimise(&measure, &options, NULL, &best));
    double product = 1, first = 1;
    koksma_points sobol = test_points("sobol", N, 3, 0);
    for (int p = 0; p < 2; p++) {
        double xs[2 * N], before[2 * N];
        for (size_t i = 0; i < 2 * N; i++) {
            xs[i] = best.points.xs[i / 2 * 3 + i % 2 + (size_t)p];
            before[i] = sobol.xs[i / 2 * 3 + i % 2 + (size_t)p];
        }
        product *= kept_value("l2-star", &(koksma_points){N, 2, xs}, KOKSMA_KEEP_SEQUENCE);
        first *= kept_value("l2-star", &(koksma_points){N, 2, before}, KOKSMA_KEEP_SEQUENCE);
    }
    assert_near(best.value, sqrt(product), 1e-14);
    assert_true(product < first && best.value != best.lower);
    assert_ok(koksma_net_write(path, &best.points, "two\nlines"));
    for (size_t n = 1; n <= N; n *= 2) {
        koksma_points read = test_points("net-file:optimised-net.txt", n, 3, 0);
        assert_memory_equal(read.xs, best.points.xs, n * 3 * sizeof(double));
        koksma_points_fini(&read);
    }
    assert_int_equal(remove(path), 0);
    best.points.xs[3 * N - 1] += 0x1p-53;
    assert_int_equal(koksma_net_write(path, &best.points, NULL), KOKSMA_ARGUMENT);
    options.projections = &(uint64_t){8};
    options.n_projections = 1;
    koksma_optimum_fini(&best);
    assert_int_equal(koksma_optimise(&measure, &options, NULL, &best), KOKSMA_ARGUMENT);
    koksma_points_fini(&sobol);
}

/* The root of the weighted mean of the squares in the projections, by hand; with a gradient and without. */
TEST_CASE(values_of_projections)
{
    enum { N = 8 };
    static const struct {
        const char *measure, *method;
    } rows[] = {{"l2-star", "descent"}, {"l2-wraparound", "descent"}, {"extreme", "perturb"}};
    for (size_t r = 0; r < 3; r++) {
        const koksma_optimise_options options = {.n = N,
                                                 .dim = 2,
                                                 .steps = 2,
                                                 .projections = (uint64_t[]){1, 2, 3},
                                                 .weights = (double[]){1, 2, 5},
                                                 .n_projections = 3};
        koksma_spec measure;
        koksma_optimum best;
        koksma_points sets[2] = {test_points("latin-hypercube", N, 2, 0)};
        double values[2];
        assert_ok(koksma_measure_spec(rows[r].measure, &measure));
        assert_ok(koksma_optimise(&measure, &options, NULL, &best));
        assert_string_equal(best.method, rows[r].method);
        assert_true(best.lower != best.lower && best.last_gain > 0);
        sets[1] = best.points;
        for (int s = 0; s < 2; s++) {
            double sum = 0, axis[N];
            for (size_t u = 0; u < 3; u++) {
                for (size_t i = 0; i < N; i++) {
                    axis[i] = sets[s].xs[2 * i + u % 2];
                }
                const double value =
                    test_measure(rows[r].measure, u < 2 ? &(koksma_points){N, 1, axis} : &sets[s]).value;
                sum += options.weights[u] * value * value;
            }
            values[s] = sqrt(sum / 8);
        }
        assert_near(best.value, values[1], 1e-14);
        assert_true(values[1] < values[0]);
        koksma_points_fini(&sets[0]);
        koksma_optimum_fini(&best);
    }
}

/* The root mean square difference to a target, ring r counted r times, from the spectrum's own radial mean. */
static double distance_to(const double *power, int rings, const koksma_points *points)
{
    koksma_spectrum spectrum;
    koksma_ring found[16];
    double sum = 0;
    assert_ok(koksma_spectrum_init(&spectrum, rings));
    assert_ok(koksma_spectrum_add(&spectrum, points, KOKSMA_SPECTRUM_EXACT, NULL));
    assert_ok(koksma_spectrum_rings(&spectrum, found));
    for (int r = 1; r <= rings; r++) {
        sum += r * (found[r - 1].power - power[r - 1]) * (found[r - 1].power - power[r - 1]);
    }
    koksma_spectrum_fini(&spectrum);
    return sqrt(sum / (rings * (rings + 1) / 2.0));
}

/* The value is the distance by definition, for any number of threads; descents nearly reach targets that exist. */
TEST_CASE(target_powers)
{
    enum { N = 24, RINGS = 10 };
    static const char *const targets[] = {"step", "gaussian", "latin-hypercube"};
    double power[RINGS];
    for (size_t t = 0; t < 3; t++) {
        const size_t n = t == 2 ? 25 : N;
        assert_ok(koksma_radial_power(targets[t], n, RINGS, NULL, power));
        koksma_points before = test_points("gaussian-blue-noise", n, 2, 0);
        koksma_optimise_options o = {.n = n, .dim = 2, .steps = 1, .power = power, .rings = RINGS};
        koksma_optimum best[2];
        for (int k = 0; k < 2; k++) {
            assert_ok(koksma_optimise(NULL, &o, &(koksma_run){.threads = 1 + 2 * k}, &best[k]));
        }
        assert_memory_equal(best[0].points.xs, best[1].points.xs, 2 * n * sizeof(double));
        assert_near(best[0].value, distance_to(power, RINGS, &best[0].points), 1e-9);
        assert_true(best[0].value < 0.1 * distance_to(power, RINGS, &before));
        assert_string_equal(best[0].method, "descent");
        koksma_points_fini(&before);
        koksma_optimum_fini(&best[0]);
        koksma_optimum_fini(&best[1]);
    }
}

/* Named targets are their formulas, a file's lines are joined by lines, a pattern's is the mean of its spectra. */
TEST_CASE(profiles_of_targets)
{
    enum { N = 16, RINGS = 8 };
    double power[RINGS];
    const char path[] = "profile.txt";
    assert_ok(koksma_radial_power("step", N, RINGS, NULL, power));
    for (int r = 1; r <= RINGS; r++) {
        assert_true(power[r - 1] == (r > sqrt(N / M_PI)));
    }
    assert_ok(koksma_radial_power("gaussian", N, RINGS, NULL, power));
    for (int r = 1; r <= RINGS; r++) {
        assert_near(power[r - 1], 1 - exp(-M_PI * r * r / N), 1e-15);
    }
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("# f/sqrt(n) power\n0.5 0\n1,2 # a peak\n\n1.5\t1\n", file);
    assert_int_equal(fclose(file), 0);
    static const double joined[RINGS] = {0, 0, 1, 2, 1.5, 1, 1, 1};
    assert_ok(koksma_radial_power(path, N, RINGS, NULL, power));
    for (int r = 0; r < RINGS; r++) {
        assert_near(power[r], joined[r], 1e-15);
    }
    static const char *const wrong[] = {"0.5\n",    "1 1\n0.5 1\n", "a b\n",   "0.5 -1\n",
                                        "# none\n", "0 1e308\n",    "1 2 3\n", "0 inf\n"};
    for (size_t w = 0; w < sizeof wrong / sizeof *wrong; w++) {
        file = fopen(path, "w");
        assert_non_null(file);
        fputs(wrong[w], file);
        assert_int_equal(fclose(file), 0);
        assert_int_equal(koksma_radial_power(path, N, RINGS, NULL, power), KOKSMA_MALFORMED);
    }
    assert_int_equal(remove(path), 0);
    assert_int_equal(koksma_radial_power(path, N, RINGS, NULL, power), KOKSMA_MISSING);
    double mean[RINGS] = {0};
    for (uint64_t seed = 0; seed < 16; seed++) {
        koksma_points points = test_points("jittered", N, 2, seed);
        koksma_spectrum spectrum;
        koksma_ring found[RINGS];
        assert_ok(koksma_spectrum_init(&spectrum, RINGS));
        assert_ok(koksma_spectrum_add(&spectrum, &points, KOKSMA_SPECTRUM_EXACT, NULL));
        assert_ok(koksma_spectrum_rings(&spectrum, found));
        for (int r = 0; r < RINGS; r++) {
            mean[r] += found[r].power / 16;
        }
        koksma_spectrum_fini(&spectrum);
        koksma_points_fini(&points);
    }
    assert_ok(koksma_radial_power("jittered", N, RINGS, NULL, power));
    for (int r = 0; r < RINGS; r++) {
        assert_near(power[r], mean[r], 1e-12);
    }
    koksma_optimum best;
    koksma_optimise_options o = {.n = N, .dim = 3, .steps = 1, .power = power, .rings = RINGS};
    assert_int_equal(koksma_optimise(NULL, &o, NULL, &best), KOKSMA_DIM);
    o.dim = 2;
    o.keep = KOKSMA_KEEP_SEQUENCE;
    assert_int_equal(koksma_optimise(NULL, &o, NULL, &best), KOKSMA_ARGUMENT);
    o.keep = KOKSMA_KEEP_NONE;
    power[3] = -1;
    assert_int_equal(koksma_optimise(NULL, &o, NULL, &best), KOKSMA_ARGUMENT);
    o.power = NULL;
    assert_int_equal(koksma_optimise(NULL, &o, NULL, &best), KOKSMA_ARGUMENT);
}

static bool stop_at_once(void *context, const koksma_optimum *best)
{
    *(koksma_optimum *)context = *best;
    return best->steps < 1;
}

static bool never(void *context, double fraction)
{
    (void)context, (void)fraction;
    return false;
}

TEST_CASE(ends_when_asked)
{
    koksma_spec star;
    koksma_optimum seen, best;
    koksma_optimise_options options = {.n = 8, .dim = 2, .progress = stop_at_once, .context = &seen};
    assert_ok(koksma_measure_spec("star", &star));
    assert_ok(koksma_optimise(&star, &options, NULL, &best));
    assert_true(best.steps == 1 && seen.steps == 1 && seen.value == best.value);
    koksma_optimum_fini(&best);
    const koksma_run run = {.keep_going = never};
    assert_int_equal(koksma_optimise(&star, &options, &run, &best), KOKSMA_INTERRUPTED);
    assert_true(best.points.n == 8 && best.steps == 0);
    koksma_optimum_fini(&best);
    const koksma_optimise_options unmade = {.n = 64, .dim = 2, .power = (double[]){1}, .rings = 1};
    assert_int_equal(koksma_optimise(NULL, &unmade, &run, &best), KOKSMA_INTERRUPTED);
    assert_true(!best.points.xs && !best.method);
    options.n = 9;
    options.first = &(koksma_points){.n = 1, .dim = 1, .xs = (double[]){0.5}};
    assert_int_equal(koksma_optimise(&star, &options, NULL, &best), KOKSMA_N);
    assert_null(best.points.xs);
    assert_ok(koksma_measure_spec("edge-sampled", &star));
    options.first = NULL;
    assert_int_equal(koksma_optimise(&star, &options, NULL, &best), KOKSMA_ARGUMENT);
}

static bool until_calls(void *context, double fraction)
{
    (void)fraction;
    size_t *left = context;
    *left -= *left > 0;
    return *left > 0;
}

/* Every method, interrupted after k questions for growing k, returns a set with the structure of the first one that is
   never worse, and better before the search is over. */
TEST_CASE(interrupted_searches_return_what_they_have)
{
    for (size_t i = 0; i < sizeof searches / sizeof *searches; i++) {
        const koksma_keep keep = searches[i].keep;
        const char *pattern = keep == KOKSMA_KEEP_NET || keep == KOKSMA_KEEP_SEQUENCE ? "sobol" : "latin-hypercube";
        const char *measure = searches[i].measure;
        koksma_points from = test_points(pattern, searches[i].n, searches[i].dim, 3), points = {0};
        const koksma_optimise_options options = {.n = from.n, .dim = from.dim, .keep = keep};
        const double before = kept_value(measure, &from, keep), sign = strcmp(measure, "min-distance") ? 1 : -1;
        const size_t bytes = from.n * (size_t)from.dim * sizeof(double);
        koksma_spec spec;
        bool gained = false;
        koksma_status status = KOKSMA_INTERRUPTED;
        assert_ok(koksma_measure_spec(measure, &spec));
        assert_ok(koksma_points_init(&points, from.n, from.dim));
        for (size_t calls = 1; status && !gained; calls *= 2) {
            size_t left = calls;
            const koksma_run run = {.threads = 1, .keep_going = until_calls, .context = &left};
            memcpy(points.xs, from.xs, bytes);
            status = koksma_method_find(searches[i].method)->search(&spec, &options, 4, before, &run, &points);
            assert_true(!status || status == KOKSMA_INTERRUPTED);
            const double after = kept_value(measure, &points, keep);
            assert_true(!status || sign * after <= sign * before + 1e-12);
            gained = status && sign * after < sign * before - 1e-9;
            expect_kept(&from, &points, keep);
        }
        assert_that(gained, "%s of %zu points: %s keeps nothing of a search that is interrupted", measure, from.n,
                    searches[i].method);
        koksma_points_fini(&points);
        koksma_points_fini(&from);
    }
}

static bool first_only(void *context, const koksma_optimum *best)
{
    (void)context, (void)best;
    return false;
}

/* Without a first set no result is worse than the set of any pattern of the table that makes n points. */
static void expect_no_better_pattern(const koksma_measure *m, size_t n, int dim)
{
    const koksma_optimise_options options = {.n = n, .dim = dim, .seed = 7, .progress = first_only};
    koksma_points points;
    koksma_spec spec, measure;
    koksma_optimum best;
    koksma_value value;
    assert_ok(koksma_measure_spec(m->name, &measure));
    assert_ok(koksma_points_init(&points, n, dim));
    assert_ok(koksma_optimise(&measure, &options, NULL, &best));
    for (size_t i = 0; koksma_pattern_at(i); i++) {
        const koksma_pattern *p = koksma_pattern_at(i);
        if (!p->operand && !koksma_pattern_spec(p->name, &spec) && !koksma_generate(&spec, 7, NULL, &points)) {
            assert_ok(koksma_evaluate(&measure, &points, NULL, &value));
            if (m->larger_is_better ? value.value > best.value : value.value < best.value) {
                fail_msg("%s of %zu points, %d dimensions: %g, but %s has %g", m->name, n, dim, best.value, p->name,
                         value.value);
            }
        }
    }
    koksma_optimum_fini(&best);
    koksma_points_fini(&points);
}

TEST_CASE(no_listed_pattern_is_better)
{
    static const size_t sizes[] = {16, 9, 8};
    size_t n = 0;
    for (size_t i = 0; koksma_measure_at(i); i++) {
        const koksma_measure *m = koksma_measure_at(i);
        for (int dim = m->min_dim; dim <= 3 && dim <= m->max_dim && m->answer == KOKSMA_ANSWER_EXACT; dim++, n++) {
            const bool binary = !strcmp(m->name, "t-value"); /* takes powers of its base, which is 2 */
            expect_no_better_pattern(m, sizes[test_repeats(binary ? 2 : n % 3, 0)], dim);
        }
    }
    assert_true(n > 40);
}
