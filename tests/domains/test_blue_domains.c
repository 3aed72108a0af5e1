/* SPDX-License-Identifier: Apache-2.0 */
/* poisson-disk-maximal with a density and on models, and gaussian-blue-noise with a density, from their definitions:
   distances of all pairs and of random positions for maximal sets, the Fourier coefficients of the density and power at
   low frequencies for Gaussian blue noise, areas by chi-squared. */
#include <koksma/density.h>

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "test.h"

static koksma_spec spec_of(const char *text)
{
    koksma_spec spec;
    assert_ok(koksma_pattern_spec(text, &spec));
    return spec;
}

/* ---- Densities ------------------------------------------------------------------------------------------- */

enum { SIDE = 4 };

/* 4 x 4 pixels, the bottom row first; one is black. */
static const float steps[SIDE * SIDE] = {1, 1, 3, 3, 1, 1, 3, 3, 9, 9, 2, 2, 9, 9, 2, 0};
static const float even[SIDE * SIDE] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};

static koksma_image map_of(const float *values)
{
    koksma_image map;
    assert_ok(koksma_image_init(&map, SIDE, SIDE, 1));
    for (int i = 0; i < SIDE * SIDE; i++) {
        map.pixels[i] = values[(SIDE - 1 - i / SIDE) * SIDE + i % SIDE];
    }
    return map;
}

static koksma_points with_density(const char *text, const float *values, size_t n, uint64_t seed, int threads)
{
    const koksma_spec spec = spec_of(text);
    koksma_image map = map_of(values);
    koksma_points p;
    assert_ok(koksma_points_init(&p, n, 2));
    assert_ok(koksma_generate_density(&spec, seed, &map, &(koksma_run){.threads = threads}, &p));
    koksma_image_fini(&map);
    return p;
}

static double sum_of(const float *values)
{
    double sum = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        sum += (double)values[i];
    }
    return sum;
}

/* 1 / sqrt of the density over its mean at x. */
static double unit_at(const float *values, const double *x)
{
    const int pixel = (int)(x[1] * SIDE) * SIDE + (int)(x[0] * SIDE);
    return sqrt(sum_of(values) / SIDE / SIDE / (double)values[pixel]);
}

static double distance_of(const double *a, const double *b, size_t dim, bool torus)
{
    double square = 0;
    for (size_t k = 0; k < dim; k++) {
        const double t = fabs(a[k] - b[k]), d = torus && t > 0.5 ? 1 - t : t;
        square += d * d;
    }
    return sqrt(square);
}

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

/* The largest d at which all pairs keep d times the smaller unit; no position of the square has room at that d. */
static double check_maximal(const koksma_points *p, const float *values)
{
    double d = INFINITY;
    for (size_t i = 0; i < p->n; i++) {
        for (size_t j = 0; j < i; j++) {
            const double *a = p->xs + 2 * i, *b = p->xs + 2 * j;
            d = fmin(d, distance_of(a, b, 2, true) / fmin(unit_at(values, a), unit_at(values, b)));
        }
    }
    uint64_t state = 1;
    for (int t = 0; t < test_repeats(20000, 2000); t++) {
        const double x[2] = {uniform(&state), uniform(&state)};
        if (!isfinite(unit_at(values, x))) {
            continue;
        }
        bool room = true;
        for (size_t i = 0; i < p->n && room; i++) {
            const double *y = p->xs + 2 * i;
            room = distance_of(x, y, 2, true) >= d * fmin(unit_at(values, x), unit_at(values, y));
        }
        if (room) {
            fail_msg("there is room at %g %g for d = %g", x[0], x[1], d);
        }
    }
    return d;
}

TEST_CASE(maximal_sets_follow_a_density)
{
    koksma_points p = with_density("poisson-disk-maximal", steps, 300, 1, 0);
    check_maximal(&p, steps);
    koksma_points_fini(&p);
    p = with_density("poisson-disk-maximal", even, 300, 2, 0);
    /* saturated random sequential addition of disks covers 0.547 of the plane (Feder 1980) */
    assert_near(check_maximal(&p, even), sqrt(4 * 0.547 / M_PI / 300), 0.002);
    koksma_points_fini(&p);
}

static koksma_status try_density(const char *text, size_t n, koksma_points *p)
{
    const koksma_spec spec = spec_of(text);
    koksma_image map = map_of(even);
    assert_ok(koksma_points_init(p, n, 2));
    const koksma_status status = koksma_generate_density(&spec, 4, &map, NULL, p);
    koksma_image_fini(&map);
    return status;
}

