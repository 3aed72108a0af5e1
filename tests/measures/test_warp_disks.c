/* SPDX-License-Identifier: Apache-2.0 */
/* Disks and caps of mapped points: potentials and constants by other means, the closed forms against random disks and
   caps, and the advantage of the concentric map. */
#include <koksma/warp.h>

#include "measures/shared/shared.h"
#include "measures/warped/warped.h"
#include "sets.h"

static koksma_value warped(const char *warp, const char *measure, const koksma_points *points)
{
    koksma_spec spec;
    koksma_value value;
    assert_ok(koksma_measure_spec(measure, &spec));
    assert_ok(koksma_warp_evaluate(koksma_warp_find(warp), &spec, points, NULL, &value));
    return value;
}

static double root_at_both_ends(double x, const void *context)
{
    (void)context;
    return sqrt(x * (2 - x)) * log(x);
}

TEST_CASE(quadrature_and_elliptic_integrals)
{
    /* the integral of sqrt(x (2-x)) ln x over (0,2), by substitution x = 1 - cos t: (pi/4)(1 - 2 ln 2) + pi/4 ln 2 */
    assert_near(koksma__integral(root_at_both_ends, NULL, 0, 2), M_PI / 4 - M_PI / 2 * log(2), 1e-14);
    assert_true(koksma__integral(root_at_both_ends, NULL, 1, 1) == 0);
    double first, second;
    koksma__elliptic(1, &first, &second);
    assert_near(first, M_PI / 2, 1e-15);
    assert_near(second, M_PI / 2, 1e-15);
    koksma__elliptic(sqrt(0.5), &first, &second); /* the lemniscate */
    assert_near(first, 1.8540746773013719184, 1e-15);
    assert_near(second, 1.3506438810476755025, 1e-15);
    koksma__elliptic(0, &first, &second);
    assert_true(second == 1);
}

static double potential_at(double z, const void *context)
{
    const koksma_warp_domain *domain = context;
    return koksma__cap_potential((double[]){sqrt((1 - z) * (1 + z)), 0, z}, *domain) *
           (*domain == KOKSMA_DOMAIN_HEMISPHERE_COSINE ? 2 * z : 1);
}

TEST_CASE(cap_potentials)
{
    const double pole[3] = {0, 0, 1}, rim[3] = {0.6, 0.8, 0};
    const koksma_warp_domain uniform = KOKSMA_DOMAIN_HEMISPHERE, cosine = KOKSMA_DOMAIN_HEMISPHERE_COSINE;
    assert_near(koksma__cap_potential(pole, uniform), 2 * sqrt(2) / 3, 1e-14);
    assert_near(koksma__cap_potential(rim, uniform), 4.0 / 3, 1e-14);
    assert_near(koksma__cap_potential(pole, cosine), 8 * sqrt(2) / 15, 1e-14);
    assert_near(koksma__cap_potential(rim, cosine), 64 / (15 * M_PI), 1e-14);
    assert_near(koksma__cap_constant(uniform), koksma__integral(potential_at, &uniform, 0, 1), 1e-13);
    assert_near(koksma__cap_constant(cosine), koksma__integral(potential_at, &cosine, 0, 1), 1e-13);
}

/* The mean distance over a mapped lattice of the square: the map carries the measure, and P is right. */
TEST_CASE(warps_carry_the_measure)
{
    static const char *const names[] = {"hemisphere", "concentric-hemisphere", "cosine-hemisphere", "sphere"};
    enum { GRID = 300 };
    for (int w = 0; w < 4; w++) {
        const koksma_warp *warp = koksma_warp_find(names[w]);
        for (uint64_t s = 0; s < 4; s++) {
            double x[3], y[3], sum = 0;
            warp->map((double[2]){sets_unit(11, s), sets_unit(12, s)}, x);
            for (int i = 0; i < GRID * GRID; i++) {
                warp->map((double[2]){(i % GRID + 0.5) / GRID, (i / GRID + 0.5) / GRID}, y);
                assert_near(y[0] * y[0] + y[1] * y[1] + y[2] * y[2], 1, 1e-14);
                sum += sqrt(pow(x[0] - y[0], 2) + pow(x[1] - y[1], 2) + pow(x[2] - y[2], 2)) / GRID / GRID;
            }
            assert_near(koksma__cap_potential(x, warp->domain), sum, 1e-4);
        }
    }
}

