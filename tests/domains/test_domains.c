/* SPDX-License-Identifier: Apache-2.0 */
/* Points whose density follows an image, and points on a model: counts against exact binomial bounds and chi-squared,
   distances against all pairs. */
#include <koksma/density.h>

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "test.h"

static const char *const forms[] = {"random", "sample-elimination", "progressive-elimination:length=2000"};
enum { FORMS = sizeof forms / sizeof *forms };

static koksma_spec spec_of(const char *text)
{
    koksma_spec spec;
    assert_ok(koksma_pattern_spec(text, &spec));
    return spec;
}

/* 8 x 8 pixels in four quarters of these densities: left bottom, right bottom, left top, right top. */
static koksma_image quarters(const float values[4])
{
    koksma_image map;
    assert_ok(koksma_image_init(&map, 8, 8, 1));
    for (int i = 0; i < 64; i++) {
        map.pixels[i] = values[(i % 8 >= 4) + 2 * (i / 8 < 4)];
    }
    return map;
}

static koksma_points with_density(const char *text, const koksma_image *map, size_t n, uint64_t seed)
{
    const koksma_spec spec = spec_of(text);
    koksma_points p;
    assert_ok(koksma_points_init(&p, n, 2));
    assert_ok(koksma_generate_density(&spec, seed, map, NULL, &p));
    return p;
}

static size_t quarter_of(const double *x)
{
    return (x[0] >= 0.5) + 2 * (x[1] >= 0.5);
}

/* Whether a count of n with probability p is outside of the central 1 - 1e-7 of the binomial distribution, by the sums
   of its exact probabilities. */
static bool outside_binomial(size_t count, size_t n, double p)
{
    double below = 0, above = 0;
    for (size_t k = 0; k <= n; k++) {
        const double term = exp(lgamma((double)n + 1) - lgamma((double)k + 1) - lgamma((double)(n - k) + 1) +
                                (double)k * log(p) + (double)(n - k) * log1p(-p));
        below += k <= count ? term : 0;
        above += k >= count ? term : 0;
    }
    return below < 5e-8 || above < 5e-8;
}

TEST_CASE(counts_follow_the_density)
{
    const float values[4] = {1, 2, 4, 0};
    koksma_image map = quarters(values);
    for (size_t f = 0; f < FORMS; f++) {
        for (uint64_t seed = 0; seed < test_repeats(3, 1); seed++) {
            koksma_points p = with_density(forms[f], &map, 2000, seed);
            size_t counts[4] = {0};
            for (size_t i = 0; i < p.n; i++) {
                assert_true(p.xs[2 * i] >= 0 && p.xs[2 * i] < 1 && p.xs[2 * i + 1] >= 0 && p.xs[2 * i + 1] < 1);
                counts[quarter_of(p.xs + 2 * i)]++;
            }
            assert_int_equal(counts[3], 0);
            for (int q = 0; q < 3; q++) {
                if (outside_binomial(counts[q], p.n, (double)values[q] / 7)) {
                    fail_msg("%s: %zu of %zu points in quarter %d", forms[f], counts[q], p.n, q);
                }
            }
            koksma_points_fini(&p);
        }
    }
    koksma_image_fini(&map);
}

/* The smallest distance between two points of `width` coordinates, the first `dim` of which count. */
static double smallest(const double *xs, size_t n, size_t width, size_t dim, bool torus, int quarter)
{
    double best = INFINITY;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < i; j++) {
            double square = 0;
            for (size_t k = 0; k < dim; k++) {
                const double t = fabs(xs[i * width + k] - xs[j * width + k]);
                square += torus && t > 0.5 ? (1 - t) * (1 - t) : t * t;
            }
            if (quarter < 0 ||
                ((int)quarter_of(xs + i * width) == quarter && (int)quarter_of(xs + j * width) == quarter)) {
                best = fmin(best, square);
            }
        }
    }
    return sqrt(best);
}

/* Distances are in proportion to 1 / sqrt(density): in each quarter elimination keeps the relative radius of its even
   sets. */
TEST_CASE(distances_follow_the_density)
{
    const float values[4] = {1, 3, 9, 2};
    koksma_image map = quarters(values);
    for (size_t f = 1; f < FORMS; f++) {
        koksma_points p = with_density(forms[f], &map, 2000, 1);
        for (int q = 0; q < 4; q++) {
            const double density = (double)values[q] / 3.75, found = smallest(p.xs, p.n, 2, 2, true, q);
            const double radius = found / sqrt(2 / (sqrt(3) * 2000 * density));
            if (!(radius >= 0.6 && radius < 0.8)) {
                fail_msg("%s: quarter %d: relative radius %g, smallest distance %g", forms[f], q, radius, found);
            }
        }
        koksma_points_fini(&p);
    }
    koksma_image_fini(&map);
}

