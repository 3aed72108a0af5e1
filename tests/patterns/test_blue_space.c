/* SPDX-License-Identifier: Apache-2.0 */
/* Blue noise in 3 to 6 dimensions: counts and distances of maximal Poisson disk sets, forces of gaussian-blue-noise
   by their definition, radial means of the power. */
#include <string.h>

#include "pattern_sets.h"
#include "patterns/darts/darts.h"
#include "sets.h"

static double nearest_to(const koksma_points *p, const double *x)
{
    double best = INFINITY;
    for (size_t i = 0; i < p->n; i++) {
        best = fmin(best, sets_torus_distance2(p->xs + i * (size_t)p->dim, x, p->dim));
    }
    return sqrt(best);
}

/* No two points are closer than d, and no random place is further than d from all. */
static void assert_maximal(const koksma_points *p, double d)
{
    assert_true(smallest_distance(p, true) >= d * (1 - 1e-12));
    for (uint64_t i = 0; i < test_repeats(5000, 500); i++) {
        double x[6];
        for (uint64_t k = 0; k < 6; k++) {
            x[k] = sets_unit(17, 6 * i + k);
        }
        assert_true(nearest_to(p, x) <= d * (1 + 1e-9));
    }
}

/* The share of the volume of balls of diameter d is that of saturated random sequential addition: Zhang & Torquato
   2013, Physical Review E 88, 053312. Its spread is that of the sets. A set that is not maximal, or not of uniform
   darts, has another. */
TEST_CASE(counts_are_those_of_saturated_packings)
{
    enum { SETS = test_repeats(12, 2) };
    static const struct {
        int dim;
        double d, ball, filled;
    } rows[] = {{3, 0.1, 4.18879020478639, 0.384131},
                {4, 0.25, 4.93480220054468, 0.260078},
                {5, 0.42, 5.26378901391432, 0.170776},
                {6, 0.6, 5.16771278004997, 0.109302}};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        char text[64];
        koksma_spec spec;
        double sum = 0, squares = 0;
        snprintf(text, sizeof text, "poisson-disk-maximal:d=%g", rows[r].d);
        assert_ok(koksma_pattern_spec(text, &spec));
        for (uint64_t seed = 0; seed < SETS; seed++) {
            koksma_points p;
            assert_ok(koksma_generate_whole(&spec, seed, NULL, rows[r].dim, &p));
            if (seed < 2) {
                assert_maximal(&p, rows[r].d);
            }
            const double filled = (double)p.n * rows[r].ball * pow(rows[r].d / 2, rows[r].dim);
            sum += filled / SETS;
            squares += filled * filled / SETS;
            koksma_points_fini(&p);
        }
        const double error = sqrt(fmax(squares - sum * sum, 0) / (SETS - 1));
        assert_true(error < 0.01);
        /* a torus that is only some d wide moves the mean: by less than 2 % in these rows */
        assert_near(sum, rows[r].filled, 4 * error + 0.02 * rows[r].filled);
    }
}

TEST_CASE(sets_by_number_are_maximal)
{
    static const size_t counts[] = {1, 2, 3, 5, 8, 30, 64, 100};
    for (int dim = 3; dim <= 6; dim++) {
        for (size_t c = 0; c < sizeof counts / sizeof *counts && counts[c] <= test_repeats(dim < 6 ? 100 : 30, 8);
             c++) {
            koksma_points p = test_points("poisson-disk-maximal", counts[c], dim, 3);
            if (counts[c] > 1) {
                assert_maximal(&p, smallest_distance(&p, true));
            }
            koksma_points_fini(&p);
        }
    }
}

/* Forces against sums over all images within 12 s. Up to s = 1/10 the cut-off leaves out less than 1e-3 of a force. */
TEST_CASE(forces_are_sums_over_images)
{
    static const struct {
        int dim;
        size_t n;
        double s, bound;
    } rows[] = {{3, 60, 0.3, 2e-6}, {3, 40, 0.11, 2e-6},  {4, 30, 0.35, 2e-6},
                {6, 6, 0.4, 2e-6},  {3, 300, 0.09, 1e-4}, {3, 2000, 0.05, 1e-4}};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        const int dim = rows[r].dim, reach = (int)ceil(8 * rows[r].s);
        const double s = rows[r].s, scale = s * sqrt((double)rows[r].n * pow(s, dim) + 1);
        koksma_points p = test_points("random", rows[r].n, dim, r);
        koksma__space_forces f;
        assert_ok(koksma__space_forces_init(&f, p.n, dim, s));
        koksma__space_forces_sort(&f, p.xs);
        for (size_t at = 0; at < 5; at++) {
            double force[6], brute[6] = {0};
            koksma__space_force(&f, at, force);
            const double *x = p.xs + f.order[at] * (size_t)dim;
            for (size_t j = 0; j < p.n; j++) {
                for (int image = 0; image < (int)pow(2 * reach + 1, dim) && j != f.order[at]; image++) {
                    double t[6], square = 0;
                    for (int k = 0, rest = image; k < dim; k++, rest /= 2 * reach + 1) {
                        t[k] = x[k] - p.xs[j * (size_t)dim + (size_t)k] + rest % (2 * reach + 1) - reach;
                        square += t[k] * t[k];
                    }
                    for (int k = 0; k < dim; k++) {
                        brute[k] += t[k] * exp(-square / (2 * s * s));
                    }
                }
            }
            for (int k = 0; k < dim; k++) {
                assert_near(force[k], brute[k], rows[r].bound * scale);
            }
        }
        koksma__space_forces_fini(&f);
        koksma_points_fini(&p);
    }
}

