/* SPDX-License-Identifier: Apache-2.0 */
/* koksma_identify says of points that other packages made what their documents or sources say, of points of ours which they
   are, however they were permuted, cut, scaled or rounded, and of others that it does not know them. The files of
   `sets` have 64 points each: made by the versions in docs/conventions-of-others.md, with seed 1 where there is one. */
#include <koksma/identify.h>

#include <math.h>
#include <string.h>

#include "test.h"

/* Returns the statement that names the points, or the one that says that they are unknown. */
static koksma_identity name_of(const koksma_points *points)
{
    koksma_identities all;
    koksma_identity best = {0};
    assert_ok(koksma_identify(points, NULL, &all));
    for (size_t i = all.count; i-- > 0;) {
        if (koksma_identity_names(&all.items[i]) || (!best.relation && !strcmp(all.items[i].relation, "unknown"))) {
            best = all.items[i];
        }
    }
    koksma_identities_fini(&all);
    return best;
}

static void expect(const char *name, const koksma_points *points, const char *relation, const char *what,
                   uint64_t first)
{
    const koksma_identity found = name_of(points);
    assert_that(found.relation && !strcmp(found.relation, relation) && !strncmp(found.what, what, strlen(what)) &&
                    found.first == first,
                "%s: %s of %s from %llu, not %s of %s from %llu", name, found.relation, found.what,
                (unsigned long long)found.first, relation, what, (unsigned long long)first);
}

static const struct {
    const char *file, *relation, *what;
    uint64_t first;
    bool slow;
} sets[] = {
    {"QuantLib-halton", "equal", "Halton", 1, false},
    {"QuantLib-sobol-jaeckel", "equal", "Sobol' (Bratley & Fox 1988, ACM 659), Gray order", 1, false},
    {"QuantLib-sobol-joekuo7", "equal", "Sobol' (Joe & Kuo 2008, new-joe-kuo-6.21201), Gray order", 1, false},
    {"QuantLib-sobol-unit", "sequence", "sequence in base 2 of other matrices", 0, false},
    {"SALib-sobol", "reordered", "Sobol' (Joe", 0, false},
    {"babylon-halton", "equal", "Halton", 1, false},
    {"boost-faure", "equal", "Faure", 0, false},
    {"boost-niederreiter", "equal", "Niederreiter in base 2 (Bratley, Fox & Niederreiter 1992), Gray order", 1,
     false},
    {"chaospy-sobol", "equal", "Sobol' (Bratley & Fox 1988, ACM 659), Gray order", 1, false},
    {"chaospy-halton", "equal", "Halton", 8, false},
    {"chaospy-hammersley", "equal", "Hammersley: Halton, coordinates 0 1 2 i/n", 6, false},
    {"chaospy-korobov", "reordered", "rank-1 lattice of 65 points", 1, false},
    {"curand-sobol32", "shifted", "Sobol' (Joe", 0, true},
    {"deepxde-sobol", "equal", "Sobol' (Bratley & Fox 1988, ACM 659), Gray order", 2, false},
    {"deepxde-hammersley", "equal", "Hammersley: Halton, coordinates 0 1 2 i/n", 1, false},
    {"gsl-sobol", "equal", "Sobol' (Bratley & Fox 1988, ACM 659), Gray order", 1, false},
    {"gsl-niederreiter-2", "reordered", "Niederreiter in base 2", 0, false},
    {"gsl-halton", "equal", "Halton", 1, false},
    {"mitsuba-multijitter", "stratified", "Latin hypercube", 0, false},
    {"mitsuba-stratified", "stratified", "jittered points", 0, false},
    {"mkl-niederreiter", "equal", "Niederreiter in base 2 (Bratley, Fox & Niederreiter 1992), Gray order", 1, false},
    {"nevergrad-hammersleysearch", "equal", "Hammersley: Halton, coordinates i/n 0 1 2", 1, false},
    {"openturns-haselgrove", "recurrence", "additive recurrence of the square roots of primes", 1, false},
    {"openturns-sobol", "equal", "Sobol' (Bratley & Fox 1988, ACM 659), Gray order", 1, false},
    {"optuna-sobol", "reordered", "Sobol' (Joe", 0, false},
    {"pydoe-korobov_sequence", "equal", "rank-1 lattice of 64 points", 0, false},
    {"pydoe-hammersley_sequence", "equal", "Hammersley: Halton, coordinates i/n 0 1 2", 0, false},
    {"prosamplers-jittered", "stratified", "jittered points", 0, false},
    {"qmcpy-sobol", "equal", "Sobol' (Joe", 0, false},
    {"qmcpy-sobol-ds", "digital-shift", "Sobol' (Joe", 0, true},
    {"qmcpy-sobol-lmsds", "linear-scramble", "Sobol' (Joe", 0, true},
    {"qmcpy-lattice-shift", "lattice", "lattice sequence in base 2, shifted modulo 1", 0, false},
    {"qmcpy-lattice-linear", "lattice", "rank-1 lattice of 64 points", 0, false},
    {"scikit-optimize-hammersly", "equal", "Hammersley: Halton, coordinates 0 1 2 i/n", 0, false},
    {"scikit-optimize-sobol", "shifted", "Sobol' (Bratley & Fox 1988, ACM 659), Gray order", 0, false},
    {"scikit-optimize-grid", "grid", "grid of 8 x 8", 0, false},
    {"scipy-sobol", "reordered", "Sobol' (Joe", 0, false},
    {"scipy-sobol-box", "reordered", "Sobol' (Joe", 0, false},
    {"scipy-halton", "equal", "Halton", 0, false},
    {"scipy-halton-scrambled", "digit-permutation", "Halton", 0, true},
    {"sobol-burley", "sequence", "sequence in base 2", 0, false},
    {"sobol-seq-sobol", "equal", "Sobol' (Bratley & Fox 1988, ACM 659), Gray order", 1, false},
    {"ssj-faure", "part", "Faure", 0, false},
    {"thi-ng-plastic", "equal", "additive recurrence of the generalised golden ratio", 0, false},
    {"tklds-sobol", "sequence", "sequence in base 2 of other matrices", 0, false},
    {"torch-sobol", "reordered", "Sobol' (Joe", 0, false},
    {"torch-sobol-scrambled", "linear-scramble", "Sobol' (Joe & Kuo 2008, new-joe-kuo-6.21201), Gray order", 0, true},
};

