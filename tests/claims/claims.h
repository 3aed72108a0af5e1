/* SPDX-License-Identifier: Apache-2.0 */
/* The test of each claim, on one set of points. A check that does not apply to this n or dim returns.
   Long because it has a test for every claim, and they belong side by side. */
#ifndef KOKSMA_TESTS_CLAIMS_H
#define KOKSMA_TESTS_CLAIMS_H

#include <stdlib.h>
#include <string.h>

#include "api/generate.h"
#include "patterns/shared/packing.h"
#include "patterns/shared/radical.h"
#include "test.h"

typedef void (*claim_check)(const koksma_spec *spec, const koksma_points *points, uint64_t seed);

#define fail_claim(spec, points, ...)                                                                                \
    do {                                                                                                             \
        char text_[KOKSMA_MAX_SPEC], why_[200];                                                                      \
        koksma_spec_text(spec, text_);                                                                               \
        snprintf(why_, sizeof why_, __VA_ARGS__);                                                                    \
        fail_msg("%s, n = %zu, dim = %d: %s", text_, (points)->n, (points)->dim, why_);                              \
    } while (0)

static inline double param_of(const koksma_spec *spec, const char *name, double fallback)
{
    for (int k = 0; spec->pattern->params && spec->pattern->params[k].name; k++) {
        if (!strcmp(spec->pattern->params[k].name, name)) {
            return spec->params[k];
        }
    }
    return fallback;
}

/* The stratum of x among m, bounded by the doubles nearest to j/m. */
static inline size_t stratum(double x, size_t m)
{
    size_t j = (size_t)(x * (double)m);
    while (j > 0 && x < (double)j / (double)m) {
        j--;
    }
    while (j + 1 < m && x >= (double)(j + 1) / (double)m) {
        j++;
    }
    return j;
}

/* The first n points: one in each cell of a grid that has m[k] cells along coordinate use[k]. */
static inline bool one_in_each(const koksma_points *points, size_t n, const int *use, const size_t *m, int count)
{
    unsigned char *seen = calloc(n, 1);
    bool ok = true;
    for (size_t i = 0; i < n && ok; i++) {
        size_t cell = 0;
        for (int k = 0; k < count; k++) {
            cell = cell * m[k] + stratum(points->xs[i * (size_t)points->dim + (size_t)use[k]], m[k]);
        }
        ok = cell < n && !seen[cell];
        seen[cell < n ? cell : 0] = 1;
    }
    free(seen);
    return ok;
}

static inline size_t root_of(size_t n, int power)
{
    for (size_t m = 1;; m++) {
        size_t product = 1;
        for (int k = 0; k < power; k++) {
            product *= m;
        }
        if (product >= n) {
            return product == n ? m : 0;
        }
    }
}

static void check_deterministic(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    const bool deterministic = koksma__spec_is_deterministic(spec);
    koksma_points other;
    assert_ok(koksma_points_init(&other, points->n, points->dim));
    assert_ok(koksma_generate(spec, seed + 1, NULL, &other));
    const bool equal = !memcmp(other.xs, points->xs, points->n * (size_t)points->dim * sizeof *points->xs);
    if (equal != deterministic && (deterministic || points->n >= 16)) {
        fail_claim(spec, points, deterministic ? "the seed matters" : "the seed does not matter");
    }
    koksma_points_fini(&other);
}

static void check_sequence(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    const size_t ks[] = {1, points->n / 2, points->n - 1};
    for (int t = 0; t < 3; t++) {
        koksma_points prefix;
        if (ks[t] == 0) {
            continue;
        }
        assert_ok(koksma_points_init(&prefix, ks[t], points->dim));
        assert_ok(koksma_generate(spec, seed, NULL, &prefix));
        if (memcmp(prefix.xs, points->xs, ks[t] * (size_t)points->dim * sizeof *points->xs)) {
            fail_claim(spec, points, "its first %zu points are not the set of %zu", ks[t], ks[t]);
        }
        koksma_points_fini(&prefix);
    }
}

static void check_any_n(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)spec, (void)points, (void)seed; /* the walk fails on a refusal */
}

static void check_stratified(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const size_t m = root_of(points->n, points->dim);
    const bool centred = spec->pattern->claims & KOKSMA_CLAIM_CENTRED;
    for (size_t i = 0; i < points->n && m; i++) {
        size_t rest = i;
        for (int k = points->dim - 1; k >= 0; k--, rest /= m) {
            const double x = points->xs[i * (size_t)points->dim + (size_t)k];
            const double place = x * (double)m - (double)(rest % m);
            if (stratum(x, m) != rest % m || (centred && (place < 0.25 - 1e-6 || place > 0.75 + 1e-6))) {
                fail_claim(spec, points, "point %zu is not in its cell", i);
            }
        }
    }
}

