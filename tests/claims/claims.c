/* SPDX-License-Identifier: Apache-2.0 */
/* The test of each claim of <koksma/claims.def>, in the order of its lines: claim_ID looks at one set of points. */
#include "claims/claims.h"
#include "patterns/nets/nets.h"

/* deterministic: the seed does not matter, unless the parameter scramble or shuffle or a random modifier is set. */
void claim_DETERMINISTIC(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    const bool deterministic = koksma_has_one_set(spec);
    koksma_points other;
    assert_ok(koksma_points_init(&other, points->n, points->dim));
    assert_ok(koksma_generate(spec, seed + 1, NULL, &other));
    const bool equal = !memcmp(other.xs, points->xs, points->n * (size_t)points->dim * sizeof *points->xs);
    if (equal != deterministic && (deterministic || points->n >= 16)) {
        fail_claim(spec, points, deterministic ? "the seed matters" : "the seed does not matter");
    }
    koksma_points_fini(&other);
}

/* sequence: for every k <= n, the first k of n points equal the set generated for k points. */
void claim_SEQUENCE(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
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

/* any-n: serves every n >= 1. */
void claim_ANY_N(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)spec, (void)points, (void)seed; /* the walk fails on a refusal */
}

/* Fails unless, for n = m^dim, point i is in cell i, the last coordinate changing fastest; centred: in its middle half. */
static void check_order(const koksma_spec *spec, const koksma_points *points, bool centred)
{
    const size_t m = root_of(points->n, points->dim);
    for (size_t i = 0; i < points->n && m; i++) {
        size_t rest = i;
        for (int k = points->dim - 1; k >= 0; k--, rest /= m) {
            const double x = points->xs[i * (size_t)points->dim + (size_t)k],
                         place = x * (double)m - (double)(rest % m);
            if (centred ? place < 0.25 - 1e-6 || place > 0.75 + 1e-6 : stratum(x, m) != rest % m) {
                fail_claim(spec, points, "point %zu is not in %s its cell", i, centred ? "the middle half of" : "");
            }
        }
    }
}

/* stratified: for n = m^dim, each of the m^dim cells has one point; the points are in the order of the cells, in
   which the last coordinate changes fastest. */
void claim_STRATIFIED(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    check_order(spec, points, false);
}

/* Fails unless each projection to `count` coordinates, of which `chosen` are in use, has one point in each cell of a grid
   of s cells a side. */
static void check_cells(const koksma_spec *spec, const koksma_points *points, size_t s, int count, int *use,
                        int chosen)
{
    const size_t sides[3] = {s, s, s};
    if (chosen == count) {
        if (!one_in_each(points, points->n, use, sides, count)) {
            fail_claim(spec, points, "coordinates %d.. do not have one point in each of %zu^%d cells", use[count - 1],
                       s, count);
        }
        return;
    }
    for (use[chosen] = 0; use[chosen] < (chosen ? use[chosen - 1] : points->dim); use[chosen]++) {
        check_cells(spec, points, s, count, use, chosen + 1);
    }
}

/* latin: on each axis, each of the n intervals [j/n, (j+1)/n) has one point. */
void claim_LATIN(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    check_cells(spec, points, points->n, 1, (int[3]){0}, 0);
}

/* unbiased: for every box B, the expected fraction of the points in B is the volume of B. */
void claim_UNBIASED(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    check_means(spec, points, seed, false);
}

/* exchangeable: the points are in random order; shuffling has no effect. */
void claim_EXCHANGEABLE(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    check_means(spec, points, seed, true);
}

/* min-distance: no two points are closer than the parameter d (on the torus if torus=1). */
void claim_MIN_DISTANCE(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const double d = param_of(spec, "d", 0);
    if (points->n > 1 && smallest_distance(points, param_of(spec, "torus", 1) != 0) < d * (1 - 1e-12)) {
        fail_claim(spec, points, "two points are closer than %g", d);
    }
}

/* centred: on each axis, each point lies in the middle half of its stratum (patterns that also claim `stratified`). */
void claim_CENTRED(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    check_order(spec, points, true);
}

/* grid: in 2D with n = m^2, each of the m x m cells has one point; the points are in any order. */
void claim_GRID(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const size_t m = root_of(points->n, 2), ms[2] = {m, m};
    const int use[2] = {0, 1};
    if (points->dim == 2 && m && !one_in_each(points, points->n, use, ms, 2)) {
        fail_claim(spec, points, "not one point in each cell");
    }
}

