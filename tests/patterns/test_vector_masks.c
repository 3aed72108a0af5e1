/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Vector masks against what Georgiev & Fajardo (2016) ask of them: the energy of the arrangement, computed here by its
 * definition over all pairs of pixels, is as small as that of another search, and no swap lowers it by much. The vectors
 * are a set of low discrepancy with one value in each interval of length 1 / size^2 along every axis.
 */
#include <koksma/mask.h>

#include <stdlib.h>
#include <string.h>

#include "core/random.h"
#include "test.h"

static double *mask_of(int size, int dim, uint64_t seed)
{
    double *values = malloc((size_t)(size * size * dim) * sizeof *values);
    assert_non_null(values);
    assert_ok(koksma_mask_vectors(size, dim, seed, NULL, values));
    return values;
}

TEST_CASE(every_interval_has_one_value)
{
    static const int cases[][2] = {{4, 1}, {4, 8}, {5, 2}, {7, 3}, {12, 2}, {13, 4}, {14, 1}};
    const size_t n_cases = test_repeats(sizeof cases / sizeof *cases, 4);
    for (size_t t = 0; t < n_cases; t++) {
        const int size = cases[t][0], dim = cases[t][1], n = size * size;
        double *values = mask_of(size, dim, t);
        for (int k = 0; k < dim; k++) {
            bool seen[256] = {false};
            for (int p = 0; p < n; p++) {
                const double x = values[p * dim + k];
                assert_true(x >= 0 && x < 1);
                const int interval = (int)(x * n);
                assert_that(!seen[interval], "size %d, dim %d: coordinate %d has two values in interval %d", size,
                            dim, k, interval);
                seen[interval] = true;
            }
        }
        free(values);
    }
}

/* The star discrepancy is below 2.2 log(n) / n, which good lattices in two dimensions have (Niederreiter 1992, chapter 5):
   .048 for 256 points, of which random ones have some .07. */
TEST_CASE(vectors_have_a_low_discrepancy)
{
    enum { SIZE = test_repeats(16, 8), N = SIZE * SIZE };
    double *values = mask_of(SIZE, 2, 3);
    const koksma_points points = {N, 2, values};
    const koksma_value star = test_measure("star", &points);
    assert_that(star.value < 2.2 * log(N) / N, "star discrepancy %.4f", star.value);
    free(values);
}

static int on_torus(int d, int size)
{
    d = abs(d);
    return d < size - d ? d : size - d;
}

/* The two factors of the energy's terms: of pixels p and q element p n + q, of vectors i and j element i n + j. */
typedef struct factors {
    int n;
    double *pixels, *vectors;
} factors;

static factors factors_of(const double *values, int size, int dim)
{
    const int n = size * size;
    factors f = {n, malloc((size_t)(n * n) * sizeof(double)), malloc((size_t)(n * n) * sizeof(double))};
    assert_true(f.pixels && f.vectors);
    for (int p = 0; p < n; p++) {
        for (int q = 0; q < n; q++) {
            const int x = on_torus(p % size - q % size, size), y = on_torus(p / size - q / size, size);
            double square = 0;
            for (int k = 0; k < dim; k++) {
                square += (values[p * dim + k] - values[q * dim + k]) * (values[p * dim + k] - values[q * dim + k]);
            }
            f.pixels[p * n + q] = p == q ? 0 : exp(-(x * x + y * y) / (2.1 * 2.1));
            f.vectors[p * n + q] = exp(-pow(square, dim / 4.0));
        }
    }
    return f;
}

static void forget(factors *f)
{
    free(f->pixels);
    free(f->vectors);
}

/* The energy of pixel p with all others, where pixel q has the vector at[q]. */
static double energy_at(const factors *f, const int *at, int p)
{
    double energy = 0;
    for (int q = 0; q < f->n; q++) {
        energy += f->pixels[p * f->n + q] * f->vectors[at[p] * f->n + at[q]];
    }
    return energy;
}

static double energy_of(const factors *f, const int *at)
{
    double energy = 0;
    for (int p = 0; p < f->n; p++) {
        energy += energy_at(f, at, p) / 2;
    }
    return energy;
}

static void shuffle(int *at, int n, uint64_t seed)
{
    for (int i = 0; i < n; i++) {
        at[i] = i;
    }
    for (int i = n - 1; i > 0; i--) {
        const koksma__words random = koksma__random(seed, KOKSMA__PURPOSE_TEST, (uint64_t)i, 7);
        const int j = (int)koksma__below(random.w[0], (uint32_t)i + 1), point = at[i];
        at[i] = at[j];
        at[j] = point;
    }
}

/* Returns by how much swapping pixels p and q raises the energy; the swap stays if it does not raise it. */
static double descend(const factors *f, int *at, int p, int q)
{
    const double before = energy_at(f, at, p) + energy_at(f, at, q);
    const int point = at[p];
    at[p] = at[q];
    at[q] = point;
    const double growth = energy_at(f, at, p) + energy_at(f, at, q) - before;
    if (growth > 0) {
        at[q] = at[p];
        at[p] = point;
    }
    return growth;
}

/* The energy lies below the mean of random arrangements by as much, within 3 %, as the best of the arrangements in which
   a descent by swaps of all pairs ends; and no swap lowers it by more than 1 % of that. */
TEST_CASE(the_energy_is_small)
{
    enum { SIZE = test_repeats(12, 8), N = SIZE * SIZE, RANDOM = test_repeats(20, 4), DESCENTS = test_repeats(2, 1) };
    for (int dim = 1; dim <= test_repeats(4, 2); dim++) {
        double *values = mask_of(SIZE, dim, (uint64_t)dim), random = 0, least = INFINITY;
        factors f = factors_of(values, SIZE, dim);
        int at[N];
        for (uint64_t r = 0; r < RANDOM; r++) {
            shuffle(at, N, r);
            random += energy_of(&f, at) / RANDOM;
        }
        for (uint64_t r = 0; r < DESCENTS; r++) {
            shuffle(at, N, 100 + r);
            bool moved = true;
            for (int round = 0; round < test_repeats(30, 2) && moved; round++) {
                moved = false;
                for (int pair = 0; pair < N * N; pair++) {
                    moved |= pair / N < pair % N && descend(&f, at, pair / N, pair % N) < -1e-9;
                }
            }
            least = fmin(least, energy_of(&f, at));
        }
        for (int i = 0; i < N; i++) {
            at[i] = i;
        }
        const double energy = energy_of(&f, at);
        assert_that(random - energy > 0.97 * (random - least), "dim %d: energy %.4f; random %.4f, descents %.4f", dim,
                    energy, random, least);
        double gain = 0;
        for (int pair = 0; pair < N * N; pair++) {
            int swapped[N];
            memcpy(swapped, at, sizeof at);
            if (pair / N < pair % N) {
                gain = fmax(gain, -descend(&f, swapped, pair / N, pair % N));
            }
        }
        assert_that(gain < 0.01 * (random - energy), "dim %d: a swap lowers the energy by %.4f, of %.4f below random",
                    dim, gain, random - energy);
        forget(&f);
        free(values);
    }
}
