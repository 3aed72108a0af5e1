/* SPDX-License-Identifier: Apache-2.0 */
/* Points in rectangles and on pictures that are no squares: distances by all pairs on the torus of the rectangle, for
   every pattern of the table that claims blue noise; sets whose distance decides how many points there are. */
#include <koksma/density.h>

#include <string.h>

#include "test.h"

enum { UNIT = 12 }; /* the larger side of a picture has up to 4 UNIT pixels */

static koksma_image even_picture(int width, int height)
{
    koksma_image map;
    assert_ok(koksma_image_init(&map, width, height, 1));
    for (int i = 0; i < width * height; i++) {
        map.pixels[i] = 0.25f;
    }
    return map;
}

static koksma_spec spec_of(const char *text)
{
    koksma_spec spec;
    assert_ok(koksma_pattern_spec(text, &spec));
    return spec;
}

/* Of two points on the torus of a rectangle. */
static double distance_of(const double *a, const double *b, const double size[2])
{
    double square = 0;
    for (int k = 0; k < 2; k++) {
        const double t = fabs(a[k] - b[k]), across = fmin(t, size[k] - t);
        square += across * across;
    }
    return sqrt(square);
}

static double smallest(const koksma_points *p, const double size[2])
{
    double best = INFINITY;
    for (size_t i = 0; i < p->n; i++) {
        for (size_t j = 0; j < i; j++) {
            best = fmin(best, distance_of(p->xs + 2 * i, p->xs + 2 * j, size));
        }
    }
    return best;
}

/* The smallest distance over that of the densest packing of n points in the plane. */
static double relative_radius(const koksma_points *p, const double size[2])
{
    return smallest(p, size) / sqrt(2 * size[0] * size[1] / (sqrt(3) * (double)p->n));
}

/* Points that are in fractions of a picture, in units of its height. */
static void put_back(koksma_points *p, double ratio)
{
    for (size_t i = 0; i < p->n; i++) {
        assert_true(p->xs[2 * i] >= 0 && p->xs[2 * i] < 1 && p->xs[2 * i + 1] >= 0 && p->xs[2 * i + 1] < 1);
        p->xs[2 * i] *= ratio;
    }
}

static const int shapes[][2] = {{1, 1}, {4, 3}, {2, 1}, {4, 1}, {1, 4}};
enum { SHAPES = sizeof shapes / sizeof *shapes, SETS = test_repeats(3, 1), N = test_repeats(100, 40) };

/* The mean relative radius of sets on an even picture of a shape (density), or in a rectangle without one. */
static double mean_radius(const koksma_spec *spec, const int *shape, bool density)
{
    const double size[2] = {(double)shape[0] / shape[1], 1}, sides[2] = {0.3 * shape[0], 0.3 * shape[1]};
    koksma_image map = even_picture(UNIT * shape[0], UNIT * shape[1]);
    koksma_points p;
    double sum = 0;
    assert_ok(koksma_points_init(&p, N, 2));
    for (uint64_t seed = 0; seed < SETS; seed++) {
        if (density) {
            assert_ok(koksma_generate_density(spec, seed, &map, NULL, &p));
            put_back(&p, size[0]);
        } else {
            assert_ok(koksma_generate_rectangle(spec, seed, sides[0], sides[1], NULL, NULL, &p));
        }
        sum += relative_radius(&p, density ? size : sides) / SETS;
    }
    koksma_points_fini(&p);
    koksma_image_fini(&map);
    return sum;
}

/* Elimination keeps its relative radius whatever the shape; with distances
   of the unit square 4:3 would lose 10 %, 4:1 half. */
TEST_CASE(radii_do_not_depend_on_the_shape)
{
    for (int i = 0; i < 2; i++) {
        char text[64];
        snprintf(text, sizeof text, i ? "progressive-elimination:length=%d" : "sample-elimination", (int)N);
        const koksma_spec spec = spec_of(text);
        const double square = mean_radius(&spec, shapes[0], true);
        for (size_t s = 0; s < SHAPES; s++) {
            for (int density = 0; density < 2; density++) {
                const double found = mean_radius(&spec, shapes[s], density);
                print_message("%s, %d:%d, %s: %.3f\n", text, shapes[s][0], shapes[s][1],
                              density ? "picture" : "rectangle", found);
                assert_true(found > 0.5);
                if (!(fabs(found / square - 1) < test_repeats(8, 20) / 100.0)) {
                    fail_msg("%s, %d:%d: relative radius %.3f, in a square %.3f", text, shapes[s][0], shapes[s][1],
                             found, square);
                }
            }
        }
    }
}

/* A picture of 2:1, the right half of which has 4 times the density: distances there are half of those on the left. */
TEST_CASE(distances_follow_the_density_on_a_picture)
{
    static const char *const specs[] = {"sample-elimination", "progressive-elimination:length=250"};
    enum { POINTS = test_repeats(250, 100) };
    koksma_image map = even_picture(2 * UNIT, UNIT);
    for (int i = 0; i < 2 * UNIT * UNIT; i++) {
        map.pixels[i] = i % (2 * UNIT) < UNIT ? 1 : 4;
    }
    for (size_t s = 0; s < sizeof specs / sizeof *specs; s++) {
        const koksma_spec spec = spec_of(specs[s]);
        koksma_points p;
        assert_ok(koksma_points_init(&p, POINTS, 2));
        assert_ok(koksma_generate_density(&spec, 1, &map, NULL, &p));
        put_back(&p, 2);
        for (int half = 0; half < 2; half++) { /* each is a square of side 1 */
            double least = INFINITY;
            size_t count = 0;
            for (size_t i = 0; i < p.n; i++) {
                const double *a = p.xs + 2 * i;
                count += (a[0] >= 1) == half;
                for (size_t j = 0; j < i && (a[0] >= 1) == half; j++) {
                    const double *b = p.xs + 2 * j;
                    least = (b[0] >= 1) == half ? fmin(least, hypot(a[0] - b[0], a[1] - b[1])) : least;
                }
            }
            const double expected = POINTS * (half ? 0.8 : 0.2), radius = least / sqrt(2 / (sqrt(3) * expected));
            print_message("%s, half %d: %zu of %g, relative radius %.3f\n", specs[s], half, count, expected, radius);
            assert_near((double)count, expected, 5 * sqrt(0.16 * POINTS));
            assert_true(radius > (TEST_SANITIZED ? 0.4 : 0.5));
        }
        koksma_points_fini(&p);
    }
    koksma_image_fini(&map);
}

/* An image in a rectangle of its shape gives the points of the image, in the rectangle's units. */
TEST_CASE(a_picture_fills_a_rectangle)
{
    const koksma_spec spec = spec_of("sample-elimination");
    koksma_image map = even_picture(4, 2);
    koksma_points a, b;
    map.pixels[3] = 2;
    assert_ok(koksma_points_init(&a, 50, 2));
    assert_ok(koksma_points_init(&b, 50, 2));
    assert_ok(koksma_generate_density(&spec, 7, &map, NULL, &a));
    assert_ok(koksma_generate_rectangle(&spec, 7, 16, 8, &map, NULL, &b));
    for (size_t i = 0; i < 100; i++) {
        assert_true(b.xs[i] == (i % 2 ? 8 : 16) * a.xs[i]);
    }
    koksma_points_fini(&a);
    koksma_points_fini(&b);
    koksma_image_fini(&map);
}
