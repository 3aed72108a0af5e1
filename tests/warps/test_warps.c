/* SPDX-License-Identifier: Apache-2.0 */
/* Warps keep area; potentials against quadrature; edges of mapped points against random lines and planes. */
#include <string.h>

#include <koksma/warp.h>

#include "measures/warped/warped.h"
#include "sets.h"

enum { GRID = 256 };

/* Whether lines or great circles are random on the warp's domain, and its kind among these domains. */
static bool has_edges(const koksma_warp *warp, koksma__domain_kind *kind)
{
    *kind = warp->domain == KOKSMA_DOMAIN_DISK         ? KOKSMA__DISK
            : warp->domain == KOKSMA_DOMAIN_TRIANGLE   ? KOKSMA__TRIANGLE
            : warp->domain == KOKSMA_DOMAIN_HEMISPHERE ? KOKSMA__HEMISPHERE
                                                       : KOKSMA__SPHERE;
    return *kind != KOKSMA__SPHERE || warp->domain == KOKSMA_DOMAIN_SPHERE;
}

/* P(p) is the mean of sigma(p, map(u)) over the square, if the map keeps areas and P is right; C the mean of P. */
TEST_CASE(potentials_are_means_over_the_square)
{
    const koksma_warp *warp;
    koksma__domain_kind kind;
    for (size_t w = 0; (warp = koksma_warp_at(w)); w++) {
        if (!has_edges(warp, &kind)) {
            continue;
        }
        double mean = 0;
        for (int s = 0; s < 6; s++) {
            double p[3], q[3], sum = 0;
            warp->map((double[2]){sets_unit(1, (uint64_t)s), sets_unit(2, (uint64_t)s)}, p);
            for (int i = 0; i < GRID * GRID; i++) {
                warp->map((double[2]){(i % GRID + 0.5) / GRID, (i / GRID + 0.5) / GRID}, q);
                sum += koksma__domain_separates(kind, p, q);
            }
            assert_near(koksma__domain_potential(kind, p), sum / GRID / GRID, 3e-5);
        }
        for (int i = 0; i < 64 * 64; i++) {
            double q[3];
            warp->map((double[2]){(i % 64 + 0.5) / 64, (i / 64 + 0.5) / 64}, q);
            mean += koksma__domain_potential(kind, q) / 4096;
        }
        assert_near(koksma__domain_constant(kind), mean, 2e-4);
    }
    assert_null(koksma_warp_find("bilinear"));
}

TEST_CASE(maps_may_write_over_what_they_map)
{
    const koksma_warp *warp;
    for (size_t w = 0; (warp = koksma_warp_at(w)) != NULL; w++) {
        for (uint64_t i = 0; i < 1000; i++) {
            double place[3] = {sets_unit(3, i), sets_unit(4, i), 0}, mapped[3];
            warp->map(place, mapped);
            warp->map(place, place);
            assert_memory_equal(place, mapped, (size_t)warp->dim * sizeof *mapped);
        }
    }
}

static koksma_value measure_warped(const char *warp, const char *measure, const koksma_points *points)
{
    koksma_spec spec;
    koksma_value value;
    assert_ok(koksma_measure_spec(measure, &spec));
    assert_ok(koksma_warp_evaluate(koksma_warp_find(warp), &spec, points, NULL, &value));
    return value;
}

/* In the disk lines at a uniform angle and distance, on the hemisphere and the sphere planes with uniform normals: the
   mean square, and no line may beat `edge`. */
