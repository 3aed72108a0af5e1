/* SPDX-License-Identifier: Apache-2.0 */
/* Half-spaces and balls of 3 dimensions against searches, quadrature and sampling that know nothing of planes through
   points. */
#include <string.h>

#include "measures/edge/edge.h"
#include "sets.h"

enum { DIRECTIONS = 1500, STARTS = 6 };

/* The volume of the cube where a . x <= c: the area of each slice, which is of degree 2 in z between the places where
   the line of the slice goes through a corner, by the rule of Gauss with two nodes, which is exact
   there. */
static double sliced_volume(const double a[3], double c)
{
    double at[6] = {0, 1, 0, 0, 0, 0}, volume = 0;
    for (int corner = 0; corner < 4; corner++) {
        const double z = a[2] != 0 ? (c - (corner & 1 ? a[0] : 0) - (corner & 2 ? a[1] : 0)) / a[2] : 0;
        at[2 + corner] = z > 0 && z < 1 ? z : 0;
    }
    for (int i = 1; i < 6; i++) {
        for (int j = i; j > 0 && at[j - 1] > at[j]; j--) {
            const double swap = at[j];
            at[j] = at[j - 1];
            at[j - 1] = swap;
        }
    }
    for (int i = 0; i < 5; i++) {
        const double half = (at[i + 1] - at[i]) / 2, middle = at[i] + half, node = half / sqrt(3.0);
        volume += half * (koksma__area_below(a[0], a[1], c - a[2] * (middle - node)) +
                          koksma__area_below(a[0], a[1], c - a[2] * (middle + node)));
    }
    return volume;
}

TEST_CASE(volumes_are_slices)
{
    for (uint64_t s = 0; s < 20000; s++) {
        double a[3], c = 0, turned[3], at[3];
        for (uint64_t k = 0; k < 3; k++) {
            at[k] = sets_unit(s, k);
            a[k] = (2 * sets_unit(s, 3 + k) - 1) * exp2(-floor(60 * sets_unit(s, 6 + k)) * (double)(s % 2));
            a[k] = s % 5 == k ? 0 : a[k];
            c += a[k] * at[k];
        }
        if (a[0] == 0 && a[1] == 0) {
            continue; /* of no line is there an area */
        }
        const double volume = koksma__volume_below(a, c);
        assert_near(volume, sliced_volume(a, c), 1e-14);
        assert_near(koksma__volume_below_through(a, at), volume, 1e-14);
        for (int k = 0; k < 3; k++) {
            turned[k] = -a[(k + 1) % 3];
        }
        assert_near(koksma__volume_below(turned, -c), 1 - volume, 1e-14);
        assert_near(koksma__volume_below(a, 4), 1, 0);
        assert_near(koksma__volume_below(a, -4), 0, 0);
    }
    assert_near(koksma__volume_below((double[3]){0, 0, 2}, 0.5), 0.25, 0);
}

/* The best half-space of a direction: its plane is through a point. */
static double best_of(const koksma_points *p, const double a[3])
{
    double best = 0;
    for (size_t k = 0; k < p->n; k++) {
        const double *x = p->xs + 3 * k, c = a[0] * x[0] + a[1] * x[1] + a[2] * x[2];
        double count = 0;
        for (size_t i = 0; i < p->n; i++) {
            const double *y = p->xs + 3 * i;
            count += a[0] * y[0] + a[1] * y[1] + a[2] * y[2] <= c + 1e-15;
        }
        best = fmax(best, count / (double)p->n - sliced_volume(a, c));
    }
    return best;
}

static void cross(const double u[3], const double v[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    }
}

/* Both normals of the plane along two vectors, unless they are along each other. */
static double try_plane(const koksma_points *p, const double u[3], const double v[3], double best)
{
    double a[3];
    cross(u, v, a);
    const double b[3] = {-a[0], -a[1], -a[2]};
    return fabs(a[0]) + fabs(a[1]) + fabs(a[2]) > 1e-9 ? fmax(best, fmax(best_of(p, a), best_of(p, b))) : best;
}