/* By distance the set has as many points as the message says, and keeps the distance. */
TEST_CASE(maximal_sets_keep_a_given_distance)
{
    koksma_points p;
    assert_int_equal(try_density("poisson-disk-maximal:d=0.05", 200, &p), KOKSMA_N);
    const char *said = strstr(koksma_error_text(), "with this seed has ");
    assert_non_null(said);
    const size_t n = strtoul(said + strlen("with this seed has "), NULL, 10);
    koksma_points_fini(&p);
    assert_ok(try_density("poisson-disk-maximal:d=0.05", n, &p));
    assert_true(check_maximal(&p, even) >= 0.05);
    koksma_points_fini(&p);
    assert_int_equal(try_density("poisson-disk-maximal:d=0.01", 10, &p), KOKSMA_N);
    assert_non_null(strstr(koksma_error_text(), "a larger d, or no d, would do"));
    koksma_points_fini(&p);
}

/* exp(2 pi i t) */
static double complex wave(double t)
{
    return cos(2 * M_PI * t) + (double complex)I * sin(2 * M_PI * t);
}

/* n times the mean of |F - E F|^2 over frequencies |a|, |b| <= 3, F the mean of exp(2 pi i (a x + b y)) over the points
   and E F that over the density: 1 - |E F|^2 on average for independent points. */
static double deviation(const koksma_points *p, const float *values)
{
    double sum = 0;
    for (int a = -3; a <= 3; a++) {
        for (int b = -3; b <= 3; b++) {
            double complex found = 0, wanted = 0;
            for (size_t i = 0; i < p->n; i++) {
                found += wave(a * p->xs[2 * i] + b * p->xs[2 * i + 1]) / (double)p->n;
            }
            for (int pixel = 0; pixel < SIDE * SIDE; pixel++) {
                const double x = (pixel % SIDE + 0.5) / SIDE, y = ((double)(pixel / SIDE) + 0.5) / SIDE;
                const double u = M_PI * a / SIDE, v = M_PI * b / SIDE;
                const double box = (a ? sin(u) / u : 1) * (b ? sin(v) / v : 1);
                wanted += (double)values[pixel] / sum_of(values) * box * wave(a * x + b * y);
            }
            sum += (double)p->n * pow(cabs(found - wanted), 2) / 48;
        }
    }
    return sum;
}

/* Low frequencies of the points are those of the density. */
TEST_CASE(gaussian_sets_follow_a_density)
{
    koksma_points p = with_density("gaussian-blue-noise", steps, 256, 1, 0);
    koksma_points white = with_density("random", steps, 256, 1, 0);
    assert_true(deviation(&white, steps) > 0.4 && deviation(&white, steps) < 2);
    assert_true(deviation(&p, steps) < 0.02);
    for (size_t i = 0; i < p.n; i++) {
        assert_true(isfinite(unit_at(steps, p.xs + 2 * i)));
    }
    koksma_points_fini(&white);
    koksma_points_fini(&p);
}

/* ---- Models ---------------------------------------------------------------------------------------------- */

/* A unit sphere of triangles, an octahedron whose faces are quartered and pushed out, and beside it a flat square of
   side 2, whose border is open. */
enum { LEVELS = 3, FACES = 8 << (2 * LEVELS), SQUARE_FACES = 2 };

static double corners[FACES + SQUARE_FACES][3][3];
static char model[64];

static void quarter_face(const double c[3][3], int level, size_t *n)
{
    if (level == LEVELS) {
        memcpy(corners[(*n)++], c, sizeof corners[0]);
        return;
    }
    double middle[3][3];
    for (int i = 0; i < 3; i++) {
        double square = 0;
        for (int k = 0; k < 3; k++) {
            middle[i][k] = c[i][k] + c[(i + 1) % 3][k];
            square += middle[i][k] * middle[i][k];
        }
        for (int k = 0; k < 3; k++) {
            middle[i][k] /= sqrt(square);
        }
    }
    for (int i = 0; i < 4; i++) {
        double q[3][3];
        memcpy(q[0], i < 3 ? c[i] : middle[0], sizeof q[0]);
        memcpy(q[1], i < 3 ? middle[i] : middle[1], sizeof q[0]);
        memcpy(q[2], i < 3 ? middle[(i + 2) % 3] : middle[2], sizeof q[0]);
        quarter_face((const double(*)[3])q, level + 1, n);
    }
}

