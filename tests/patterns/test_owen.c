/* SPDX-License-Identifier: Apache-2.0 */
/* Owen's nested uniform scrambling (1995) of every pattern that has it, against its definition: each node of the tree
   of digits has a random permutation, uniform and independent of the others; means have no bias; and variances are those
   of permutations drawn node by node, by the book, here. The claims have that nets stay nets. */
#include <stdlib.h>

#include "core/random.h"
#include "pattern_sets.h"
#include "patterns/nets/nets.h"

enum { MOST_DIM = 7 };

/* Bases: PRIMES, PRIMES after the equidistant coordinate of base 2, the least PRIME >= dim, or a number. */
enum { PRIMES, EQUIDISTANT, PRIME, TWO, THREE };

/* A pattern that takes scramble=owen, and is not here, fails the first test. */
static const struct scrambled {
    const char *name;
    int bases;
} patterns[] = {
    {"halton", PRIMES},          {"sobol", TWO},           {"faure", PRIME},
    {"hammersley", EQUIDISTANT}, {"zaremba", EQUIDISTANT}, {"larcher-pillichshammer", TWO},
    {"ternary-quads", THREE},
};
enum { N_PATTERNS = sizeof patterns / sizeof *patterns };

/* The base of coordinate k. */
static uint32_t base_of(const struct scrambled *p, int dim, int k)
{
    const int number = p->bases == PRIMES ? k : p->bases == EQUIDISTANT && k ? k - 1 : p->bases == THREE;
    uint32_t base = koksma__prime(number);
    for (int i = 1; p->bases == PRIME && base < (uint32_t)dim; i++) {
        base = koksma__prime(i);
    }
    return base;
}

static const struct scrambled *of_name(const char *name)
{
    for (size_t i = 0; i < N_PATTERNS; i++) {
        if (!strcmp(patterns[i].name, name)) {
            return &patterns[i];
        }
    }
    return NULL;
}

TEST_CASE(all_that_scramble_are_tested)
{
    const koksma_pattern *p;
    size_t found = 0;
    for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
        for (int k = 0; p->params && p->params[k].name; k++) {
            for (int c = 0; p->params[k].choices && p->params[k].choices[c]; c++) {
                /* Interlacing after scrambling leaves no net in base 2 of its own: test_interlaced.c has that pattern. */
                if (!strcmp(p->params[k].choices[c], "owen") && strcmp(p->name, "interlaced-sobol") != 0) {
                    assert_string_equal(p->params[k].name, "scramble");
                    assert_string_equal(p->params[k].choices[0], "none");
                    assert_non_null(of_name(p->name));
                    found++;
                }
            }
        }
    }
    assert_int_equal(found, N_PATTERNS);
    for (size_t i = 0; i < N_PATTERNS; i++) {
        char text[KOKSMA_MAX_SPEC];
        koksma_spec spec;
        snprintf(text, sizeof text, "%s:scramble=owen", patterns[i].name);
        assert_ok(koksma_pattern_spec(text, &spec));
        assert_false(koksma_has_one_set(&spec)); /* trials and pixels have sets of their own */
        assert_ok(koksma_pattern_spec(patterns[i].name, &spec));
        assert_int_equal(koksma_has_one_set(&spec), !!(spec.pattern->claims & KOKSMA_CLAIM_DETERMINISTIC));
    }
    assert_int_equal(status_of("hammersley:scramble=owen,offset=0.5", 16, 2), KOKSMA_ARGUMENT);
}

static koksma_points scrambled_points(const char *name, size_t n, int dim, uint64_t seed)
{
    char spec[KOKSMA_MAX_SPEC];
    snprintf(spec, sizeof spec, "%s:scramble=owen", name);
    return test_points(spec, n, dim, seed);
}

/* The first two digits of x in a base, as one number; plain values may be the double below theirs. */
static uint32_t two_digits(double x, uint32_t base)
{
    return (uint32_t)((x + 1e-12) * base * base);
}

/* The place of a permutation of 0 .. b-1 in the order of their words. */
static uint32_t rank_of(const uint32_t *permutation, uint32_t b)
{
    uint32_t rank = 0;
    for (uint32_t i = 0; i < b; i++) {
        uint32_t smaller = 0;
        for (uint32_t j = i + 1; j < b; j++) {
            smaller += permutation[j] < permutation[i];
        }
        rank = rank * (b - i) + smaller;
    }
    return rank;
}

