/* SPDX-License-Identifier: Apache-2.0 */
/* What the tests of several claims use. They read points; nothing here makes patterns but make_sets_of_means. */
#include "claims/claims.h"

#include <koksma/verify.h>

koksma_spec quick_spec_of(const koksma_pattern *pattern)
{
    koksma_spec spec;
    assert_ok(
        koksma_pattern_spec(!strcmp(pattern->name, "mask-offset") ? "mask-offset:width=8" : pattern->name, &spec));
    for (int k = 0; pattern->params && pattern->params[k].name; k++) {
        const char *name = pattern->params[k].name;
        const double less = !strcmp(name, "length")   ? 64
                            : !strcmp(name, "levels") ? 4
                            : !strcmp(name, "size")   ? pattern->params[k].fallback / 2
                                                      : 0;
        spec.params[k] = less > 0 ? less : spec.params[k];
    }
    return spec;
}

double param_of(const koksma_spec *spec, const char *name, double fallback)
{
    for (int k = 0; spec->pattern->params && spec->pattern->params[k].name; k++) {
        if (!strcmp(spec->pattern->params[k].name, name)) {
            return spec->params[k];
        }
    }
    return fallback;
}

size_t stratum(double x, size_t m)
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

bool one_in_each(const koksma_points *points, size_t n, const int *use, const size_t *m, int count)
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

size_t root_of(size_t n, int power)
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

double gap(double a, double b, bool torus)
{
    const double t = fabs(a - b);
    return torus && t > 0.5 ? 1 - t : t;
}

double smallest_distance(const koksma_points *points, bool torus)
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

bool is_net2_block(const koksma_points *points, size_t first, size_t n)
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

void check_means_of(const koksma_spec *spec, const koksma_points *sets, bool first_only)
{
    koksma_findings found;
    assert_ok(koksma_verify_sets(sets, MEANS_SETS, NULL, &found));
    if (!found.items[first_only].holds) {
        fail_claim(spec, sets, "%s", found.items[first_only].detail);
    }
    koksma_findings_fini(&found);
}

void make_sets_of_means(const koksma_spec *spec, size_t n, int dim, koksma_points sets[MEANS_SETS])
{
    for (uint64_t s = 0; s < MEANS_SETS; s++) {
        assert_ok(koksma_points_init(&sets[s], n, dim));
        if (koksma_generate(spec, MEANS_SEED + s, NULL, &sets[s])) {
            fail_claim(spec, &sets[s], "seed %d: %s", (int)(MEANS_SEED + s), koksma_error_text());
        }
    }
}

void free_sets_of_means(koksma_points sets[MEANS_SETS])
{
    for (size_t s = 0; s < MEANS_SETS; s++) {
        koksma_points_fini(&sets[s]);
    }
}

/* Numbers of points that say something about means: squares, cubes, powers of two and neither; and their ends. */
static bool shows_means(size_t n)
{
    static const size_t counts[] = {9, 16, 27, 4, 7, 32};
    for (size_t i = 0; i < test_repeats(sizeof counts / sizeof *counts, 2); i++) {
        if (counts[i] == n) {
            return true;
        }
    }
    return false;
}

void check_means(const koksma_spec *spec, const koksma_points *points, uint64_t seed, bool first_only)
{
    static koksma_points sets[MEANS_SETS];
    static char made[KOKSMA_MAX_SPEC];
    char text[KOKSMA_MAX_SPEC];
    if (!shows_means(points->n) || points->dim > 3 || seed != 0) {
        return;
    }
    koksma_spec_text(spec, text);
    if (sets->n != points->n || sets->dim != points->dim || strcmp(made, text) != 0) {
        free_sets_of_means(sets);
        make_sets_of_means(spec, points->n, points->dim, sets);
        strcpy(made, text);
    }
    check_means_of(spec, sets, first_only);
}

/* All ways of writing n = b^m as a product of powers of b along the coordinates. */
static bool is_net_from(const koksma_points *points, size_t n, size_t b, int *use, size_t *ms, int k, size_t left)
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
        ok = is_net_from(points, n, b, use, ms, k + 1, left / a);
    }
    return ok;
}

bool is_net_in_base(const koksma_points *points, size_t n, size_t b)
{
    int use[8];
    size_t ms[8];
    assert_true(points->dim <= 8);
    return is_net_from(points, n, b, use, ms, 0, n);
}

bool keeps_dimensions(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    koksma_points more;
    const size_t dim = (size_t)points->dim;
    bool same = true;
    assert_ok(koksma_points_init(&more, points->n, points->dim + 1));
    const koksma_status status = koksma_generate(spec, seed, NULL, &more);
    for (size_t i = 0; !status && i < points->n && same; i++) {
        same = !memcmp(more.xs + i * (dim + 1), points->xs + i * dim, dim * sizeof *more.xs);
    }
    koksma_points_fini(&more);
    return same;
}

koksma_points projection_of(const koksma_points *points, int k, int count)
{
    koksma_points projection;
    assert_ok(koksma_points_init(&projection, points->n, count));
    for (size_t i = 0; i < points->n; i++) {
        memcpy(projection.xs + i * (size_t)count, points->xs + i * (size_t)points->dim + k,
               (size_t)count * sizeof *points->xs);
    }
    return projection;
}
