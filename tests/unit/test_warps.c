/* SPDX-License-Identifier: Apache-2.0 */
/* Warps keep area; potentials against quadrature; edges of mapped points against random lines and planes. */
#include <string.h>

#include <koksma/warp.h>

#include "measures/parts/warp_domains.h"
#include "sets.h"

enum { GRID = 256 };

static koksma__domain_kind kind_of(int warp)
{
    static const koksma__domain_kind kinds[] = {KOKSMA__DISK, KOKSMA__DISK, KOKSMA__TRIANGLE, KOKSMA__HEMISPHERE,
                                                KOKSMA__HEMISPHERE};
    return kinds[warp];
}

/* P(p) is the mean of sigma(p, map(u)) over the square, if the map keeps areas and P is right; C the mean of P. */
static void potentials_are_means_over_the_square(void **state)
{
    (void)state;
    for (int w = 0; w < 5; w++) {
        const koksma_warp *warp = koksma_warp_at((size_t)w);
        double mean = 0;
        for (int s = 0; s < 6; s++) {
            double p[3], q[3], sum = 0;
            warp->map((double[2]){sets_unit(1, (uint64_t)s), sets_unit(2, (uint64_t)s)}, p);
            for (int i = 0; i < GRID * GRID; i++) {
                warp->map((double[2]){(i % GRID + 0.5) / GRID, (i / GRID + 0.5) / GRID}, q);
                sum += koksma__domain_separates(kind_of(w), p, q);
            }
            assert_near(koksma__domain_potential(kind_of(w), p), sum / GRID / GRID, 3e-5);
        }
        for (int i = 0; i < 64 * 64; i++) {
            double q[3];
            warp->map((double[2]){(i % 64 + 0.5) / 64, (i / 64 + 0.5) / 64}, q);
            mean += koksma__domain_potential(kind_of(w), q) / 4096;
        }
        assert_near(koksma__domain_constant(kind_of(w)), mean, 2e-4);
    }
    assert_null(koksma_warp_at(7));
    assert_null(koksma_warp_find("bilinear"));
}

static koksma_value measure_warped(const char *warp, const char *measure, const koksma_points *points)
{
    koksma_spec spec;
    koksma_value value;
    assert_ok(koksma_measure_spec(measure, &spec));
    assert_ok(koksma_warp_evaluate(koksma_warp_find(warp), &spec, points, NULL, &value));
    return value;
}

/* In the disk lines at a uniform angle and distance, on the hemisphere planes with uniform normals: the mean square,
   and no line may beat `edge`. */
static void edges_agree_with_random_lines(void **state)
{
    (void)state;
    static const char *const warps[] = {"concentric-disk", "polar-disk", "hemisphere"};
    for (int w = 0; w < 3; w++) {
        const koksma_warp *warp = koksma_warp_find(warps[w]);
        koksma_points p = test_points("jittered", 16, 2, 5);
        double mapped[48], sum = 0, squares = 0, most = 0;
        for (size_t i = 0; i < p.n; i++) {
            warp->map(p.xs + 2 * i, mapped + 3 * i);
        }
        const int lines = 100000;
        for (uint64_t l = 0; l < (uint64_t)lines; l++) {
            const double angle = 2 * M_PI * sets_unit(8, l), t = 2 * sets_unit(9, l) - 1;
            const double z = w == 2 ? t : 0, r = sqrt(1 - z * z), c = w == 2 ? 0 : t;
            double inside = 0;
            for (size_t i = 0; i < p.n; i++) {
                const double *x = mapped + 3 * i;
                inside += r * (cos(angle) * x[0] + sin(angle) * x[1]) + (w == 2 ? z * x[2] : 0) <= c;
            }
            const double area = w == 2 ? acos(z) / M_PI : (acos(-t) + t * sqrt(1 - t * t)) / M_PI;
            const double deviation = inside / 16 - area;
            sum += deviation * deviation;
            squares += pow(deviation, 4);
            most = fmax(most, fabs(deviation));
        }
        const double mean = sum / lines, error = sqrt((squares / lines - mean * mean) / lines);
        assert_near(measure_warped(warps[w], "l2-edge", &p).square, mean, 5 * error);
        if (w < 2) {
            const double worst = measure_warped(warps[w], "edge", &p).value;
            assert_true(worst >= most && worst < most + 0.05);
        }
        koksma_points_fini(&p);
    }
}

/* A triangle's worst half-plane does not change under affine maps: exchange of the axes, and of corners. */
static void triangle_is_affine(void **state)
{
    (void)state;
    koksma_points p = test_points("random", 40, 2, 3), q = test_points("random", 40, 2, 3);
    const double edge = measure_warped("triangle", "edge", &p).value;
    for (size_t i = 0; i < p.n; i++) { /* v -> 1 - v exchanges two corners */
        q.xs[2 * i + 1] = 1 - p.xs[2 * i + 1];
    }
    assert_near(edge, measure_warped("triangle", "edge", &q).value, 1e-13);
    const double l2 = measure_warped("triangle", "l2-edge", &p).value;
    assert_true(l2 > 0.02 && l2 < 0.15 && edge > l2);
    koksma_points_fini(&p);
    koksma_points_fini(&q);
}

static void others_say_what_is_taken(void **state)
{
    (void)state;
    koksma_points p = test_points("random", 4, 2, 3);
    koksma_spec spec;
    koksma_value value;
    assert_ok(koksma_measure_spec("star", &spec));
    assert_int_equal(koksma_warp_evaluate(koksma_warp_find("triangle"), &spec, &p, NULL, &value), KOKSMA_UNSUPPORTED);
    assert_non_null(strstr(koksma_error_text(), "l2-edge"));
    assert_ok(koksma_measure_spec("disk-sampled:disks=2000,r=0.5", &spec));
    assert_ok(koksma_warp_evaluate(koksma_warp_find("polar-disk"), &spec, &p, NULL, &value));
    assert_true(value.value > 0 && value.standard_error > 0 && !value.exact);
    koksma_points_fini(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(potentials_are_means_over_the_square),
        cmocka_unit_test(edges_agree_with_random_lines),
        cmocka_unit_test(triangle_is_affine),
        cmocka_unit_test(others_say_what_is_taken),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