/* net2: in 2D with n = 2^m, the points are a (0,m,2)-net in base 2. */
void claim_NET2(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    if (points->dim == 2 && !(points->n & (points->n - 1)) && !is_net2_block(points, 0, points->n)) {
        fail_claim(spec, points, "not a (0,m,2)-net in base 2");
    }
}

/* net2-prefixes: in 2D, for all a and m, points a 2^m to (a + 1) 2^m - 1 are a (0,m,2)-net in base 2. */

/* Blocks across and beyond point 2^32, up to the last point. */
static void check_late_blocks(const koksma_spec *spec, uint64_t seed)
{
    enum { N = 512 };
    static const uint64_t firsts[] = {((uint64_t)1 << 32) - N, (uint64_t)1 << 32, ((uint64_t)5 << 32) + 77 * N,
                                      ((uint64_t)1 << 50) - N, KOKSMA_MAX_INDEX + 1 - N};
    koksma_points points;
    assert_ok(koksma_points_init(&points, N, 2));
    for (size_t b = 0; b < sizeof firsts / sizeof *firsts; b++) {
        assert_ok(koksma_generate_range(spec, seed, 0, firsts[b], NULL, &points));
        for (size_t n = 1; n <= N; n *= 2) {
            if (!is_net2_block(&points, N - n, n)) {
                fail_claim(spec, &points, "points from %llu on are not a (0,m,2)-net in base 2",
                           (unsigned long long)(firsts[b] + N - n));
            }
        }
    }
    koksma_points_fini(&points);
}

void claim_NET2_PREFIXES(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    if (points->dim == 2 && koksma_has_ranges(spec)) {
        check_late_blocks(spec, seed);
    }
    for (size_t n = 1; points->dim == 2 && n <= points->n; n *= 2) {
        for (size_t first = 0; first + n <= points->n; first += n) {
            if (!is_net2_block(points, first, n)) {
                fail_claim(spec, points, "points %zu to %zu are not a (0,m,2)-net in base 2", first, first + n - 1);
            }
        }
    }
}

/* net-prefixes: in d dimensions, for every m, the first b^m points are a (0,m,d)-net in base b, where b is the
   smallest prime >= d. */
void claim_NET_PREFIXES(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    size_t b = 2;
    if (points->dim > 7) {
        return;
    }
    for (int k = 1; b < (size_t)points->dim; k++) {
        b = koksma__prime(k);
    }
    for (size_t n = 1; n <= points->n; n *= b) {
        if (!is_net_in_base(points, n, b)) {
            fail_claim(spec, points, "the first %zu points are not a (0,m,%d)-net in base %zu", n, points->dim, b);
        }
    }
}

/* For n = s^strength, each projection to so many coordinates has one point in each cell of s^strength. */
static void check_array(const koksma_spec *spec, const koksma_points *points, int strength)
{
    const size_t s = root_of(points->n, strength);
    if (s > 1 && param_of(spec, "strength", 2) == strength) {
        check_cells(spec, points, s, strength, (int[3]){0}, 0);
    }
}

/* oa2: for n = s^2, each 2D projection has one point in each of its s x s cells. */
void claim_OA2(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    check_array(spec, points, 2);
}

/* oa3: for n = s^3 and strength=3, each 3D projection has one point in each of its s x s x s cells. */
void claim_OA3(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    check_array(spec, points, 3);
}

/* fraction: in 2D on the torus, no two points are closer than the parameter f times the smallest distance in the
   densest packing. */
void claim_FRACTION(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const double f = param_of(spec, "f", 0), densest = koksma__packing_distance(points->n, 2, true);
    if (points->n > 1 && smallest_distance(points, true) < f * densest * (1 - 1e-12)) {
        fail_claim(spec, points, "two points are closer than %g of the densest packing's distance", f);
    }
}

/* maximal: no place of the torus is further from all points than their smallest distance: no point can be added. */

/* The largest hole of the torus is at a corner of the Voronoi diagram; a fine grid of places finds any hole that is
   worth the name: 150^2 places in the plane, 28^3, 12^4, .. in more dimensions. */