/* Heitz's triangle: means of 1, x, y, x y over the triangle. */
TEST_CASE(triangle_maps_keep_area)
{
    static const char *const names[] = {"triangle", "triangle-heitz"};
    enum { GRID = 400 };
    for (int w = 0; w < 2; w++) {
        double x[2], mean[3] = {0};
        for (int i = 0; i < GRID * GRID; i++) {
            koksma_warp_find(names[w])->map((double[2]){(i % GRID + 0.5) / GRID, (i / GRID + 0.5) / GRID}, x);
            assert_true(x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1);
            mean[0] += x[0] / GRID / GRID;
            mean[1] += x[1] / GRID / GRID;
            mean[2] += x[0] * x[1] / GRID / GRID;
        }
        assert_near(mean[0], 1.0 / 3, 1e-5);
        assert_near(mean[1], 1.0 / 3, 1e-5);
        assert_near(mean[2], 1.0 / 12, 1e-5);
    }
}

/* The closed form against random disks, over sets with ties and points on the rim. */
TEST_CASE(disks_agree_with_random_disks)
{
    static const double radii[] = {0.25, 0.5, 1, 0.1};
    double squares = 0;
    enum { CASES = 48 };
    for (int c = 0; c < CASES; c++) {
        char exact[64], sampled[96];
        const char *warp = c % 2 ? "polar-disk" : "concentric-disk";
        koksma_points p = sets_points(1 + (size_t)c % 13, 2, c / 2 % SETS_KINDS, (uint64_t)c);
        snprintf(exact, sizeof exact, "l2-disk:r=%.17g", fmin(radii[c % 4], 0.5));
        snprintf(sampled, sizeof sampled, "disk-sampled:disks=20000,r=%.17g,seed=%d", fmin(radii[c % 4], 0.5), c);
        const koksma_value v = warped(warp, sampled, &p);
        const double z = (v.value - warped(warp, exact, &p).value) / v.standard_error;
        assert_true(fabs(z) < 5);
        squares += z * z / CASES;
        koksma_points_fini(&p);
    }
    assert_near(squares, 1, 4 * sqrt(2.0 / CASES));
}

/* The error of one disk is unknown, that of two half of their squares' difference over twice the value; where nearly
   all squares are equal digits are not lost. */
TEST_CASE(errors_of_few_disks)
{
    koksma_points p = sets_points(9, 2, 0, 4);
    const koksma_value one = warped("polar-disk", "disk-sampled:disks=1", &p),
                       two = warped("polar-disk", "disk-sampled:disks=2", &p);
    assert_true(one.value > 0 && isnan(one.standard_error) && !one.exact);
    const double other = 2 * two.square - one.square;
    assert_near(two.standard_error, fabs(one.square - other) / 4 / two.value, 1e-15);
    koksma_points_fini(&p);
}

/* Random caps against a fine mapped lattice as the measure of the domain. */
TEST_CASE(caps_agree_with_random_caps)
{
    static const char *const names[] = {"hemisphere", "concentric-hemisphere", "cosine-hemisphere", "sphere"};
    enum { GRID = 100, CAPS = 4000, N = 16 };
    static double grid[3 * GRID * GRID];
    for (int w = 0; w < 4; w++) {
        const koksma_warp *warp = koksma_warp_find(names[w]);
        koksma_points p = test_points("random", N, 2, 4);
        double xs[3 * N], sum = 0, squares = 0;
        for (size_t i = 0; i < N; i++) {
            warp->map(p.xs + 2 * i, xs + 3 * i);
        }
        for (int i = 0; i < GRID * GRID; i++) {
            warp->map((double[2]){(i % GRID + 0.5) / GRID, (i / GRID + 0.5) / GRID}, grid + 3 * i);
        }
        for (uint64_t c = 0; c < CAPS; c++) {
            const double h = 2 * sets_unit(5, c) - 1, angle = 2 * M_PI * sets_unit(6, c), t = 2 * sets_unit(7, c) - 1;
            const double y[3] = {sqrt(1 - h * h) * cos(angle), sqrt(1 - h * h) * sin(angle), h};
            double inside = 0, all = 0;
            for (int i = 0; i < N; i++) {
                inside += xs[3 * i] * y[0] + xs[3 * i + 1] * y[1] + xs[3 * i + 2] * y[2] >= t;
            }
            for (int i = 0; i < GRID * GRID; i++) {
                all += grid[3 * i] * y[0] + grid[3 * i + 1] * y[1] + grid[3 * i + 2] * y[2] >= t;
            }
            const double deviation = inside / N - all / GRID / GRID;
            sum += deviation * deviation / CAPS;
            squares += pow(deviation, 4) / CAPS;
        }
        assert_near(warped(names[w], "l2-disk:law=area", &p).square, sum, 4 * sqrt((squares - sum * sum) / CAPS));
        koksma_points_fini(&p);
    }
}