TEST_CASE(points_of_others_are_named)
{
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        koksma_points points;
        char path[512];
        snprintf(path, sizeof path, "%s/identify/sets/%s.npy", KOKSMA_TESTS, sets[i].file);
        if (!sets[i].slow || test_repeats(1, 0)) {
            assert_ok(koksma_points_read_mapped(path, &points));
            expect(sets[i].file, &points, sets[i].relation, sets[i].what, sets[i].first);
            koksma_points_fini(&points);
        }
    }
}

/* Points in another order, with columns permuted, cut, scaled and rounded. */
TEST_CASE(changed_points_are_named)
{
    koksma_points all = test_points("sobol", 640, 3, 0), some = test_points("sobol", 600, 3, 0);
    for (size_t i = 0; i < some.n; i++) { /* 7 has no factor in common with 640 */
        for (int k = 0; k < 3; k++) {
            some.xs[3 * i + (size_t)k] = all.xs[3 * (7 * i % 640) + 2 - (size_t)k];
        }
    }
    expect("cut and permuted", &some, "part", "Sobol' (Joe & Kuo 2008, new-joe-kuo-6.21201), coordinates 2 1 0", 0);
    for (size_t i = 0; i < 3 * some.n; i++) {
        some.xs[i] = 2 * some.xs[i] - 1;
    }
    expect("in [-1,1]", &some, "part", "Sobol' (Joe", 0);
    koksma_points_fini(&some);
    koksma_points_fini(&all);
    koksma_points halton = test_points("halton", 100, 3, 0);
    for (size_t i = 0; i < 3 * halton.n; i++) {
        halton.xs[i] = (double)(float)halton.xs[i];
    }
    if (test_repeats(1, 0)) {
        expect("as float", &halton, "equal", "Halton", 0);
    }
    koksma_points_fini(&halton);
    koksma_points late =
        test_points("halton", 1337 + 100, 4, 0); /* from any number on its digits are a nested scramble */
    late.n = 100;
    for (size_t i = 0; i < 4 * late.n; i++) {
        late.xs[i] = (double)(float)late.xs[4 * (1337 + i / 4) + 3 - i % 4];
    }
    if (test_repeats(1, 0)) {
        expect("as float, from 1337, reversed", &late, "equal", "Halton, coordinates 3 2 1 0", 1337);
    }
    koksma_points_fini(&late);
    koksma_points sobol =
        test_points("sobol", 129 + 204, 6, 0); /* digits after the eighth place make a linear scramble */
    sobol.n = 204;
    for (size_t i = 0; i < 6 * sobol.n; i++) {
        sobol.xs[i] = round(sobol.xs[6 * 129 + i] * 1e8) / 1e8;
    }
    expect("to 8 places, from 129", &sobol, "equal", "Sobol' (Joe & Kuo 2008, new-joe-kuo-6.21201)", 129);
    koksma_points_fini(&sobol);
    koksma_points hammersley = test_points("hammersley", 97, 4, 0); /* i / 97 is Halton's coordinate 24, too */
    expect("a prime number of points", &hammersley, "equal", "Hammersley: Halton, coordinates i/n 0 1 2", 0);
    koksma_points_fini(&hammersley);
}