/* An even density gives sets as even as those of sample-elimination itself (0.696 in 1,024 points, 10 sets). */
TEST_CASE(even_densities_are_even)
{
    const float values[4] = {5, 5, 5, 5};
    koksma_image map = quarters(values);
    double sum = 0;
    for (uint64_t seed = 0; seed < 4; seed++) {
        koksma_points p = with_density("sample-elimination", &map, 1024, seed);
        sum += smallest(p.xs, p.n, 2, 2, true, -1) / sqrt(2 / (sqrt(3) * 1024)) / 4;
        koksma_points_fini(&p);
    }
    assert_near(sum, 0.696, 0.012);
    koksma_image_fini(&map);
}

/* The first points of a progressive sequence do not depend on n, and are blue noise of their number. */
TEST_CASE(prefixes_are_blue)
{
    const float values[4] = {1, 4, 4, 1};
    koksma_image map = quarters(values);
    koksma_points all = with_density("progressive-elimination", &map, 1024, 3);
    for (size_t n = 128; n < 1024; n *= 2) {
        koksma_points p = with_density("progressive-elimination", &map, n, 3);
        assert_memory_equal(p.xs, all.xs, 2 * n * sizeof *p.xs);
        for (int q = 0; q < 4; q++) {
            const double densest = sqrt(2 / (sqrt(3) * (double)n * (double)values[q] / 2.5));
            assert_true(smallest(p.xs, n, 2, 2, true, q) > 0.5 * densest);
        }
        koksma_points_fini(&p);
    }
    koksma_points_fini(&all);
    koksma_image_fini(&map);
}

/* ---- Models ---------------------------------------------------------------------------------------------- */

/* A box of 2 x 1 x 1 with an open top, of quadrilaterals, and a sliver of length 4 above it. */
static const double vertices[][3] = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0},   {0, 0, 1}, {2, 0, 1},
                                     {2, 1, 1}, {0, 1, 1}, {4, 0, 3}, {0, 0.3, 3}, {0, 0, 3}};
static const int faces[][3] = {{1, 4, 3}, {1, 3, 2}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7},  {2, 7, 6},
                               {3, 4, 8}, {3, 8, 7}, {4, 1, 5}, {4, 5, 8}, {9, 10, 11}};
enum { FACES = sizeof faces / sizeof *faces, BINS = 4 * FACES };

static char model[64];

static int write_model(void **state)
{
    (void)state;
    snprintf(model, sizeof model, "/tmp/koksma-domains-XXXXXX");
    assert_non_null(mkdtemp(model));
    strcat(model, "/box.obj");
    FILE *f = fopen(model, "w");
    assert_non_null(f);
    for (size_t i = 0; i < sizeof vertices / sizeof *vertices; i++) {
        fprintf(f, "v %g %g %g\n", vertices[i][0], vertices[i][1], vertices[i][2]);
    }
    for (size_t i = 0; i < FACES; i++) {
        fprintf(f, "f %d %d %d\n", faces[i][0], faces[i][1], faces[i][2]);
    }
    return fclose(f);
}

static int remove_model(void **state)
{
    (void)state;
    remove(model);
    *strrchr(model, '/') = '\0';
    return rmdir(model);
}

static koksma_points on_model(const char *text, size_t n, int dim, uint64_t seed)
{
    const koksma_spec spec = spec_of(text);
    koksma_points p;
    assert_ok(koksma_points_init(&p, n, dim));
    assert_ok(koksma_generate_on(&spec, seed, model, NULL, &p));
    return p;
}

static double cross(const double *a, const double *b, double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
    return sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
}

/* The areas of the parts of a triangle opposite to its corners, over its own: barycentric coordinates; returns the
   triangle's area and its unit normal. */
static double barycentric(int face, const double *x, double weights[3], double normal[3])
{
    const double *p[3];
    double e[2][3], area;
    for (int c = 0; c < 3; c++) {
        p[c] = vertices[faces[face][c] - 1];
    }
    for (int k = 0; k < 3; k++) {
        e[0][k] = p[1][k] - p[0][k];
        e[1][k] = p[2][k] - p[0][k];
    }
    area = cross(e[0], e[1], normal);
    for (int k = 0; k < 3; k++) {
        normal[k] /= area;
    }
    for (int c = 0; c < 3; c++) {
        double u[3], v[3], part[3];
        for (int k = 0; k < 3; k++) {
            u[k] = p[(c + 1) % 3][k] - x[k];
            v[k] = p[(c + 2) % 3][k] - x[k];
        }
        cross(u, v, part);
        weights[c] = (part[0] * normal[0] + part[1] * normal[1] + part[2] * normal[2]) / area;
    }
    return area / 2;
}