static void assert_uniform(const uint32_t *counts, uint32_t cells, const char *what, int k)
{
    double total = 0, chi = 0;
    for (uint32_t c = 0; c < cells; c++) {
        total += counts[c];
    }
    for (uint32_t c = 0; c < cells; c++) {
        const double off = counts[c] - total / cells;
        chi += off * off / (total / cells);
    }
    /* Wilson & Hilferty: the cube root is normal. About 60 tests: 4.5 standard deviations. */
    const double freedom = cells - 1, z = (cbrt(chi / freedom) - 1 + 2 / (9 * freedom)) / sqrt(2 / (9 * freedom));
    assert_that(fabs(z) < 4.5, "%s, coordinate %d: chi-square %.1f with %.0f degrees of freedom", what, k, chi,
                freedom);
}

/* n = b^2 points show the root's permutation and those of its b children. Counted over seeds: the root's and child
   0's together, those of children 0 and 1 together (to base 3; above, the places of two digits), and the place of
   every point within its stratum. */
static void check_digits(const struct scrambled *p, int dim, int k)
{
    enum { SEEDS = 2500, PLACES = 16, MOST_CELLS = 400 };
    const uint32_t b = base_of(p, dim, k);
    const size_t n = (size_t)b * b;
    uint32_t trees[MOST_CELLS] = {0}, children[MOST_CELLS] = {0}, places[PLACES] = {0}, deep[PLACES] = {0};
    const uint32_t each = b == 2 ? 2 : b == 3 ? 6 : b * (b - 1);
    koksma_points plain = test_points(p->name, n, dim, 0);
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        koksma_points points = scrambled_points(p->name, n, dim, seed);
        uint32_t nodes[1 + 7][7] = {{0}}, ranks[3];
        for (size_t i = 0; i < n; i++) {
            const double x = points.xs[i * (size_t)dim + (size_t)k];
            const uint32_t from = two_digits(plain.xs[i * (size_t)dim + (size_t)k], b);
            const uint32_t to = (uint32_t)(x * b * b);
            nodes[0][from / b] = to / b;
            nodes[1 + from / b][from % b] = to % b;
            places[(uint32_t)(x * b * b * PLACES) % PLACES]++;
            deep[(uint64_t)(x * 0x1p31) % PLACES]++;
        }
        for (int node = 0; node < 3; node++) {
            const uint32_t second = nodes[node][1] - (nodes[node][1] > nodes[node][0]);
            ranks[node] = b <= 3 ? rank_of(nodes[node], b) : nodes[node][0] * (b - 1) + second;
        }
        trees[b <= 3 ? ranks[0] * each + ranks[1] : ranks[0]]++;
        children[b <= 3 ? ranks[1] * each + ranks[2] : ranks[1]]++;
        koksma_points_fini(&points);
    }
    koksma_points_fini(&plain);
    assert_uniform(trees, b <= 3 ? each * each : each, p->name, k);
    assert_uniform(children, b <= 3 ? each * each : each, p->name, k);
    assert_uniform(places, PLACES, p->name, k);
    assert_uniform(deep, PLACES, p->name, k);
}

TEST_CASE(permutations_are_uniform_and_independent)
{
    for (size_t i = 0; i < N_PATTERNS; i++) {
        const int most = koksma_pattern_find(patterns[i].name)->max_dim < 4 ? 2 : 4;
        for (int k = 0; k < most; k++) {
            check_digits(&patterns[i], most, k);
        }
    }
    check_digits(of_name("faure"), 3, 2);
    check_digits(of_name("faure"), 2, 1);
    check_digits(of_name("faure"), 7, 5);
}

/* With any number of points, i/n is scrambled within its stratum. */
TEST_CASE(other_counts_are_stratified)
{
    static const char *const planar[] = {"hammersley", "zaremba", "larcher-pillichshammer"};
    static const size_t counts[] = {3, 12, 100, 999};
    for (size_t p = 0; p < 3; p++) {
        for (size_t c = 0; c < 4; c++) {
            koksma_points points = scrambled_points(planar[p], counts[c], 2, c);
            const int use = 0;
            assert_true(one_in_each(&points, counts[c], &use, &counts[c], 1));
            koksma_points_fini(&points);
        }
    }
}

/* The bits of a point do not depend on how many there are. */
TEST_CASE(prefixes_are_the_sets)
{
    static const int dims[] = {2, 3, 17, 60};
    for (size_t d = 0; d < 4; d++) {
        koksma_points all = scrambled_points("faure", 20000, dims[d], 4);
        static const size_t counts[] = {1, 60, 3000, 19683};
        for (size_t c = 0; c < 4; c++) {
            koksma_points some = scrambled_points("faure", counts[c], dims[d], 4);
            assert_memory_equal(some.xs, all.xs, counts[c] * (size_t)dims[d] * sizeof *all.xs);
            koksma_points_fini(&some);
        }
        koksma_points_fini(&all);
    }
}