static void check_latin(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    for (int k = 0; k < points->dim; k++) {
        if (!one_in_each(points, points->n, &k, &points->n, 1)) {
            fail_claim(spec, points, "coordinate %d is not Latin", k);
        }
    }
}

static void check_latin_prefixes(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    for (int k = 0; k < points->dim; k++) {
        for (size_t m = 1; m <= points->n; m *= koksma__prime(k)) {
            if (!one_in_each(points, m, &k, &m, 1)) {
                fail_claim(spec, points, "the first %zu points are not Latin in coordinate %d", m, k);
            }
        }
    }
}

static void check_grid(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const size_t m = root_of(points->n, 2), ms[2] = {m, m};
    const int use[2] = {0, 1};
    if (points->dim == 2 && m && !one_in_each(points, points->n, use, ms, 2)) {
        fail_claim(spec, points, "not one point in each cell");
    }
}

/* The n points from `first` on. */
static inline bool is_net2_block(const koksma_points *points, size_t first, size_t n)
{
    const koksma_points block = {.n = n, .dim = points->dim, .xs = points->xs + first * (size_t)points->dim};
    const int use[2] = {0, 1};
    bool ok = true;
    for (size_t a = 1; a <= n && ok; a *= 2) {
        const size_t ms[2] = {a, n / a};
        ok = one_in_each(&block, n, use, ms, 2);
    }
    return ok;
}

static inline bool is_net2(const koksma_points *points, size_t n)
{
    return is_net2_block(points, 0, n);
}

static void check_net2(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    if (points->dim == 2 && !(points->n & (points->n - 1)) && !is_net2(points, points->n)) {
        fail_claim(spec, points, "not a (0,m,2)-net in base 2");
    }
}

static void check_net2_prefixes(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    for (size_t n = 1; points->dim == 2 && n <= points->n; n *= 2) {
        for (size_t first = 0; first + n <= points->n; first += n) {
            if (!is_net2_block(points, first, n)) {
                fail_claim(spec, points, "points %zu to %zu are not a (0,m,2)-net in base 2", first, first + n - 1);
            }
        }
    }
}

/* All ways of writing n = b^m as a product of powers of b along the coordinates. */
static inline bool is_net(const koksma_points *points, size_t n, size_t b, int *use, size_t *ms, int k, size_t left)
{
    if (k == points->dim - 1) {
        use[k] = k;
        ms[k] = left;
        return one_in_each(points, n, use, ms, points->dim);
    }
    bool ok = true;
    for (size_t a = 1; a <= left && ok; a *= b) {
        use[k] = k;
        ms[k] = a;
        ok = is_net(points, n, b, use, ms, k + 1, left / a);
    }
    return ok;
}

static void check_net_prefixes(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    int use[8];
    size_t ms[8], b = 2;
    if (points->dim > 7) {
        return;
    }
    for (int k = 1; b < (size_t)points->dim; k++) {
        b = koksma__prime(k);
    }
    for (size_t n = 1; n <= points->n; n *= b) {
        if (!is_net(points, n, b, use, ms, 0, n)) {
            fail_claim(spec, points, "the first %zu points are not a (0,m,%d)-net in base %zu", n, points->dim, b);
        }
    }
}

static void check_oa2(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const size_t s = root_of(points->n, 2), ms[2] = {s, s};
    for (int a = 0; a < points->dim && s > 1 && param_of(spec, "strength", 2) == 2; a++) {
        for (int b = 0; b < a; b++) {
            const int use[2] = {a, b};
            if (!one_in_each(points, points->n, use, ms, 2)) {
                fail_claim(spec, points, "coordinates %d and %d do not have one point in each cell", b, a);
            }
        }
    }
}

static void check_oa3(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const size_t s = root_of(points->n, 3), ms[3] = {s, s, s};
    for (int a = 0; a < points->dim && s > 1 && param_of(spec, "strength", 2) == 3; a++) {
        for (int b = 0; b < a; b++) {
            for (int c = 0; c < b; c++) {
                const int use[3] = {a, b, c};
                if (!one_in_each(points, points->n, use, ms, 3)) {
                    fail_claim(spec, points, "coordinates %d, %d and %d lack a cell", c, b, a);
                }
            }
        }
    }
}

static inline double gap(double a, double b, bool torus)
{
    const double t = fabs(a - b);
    return torus && t > 0.5 ? 1 - t : t;
}

