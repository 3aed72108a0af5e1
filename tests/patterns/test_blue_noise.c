/* SPDX-License-Identifier: Apache-2.0 */
/* Blue-noise patterns against their papers: docs/findings/blue-noise.md has the numbers that are held here. */
#include <stdlib.h>
#include <string.h>

#include "pattern_sets.h"
#include "sets.h"

/* Mean relative radius of SETS sets of 1,024 points in its band; each blue-noise pattern is in the table. */
TEST_CASE(relative_radii_are_those_of_the_table)
{
    enum { SETS = 2 };
    static const struct {
        const char *spec;
        double low, high;
    } rows[] = {
        {"sample-elimination", 0.683, 0.709},
        {"sample-elimination:factor=20", 0.76, 0.78},
        {"progressive-elimination", 0.683, 0.709},
        {"gaussian-blue-noise", 0.69, 0.76},
        {"dart-throwing", 0.75, 0.755},
        {"poisson-disk:d=0.0251,torus=1", 0.7474, 0.753},
        {"poisson-disk-maximal", 0.765, 0.79},
        {"best-candidate", 0.65, 0.73},
        {"void-and-cluster", 0.465, 0.466},
    };
    enum { ROWS = sizeof rows / sizeof *rows };
    const koksma_pattern *p;
    for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
        bool found = !(p->claims & KOKSMA_CLAIM_BLUE) || p->alias_of;
        for (size_t r = 0; r < ROWS && !found; r++) {
            found = !strncmp(rows[r].spec, p->name, strcspn(rows[r].spec, ":")) &&
                    strlen(p->name) == strcspn(rows[r].spec, ":");
        }
        assert_that(found, "%s claims a blue-noise distance and is not in this table", p->name);
    }
    for (size_t r = 0; r < ROWS; r++) {
        double sum = 0;
        for (uint64_t seed = 0; seed < SETS; seed++) {
            koksma_points points = test_points(rows[r].spec, 1024, 2, seed);
            sum += relative_radius(&points) / SETS;
            koksma_points_fini(&points);
        }
        assert_that(sum >= rows[r].low && sum <= rows[r].high, "%s: relative radius %.4f, not %g to %g", rows[r].spec,
                    sum, rows[r].low, rows[r].high);
    }
}

/* Yuksel 2015: the radii of the weight function and its limit. */
TEST_CASE(elimination_has_the_papers_formulas)
{
    assert_near(koksma__elimination_radius(1000, 1), 1e-3, 1e-15);
    assert_near(koksma__elimination_radius(1000, 2), sqrt(2 / (sqrt(3) * 1000)), 1e-15);
    assert_near(koksma__elimination_radius(1000, 3), 2 * pow(1 / (4 * sqrt(2) * 1000), 1.0 / 3), 1e-15);
    assert_near(koksma__elimination_radius(1000, 4), 2 * pow(2 / (M_PI * M_PI * 1000), 0.25), 1e-14);
    assert_near(koksma__elimination_radius(1000, 5), 2 * pow(15 / (8 * M_PI * M_PI * 1000), 0.2), 1e-14);
    assert_near(koksma__elimination_radius(1000, 6), 2 * pow(6 / (M_PI * M_PI * M_PI * 1000), 1.0 / 6), 1e-14);
    for (int dim = 1; dim <= 8; dim++) { /* the paper's limit up to 3 dimensions, above them none */
        assert_near(koksma__elimination_limit(100, 100, dim), 0, 0);
        assert_near(koksma__elimination_limit(100, 500, dim), dim > 3 ? 0 : 0.65 * (1 - pow(0.2, 1.5)), 1e-15);
    }
}

enum { ELIMINATED = 150 };

/* By the definition: what two points weigh on each other, over all images of one of them that are shifted by -1, 0 or 1
   along each axis. More are not within d_max <= 1; all but the nearest are nearer than d_max only if it is above 1/2. */
static double pair_weight(const double *x, const double *y, int dim, double d_max, double d_min)
{
    int n_images = 1;
    double weight = 0;
    for (int k = 0; k < dim; k++) {
        n_images *= 3;
    }
    for (int image = 0; image < n_images; image++) {
        double square = 0;
        for (int k = 0, rest = image; k < dim; k++, rest /= 3) {
            const double t = x[k] - y[k] + rest % 3 - 1;
            square += t * t;
        }
        weight += sqrt(square) < d_max ? pow(1 - fmax(sqrt(square), d_min) / d_max, 8) : 0;
    }
    return weight;
}

/* Each point is the heaviest when it goes, but for roundings: two that have only each other weigh the same. With
   `nearest` one image of a point counts alone. */