static int write_model(void **state)
{
    (void)state;
    size_t n = 0;
    for (int octant = 0; octant < 8; octant++) {
        const double x = octant & 1 ? -1 : 1, y = octant & 2 ? -1 : 1, z = octant & 4 ? -1 : 1;
        const double c[3][3] = {{x, 0, 0}, {0, y, 0}, {0, 0, z}};
        quarter_face(c, 0, &n);
    }
    const double square[4][3] = {{3, -1, 0}, {5, -1, 0}, {5, 1, 0}, {3, 1, 0}};
    for (int c = 0; c < 3; c++) {
        memcpy(corners[n][c], square[c], sizeof square[c]);
        memcpy(corners[n + 1][c], square[(c + 2) % 4], sizeof square[c]);
    }
    snprintf(model, sizeof model, "/tmp/koksma-blue-XXXXXX");
    assert_non_null(mkdtemp(model));
    strcat(model, "/model.obj");
    FILE *f = fopen(model, "w");
    assert_non_null(f);
    for (size_t i = 0; i < FACES + SQUARE_FACES; i++) {
        for (int c = 0; c < 3; c++) {
            fprintf(f, "v %.9g %.9g %.9g\n", corners[i][c][0], corners[i][c][1], corners[i][c][2]);
        }
        fprintf(f, "f %zu %zu %zu\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
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

static koksma_points on_model(const char *text, size_t n, uint64_t seed)
{
    const koksma_spec spec = spec_of(text);
    koksma_points p;
    assert_ok(koksma_points_init(&p, n, 7));
    assert_ok(koksma_generate_on(&spec, seed, model, NULL, &p));
    return p;
}

static double area_of(size_t face)
{
    double e[2][3], square = 0;
    for (int k = 0; k < 3; k++) {
        e[0][k] = corners[face][1][k] - corners[face][0][k];
        e[1][k] = corners[face][2][k] - corners[face][0][k];
    }
    for (int k = 0; k < 3; k++) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        square += pow(e[0][u] * e[1][v] - e[0][v] * e[1][u], 2);
    }
    return sqrt(square) / 2;
}

static const double square_area = 4;

static double total_area(void)
{
    double sum = 0;
    for (size_t face = 0; face < FACES + SQUARE_FACES; face++) {
        sum += area_of(face);
    }
    return sum;
}

/* Chi-squared of the counts in the eight octants of the sphere, and in 3 x 3 parts of the square. Points lie on the
   triangles that they name. */
static double chi_squared(const koksma_points *p)
{
    double counts[17] = {0}, squared = 0;
    const double total = total_area(), octant = (total - square_area) / 8;
    for (size_t i = 0; i < p->n; i++) {
        const double *x = p->xs + 7 * i;
        const size_t face = (size_t)x[6];
        double off = 0;
        assert_true(face < FACES + SQUARE_FACES);
        for (int k = 0; k < 3; k++) {
            off += x[3 + k] * (x[k] - corners[face][0][k]);
        }
        assert_near(off, 0, 1e-6);
        if (face < FACES) {
            counts[(x[0] < 0) + 2 * (x[1] < 0) + 4 * (x[2] < 0)]++;
        } else {
            assert_true(fabs(x[0] - 4) <= 1 + 1e-12 && fabs(x[1]) <= 1 + 1e-12); /* rounding at the border */
            counts[8 + (int)fmin((x[0] - 3) * 1.5, 2) + 3 * (int)fmin((x[1] + 1) * 1.5, 2)]++;
        }
    }
    for (int b = 0; b < 17; b++) {
        const double expected = (double)p->n * (b < 8 ? octant : square_area / 9) / total;
        squared += (counts[b] - expected) * (counts[b] - expected) / expected;
    }
    return squared;
}

TEST_CASE(models_are_covered_evenly)
{
    koksma_points p = on_model("poisson-disk-maximal", 1000, 1);
    assert_true(chi_squared(&p) < 39); /* its quantile of 0.999 for independent points */
    koksma_points_fini(&p);
}

TEST_CASE(maximal_sets_cover_models)
{
    koksma_points p = on_model("poisson-disk-maximal", 500, 2);
    double d = INFINITY;
    for (size_t i = 0; i < p.n; i++) {
        for (size_t j = 0; j < i; j++) {
            d = fmin(d, distance_of(p.xs + 7 * i, p.xs + 7 * j, 3, false));
        }
    }
    uint64_t random = 7;
    for (int t = 0; t < test_repeats(20000, 2000); t++) {
        double x[3], nearest = INFINITY, u = uniform(&random), v = uniform(&random);
        const size_t face = t % 3 ? (size_t)(uniform(&random) * FACES) : FACES + (size_t)(t % 2);
        for (int k = 0; k < 3; k++) {
            const double *c[3] = {corners[face][0], corners[face][1], corners[face][2]};
            x[k] = c[0][k] + (u + v > 1 ? 1 - u : u) * (c[1][k] - c[0][k]) +
                   (u + v > 1 ? 1 - v : v) * (c[2][k] - c[0][k]);
        }
        for (size_t i = 0; i < p.n; i++) {
            nearest = fmin(nearest, distance_of(x, p.xs + 7 * i, 3, false));
        }
        assert_true(nearest < d * (1 + 1e-6));
    }
    koksma_points_fini(&p);
}

/* ---- Progressive order ----------------------------------------------------------------------------------- */

static size_t width; /* coordinates of a point in the sort */

static int by_coordinates(const void *a, const void *b)
{
    const double *x = a, *y = b;
    int order = 0;
    for (size_t k = 0; k < width && !order; k++) {
        order = (x[k] > y[k]) - (x[k] < y[k]);
    }
    return order;
}

/* Fails unless both sets have the same points in different orders. Sorts them. */
static void assert_same_points(koksma_points *a, koksma_points *b)
{
    width = (size_t)a->dim;
    assert_memory_not_equal(a->xs, b->xs, a->n * width * sizeof *a->xs);
    qsort(a->xs, a->n, width * sizeof *a->xs, by_coordinates);
    qsort(b->xs, b->n, width * sizeof *b->xs, by_coordinates);
    assert_memory_equal(a->xs, b->xs, a->n * width * sizeof *a->xs);
}

/* The least distance of two of the first n points, in the smaller unit of both, over that of the densest packing of n. */
static double relative_radius(const koksma_points *p, size_t n)
{
    double d = INFINITY;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < i; j++) {
            const double *a = p->xs + 2 * i, *b = p->xs + 2 * j;
            d = fmin(d, distance_of(a, b, 2, true) / fmin(unit_at(steps, a), unit_at(steps, b)));
        }
    }
    return d / sqrt(2 / (sqrt(3) * (double)n));
}