static inline double smallest_distance(const koksma_points *points, bool torus)
{
    double best = INFINITY;
    const size_t dim = (size_t)points->dim;
    for (size_t i = 0; i < points->n; i++) {
        for (size_t j = 0; j < i; j++) {
            double sum = 0;
            for (size_t k = 0; k < dim; k++) {
                const double t = gap(points->xs[i * dim + k], points->xs[j * dim + k], torus);
                sum += t * t;
            }
            best = sum < best ? sum : best;
        }
    }
    return sqrt(best);
}

static void check_min_distance(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const double d = param_of(spec, "d", 0);
    if (points->n > 1 && smallest_distance(points, param_of(spec, "torus", 1) != 0) < d * (1 - 1e-12)) {
        fail_claim(spec, points, "two points are closer than %g", d);
    }
}

static void check_fraction(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const double f = param_of(spec, "f", 0), densest = koksma__packing_distance(points->n, 2, true);
    if (points->n > 1 && smallest_distance(points, true) < f * densest * (1 - 1e-12)) {
        fail_claim(spec, points, "two points are closer than %g of the densest packing's distance", f);
    }
}

/* The largest hole of the torus is at a corner of the Voronoi diagram; a fine grid of places, each allowed half of
   the grid's diagonal, finds any hole that is worth the name. */
static void check_maximal(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    enum { GRID = 150 };
    if (points->n < 16) {
        return;
    }
    const double d = smallest_distance(points, true);
    for (int a = 0; a < GRID * GRID; a++) {
        const double x = (a / GRID + 0.5) / GRID, y = (a % GRID + 0.5) / GRID;
        double best = INFINITY;
        for (size_t i = 0; i < points->n && best > d * d; i++) {
            const double u = gap(points->xs[2 * i], x, true), v = gap(points->xs[2 * i + 1], y, true);
            best = fmin(best, u * u + v * v);
        }
        if (best > d * d * (1 + 1e-9)) {
            fail_claim(spec, points, "there is room at (%g, %g)", x, y);
        }
    }
}

static void check_lattice(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const size_t n = points->n, dim = (size_t)points->dim;
    for (size_t i = 0; i < n && n <= 64; i++) {
        for (size_t j = 0; j < n; j++) {
            bool found = false;
            for (size_t l = 0; l < n && !found; l++) {
                found = true;
                for (size_t k = 0; k < dim && found; k++) {
                    const double t =
                        points->xs[i * dim + k] + points->xs[j * dim + k] - points->xs[k] - points->xs[l * dim + k];
                    found = fabs(t - floor(t + 0.5)) < 1e-9;
                }
            }
            if (!found) {
                fail_claim(spec, points, "points %zu and %zu do not add up to a point", i, j);
            }
        }
    }
}

static void check_blue(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const size_t least = spec->pattern->claims & KOKSMA_CLAIM_SEQUENCE ? 64 : 4;
    const double rho = smallest_distance(points, true) / koksma__packing_distance(points->n, 2, true);
    if (points->dim == 2 && points->n >= least && !(rho > 0.5)) {
        fail_claim(spec, points, "the smallest distance is %.3f of the densest packing's", rho);
    }
}

static const double means_side[2] = {0.37, 0.61};

/* What of the first n points lies in a box with sides 0.37, 0.61, ... */
static double share_of_box(const koksma_points *points, size_t n)
{
    double inside = 0;
    for (size_t i = 0; i < n; i++) {
        bool in = true;
        for (int k = 0; k < points->dim; k++) {
            in = in && points->xs[i * (size_t)points->dim + (size_t)k] < means_side[k % 2];
        }
        inside += in ? 1.0 / (double)n : 0;
    }
    return inside;
}

/* What of their coordinates lies in a band of width 0.04: that about 0 and 1, or another one. */
static double share_of_band(const koksma_points *points, size_t n, double from)
{
    const size_t count = n * (size_t)points->dim;
    double inside = 0;
    for (size_t i = 0; i < count; i++) {
        const double x = points->xs[i], turned = x < from ? x + 1 - from : x - from;
        inside += turned < 0.04 ? 1.0 / (double)count : 0;
    }
    return inside;
}