TEST_CASE(edges_agree_with_random_lines)
{
    static const char *const warps[] = {"concentric-disk", "polar-disk", "hemisphere", "sphere"};
    for (int w = 0; w < 4; w++) {
        const koksma_warp *warp = koksma_warp_find(warps[w]);
        koksma_points p = test_points("jittered", 16, 2, 5);
        double mapped[48], sum = 0, squares = 0, most = 0;
        for (size_t i = 0; i < p.n; i++) {
            warp->map(p.xs + 2 * i, mapped + 3 * i);
        }
        const int lines = 100000;
        for (uint64_t l = 0; l < (uint64_t)lines; l++) {
            const double angle = 2 * M_PI * sets_unit(8, l), t = 2 * sets_unit(9, l) - 1;
            const double z = w >= 2 ? t : 0, r = sqrt(1 - z * z), c = w >= 2 ? 0 : t;
            double inside = 0;
            for (size_t i = 0; i < p.n; i++) {
                const double *x = mapped + 3 * i;
                inside += r * (cos(angle) * x[0] + sin(angle) * x[1]) + (w >= 2 ? z * x[2] : 0) <= c;
            }
            const double area = w == 3 ? 0.5 : w == 2 ? acos(z) / M_PI : (acos(-t) + t * sqrt(1 - t * t)) / M_PI;
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
TEST_CASE(triangle_is_affine)
{
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

/* The share of the domain where x cos + y sin <= c. */
static double mass_below(koksma__domain_kind kind, double angle, double c)
{
    const double a = cos(angle), b = sin(angle);
    return koksma__domains[kind].area_below_through(a, b, (double[2]){a * c, b * c});
}

/* Lines of 720 directions through each point: a lower bound of the supremum. The points on a line count with it, and
   without. */
static double worst_of_many_lines(koksma__domain_kind kind, size_t n, const double *xs)
{
    double worst = 0;
    for (int turn = 0; turn < 720; turn++) {
        const double angle = 2 * M_PI * turn / 720, a = cos(angle), b = sin(angle);
        for (size_t p = 0; p < n; p++) {
            const double c = a * xs[2 * p] + b * xs[2 * p + 1], mass = mass_below(kind, angle, c);
            double closed = 0, open = 0;
            for (size_t i = 0; i < n; i++) {
                const double here = a * xs[2 * i] + b * xs[2 * i + 1];
                closed += here <= c + 1e-12;
                open += here < c - 1e-12;
            }
            worst = fmax(worst, fmax(closed / (double)n - mass, mass - open / (double)n));
        }
    }
    return worst;
}

/* Points that repeat in the domain's centre, corners and sides (kinds 1 and 4 of sets.h), alone and among others. */
TEST_CASE(edges_beat_every_line)
{
    static const char *const warps[] = {"concentric-disk", "polar-disk", "triangle", "triangle-heitz"};
    static const size_t sizes[] = {1, 2, 5, 9};
    for (int round = 0; round < 4 * 4 * SETS_KINDS * 4; round++) {
        const koksma_warp *warp = koksma_warp_find(warps[round % 4]);
        const size_t n = sizes[round / 4 % 4];
        koksma_points p = sets_points(n, 2, round / 16 % SETS_KINDS, (uint64_t)round);
        for (size_t i = 2; i < n && round / 96 == 3; i++) { /* most of them are the first */
            p.xs[2 * i] = p.xs[0];
            p.xs[2 * i + 1] = p.xs[1];
        }
        double mapped[18];
        for (size_t i = 0; i < n; i++) {
            warp->map(p.xs + 2 * i, mapped + 2 * i);
        }
        const koksma_value edge = measure_warped(warp->name, "edge", &p);
        const double worst = worst_of_many_lines((koksma__domain_kind)warp->domain, n, mapped);
        assert_true(edge.exact && edge.value > 0 && edge.value <= 1);
        if (!(edge.value >= worst - 1e-10)) {
            sets_print(&p);
            fail_msg("%s: edge is %.17g, a line gives %.17g", warp->name, edge.value, worst);
        }
        assert_near(fabs((double)edge.witness.count / (double)n - edge.witness.volume), edge.value, 1e-14);
        koksma_points_fini(&p);
    }
}

/* Known exactly: k of n points in a corner of the triangle are a half-plane of no area; a point in the disk's centre
   has half of it on each side. */
TEST_CASE(edges_at_corners_and_centres)
{
    static const struct {
        const char *warp;
        double at[2];
        size_t at_it, n;
        double value; /* at least */
    } cases[] = {
        {"concentric-disk", {0.5, 0.5}, 1, 1, 0.5},
        {"polar-disk", {0, 0.3}, 1, 1, 0.5},
        {"polar-disk", {0, 0.3}, 4, 4, 0.5},
        {"triangle", {0, 0}, 1, 1, 1},
        {"triangle", {1, 1}, 2, 2, 1},
        {"triangle", {1, 0}, 3, 3, 1},
        {"triangle", {0, 0}, 5, 6, 5. / 6},
        {"triangle", {1, 1}, 5, 6, 5. / 6},
        {"triangle-heitz", {0, 0}, 5, 6, 5. / 6},
        {"triangle-heitz", {1, 0}, 5, 6, 5. / 6},
        {"triangle-heitz", {0, 1}, 5, 6, 5. / 6},
        {"triangle", {1, 0}, 3, 5, 3. / 5},
        {"concentric-disk", {1, 0.5}, 3, 5, 3. / 5},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        double xs[12];
        for (size_t i = 0; i < cases[c].n; i++) {
            const bool at_it = i < cases[c].at_it;
            xs[2 * i] = at_it ? cases[c].at[0] : i % 2 ? 0.5 : 0.1;
            xs[2 * i + 1] = at_it ? cases[c].at[1] : i % 2 ? 0.3 : 0.9;
        }
        const koksma_points p = {cases[c].n, 2, xs};
        const double value = measure_warped(cases[c].warp, "edge", &p).value;
        assert_true(value >= cases[c].value - 1e-14);
        if (cases[c].at_it == cases[c].n) {
            assert_near(value, cases[c].value, 1e-14);
        }
    }
}

TEST_CASE(others_say_what_is_taken)
{
    koksma_points p = test_points("random", 4, 2, 3);
    koksma_spec spec;
    koksma_value value;
    assert_ok(koksma_measure_spec("star", &spec));
    assert_int_equal(koksma_warp_evaluate(koksma_warp_find("triangle"), &spec, &p, NULL, &value), KOKSMA_UNSUPPORTED);
    assert_non_null(strstr(koksma_error_text(), "l2-edge"));
    assert_ok(koksma_measure_spec("edge", &spec));
    assert_int_equal(koksma_warp_evaluate(koksma_warp_find("sphere"), &spec, &p, NULL, &value), KOKSMA_UNSUPPORTED);
    assert_non_null(strstr(koksma_error_text(), "sphere, which accepts l2-edge and l2-disk:law=area"));
    for (size_t i = 0; koksma_measure_at(i); i++) {
        assert_ok(koksma_measure_spec(koksma_measure_at(i)->name, &spec));
        assert_int_equal(koksma_warp_evaluate(koksma_warp_find("ggx-visible-normals"), &spec, &p, NULL, &value),
                         KOKSMA_UNSUPPORTED);
    }
    koksma_warp flat = *koksma_warp_find("sphere"); /* a caller's own, whose measures would read a third coordinate */
    flat.dim = 2;
    assert_ok(koksma_measure_spec("l2-edge", &spec));
    assert_int_equal(koksma_warp_evaluate(&flat, &spec, &p, NULL, &value), KOKSMA_ARGUMENT);
    assert_ok(koksma_measure_spec("disk-sampled:disks=2000,r=0.5", &spec));
    assert_ok(koksma_warp_evaluate(koksma_warp_find("polar-disk"), &spec, &p, NULL, &value));
    assert_true(value.value > 0 && value.standard_error > 0 && !value.exact);
    koksma_points_fini(&p);
}