/* Planes along the lines of all pairs, turned in small steps, and onto each third point. */
static double search_pairs(const koksma_points *p)
{
    double best = 0;
    for (size_t pair = 0; pair < p->n * p->n; pair++) {
        const double *x = p->xs + pair / p->n * 3, *y = p->xs + pair % p->n * 3;
        const double u[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
        if (x >= y || fabs(u[0]) + fabs(u[1]) + fabs(u[2]) == 0) {
            continue;
        }
        double e[3], f[3];
        cross(u, (double[3]){0.3, 0.5, 0.7}, e);
        cross(u, e, f);
        const double norm =
            sqrt((f[0] * f[0] + f[1] * f[1] + f[2] * f[2]) / (e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + 1e-300));
        for (int step = 0; step < 600; step++) {
            const double c = cos(step * M_PI / 600) * norm, s = sin(step * M_PI / 600);
            best = try_plane(p, u, (double[3]){c * e[0] + s * f[0], c * e[1] + s * f[1], c * e[2] + s * f[2]}, best);
        }
        for (size_t k = 0; k < p->n; k++) {
            const double *z = p->xs + 3 * k;
            best = try_plane(p, u, (double[3]){z[0] - x[0], z[1] - x[1], z[2] - x[2]}, best);
        }
    }
    return best;
}

/* From the best of many directions, steps to whatever is better, shorter and shorter. */
static double search_edge(const koksma_points *p)
{
    double starts[STARTS][4] = {{0}}, best = 0;
    for (int d = 0; d < DIRECTIONS; d++) {
        const double z = 1 - (2 * d + 1.0) / DIRECTIONS, r = sqrt(1 - z * z), turn = d * M_PI * (3 - sqrt(5.0));
        double here[4] = {r * cos(turn), r * sin(turn), z, 0};
        here[3] = best_of(p, here);
        for (int k = 0; k < STARTS; k++) {
            if (here[3] > starts[k][3]) {
                double swap[4];
                memcpy(swap, starts[k], sizeof swap);
                memcpy(starts[k], here, sizeof swap);
                memcpy(here, swap, sizeof swap);
            }
        }
    }
    for (int k = 0; k < STARTS; k++) {
        double step = 0.1;
        for (uint64_t t = 0; t < 1000; t++) {
            double next[3];
            for (uint64_t axis = 0; axis < 3; axis++) {
                next[axis] = starts[k][axis] + step * (2 * sets_unit(t, axis) - 1);
            }
            const double value = best_of(p, next);
            if (value > starts[k][3]) {
                memcpy(starts[k], next, sizeof next);
                starts[k][3] = value;
                step *= 1.5;
            } else {
                step *= 0.98;
            }
        }
        best = fmax(best, starts[k][3]);
    }
    return best;
}

static void check_witness(const koksma_points *p, const koksma_value *v)
{
    size_t inside = 0;
    for (size_t i = 0; i < p->n; i++) {
        const double *x = p->xs + 3 * i, *a = v->witness.lo;
        const double here = a[0] * x[0] + a[1] * x[1] + a[2] * x[2];
        inside += v->witness.closed ? here <= v->witness.hi[0] : here < v->witness.hi[0];
    }
    assert_int_equal(v->witness.kind, KOKSMA_WITNESS_HALF_PLANE);
    assert_int_equal(v->witness.dim, 3);
    assert_int_equal(inside, v->witness.count);
    assert_near(fabs((double)inside / (double)p->n - v->witness.volume), v->value, 1e-15);
    assert_near(koksma__volume_below(v->witness.lo, v->witness.hi[0]), v->witness.volume, 1e-14);
}

TEST_CASE(edge_equals_search)
{
    for (int s = 0; s < 6 * SETS_KINDS; s++) {
        koksma_points p = sets_points(1 + (size_t)(s / SETS_KINDS), 3, s % SETS_KINDS, (uint64_t)s);
        const koksma_value v = test_measure("edge", &p);
        const double freely = search_edge(&p), searched = fmax(freely, search_pairs(&p));
        if (!(searched <= v.value + 1e-14 && searched >= v.value - 1e-5 && freely >= v.value - 2e-3)) {
            sets_print(&p);
            fail_msg("edge of set %d: %.17g, searched %.17g, freely %.17g", s, v.value, searched, freely);
        }
        check_witness(&p, &v);
        koksma_points_fini(&p);
    }
}

/* One point cuts off a corner, whose centroid it is; a wedge along an edge; or a slab, on an axis of the cube. The
   same in all 48 positions of the cube. */
TEST_CASE(known_edges)
{
    static const double points[][4] = {
        {0.1, 0.2, 0.3, 1 - 4.5 * 0.1 * 0.2 * 0.3},
        {0.25, 0.25, 0.25, 1 - 4.5 / 64},
        {0.2, 0.3, 0.5, 1 - 2 * 0.2 * 0.3},
        {0.2, 0.3, 0.4, 1 - 2 * 0.2 * 0.3 / (1 + 12 * 0.01)},
        {0.5, 0.5, 0.5, 0.5},
        {0.5, 0.5, 0.125, 0.875},
        {0, 0.3, 0.6, 1},
        {0, 0, 0, 1},
        {1e-9, 0.3, 0.3, 1 - 4.5e-9 * 0.09},
    };
    for (size_t s = 0; s < sizeof points / sizeof *points; s++) {
        for (int position = 0; position < 48; position++) {
            koksma_points p;
            assert_ok(koksma_points_init(&p, 1, 3));
            for (int k = 0; k < 3; k++) {
                const int from = position / 8 < 3 ? (k + position / 8) % 3 : (5 - k + position / 8) % 3;
                p.xs[k] = position >> k & 1 ? 1 - points[s][from] : points[s][from];
            }
            const koksma_value v = test_measure("edge", &p);
            assert_near(v.value, points[s][3], 1e-15);
            check_witness(&p, &v);
            koksma_points_fini(&p);
        }
    }
}

/* n points at one place are that place, and the plane of the n/3 at each of three places holds all. */
TEST_CASE(repeats_and_larger_sets)
{
    koksma_points p = test_points("random", 24, 3, 5), repeated = test_points("random", 72, 3, 5);
    for (size_t c = 0; c < 3 * repeated.n; c++) {
        repeated.xs[c] = p.xs[c / 9 * 3 + c % 3];
    }
    const koksma_value once = test_measure("edge", &p), thrice = test_measure("edge", &repeated);
    assert_near(once.value, thrice.value, 1e-15);
    assert_int_equal(3 * once.witness.count, thrice.witness.count);
    check_witness(&p, &once);
    assert_true(search_edge(&p) <= once.value + 1e-14);
    koksma_points_fini(&p);
    koksma_points_fini(&repeated);
    p = test_points("regular", 27, 3, 1); /* nine points on a plane across an axis, at 1/6 */
    const koksma_value grid = test_measure("edge", &p);
    assert_true(grid.value >= 1.0 / 6 - 1e-15);
    assert_true(search_edge(&p) <= grid.value + 1e-14);
    check_witness(&p, &grid);
    koksma_points_fini(&p);
}

TEST_CASE(edge_keeps_its_limits)
{
    koksma_spec edge;
    koksma_value v, one;
    koksma_points p = test_points("random", 1025, 3, 1), small = test_points("random", 40, 3, 1);
    assert_ok(koksma_measure_spec("edge", &edge));
    assert_int_equal(koksma_evaluate(&edge, &p, NULL, &v), KOKSMA_N);
    assert_string_equal(koksma_error_text(), "edge: n = 1025: it takes up to 1024 points in 3D; l2-edge takes more");
    koksma_points_fini(&p);
    assert_ok(koksma_evaluate(&edge, &small, &(koksma_run){.threads = 1}, &one));
    assert_ok(koksma_evaluate(&edge, &small, &(koksma_run){.time_limit_s = 1e-9}, &v));
    assert_true(!v.exact && v.lower == v.value && v.value <= one.value && v.upper == 1);
    check_witness(&small, &v);
    static const char *const plane_only[] = {"l2-edge:law=mitchell", "edge-sampled:law=mitchell"};
    for (int m = 0; m < 2; m++) {
        koksma_spec spec;
        assert_ok(koksma_measure_spec(plane_only[m], &spec));
        assert_int_equal(koksma_evaluate(&spec, &small, NULL, &v), KOKSMA_ARGUMENT);
    }
    koksma_points_fini(&small);
}

/* Mean square and its standard error over sets, and what the exact measure has for them. */
TEST_CASE(exact_agrees_with_sampled)
{
    static const char *const pairs[][2] = {
        {"l2-edge", "edge-sampled:lines=20000"},
        {"l2-disk", "disk-sampled:disks=20000"},
        {"l2-disk:r=0.5", "disk-sampled:disks=20000,r=0.5"},
        {"l2-disk:law=radius", "disk-sampled:disks=20000,law=radius"},
        {"l2-disk:law=area", "disk-sampled:disks=20000,law=area"},
        {"l2-disk:r=0.3,law=area", "disk-sampled:disks=20000,r=0.3,law=area"},
        {"l2-disk:r=0.1", "disk-sampled:disks=20000,r=0.1"},
    };
    for (int s = 0; s < 2 * SETS_KINDS; s++) {
        koksma_points p = sets_points(2 + (size_t)s, 3, s % SETS_KINDS, (uint64_t)s);
        for (size_t m = 0; m < sizeof pairs / sizeof *pairs; m++) {
            const koksma_value exact = test_measure(pairs[m][0], &p), sampled = test_measure(pairs[m][1], &p);
            assert_that(fabs(exact.value - sampled.value) <= 4.5 * sampled.standard_error,
                        "%s of set %d: %.10g, sampled %.10g +- %.3g", pairs[m][0], s, exact.value, sampled.value,
                        sampled.standard_error);
        }
        koksma_points_fini(&p);
    }
}

/* The mean square of random sets is a constant over n; of one ball volume (1 - volume). */
TEST_CASE(means_of_random_sets)
{
    const double v = 4 * M_PI / 3 / 8, quarter = v / 8;
    /* the mean distance of two points of the cube: .66170718 (Robbins 1978) */
    const struct {
        const char *measure;
        double mean;
    } cases[] = {{"l2-edge", 0.6617071822671762 / 6},
                 {"l2-disk", quarter * (1 - quarter)},
                 {"l2-disk:r=0.5", v * (1 - v)},
                 {"l2-disk:law=radius", v / 4 - v * v / 7},
                 {"l2-disk:law=area", v / 2 - v * v / 3}};
    assert_near(koksma__plane_constant(), 0.6617071822671762 / 3, 1e-15);
    for (size_t m = 0; m < sizeof cases / sizeof *cases; m++) {
        double sum = 0, squares = 0;
        const int trials = 400;
        for (int t = 0; t < trials; t++) {
            koksma_points p = test_points("random", 8, 3, (uint64_t)t);
            const double square = 8 * test_measure(cases[m].measure, &p).square;
            sum += square / trials;
            squares += square * square / trials;
            koksma_points_fini(&p);
        }
        assert_near(sum, cases[m].mean, 4 * sqrt((squares - sum * sum) / trials));
        koksma_points p = sets_points(1, 3, 0, 3);
        if (m > 0) {
            assert_near(test_measure(cases[m].measure, &p).square, cases[m].mean, 1e-15);
        }
        koksma_points_fini(&p);
    }
}

/* The potential is the mean distance to the cube over 3, here by a fine grid with an error of its cell squared. */
TEST_CASE(potential_is_an_integral)
{
    enum { SIDE = 60 };
    for (int s = 0; s < SETS_KINDS; s++) {
        koksma_points p = sets_points(2, 3, s, (uint64_t)s);
        const double *x = p.xs + 3;
        double sum = 0;
        for (int c = 0; c < SIDE * SIDE * SIDE; c++) {
            const double dx = (c % SIDE + 0.5) / SIDE - x[0], dy = (c / SIDE % SIDE + 0.5) / SIDE - x[1];
            const double dz = (c / SIDE / SIDE + 0.5) / SIDE - x[2];
            sum += sqrt(dx * dx + dy * dy + dz * dz);
        }
        assert_near(koksma__plane_potential(x), sum / (SIDE * SIDE * SIDE) / 3, 3e-5);
        koksma_points_fini(&p);
    }
}

/* Balls are on the torus: a shift changes nothing. */
TEST_CASE(balls_ignore_shifts)
{
    koksma_points p = test_points("random", 50, 3, 2), q = test_points("random", 50, 3, 2);
    for (size_t c = 0; c < 150; c++) {
        const double moved = p.xs[c] + 0.1 * (double)(1 + c % 3 * 3);
        q.xs[c] = moved < 1 ? moved : moved - 1;
    }
    static const char *const measures[] = {"l2-disk", "l2-disk:law=radius", "l2-disk:law=area", "l2-disk:r=0.05"};
    for (int m = 0; m < 4; m++) {
        assert_near(test_measure(measures[m], &p).square, test_measure(measures[m], &q).square, 1e-15);
    }
    koksma_points_fini(&p);
    koksma_points_fini(&q);
}