/* Means over sets of what a box and bands hold of all points, or of the first, in standard errors. */
static void check_means(const koksma_spec *spec, const koksma_points *points, uint64_t seed, bool first_only)
{
    enum { SETS = 120, BANDS = 3 };
    static const double bands[BANDS] = {0.98, 0.105, 0.355};
    double sum[BANDS + 1] = {0}, square[BANDS + 1] = {0}, volume = 1;
    if (points->n > 32 || points->n < 4 || points->dim > 3 || seed != 0) {
        return;
    }
    koksma_points other;
    assert_ok(koksma_points_init(&other, points->n, points->dim));
    for (uint64_t s = 0; s < SETS; s++) {
        if (koksma_generate(spec, 1000 + s, NULL, &other)) {
            fail_claim(spec, points, "seed %d: %s", (int)(1000 + s), koksma_error_text());
        }
        const size_t n = first_only ? 1 : other.n;
        for (int b = 0; b <= BANDS; b++) {
            const double inside = b < BANDS ? share_of_band(&other, n, bands[b]) : share_of_box(&other, n);
            sum[b] += inside;
            square[b] += inside * inside;
        }
    }
    for (int k = 0; k < points->dim; k++) {
        volume *= means_side[k % 2];
    }
    for (int b = 0; b <= BANDS; b++) {
        const double mean = sum[b] / SETS, variance = fmax(square[b] / SETS - mean * mean, 1e-6);
        const double expected = b < BANDS ? 0.04 : volume;
        if (fabs(mean - expected) > 4.5 * sqrt(variance / SETS) + 1e-3) {
            fail_claim(spec, points, "a %s of volume %.4f holds %.4f of the points in the mean",
                       b < BANDS ? "band" : "box", expected, mean);
        }
    }
    koksma_points_fini(&other);
}

static void check_unbiased(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    check_means(spec, points, seed, false);
}

static void check_exchangeable(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    check_means(spec, points, seed, true);
}

/* Over sets, the first coordinates of points 0 and 1, and of 0 and the last, vary and are not correlated. */
static void check_independent(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    enum { SETS = 120 };
    if (points->n > 32 || points->n < 3 || seed != 0) {
        return;
    }
    koksma_points other;
    assert_ok(koksma_points_init(&other, points->n, points->dim));
    double xs[3][SETS], means[3] = {0}, products[3] = {0}, squares[3] = {0};
    for (int s = 0; s < SETS; s++) {
        assert_ok(koksma_generate(spec, 2000 + (uint64_t)s, NULL, &other));
        for (size_t i = 0; i < 3; i++) {
            xs[i][s] = other.xs[(i < 2 ? i : other.n - 1) * (size_t)other.dim];
            means[i] += xs[i][s] / SETS;
        }
    }
    koksma_points_fini(&other);
    for (int s = 0; s < SETS; s++) {
        for (int i = 0; i < 3; i++) {
            products[i] += (xs[0][s] - means[0]) * (xs[i][s] - means[i]);
            squares[i] += (xs[i][s] - means[i]) * (xs[i][s] - means[i]);
        }
    }
    for (int i = 1; i < 3; i++) {
        const double correlation = products[i] / sqrt(squares[0] * squares[i]);
        if (!(fabs(correlation) < 4.5 / sqrt(SETS))) {
            fail_claim(spec, points, "two points have the correlation %.3f", correlation);
        }
    }
}

static const struct {
    unsigned claim;
    claim_check check;
} claims[] = {
    {KOKSMA_CLAIM_DETERMINISTIC, check_deterministic},
    {KOKSMA_CLAIM_SEQUENCE, check_sequence},
    {KOKSMA_CLAIM_ANY_N, check_any_n},
    {KOKSMA_CLAIM_STRATIFIED, check_stratified},
    {KOKSMA_CLAIM_LATIN, check_latin},
    {KOKSMA_CLAIM_UNBIASED, check_unbiased},
    {KOKSMA_CLAIM_EXCHANGEABLE, check_exchangeable},
    {KOKSMA_CLAIM_MIN_DISTANCE, check_min_distance},
    {KOKSMA_CLAIM_GRID, check_grid},
    {KOKSMA_CLAIM_NET2, check_net2},
    {KOKSMA_CLAIM_NET2_PREFIXES, check_net2_prefixes},
    {KOKSMA_CLAIM_NET_PREFIXES, check_net_prefixes},
    {KOKSMA_CLAIM_OA2, check_oa2},
    {KOKSMA_CLAIM_OA3, check_oa3},
    {KOKSMA_CLAIM_FRACTION, check_fraction},
    {KOKSMA_CLAIM_MAXIMAL, check_maximal},
    {KOKSMA_CLAIM_LATTICE, check_lattice},
    {KOKSMA_CLAIM_BLUE, check_blue},
    {KOKSMA_CLAIM_LATIN_PREFIXES, check_latin_prefixes},
    {KOKSMA_CLAIM_INDEPENDENT, check_independent},
};

enum { n_claims = sizeof claims / sizeof *claims };

#endif