void claim_MAXIMAL(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    static const int sides[] = {0, 0, 150, 28, 12, 7, 5};
    const int dim = points->dim, side = sides[dim];
    if (points->n < 16) {
        return;
    }
    const double d = smallest_distance(points, true);
    for (int a = 0; a < (int)pow(side, dim); a++) {
        double place[6], best = INFINITY;
        for (int k = 0, rest = a; k < dim; k++, rest /= side) {
            place[k] = (rest % side + 0.5) / side;
        }
        for (size_t i = 0; i < points->n && best > d * d; i++) {
            double square = 0;
            for (int k = 0; k < dim; k++) {
                const double t = gap(points->xs[i * (size_t)dim + (size_t)k], place[k], true);
                square += t * t;
            }
            best = fmin(best, square);
        }
        if (best > d * d * (1 + 1e-9)) {
            fail_claim(spec, points, "there is room at (%g, %g, ..)", place[0], place[1]);
        }
    }
}

/* lattice: the points are a lattice: their differences form a group on the torus. */
void claim_LATTICE(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
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

/* blue: in 2D, with at least 4 points (a sequence: 64), the smallest distance on the torus is more than half of
   that in the densest packing. */
void claim_BLUE(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const size_t least = spec->pattern->claims & KOKSMA_CLAIM_SEQUENCE ? 64 : 4;
    const double rho = smallest_distance(points, true) / koksma__packing_distance(points->n, 2, true);
    if (points->dim == 2 && points->n >= least && !(rho > 0.5)) {
        fail_claim(spec, points, "the smallest distance is %.3f of the densest packing's", rho);
    }
}

/* latin-prefixes: on axis k, each of the intervals [j/b^m, (j+1)/b^m) has one of the first b^m points, where b is
   the k-th prime. */
void claim_LATIN_PREFIXES(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
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

/* independent: the points are random and independent of each other. */

/* Over sets, the first coordinates of points 0 and 1, and of 0 and the last, vary and are not correlated. */
void claim_INDEPENDENT(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    enum { SETS = test_repeats(120, 40) };
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

/* Fails unless coordinates 0 .. count - 1, count .. 2 count - 1, ... are nets in base b: of all points or, with `prefixes`,
   of the first b^m for every m. */
static void check_projections(const koksma_spec *spec, const koksma_points *points, int count, size_t b,
                              bool prefixes)
{
    for (int k = 0; k + count <= points->dim; k += count) {
        koksma_points group = projection_of(points, k, count);
        for (size_t n = 1; n <= group.n; n *= b) {
            if ((prefixes || n == group.n) && !is_net_in_base(&group, n, b)) {
                fail_claim(spec, points, "coordinates %d to %d of the first %zu are not a (0,m,%d)-net in base %zu",
                           k, k + count - 1, n, count, b);
            }
        }
        koksma_points_fini(&group);
    }
}

/* pairs: n = 2^m: coordinates 2k and 2k + 1 are a (0,m,2)-net in base 2. */
void claim_PAIRS(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    check_projections(spec, points, 2, 2, false);
}

/* quadruples: the first 4^m points: coordinates 4k to 4k + 3 are a (0,m,4)-net in base 4. */
void claim_QUADRUPLES(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    check_projections(spec, points, 4, 4, true);
}

/* pairs-3: the first 3^m points: coordinates 2k and 2k + 1 are a (0,m,2)-net in base 3. */
void claim_PAIRS_3(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    check_projections(spec, points, 2, 3, true);
}

/* quadruples-3: the first 3^m points: coordinates 4k to 4k + 3 are a (1,m,4)-net in base 3: every product of four
   [a/3^d, (a+1)/3^d) of volume 3^(1-m) holds three of them. */

/* Whether each of the cells that have sides[k] strata along coordinate k holds three of the first n points. */
static bool three_in_each(const koksma_points *points, size_t n, const size_t *sides)
{
    unsigned char *counts = calloc(n / 3, 1);
    bool even = true;
    assert_non_null(counts);
    for (size_t i = 0; i < n && even; i++) {
        size_t cell = 0;
        for (int k = 0; k < 4; k++) {
            cell = cell * sides[k] + stratum(points->xs[4 * i + (size_t)k], sides[k]);
        }
        even = ++counts[cell] <= 3;
    }
    free(counts);
    return even;
}

static bool all_shapes(const koksma_points *points, size_t n, size_t *sides, int k, size_t left)
{
    bool even = true;
    for (sides[k] = 1; sides[k] <= left && even && k < 3; sides[k] *= 3) {
        even = all_shapes(points, n, sides, k + 1, left / sides[k]);
    }
    if (k == 3) {
        sides[k] = left;
        even = three_in_each(points, n, sides);
    }
    return even;
}

void claim_QUADRUPLES_3(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    for (int k = 0; k + 3 < points->dim; k += 4) {
        koksma_points four = projection_of(points, k, 4);
        for (size_t n = 3, sides[4]; n <= four.n; n *= 3) {
            if (!all_shapes(&four, n, sides, 0, n / 3)) {
                fail_claim(spec, points, "coordinates %d to %d of the first %zu are not a (1,m,4)-net in base 3", k,
                           k + 3, n);
            }
        }
        koksma_points_fini(&four);
    }
}

/* classes: in 2D, unless the parameter shuffle is set, for all a and m >= 2, the points a 2^m to (a + 1) 2^m - 1 fall into
   four classes, by the parity of bits 0, 2, 4, .. and of bits 1, 3, 5, .. of their index: (0,m-2,2)-nets in base 2. */

static int parity_of(size_t bits)
{
    int parity = 0;
    for (; bits; bits &= bits - 1) {
        parity = !parity;
    }
    return parity;
}

static void check_block(const koksma_spec *spec, const koksma_points *points, size_t first, size_t n)
{
    for (int c = 0; c < 4; c++) {
        koksma_points members;
        size_t count = 0;
        assert_ok(koksma_points_init(&members, n / 4, 2));
        for (size_t i = first; i < first + n; i++) {
            if (parity_of(i & 0x55555555) + 2 * parity_of(i & 0xaaaaaaaa) == c && count++ < n / 4) {
                memcpy(members.xs + 2 * (count - 1), points->xs + 2 * i, 2 * sizeof *members.xs);
            }
        }
        if (count != n / 4 || !is_net2_block(&members, 0, n / 4)) {
            fail_claim(spec, points, "class %d of the points %zu to %zu is not a (0,m,2)-net in base 2", c, first,
                       first + n - 1);
        }
        koksma_points_fini(&members);
    }
}

void claim_CLASSES(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    for (size_t n = 4; points->dim == 2 && !param_of(spec, "shuffle", 0) && n <= points->n; n *= 2) {
        for (size_t first = 0; first + n <= points->n; first += n) {
            check_block(spec, points, first, n);
        }
    }
}

/* lattice-prefixes: for every m, the first 2^m points are a lattice, perhaps shifted: there are whole numbers z, the
   first odd, for which they are {i z / 2^m + shift}, i = 0 .. 2^m - 1, in any order. */

/* How far point p is from the first along an axis, on the torus, in units of 1/n; fails unless it is a whole number. */
static size_t steps_of(const koksma_spec *spec, const koksma_points *points, size_t n, size_t p, size_t k)
{
    const double steps = (points->xs[p * (size_t)points->dim + k] - points->xs[k]) * (double)n, whole = round(steps);
    if (!(fabs(steps - whole) < 1e-9 * (double)n)) {
        fail_claim(spec, points, "of the first %zu points, 0 and %zu are %.9g/%zu apart on axis %zu", n, p, steps, n,
                   k);
    }
    return (size_t)(whole < 0 ? whole + (double)n : whole) % n;
}

/* The point that is i steps from the first along axis 0 is i times as far from it as that of one step, along each axis. */
static void check_prefix(const koksma_spec *spec, const koksma_points *points, size_t n)
{
    const size_t dim = (size_t)points->dim;
    size_t *at = malloc(n * sizeof *at); /* [i]: the point that is i steps from the first */
    assert_non_null(at);
    memset(at, 0xff, n * sizeof *at);
    for (size_t p = 0; p < n; p++) {
        const size_t i = steps_of(spec, points, n, p, 0);
        if (at[i] != SIZE_MAX) {
            fail_claim(spec, points, "two of the first %zu points are %zu/%zu from the first on axis 0", n, i, n);
        }
        at[i] = p;
    }
    for (size_t i = 1; i < n; i++) {
        for (size_t k = 0; k < dim; k++) {
            if (steps_of(spec, points, n, at[i], k) != i * steps_of(spec, points, n, at[1], k) % n) {
                fail_claim(spec, points, "the first %zu points are not a lattice on axis %zu", n, k);
            }
        }
    }
    free(at);
}

void claim_LATTICE_PREFIXES(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    for (size_t n = 2; n <= points->n; n *= 2) {
        check_prefix(spec, points, n);
    }
}

/* dimension-prefixes: with the same n and seed, the points of one dimension more have the same first coordinates. */
void claim_DIMENSION_PREFIXES(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    if (!keeps_dimensions(spec, points, seed)) {
        fail_claim(spec, points, "with a dimension more, other coordinates change");
    }
}