/* Independent points have a power of 1; docs/findings/blue-noise.md has the means of more sets. */
TEST_CASE(low_frequencies_are_weak_in_space)
{
    enum { N = 343 }; /* n^(1/3) = 7 */
    static const struct {
        const char *spec;
        double radius, low, high;
    } rows[] = {{"random", 5, 0.7, 1.3},
                {"gaussian-blue-noise", 3.5, 0, 1e-6},
                {"gaussian-blue-noise", 5.25, 0, 3e-3},
                {"poisson-disk-maximal", 3.5, 0.03, 0.15},
                {"sample-elimination", 3.5, 0.05, 0.25},
                {"progressive-elimination:length=343", 3.5, 0.05, 0.25}};
    koksma_points p = {0};
    /* With sanitizers one row: other tests here make such sets. */
    for (size_t r = 0; r < test_repeats(sizeof rows / sizeof *rows, 1); r++) {
        if (r == 0 || strcmp(rows[r].spec, rows[r - 1].spec) != 0) {
            koksma_points_fini(&p);
            p = test_points(rows[r].spec, N, 3, 1);
        }
        const double power = power_within(&p, rows[r].radius);
        assert_that(power >= rows[r].low && power <= rows[r].high, "%s: the power within %g is %g", rows[r].spec,
                    rows[r].radius, power);
    }
    koksma_points_fini(&p);
}

/* Yuksel's 2 r_max is the distance of the densest packing in 3D; the relative radius of his sets is about .7. */
TEST_CASE(relative_radii_in_space)
{
    static const struct {
        const char *spec;
        double low, high;
    } rows[] = {{"sample-elimination", 0.66, 0.72},
                {"sample-elimination:factor=20", 0.73, 0.79},
                {"progressive-elimination:length=1000", 0.66, 0.72},
                {"poisson-disk-maximal", 0.79, 0.82}};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        koksma_points p = test_points(rows[r].spec, 1000, 3, 2);
        const double rho = relative_radius(&p);
        assert_near(cbrt(sqrt(2) / 1000), koksma__elimination_radius(1000, 3), 1e-12);
        assert_that(rho >= rows[r].low && rho <= rows[r].high, "%s: relative radius %.3f", rows[r].spec, rho);
        koksma_points_fini(&p);
    }
}

/* The mean over sets, with the seeds 0 .. sets - 1, of the smallest distance. */
static double mean_smallest(const char *spec, size_t n, int dim, uint64_t sets)
{
    double sum = 0;
    for (uint64_t seed = 0; seed < sets; seed++) {
        koksma_points p = test_points(spec, n, dim, seed);
        sum += smallest_distance(&p, true) / (double)sets;
        koksma_points_fini(&p);
    }
    return sum;
}

/* In 2 to 8 dimensions every pattern that claims blue noise keeps points twice as far apart as random ones are. n grows
   where the patterns of that dimension allow it: of few points in many dimensions random ones are far apart, too. */
TEST_CASE(blue_noise_keeps_apart_in_all_dimensions)
{
    const size_t counts[] = {0, 0, 200, 100, 100, 64, 64, 300, 500};
    for (int dim = 2; dim <= test_repeats(8, 3); dim++) {
        const size_t n = test_repeats(counts[dim], 40);
        const double random = mean_smallest("random", n, dim, 24);
        const koksma_pattern *p;
        for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
            if (!(p->claims & KOKSMA_CLAIM_BLUE) || dim < p->min_dim || dim > p->max_dim) {
                continue;
            }
            char text[64];
            const bool has_length = p->params && !strcmp(p->params[0].name, "length");
            snprintf(text, sizeof text, has_length ? "%s:length=%zu" : "%s", p->name, n);
            const double found = mean_smallest(text, n, dim, 1);
            print_message("%s, dim = %d: %.4f, %.2f times that of random points\n", text, dim, found, found / random);
            assert_that(found >= 2 * random, "%s, n = %zu, dim = %d: smallest distance %g, random %g", text, n, dim,
                        found, random);
        }
    }
}

/* Every prefix of a progressive order is blue noise of its number (Yuksel 2015): in the plane his program has relative
   radii of .63 to .65 for eighths, quarters and halves. Random points have .3 and less. */
TEST_CASE(prefixes_are_blue_in_space)
{
    for (int dim = 3; dim <= 6; dim++) {
        koksma_points all = test_points("progressive-elimination:length=512", 512, dim, 1);
        for (size_t n = 64; n <= 512; n *= 2) {
            const double rho = relative_radius(&(koksma_points){n, dim, all.xs});
            assert_that(rho > 0.6 && rho < 0.75, "%d dimensions, first %zu of 512: relative radius %.3f", dim, n,
                        rho);
        }
        koksma_points_fini(&all);
    }
}