/* Each triangle is cut into four of equal area by the middles of its sides; counts of the parts by chi-squared: the
   bound is its quantile of 1 - 1e-6 (Wilson & Hilferty 1931). Points lie in the triangle that they name. */
TEST_CASE(areas_are_even)
{
    static const struct {
        const char *spec;
        size_t n;
    } rows[] = {{"random", 40000}, {"sample-elimination", 4000}, {"progressive-elimination:length=3000", 3000}};
    const double df = BINS - 1, cube = 1 - 2 / (9 * df) + 4.753 * sqrt(2 / (9 * df));
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        koksma_points p = on_model(rows[r].spec, rows[r].n, 7, 5);
        double counts[BINS] = {0}, areas[FACES], total = 0, squared = 0, w[3], normal[3];
        for (int t = 0; t < FACES; t++) {
            total += areas[t] = barycentric(t, vertices[0], w, normal);
        }
        for (size_t i = 0; i < p.n; i++) {
            const double *x = p.xs + 7 * i;
            const int t = (int)x[6];
            assert_true(t >= 0 && t < FACES && x[6] == t);
            barycentric(t, x, w, normal);
            for (int k = 0; k < 3; k++) {
                assert_true(w[k] > -1e-6);
                assert_near(x[3 + k], normal[k], 1e-6);
            }
            assert_near(w[0] + w[1] + w[2], 1, 1e-6);
            counts[4 * t + (w[0] > 0.5 ? 0 : w[1] > 0.5 ? 1 : w[2] > 0.5 ? 2 : 3)]++;
        }
        for (int b = 0; b < BINS; b++) {
            const double expected = (double)p.n * areas[b / 4] / total / 4;
            squared += (counts[b] - expected) * (counts[b] - expected) / expected;
        }
        if (squared > df * cube * cube * cube) {
            fail_msg("%s: chi-squared is %g with %g degrees of freedom", rows[r].spec, squared, df);
        }
        koksma_points_fini(&p);
    }
}

TEST_CASE(points_on_models_keep_distances)
{
    const double area = 8 + 0.6; /* of five faces of the box, and of the sliver */
    koksma_points p = on_model("sample-elimination", 600, 3, 2);
    assert_near(smallest(p.xs, p.n, 3, 3, false, -1) / sqrt(2 * area / (sqrt(3) * 600)), 0.68, 0.06);
    koksma_points normals = on_model("sample-elimination", 600, 6, 2);
    for (size_t i = 0; i < p.n; i++) {
        assert_memory_equal(p.xs + 3 * i, normals.xs + 6 * i, 3 * sizeof *p.xs);
    }
    koksma_points_fini(&p);
    koksma_points_fini(&normals);
}

/* ---- Refusals -------------------------------------------------------------------------------------------- */

static bool count(void *context, double fraction)
{
    assert_true(fraction >= 0 && fraction <= 1);
    ++*(int *)context;
    return true;
}

/* The work between two questions whether to go on is bounded, also before the first point is chosen. */
TEST_CASE(calls_ask_often)
{
    const struct {
        const char *pattern;
        size_t n;
        int least;
    } rows[] = {{"random", 100000, 20}, {"sample-elimination", 20000, 80}};
    const float values[4] = {1, 2, 3, 4};
    koksma_image map = quarters(values);
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        const koksma_spec spec = spec_of(rows[r].pattern);
        int questions = 0;
        koksma_points p;
        assert_ok(koksma_points_init(&p, rows[r].n, 2));
        const koksma_run run = {.threads = 1, .keep_going = count, .context = &questions};
        assert_ok(koksma_generate_density(&spec, 0, &map, &run, &p));
        assert_in_range(questions, rows[r].least, 10000);
        koksma_points_fini(&p);
        questions = 0;
        assert_ok(koksma_points_init(&p, rows[r].n, 3));
        assert_ok(koksma_generate_on(&spec, 0, model, &run, &p));
        assert_in_range(questions, rows[r].least, 10000);
        koksma_points_fini(&p);
    }
    koksma_image_fini(&map);
}

TEST_GROUP(write_model, remove_model)