/* Means of the square over random points: C/(8n) for caps. */
TEST_CASE(random_points)
{
    enum { SETS = 500, N = 8 };
    static const char *const names[] = {"hemisphere", "cosine-hemisphere", "sphere"};
    for (int w = 0; w < 3; w++) {
        double sum = 0, squares = 0;
        for (uint64_t seed = 0; seed < SETS; seed++) {
            koksma_points p = test_points("random", N, 2, 40 + seed);
            const double v = warped(names[w], "l2-disk:law=area", &p).square;
            sum += v / SETS;
            squares += v * v / SETS;
            koksma_points_fini(&p);
        }
        assert_near(sum, koksma__cap_constant(koksma_warp_find(names[w])->domain) / (8 * N),
                    4 * sqrt((squares - sum * sum) / SETS));
    }
}

/* docs/findings/disk-maps.md: jittered points lose less by the concentric map than by the polar one. */
TEST_CASE(concentric_beats_polar)
{
    static const char *const measures[] = {"l2-edge", "l2-disk", "edge"};
    enum { SETS = 200 };
    for (int c = 0; c < 6; c++) {
        const size_t n = c % 2 ? 256 : 16;
        const int sets = c >= 4 && n == 256 ? 20 : SETS; /* edge is the slow one */
        double sum = 0, squares = 0;
        for (int seed = 0; seed < sets; seed++) {
            koksma_points p = test_points("jittered", n, 2, (uint64_t)seed);
            const double d = warped("polar-disk", measures[c / 2], &p).value -
                             warped("concentric-disk", measures[c / 2], &p).value;
            sum += d / sets;
            squares += d * d / sets;
            koksma_points_fini(&p);
        }
        const double error = sqrt((squares - sum * sum) / (sets - 1));
        assert_that(sum > 3 * error, "%s at n = %zu: polar minus concentric is %.6f with standard error %.6f",
                    measures[c / 2], n, sum, error);
    }
}

/* phi - sin phi cos phi without cancelling. */
static double segment(double one_less_cosine)
{
    const double phi = 2 * asin(sqrt(one_less_cosine / 2)), x = 2 * phi;
    double term = x * x * x / 6, sum = 0;
    for (int k = 4; fabs(term) > 1e-20 * sum; k += 2) {
        sum += term;
        term *= -x * x / (k * (k + 1));
    }
    return sum / 2;
}

/* Disks of radius 1 and r a distance 1 + r - e apart share two segments. Small and large e, down to rounding. */
TEST_CASE(disks_that_touch)
{
    for (int i = 0; i < 200; i++) {
        const double r = i % 4 == 0 ? 1 : 0.25 * (i % 4), distance = (1 + r) - 0.4 * r * pow(10, -0.08 * i);
        const double e = (1 + r) - distance; /* exact */
        const double one = segment(e * (2 * r - e) / (2 * distance)),
                     other = segment(e * (2 - e) / (2 * distance * r));
        assert_near(koksma__disks_share(r, distance), one + r * r * other, 3e-16);
    }
}

/* Planes through the centre separate two points with the chance of their angle over pi: also of opposite ones. */
TEST_CASE(points_that_are_opposite)
{
    for (int i = 0; i < 160; i++) {
        const double angle = M_PI - pow(10, -0.1 * i), p[3] = {1, 0, 0}, q[3] = {cos(angle), 0, sin(angle)};
        assert_near(koksma__domain_separates(KOKSMA__HEMISPHERE, p, q), angle / M_PI, 3e-16);
        assert_near(koksma__domain_separates(KOKSMA__HEMISPHERE, q, p), angle / M_PI, 3e-16);
    }
}

/* Known exactly: a point; two opposite points, which every plane through the centre divides evenly; the six corners of an
   octahedron, with 12 distances sqrt 2 at right angles and 3 distances 2. */
TEST_CASE(few_points_on_the_sphere)
{
    static double xs[] = {0, 0, 1, 0.3, 0.5, 0, 0.5, 0.25, 0.5, 0.5, 0.5, 0.75};
    const koksma_points point = {1, 2, xs}, opposite = {2, 2, xs}, octahedron = {6, 2, xs};
    assert_near(warped("sphere", "l2-disk:law=area", &point).square, 1.0 / 6, 1e-15);
    assert_near(warped("sphere", "l2-disk:law=area", &opposite).square, 1.0 / 24, 1e-15);
    assert_near(warped("sphere", "l2-disk:law=area", &octahedron).square, (2.0 / 3 - (12 * sqrt(2) + 6) / 36) / 4,
                1e-15);
    assert_near(warped("sphere", "l2-edge", &point).square, 0.25, 1e-15);
    assert_near(warped("sphere", "l2-edge", &opposite).square, 0, 1e-15);
    assert_near(warped("sphere", "l2-edge", &octahedron).square, 0.25 - (12 * 0.5 + 3) / 36, 1e-15);
}
