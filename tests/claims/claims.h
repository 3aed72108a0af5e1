/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The tests of claims: claims.c defines claim_<ID> for each line of <koksma/claims.def>.
 * It looks at one set of points of a pattern that makes the claim and fails by fail_claim; where the claim says
 * nothing about this n or dim it returns. test_claims.c walks the patterns.
 */
#ifndef KOKSMA_TESTS_CLAIMS_H
#define KOKSMA_TESTS_CLAIMS_H

#include <stdlib.h>
#include <string.h>

#include "patterns/spacing/spacing.h"
#include "test.h"

typedef void claim_check(const koksma_spec *spec, const koksma_points *points, uint64_t seed);

#define KOKSMA_CLAIM(id, bit, name, meaning) claim_check claim_##id;
#include <koksma/claims.def>
#undef KOKSMA_CLAIM

#define fail_claim(spec, points, ...)                                                                                \
    do {                                                                                                             \
        char text_[KOKSMA_MAX_SPEC], why_[200];                                                                      \
        koksma_spec_text(spec, text_);                                                                               \
        snprintf(why_, sizeof why_, __VA_ARGS__);                                                                    \
        fail_msg("%s, n = %zu, dim = %d: %s", text_, (points)->n, (points)->dim, why_);                              \
    } while (0)

/* The spec of a pattern with its defaults or, where they fix how many points are made whatever n, with fewer. */
koksma_spec quick_spec_of(const koksma_pattern *pattern);

/* The value of a parameter; fallback when the pattern has none of this name. */
double param_of(const koksma_spec *spec, const char *name, double fallback);

/* The stratum of x among m, bounded by the doubles nearest to j/m. */
size_t stratum(double x, size_t m);

/* The first n points: one in each cell of a grid that has m[k] cells along coordinate use[k]. */
bool one_in_each(const koksma_points *points, size_t n, const int *use, const size_t *m, int count);

/* m with n = m^power; 0: there is none. */
size_t root_of(size_t n, int power);

/* |a - b|, on the torus or in [0,1]. */
double gap(double a, double b, bool torus);

/* Over all pairs. */
double smallest_distance(const koksma_points *points, bool torus);

/* The n points from `first` on are a (0,m,2)-net in base 2. */
bool is_net2_block(const koksma_points *points, size_t first, size_t n);

/* The first n = b^m points, in up to 8 dimensions, are a (0,m,dim)-net in base b. */
bool is_net_in_base(const koksma_points *points, size_t n, size_t b);

/* With the same n and seed, a dimension more leaves these points' coordinates as they are, or is refused. */
bool keeps_dimensions(const koksma_spec *spec, const koksma_points *points, uint64_t seed);

/* Coordinates k .. k + count - 1 of all points. */
koksma_points projection_of(const koksma_points *points, int k, int count);

/* The sets of a pattern that check_means_of takes, of seeds MEANS_SEED, MEANS_SEED + 1, ... */
enum { MEANS_SETS = test_repeats(120, 40), MEANS_SEED = 1000 };
void make_sets_of_means(const koksma_spec *spec, size_t n, int dim, koksma_points sets[MEANS_SETS]);
void free_sets_of_means(koksma_points sets[MEANS_SETS]);

/* Fails unless the sets are unbiased or, with first_only, each sample is uniform (koksma_verify_sets). */
void check_means_of(const koksma_spec *spec, const koksma_points *sets, bool first_only);

/* The same for sets that it makes, of a few points in up to 3 dimensions; only for the seed 0. It keeps the last sets: the
   claims `unbiased` and `exchangeable` look at the same ones. */
void check_means(const koksma_spec *spec, const koksma_points *points, uint64_t seed, bool first_only);

#endif