static void assert_heaviest_go(size_t count, size_t keep, int dim, bool nearest)
{
    static double pairs[ELIMINATED][ELIMINATED]; /* the diagonal stays 0 */
    double weight[ELIMINATED] = {0};
    unsigned char gone[ELIMINATED] = {0};
    uint32_t order[ELIMINATED];
    koksma_points points = test_points("random", count, dim, 7);
    const double d_max = koksma__elimination_radius(keep, dim);
    const double d_min = d_max * koksma__elimination_limit(keep, count, dim);
    assert_true(nearest || (d_max <= 1 && (d_max > 0.5) == (dim > 3)));
    for (size_t i = 0; i < count; i++) {
        for (size_t j = 0; j < i; j++) {
            const double *x = points.xs + i * (size_t)dim, *y = points.xs + j * (size_t)dim;
            const double d = sqrt(sets_torus_distance2(x, y, dim));
            pairs[i][j] = pairs[j][i] = !nearest    ? pair_weight(x, y, dim, d_max, d_min)
                                        : d < d_max ? pow(1 - fmax(d, d_min) / d_max, 8)
                                                    : 0;
            weight[i] += pairs[i][j];
            weight[j] += pairs[i][j];
        }
    }
    assert_ok(koksma__eliminate(count, dim, points.xs, keep, d_max, d_min, NULL, order));
    for (size_t at = count; at-- > 0;) {
        assert_int_equal(gone[order[at]], 0);
        assert_true(at + 1 >= keep || order[at] < order[at + 1]);
        for (size_t i = 0; at >= keep && i < count; i++) {
            assert_true(gone[i] || weight[i] <= weight[order[at]] + 1e-12);
        }
        gone[order[at]] = 1;
        for (size_t i = 0; i < count; i++) {
            weight[i] -= pairs[i][order[at]];
        }
    }
    koksma_points_fini(&points);
}

/* In 4 to 8 dimensions d_max is above 1/2 here, and all images within it count; in fewer there is one. */
TEST_CASE(elimination_takes_the_heaviest)
{
    for (int dim = 1; dim <= 7; dim++) {
        assert_heaviest_go(ELIMINATED, 30, dim, false);
    }
    assert_heaviest_go(90, 64, 8, false); /* fewer make d_max larger than 1 */
    assert_heaviest_go(ELIMINATED, 30, 9, true);
}

/* The mean relative radius of 1,024 of 5,120 uniform points, with a limit and without. */
TEST_CASE(limited_weights_keep_points_apart)
{
    enum { N = 1024, ALL = 5 * N };
    static uint32_t order[ALL];
    static double kept[2 * N];
    const double d_max = koksma__elimination_radius(N, 2), limit = koksma__elimination_limit(N, ALL, 2);
    koksma_points points = test_points("random", ALL, 2, 3);
    double rho[2];
    for (int limited = 0; limited < 2; limited++) {
        assert_ok(koksma__eliminate(ALL, 2, points.xs, N, d_max, limited ? d_max * limit : 0, NULL, order));
        for (size_t i = 0; i < N; i++) {
            memcpy(kept + 2 * i, points.xs + 2 * (size_t)order[i], 2 * sizeof *kept);
        }
        rho[limited] = relative_radius(&(koksma_points){N, 2, kept});
    }
    koksma_points_fini(&points);
    assert_near(rho[0], 0.634, 0.012); /* 0.633 by an independent program without the limit, 0.698 with it */
    assert_near(rho[1], 0.698, 0.014);
}

/* The first half, quarter, .. are blue noise, which those of the set in the order of drawing are not; another n is
   the same sequence, and more than `length` points are refused. */
TEST_CASE(prefixes_of_progressive_elimination)
{
    koksma_points ordered = test_points("progressive-elimination", 1024, 2, 1);
    koksma_points drawn = test_points("sample-elimination", 1024, 2, 1);
    for (size_t n = 64; n < 1024; n = n * 3 / 2) {
        const double rho = relative_radius(&(koksma_points){n, 2, ordered.xs});
        const double rho_drawn = relative_radius(&(koksma_points){n, 2, drawn.xs});
        assert_that(rho > 0.57 && rho > rho_drawn + 0.05,
                    "%zu of 1024 points: relative radius %.3f ordered, %.3f as drawn", n, rho, rho_drawn);
    }
    assert_int_equal(status_of("progressive-elimination:length=100", 101, 2), KOKSMA_N);
    koksma_points_fini(&ordered);
    koksma_points_fini(&drawn);
}

/* By its criterion the descent leaves what 2,000 steps without it used to leave: a sixth of what 400 did. */
TEST_CASE(gaussian_blue_noise_has_converged)
{
    koksma_points done = test_points("gaussian-blue-noise", 1024, 2, 0);
    koksma_points early = test_points("gaussian-blue-noise:steps=128", 1024, 2, 0);
    const double converged = power_within(&done, 24), before = power_within(&early, 24); /* .75 sqrt n */
    assert_that(converged < 0.0025 && converged > 1e-5 && before > 10 * converged,
                "power below 0.75 sqrt n: %.5f, after 128 steps %.5f", converged, before);
    koksma_points_fini(&done);
    koksma_points_fini(&early);
}