static const char *const ordered[] = {"poisson-disk-maximal", "gaussian-blue-noise"};

/* Prefixes follow the density, as blue noise of their number does; those of the plain order are random. The few points of
   the run with sanitizers have too much spread for that: it compares threads and orders. */
TEST_CASE(prefixes_follow_a_density)
{
    enum { N = test_repeats(512, 128) };
    for (size_t s = 0; s < 2; s++) {
        char text[64];
        snprintf(text, sizeof text, "%s:order=progressive", ordered[s]);
        koksma_points p = with_density(text, steps, N, 1, 0), again = with_density(text, steps, N, 1, 3);
        koksma_points plain = with_density(ordered[s], steps, N, 1, 0);
        assert_memory_equal(p.xs, again.xs, 2 * p.n * sizeof *p.xs);
        for (size_t n = 64; n <= N / 2; n *= 2) {
            const koksma_points part = {.n = n, .dim = 2, .xs = p.xs}, random = {.n = n, .dim = 2, .xs = plain.xs};
            const double radius = relative_radius(&p, n), radius_of_random = relative_radius(&plain, n);
            const double power = deviation(&part, steps), power_of_random = deviation(&random, steps);
            print_message("%s, first %zu of %d: relative radius %.3f (plain %.3f), power %.3f (plain %.3f)\n",
                          ordered[s], n, N, radius, radius_of_random, power, power_of_random);
            assert_true(TEST_SANITIZED || (radius > 0.57 && radius > radius_of_random + 0.02));
            assert_true(TEST_SANITIZED || (power < 0.3 && power < 0.7 * power_of_random));
        }
        assert_same_points(&p, &plain);
        koksma_points_fini(&p);
        koksma_points_fini(&again);
        koksma_points_fini(&plain);
    }
}

/* The same on a model: distances, and counts in parts of equal area, of which independent points have a chi-squared of 16
   on average. */
TEST_CASE(prefixes_cover_models)
{
    enum { N = test_repeats(800, 200) };
    koksma_points p = on_model("poisson-disk-maximal:order=progressive", N, 1);
    koksma_points plain = on_model("poisson-disk-maximal", N, 1);
    for (size_t n = 100; n <= N / 2; n *= 2) {
        const koksma_points part = {.n = n, .dim = 7, .xs = p.xs};
        const double closest = sqrt(2 * total_area() / (sqrt(3) * (double)n));
        double d = INFINITY, random = INFINITY;
        for (size_t i = 0; i < n; i++) {
            for (size_t j = 0; j < i; j++) {
                d = fmin(d, distance_of(p.xs + 7 * i, p.xs + 7 * j, 3, false));
                random = fmin(random, distance_of(plain.xs + 7 * i, plain.xs + 7 * j, 3, false));
            }
        }
        print_message("first %zu of %d: relative radius %.3f (plain %.3f), chi-squared %.2f\n", n, N, d / closest,
                      random / closest, chi_squared(&part));
        assert_true(d > 0.57 * closest && d > random + 0.02 * closest);
        assert_true(chi_squared(&part) < test_repeats(8, 16));
    }
    assert_same_points(&p, &plain);
    koksma_points_fini(&p);
    koksma_points_fini(&plain);
}

TEST_GROUP(write_model, remove_model)