/* A random permutation of 0 .. b-1 for the node below `prefix`, and what it makes of a digit. */
static uint32_t permuted(uint64_t seed, int k, uint64_t prefix, uint32_t b, uint32_t digit)
{
    uint32_t permutation[16];
    const uint64_t node = koksma__random_seed(seed, prefix, 1000 + (uint32_t)k);
    koksma__random_permutation(node, 0, b, permutation);
    return permutation[digit];
}

/* Nested scrambling by its definition: of the first `depth` digits of plain points, and uniform below. */
static void scramble_by_the_book(uint64_t seed, const koksma_points *plain, uint32_t b, int depth, double *xs)
{
    for (size_t i = 0; i < plain->n * (size_t)plain->dim; i++) {
        const int k = (int)(i % (size_t)plain->dim);
        double rest = plain->xs[i] + 1e-13, x = 0, scale = 1, pair[2];
        uint64_t prefix = 1;
        for (int r = 0; r < depth; r++) {
            rest *= b;
            const uint32_t digit = (uint32_t)rest;
            rest -= digit;
            scale /= b;
            x += permuted(seed, k, prefix, b, digit) * scale;
            prefix = prefix * b + digit;
        }
        koksma__random_pair(seed, KOKSMA__PURPOSE_TEST, i, 0, pair);
        xs[i] = x + pair[0] * scale;
    }
}

enum { MEANS = 4 };

/* Each has the mean 0. */
static void evaluate(const koksma_points *points, const double *xs, double f[MEANS])
{
    const size_t dim = (size_t)points->dim;
    for (int j = 0; j < MEANS; j++) {
        f[j] = 0;
    }
    for (size_t i = 0; i < points->n; i++) {
        const double *x = xs + i * dim;
        double product = 1, sum = 0;
        for (size_t k = 0; k < dim; k++) {
            product *= 1 + (x[k] - 0.5);
            sum += x[k];
        }
        f[0] += (x[dim - 1] - 0.5) / (double)points->n;
        f[1] += (product - 1) / (double)points->n;
        f[2] += (x[0] - 0.5) * (x[dim - 1] - 0.5) / (double)points->n;
        f[3] += ((sum < (double)dim / 2) - 0.5) / (double)points->n;
    }
}

/* Mean squares of errors over seeds agree within 4 standard errors, and means are 0. That of a coordinate alone is
   1 / (12 n^3) exactly: n points in strata of 1/n each. */
TEST_CASE(variances_are_owens)
{
    enum { SEEDS = 600 };
    static const struct {
        int dim, depth;
        size_t n;
    } cases[] = {{2, 5, 32}, {3, 3, 27}, {3, 4, 60}, {3, 4, 81}, {5, 2, 25}, {5, 3, 125}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        const int dim = cases[c].dim;
        koksma_points plain = test_points("faure", cases[c].n, dim, 0);
        double *xs = malloc(plain.n * (size_t)dim * sizeof *xs);
        double means[2][MEANS] = {{0}}, squares[2][MEANS] = {{0}}, fourths[2][MEANS] = {{0}};
        for (uint64_t seed = 0; seed < SEEDS; seed++) {
            double f[2][MEANS];
            koksma_points points = scrambled_points("faure", cases[c].n, dim, seed);
            evaluate(&points, points.xs, f[0]);
            koksma_points_fini(&points);
            scramble_by_the_book(seed, &plain, base_of(of_name("faure"), dim, 0), cases[c].depth, xs);
            evaluate(&plain, xs, f[1]);
            for (int j = 0; j < 2 * MEANS; j++) {
                const double e = f[j / MEANS][j % MEANS];
                means[j / MEANS][j % MEANS] += e / SEEDS;
                squares[j / MEANS][j % MEANS] += e * e / SEEDS;
                fourths[j / MEANS][j % MEANS] += e * e * e * e / SEEDS;
            }
        }
        for (int j = 0; j < MEANS; j++) {
            double spread = 0;
            for (int s = 0; s < 2; s++) {
                assert_near(means[s][j], 0, 4 * sqrt(squares[s][j] / SEEDS));
                spread += (fourths[s][j] - squares[s][j] * squares[s][j]) / SEEDS;
            }
            assert_near(squares[0][j], squares[1][j], 4 * sqrt(spread));
        }
        const double n = (double)cases[c].n, exact = 1 / (12 * n * n * n);
        if (cases[c].n != 60) {
            assert_near(squares[0][0], exact, 4 * sqrt(fourths[0][0] / SEEDS));
        }
        free(xs);
        koksma_points_fini(&plain);
    }
}
