/* SPDX-License-Identifier: Apache-2.0 */
/*
 * order=progressive of poisson-disk-maximal and gaussian-blue-noise in 2 to 6 dimensions: the points are those of the plain
 * order, and every prefix is blue noise of its number, which a prefix of a random order is not.
 *
 * A random part of a share f of a set whose power is P has the power f P + 1 - f, so at low frequencies, where P is small,
 * it has 1 - f.
 */
#include <stdlib.h>
#include <string.h>

#include "pattern_sets.h"

enum { LEAST_DIM = 2, MOST_DIM = 6, SETS = 2 };

/* Few steps of the descent take less time, and what is tested does not depend on rest. */
static const char *const patterns[] = {"poisson-disk-maximal:", "gaussian-blue-noise:steps=60,"};
enum { PATTERNS = sizeof patterns / sizeof *patterns };

static const size_t counts[MOST_DIM + 1] = {0, 0, 512, 343, 256, 128, 64};

/* Radius of the frequencies that are tested, in units of n^(1/dim); less would leave no frequency in small prefixes. */
static const double reach[MOST_DIM + 1] = {0, 0, 0.6, 0.7, 0.75, 0.8, 0.8};

static int width; /* coordinates of a point in the sort */

static int by_coordinates(const void *a, const void *b)
{
    const double *x = a, *y = b;
    int order = 0;
    for (int k = 0; k < width && !order; k++) {
        order = (x[k] > y[k]) - (x[k] < y[k]);
    }
    return order;
}

static koksma_points in_order(const char *pattern, const char *order, size_t n, int dim, uint64_t seed)
{
    char text[64];
    snprintf(text, sizeof text, "%sorder=%s", pattern, order);
    return test_points(text, n, dim, seed);
}

/* Fails unless two sets, which it sorts, have the same points; by_order: in different orders. */
static void assert_reordered(koksma_points *a, koksma_points *b, bool by_order)
{
    const size_t size = (size_t)a->dim * sizeof *a->xs;
    assert_int_equal(a->n, b->n);
    assert_true(!by_order || memcmp(a->xs, b->xs, a->n * size));
    width = a->dim;
    qsort(a->xs, a->n, size, by_coordinates);
    qsort(b->xs, b->n, size, by_coordinates);
    assert_memory_equal(a->xs, b->xs, a->n * size);
    koksma_points_fini(a);
    koksma_points_fini(b);
}

TEST_CASE(the_points_are_those_of_the_plain_order)
{
    for (size_t p = 0; p < PATTERNS; p++) {
        for (int dim = LEAST_DIM; dim <= MOST_DIM; dim++) {
            for (size_t n = 1; n <= 90; n = 3 * n - (n > 1)) { /* 1, 3, 8, 23, 68 */
                koksma_points ordered = in_order(patterns[p], "progressive", n, dim, n);
                koksma_points plain = in_order(patterns[p], "plain", n, dim, n);
                assert_reordered(&ordered, &plain, n >= 23);
            }
        }
    }
}

/* By distance, too: the number of points follows from d. */
TEST_CASE(sets_by_distance_are_ordered)
{
    for (int dim = 2; dim <= 3; dim++) {
        koksma_spec spec;
        koksma_points plain, ordered;
        assert_ok(koksma_pattern_spec("poisson-disk-maximal:d=0.15", &spec));
        assert_ok(koksma_generate_whole(&spec, 4, NULL, dim, &plain));
        assert_ok(koksma_pattern_spec("poisson-disk-maximal:d=0.15,order=progressive", &spec));
        assert_ok(koksma_generate_whole(&spec, 4, NULL, dim, &ordered));
        assert_reordered(&ordered, &plain, true);
    }
}

/* ---- Prefixes --------------------------------------------------------------------------------------------- */

enum { PREFIXES = 5 };

/* Eighths of the set, and means over SETS sets of the relative radius and the power of that prefix. */
static const size_t eighths[PREFIXES] = {1, 2, 3, 4, 6};

typedef struct look {
    double radius[PREFIXES], power[PREFIXES];
} look;

static look look_at(const char *pattern, bool progressive, int dim)
{
    look mean = {{0}, {0}};
    for (uint64_t seed = 0; seed < SETS; seed++) {
        koksma_points all = in_order(pattern, progressive ? "progressive" : "plain", counts[dim], dim, seed);
        for (size_t e = 0; e < PREFIXES; e++) {
            const koksma_points part = {.n = all.n * eighths[e] / 8, .dim = dim, .xs = all.xs};
            mean.radius[e] += relative_radius(&part) / SETS;
            mean.power[e] += power_within(&part, reach[dim] * pow((double)part.n, 1.0 / dim)) / SETS;
        }
        koksma_points_fini(&all);
    }
    return mean;
}

/* Yuksel 2015: in the plane prefixes of his program have relative radii of .63 to .65; the same is asked here of all
   dimensions. Below reach n^(1/dim) random points have the power 1. */
TEST_CASE(prefixes_are_blue_noise)
{
    int failed = 0;
    for (size_t p = 0; p < PATTERNS; p++) {
        for (int dim = LEAST_DIM; dim <= test_repeats(MOST_DIM, LEAST_DIM); dim++) {
            const look found = look_at(patterns[p], true, dim), plain = look_at(patterns[p], false, dim);
            for (size_t e = 0; e < PREFIXES; e++) {
                /* the whole set limits large prefixes: a random half of a maximal set in many dimensions keeps almost all
                   of its distance */
                const bool few = eighths[e] <= 2, half = eighths[e] <= 4;
                const bool ok = found.radius[e] >= plain.radius[e] + (few ? 0.02 : -0.01) &&
                                (!half || (found.radius[e] > 0.57 && found.power[e] < 0.4)) &&
                                (!few || found.power[e] < 0.75 * plain.power[e]);
                print_message("%s, %d dimensions, first %zu/8 of %zu: relative radius %.3f (plain %.3f), power %.3f "
                              "(plain %.3f)\n",
                              patterns[p], dim, eighths[e], counts[dim], found.radius[e], plain.radius[e],
                              found.power[e], plain.power[e]);
                failed += !ok;
            }
        }
    }
    assert_int_equal(failed, 0);
}
