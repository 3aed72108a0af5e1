/* SPDX-License-Identifier: Apache-2.0 */
/* Half-planes and disks against brute force, quadrature and sampling. */
#include <string.h>

#include "kernels/kernels.h"
#include "measures/edge/edge.h"
#include "measures/shared/shared.h"
#include "sets.h"

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 quad;
#else
typedef long double quad; /* it has 113 bits on aarch64 and s390x */
#endif

/* Coordinates of sets are multiples of 2^-53: products of differences fit into 113 bits. */
static int quad_side(const double *p, quad dx, quad dy, const double *x)
{
    const quad cross = dx * ((quad)x[1] - (quad)p[1]) - dy * ((quad)x[0] - (quad)p[0]);
    return (cross > 0) - (cross < 0);
}

/* The area of the square left of the line through p along (dx, dy), by clipping the square. */
static double clipped_area(const double *p, double dx, double dy)
{
    static const double corners[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    double polygon[12][2], area = 0;
    int m = 0;
    for (int c = 0; c < 4; c++) {
        const double *u = corners[c], *v = corners[c + 1];
        const double su = dx * (u[1] - p[1]) - dy * (u[0] - p[0]), sv = dx * (v[1] - p[1]) - dy * (v[0] - p[0]);
        if (su >= 0) {
            polygon[m][0] = u[0];
            polygon[m++][1] = u[1];
        }
        if ((su > 0 && sv < 0) || (su < 0 && sv > 0)) {
            polygon[m][0] = u[0] + su / (su - sv) * (v[0] - u[0]);
            polygon[m++][1] = u[1] + su / (su - sv) * (v[1] - u[1]);
        }
    }
    for (int c = 0; c < m; c++) {
        const double *u = polygon[c], *v = polygon[(c + 1) % m];
        area += (u[0] * v[1] - u[1] * v[0]) / 2;
    }
    return area;
}

static double try_line(const koksma_points *s, const double *p, quad dx, quad dy)
{
    double open = 0, closed = 0;
    for (size_t i = 0; i < s->n; i++) {
        const int side = quad_side(p, dx, dy, s->xs + 2 * i);
        open += side > 0;
        closed += side >= 0;
    }
    const double area = clipped_area(p, (double)dx, (double)dy), n = (double)s->n;
    return fmax(closed / n - area, area - open / n);
}

static double brute_edge(const koksma_points *s)
{
    double best = 0;
    for (size_t i = 0; i < s->n; i++) {
        const double *p = s->xs + 2 * i;
        for (size_t j = 0; j < s->n; j++) {
            const quad dx = (quad)s->xs[2 * j] - (quad)p[0], dy = (quad)s->xs[2 * j + 1] - (quad)p[1];
            best = dx != 0 || dy != 0 ? fmax(best, try_line(s, p, dx, dy)) : best;
        }
        for (int corner = 0; corner < 4; corner++) { /* all four: those of far corners are lines as well */
            const quad dx = (quad)(corner % 2) - (quad)p[0], dy = (quad)p[1] - (quad)(corner / 2);
            if (dx != 0 || dy != 0) {
                best = fmax(best, fmax(try_line(s, p, dx, dy), try_line(s, p, -dx, -dy)));
            }
        }
        const double axis[2] = {p[0] == 0 || p[0] == 1, p[1] == 0 || p[1] == 1};
        best = axis[0] > 0 ? fmax(best, fmax(try_line(s, p, 0, 1), try_line(s, p, 0, -1))) : best;
        best = axis[1] > 0 ? fmax(best, fmax(try_line(s, p, 1, 0), try_line(s, p, -1, 0))) : best;
    }
    return best;
}

/* Each fourth set is shrunk towards (0,0) by a power of two, down to numbers whose products are below all doubles; in
   each fortieth 40 points crowd in a place so small that others see them in nearly one direction. */
TEST_CASE(edge_equals_brute_force)
{
    for (int s = 0; s < test_repeats(3000, 300); s++) {
        const size_t n = 1 + (size_t)(s / SETS_KINDS) % 16, crowd = s % 40 == 7 ? 40 : 0;
        koksma_points p = sets_points(n + crowd, 2, s % SETS_KINDS, (uint64_t)s);
        for (size_t c = 0; c < 2 * p.n && s / SETS_KINDS % 4 == 3; c++) {
            p.xs[c] *= exp2(-200 - 100 * (s / (4 * SETS_KINDS) % 9));
        }
        for (size_t c = 2 * n; c < 2 * p.n; c++) {
            p.xs[c] = 0.6 + 1e-11 * sets_unit((uint64_t)s, c);
        }
        const koksma_value v = test_measure("edge", &p);
        const double brute = brute_edge(&p);
        if (!(fabs(v.value - brute) <= 2e-15)) {
            sets_print(&p);
            fail_msg("edge of set %d: %.17g, brute force %.17g", s, v.value, brute);
        }
        size_t inside = 0;
        for (size_t i = 0; i < p.n; i++) {
            const double here = v.witness.lo[0] * p.xs[2 * i] + v.witness.lo[1] * p.xs[2 * i + 1];
            inside += v.witness.closed ? here <= v.witness.hi[0] : here < v.witness.hi[0];
        }
        assert_int_equal(inside, v.witness.count);
        assert_near(fabs((double)inside / (double)p.n - v.witness.volume), v.value, 1e-15);
        koksma_points_fini(&p);
    }
}

/* With all the time there is, the bounds close upon the value from both sides. */
TEST_CASE(bounds_of_edge_hold)
{
    static const koksma__domain square = {koksma__area_below_through, NULL, M_SQRT1_2};
    for (int s = 0; s < test_repeats(10, 3) * SETS_KINDS; s++) {
        koksma_points p = sets_points(1 + (size_t)s % 30, 2, s % SETS_KINDS, (uint64_t)s);
        const double value = test_measure("edge", &p).value;
        koksma__edge_line line = {.value = 0};
        double upper = NAN;
        assert_ok(koksma__edge_cover(&square, p.n, p.xs, NULL, INFINITY, &line, &upper));
        assert_true(line.value <= value + 1e-15);
        assert_true(upper >= value);
        assert_near(upper, value, 4e-9);
        assert_near(line.value, value, 4e-9);
        koksma_points_fini(&p);
    }
}

TEST_CASE(edge_obeys_its_time_limit)
{
    koksma_points p = test_points("random", 2000, 2, 1);
    const double value = test_measure("edge", &p).value;
    koksma_spec edge;
    assert_ok(koksma_measure_spec("edge", &edge));
    for (double limit_s = 1e-6; limit_s < 0.5; limit_s *= 10) {
        const koksma_run run = {.time_limit_s = limit_s};
        koksma_value v;
        assert_ok(koksma_evaluate(&edge, &p, &run, &v));
        assert_true(v.lower <= value && value <= v.upper + 1e-14 && v.value == v.lower);
        assert_true(v.exact == (v.lower == v.upper));
        assert_true(limit_s > 1e-5 || !v.exact);
    }
    koksma_points_fini(&p);
}

TEST_CASE(signs_are_exact)
{
    for (uint64_t i = 0; i < test_repeats(20000, 2000); i++) {
        double v[8];
        for (uint64_t k = 0; k < 8; k++) {
            const double u = sets_unit(3, 8 * i + k);
            v[k] = i % 3 == 0 ? u : i % 3 == 1 ? floor(u * 4) / 4 : k < 4 ? u : v[k - 4];
        }
        if (i % 5 == 0) {
            v[7] = fmin(1, v[7] * (1 + 0x1p-52));
        }
        const quad det = ((quad)v[0] - (quad)v[1]) * ((quad)v[2] - (quad)v[3]) -
                         ((quad)v[4] - (quad)v[5]) * ((quad)v[6] - (quad)v[7]);
        assert_int_equal(koksma__sign_of_cross(v, v + 2, v + 4, v + 6), (det > 0) - (det < 0));
    }
}

/* P and C by the midpoint rule on 400 x 400 and 40 x 40 squares. */
TEST_CASE(potentials_are_integrals)
{
    for (int law = 0; law < 2; law++) {
        static const double at[4][2] = {{0.3, 0.8}, {0, 1}, {0.5, 0.001}, {1, 0.4}};
        for (int i = 0; i < 4; i++) {
            double sum = 0;
            for (int c = 0; c < 400 * 400; c++) {
                sum += koksma__line_separates((koksma__line_law)law, (c % 400 + 0.5) / 400 - at[i][0],
                                              (c / 400 + 0.5) / 400 - at[i][1]);
            }
            assert_near(koksma__line_potential((koksma__line_law)law, at[i]), sum / 160000, 2e-6);
        }
        double constant = 0;
        for (int c = 0; c < 40 * 40; c++) {
            constant +=
                koksma__line_potential((koksma__line_law)law, (double[2]){(c % 40 + 0.5) / 40, (c / 40 + 0.5) / 40});
        }
        assert_near(koksma__line_constant((koksma__line_law)law), constant / 1600, 1e-4);
    }
}

/* Exact values within five standard errors of sampled ones, whose lines and disks know nothing of the closed forms.
 */
TEST_CASE(exact_agrees_with_sampled)
{
    static const char *const pairs[][2] = {
        {"l2-edge", "edge-sampled:lines=60000"},
        {"l2-edge:law=mitchell", "edge-sampled:lines=60000,law=mitchell"},
        {"l2-disk:r=0.1", "disk-sampled:disks=60000,r=0.1"},
        {"l2-disk:r=0.5", "disk-sampled:disks=60000,r=0.5"},
        {"l2-disk:law=radius", "disk-sampled:disks=60000,law=radius"},
        {"l2-disk:law=area,r=0.3", "disk-sampled:disks=60000,law=area,r=0.3"},
    };
    for (size_t m = 0; m < sizeof pairs / sizeof *pairs; m++) {
        for (int kind = 0; kind < SETS_KINDS; kind++) {
            koksma_points p = sets_points(12, 2, kind, (uint64_t)kind);
            const koksma_value exact = test_measure(pairs[m][0], &p), sampled = test_measure(pairs[m][1], &p);
            assert_near(exact.value, sampled.value, 5 * sampled.standard_error);
            assert_true(sampled.standard_error < 0.02 * sampled.value);
            koksma_points_fini(&p);
        }
    }
}

/* Every disk of a fine net of centres and radii, whose deviation no disk may beat; and close to the best of them. */
TEST_CASE(disk_equals_fine_search)
{
    for (int s = 0; s < test_repeats(18, 6); s++) {
        koksma_points p = sets_points(1 + (size_t)s / 2, 2, s % SETS_KINDS, (uint64_t)s);
        const koksma_value v = test_measure("disk:r=0.3", &p);
        double best = 0;
        for (int c = 0; c < 64 * 64; c++) {
            double distances[16];
            for (size_t i = 0; i < p.n; i++) {
                double dx = fabs(p.xs[2 * i] - c % 64 / 64.0), dy = fabs(p.xs[2 * i + 1] - c / 64 / 64.0);
                dx = fmin(dx, 1 - dx);
                dy = fmin(dy, 1 - dy);
                distances[i] = sqrt(dx * dx + dy * dy);
            }
            for (size_t i = 0; i <= p.n; i++) { /* the rim at each point, and at 0.3 */
                const double r = i < p.n ? distances[i] : 0.3;
                size_t open = 0, closed = 0;
                for (size_t k = 0; k < p.n && r <= 0.3; k++) {
                    open += distances[k] < r;
                    closed += distances[k] <= r;
                }
                if (r <= 0.3) {
                    const double area = M_PI * r * r, n = (double)p.n;
                    best = fmax(best, fmax((double)closed / n - area, area - (double)open / n));
                }
            }
        }
        assert_true(v.value >= best - 1e-11);
        assert_near(v.value, best, 0.05);
        koksma_points_fini(&p);
    }
}

TEST_CASE(kernels_equal_reference)
{
    double x[200], y[200], a[16], b[16], c[16], counts[2][16];
    for (size_t i = 0; i < 200; i++) {
        x[i] = sets_unit(7, i);
        y[i] = sets_unit(8, i);
    }
    const koksma__kernel_table *ref = koksma__kernels_find("ref");
    static const char *const isas[] = {"baseline", "avx2", "avx512"};
    for (size_t n = 0; n <= 200; n += 1 + n / 3) {
        for (uint64_t l = 0; l < 16; l++) {
            koksma__random_line(KOKSMA__LINES_ISOTROPIC, 5, l + n, &a[l], &b[l], &c[l]);
        }
        ref->count_below(n, x, y, a, b, c, counts[0]);
        for (int isa = 0; isa < 3; isa++) {
            const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
            if (fast) {
                fast->count_below(n, x, y, a, b, c, counts[1]);
                assert_memory_equal(counts[0], counts[1], sizeof counts[0]);
                assert_near(fast->distances(n, x, y, 0.3, 0.4), ref->distances(n, x, y, 0.3, 0.4), 1e-13);
            }
        }
    }
}

/* The angle t between a line and the nearer axis, in bins of 1 degree. Mitchell's slope is that of a uniform point of a
   square, seen from its centre: below t lie tan t of them. Isotropic lines meet the square as often as it is wide,
   cos t + sin t: below t lie 1 + sin t - cos t. Chi-square with 44 degrees of freedom; the other law must fail. */
TEST_CASE(angles_of_random_lines)
{
    enum { LINES = 200000 };
    for (int law = 0; law < 2; law++) {
        double counts[45] = {0}, square[2] = {0};
        for (uint64_t i = 0; i < LINES; i++) {
            double a, b, c;
            koksma__random_line((koksma__line_law)law, 3, i, &a, &b, &c);
            const double t = atan2(fmin(fabs(a), fabs(b)), fmax(fabs(a), fabs(b))) * 180 / M_PI;
            counts[(int)fmin(t, 44)]++;
        }
        for (int k = 0; k < 45; k++) {
            const double t = k * M_PI / 180, u = (k + 1) * M_PI / 180;
            const double expected[2] = {sin(u) - cos(u) - sin(t) + cos(t), tan(u) - tan(t)};
            for (int l = 0; l < 2; l++) {
                const double difference = counts[k] - LINES * expected[l];
                square[l] += difference * difference / (LINES * expected[l]);
            }
        }
        assert_true(square[law] < 44 + 4 * sqrt(2 * 44));
        assert_true(square[!law] > 1000);
    }
}