/* A sequence from any first point, with the columns reversed. */
TEST_CASE(reversed_columns_are_named)
{
    static const struct {
        const char *spec, *what;
        uint64_t first;
    } sequences[] = {
        {"sobol", "Sobol' (Joe & Kuo 2008, new-joe-kuo-6.21201), coordinates 3 2 1 0", 5},
        {"sobol:numbers=bratley-fox", "Sobol' (Bratley & Fox 1988, ACM 659), coordinates 3 2 1 0", 100},
        {"halton", "Halton, coordinates 3 2 1 0", 77},
        {"faure", "Faure, coordinates 3 2 1 0", 31},
    };
    for (size_t s = 0; s < sizeof sequences / sizeof *sequences; s++) {
        const size_t first = (size_t)sequences[s].first;
        koksma_points all = test_points(sequences[s].spec, first + 64, 4, 0), some = test_points("random", 64, 4, 0);
        for (size_t i = 0; i < 4 * some.n; i++) {
            some.xs[i] = all.xs[4 * (first + i / 4) + 3 - i % 4];
        }
        expect(sequences[s].spec, &some, "equal", sequences[s].what, first);
        koksma_points_fini(&some);
        koksma_points_fini(&all);
    }
}

/* Points with a seed are those of that seed; beyond the seeds that are tried no set is called one of a pattern. */
TEST_CASE(seeds_are_found_and_no_set_is_called_another)
{
    static const char *const specs[] = {"jittered"};
    static const char *const named[] = {"equal", "reordered", "part"};
    for (size_t s = 0; test_repeats(1, 0) && s < sizeof specs / sizeof *specs; s++) {
        koksma_points near = test_points(specs[s], 49, 2, 3), far = test_points(specs[s], 49, 2, (uint64_t)1 << 50);
        const koksma_identity found = name_of(&far);
        koksma_identities all;
        bool seen = false;
        assert_ok(koksma_identify(&near, NULL, &all));
        for (size_t i = 0; i < all.count; i++) {
            seen = seen || (!strcmp(all.items[i].spec, specs[s]) && all.items[i].seed == 3);
        }
        koksma_identities_fini(&all);
        assert_true(seen);
        for (size_t i = 0; i < sizeof named / sizeof *named; i++) {
            assert_string_not_equal(found.relation, named[i]);
        }
        koksma_points_fini(&near);
        koksma_points_fini(&far);
    }
}

TEST_CASE(bad_points_are_refused)
{
    koksma_points points = test_points("random", 4, 2, 0);
    koksma_identities all;
    points.xs[3] = INFINITY;
    assert_int_equal(koksma_identify(&points, NULL, &all), KOKSMA_ARGUMENT);
    koksma_points_fini(&points);
    assert_int_equal(koksma_identify(&points, NULL, &all), KOKSMA_ARGUMENT);
}
