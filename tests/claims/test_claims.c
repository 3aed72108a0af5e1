/* SPDX-License-Identifier: Apache-2.0 */
/* Walks the table of patterns: the laws that all of them obey, then the test of each claim for every pattern that
   makes it, for several n, dimensions and seeds. claim_<id>.c has the test of each claim. */
#include <stdlib.h>
#include <string.h>

#include "claims/claims.h"
#include "test.h"

static const struct {
    unsigned claim;
    claim_check *check;
} claims[] = {
#define KOKSMA_CLAIM(id, bit, name, meaning) {KOKSMA_CLAIM_##id, claim_##id},
#include <koksma/claims.def>
#undef KOKSMA_CLAIM
};

enum { n_claims = sizeof claims / sizeof *claims };

static const size_t counts[] = {1, 2, 3, 4, 7, 8, 9, 16, 17, 25, 27, 32, 49, 64, 121, 125, 128, 256, 625, 1024};
enum { N_COUNTS = sizeof counts / sizeof *counts };
static const int dims[] = {1, 2, 3, 4, 5, 7, 12, 40};
enum { N_DIMS = sizeof dims / sizeof *dims, SEEDS = test_repeats(2, 1) };

/* The largest n that is walked: some patterns are optimisers, which take a second for a thousand points. A fixed
   list, so that what is tested does not depend on the machine. */
static size_t largest_count(const char *name, int dim)
{
    static const char *const slow[] = {
        "best-candidate", "gaussian-blue-noise", "sample-elimination", "progressive-elimination",
        "pmj02bn",        "poisson-disk",        "void-and-cluster"};
    if (dim > 2 && (!strcmp(name, "gaussian-blue-noise") || !strcmp(name, "poisson-disk-maximal"))) {
        return name[0] == 'g' ? 16 : test_repeats(64, 16);
    }
    for (size_t i = 0; i < sizeof slow / sizeof *slow; i++) {
        if (!strcmp(slow[i], name)) {
            return dim <= 4 ? test_repeats(128, 16) : test_repeats(64, 9);
        }
    }
    return dim <= 4 ? test_repeats(1024, 64) : test_repeats(256, 49);
}

static bool generates(const koksma_spec *spec)
{
    koksma_points points;
    assert_ok(koksma_points_init(&points, 16, spec->pattern->min_dim > 2 ? spec->pattern->min_dim : 2));
    const bool made = koksma_generate(spec, 0, NULL, &points) == KOKSMA_OK;
    koksma_points_fini(&points);
    return made;
}

/* The specs to test of a pattern: with its defaults, with each choice of its parameters, and with each switch, a
   parameter that is 0 or 1: turned alone, or with the first choice that the switch needs. */
static size_t specs_of(const koksma_pattern *p, koksma_spec *specs, size_t room)
{
    size_t count = 1, choices;
    specs[0] = quick_spec_of(p);
    for (int k = 0; p->params && p->params[k].name; k++) {
        for (int c = 0; p->params[k].choices && p->params[k].choices[c] && count < room; c++) {
            if (c != (int)p->params[k].fallback) {
                specs[count] = specs[0];
                specs[count++].params[k] = c;
            }
        }
    }
    choices = count;
    for (int k = 0; p->params && p->params[k].name; k++) {
        const koksma_param *param = &p->params[k];
        bool found = param->choices || !param->whole || param->min != 0 || param->max != 1;
        for (size_t s = 0; s < choices && !found && count < room; s++) {
            specs[count] = specs[s];
            specs[count].params[k] = 1 - param->fallback;
            found = generates(&specs[count]);
            count += found;
        }
        assert_that(found, "%s: no spec with %s=%g", p->name, param->name, 1 - param->fallback);
    }
    return count;
}

static void assert_refusal(const koksma_spec *spec, koksma_status status)
{
    char text[KOKSMA_MAX_SPEC];
    koksma_spec_text(spec, text);
    const char *said = koksma_error_text();
    assert_that(status == KOKSMA_N || status == KOKSMA_IMPOSSIBLE || status == KOKSMA_ARGUMENT ||
                    status == KOKSMA_DIM,
                "%s: status %d: %s", text, (int)status, said);
    assert_that(koksma_status_exit_code(status) == 2 && strstr(said, spec->pattern->name) && !strchr(said, '\n') &&
                    strpbrk(said, "0123456789"),
                "%s refused with '%s'", text, said);
}

static void assert_common(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    char text[KOKSMA_MAX_SPEC];
    koksma_spec_text(spec, text);
    const size_t count = points->n * (size_t)points->dim;
    for (size_t i = 0; i < count; i++) {
        assert_that(points->xs[i] >= 0 && points->xs[i] < 1, "%s: n = %zu: coordinate %.17g", text, points->n,
                    points->xs[i]);
    }
    koksma_points again;
    const koksma_run run = {.threads = 3};
    assert_ok(koksma_points_init(&again, points->n, points->dim));
    memset(again.xs, 0x5a, count * sizeof *again.xs); /* what was there must not matter */
    assert_ok(koksma_generate(spec, seed, &run, &again));
    assert_that(!memcmp(again.xs, points->xs, count * sizeof *again.xs),
                "%s: n = %zu, dim = %d: the same seed gave other bits", text, points->n, points->dim);
    koksma_points_fini(&again);
}

/* Points first .. first + count - 1, made alone, are those of the whole. */
static void assert_range(const koksma_spec *spec, const koksma_points *points, uint64_t seed, size_t first,
                         size_t count)
{
    koksma_points range;
    const size_t dim = (size_t)points->dim;
    assert_ok(koksma_points_init(&range, count, points->dim));
    memset(range.xs, 0x5a, count * dim * sizeof *range.xs);
    assert_ok(koksma_generate_range(spec, seed, points->n, first, NULL, &range));
    if (memcmp(range.xs, points->xs + first * dim, count * dim * sizeof *range.xs)) {
        fail_claim(spec, points, "points %zu to %zu alone are others", first, first + count - 1);
    }
    koksma_points_fini(&range);
}

/* Also one point at the end, and ranges that begin and end at, before and behind the lengths at which work is cut. */
static void assert_ranges(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    static const size_t cuts[] = {0, 1, 2, 63, 64, 65, 511, 512, 513, 1000, 4095, 4097, 32767, 32769, 40000, 65537};
    const size_t n = points->n, n_cuts = sizeof cuts / sizeof *cuts;
    koksma_points past;
    if (!koksma_has_ranges(spec)) {
        assert_ok(koksma_points_init(&past, 1, points->dim));
        assert_int_equal(koksma_generate_range(spec, seed, n, 0, NULL, &past), KOKSMA_UNSUPPORTED);
        koksma_points_fini(&past);
        return;
    }
    assert_range(spec, points, seed, n - 1, 1);
    for (size_t a = 0; a < n_cuts && cuts[a] < n; a++) {
        const size_t b = a + 1 + (n + seed) % 5; /* another for each set that is walked */
        assert_range(spec, points, seed, cuts[a], (b < n_cuts && cuts[b] < n ? cuts[b] : n) - cuts[a]);
    }
    assert_ok(koksma_points_init(&past, 2, points->dim));
    const uint64_t end = spec->pattern->claims & KOKSMA_CLAIM_SEQUENCE ? KOKSMA_MAX_INDEX + 1 : n;
    assert_refusal(spec, koksma_generate_range(spec, seed, n, end - 1, NULL, &past));
    assert_refusal(spec, koksma_generate_range(spec, seed, n, UINT64_MAX, NULL, &past));
    koksma_points_fini(&past);
}

/* A spec is unbiased by what it claims and, without a claim, by a scrambling or the torus; what has one set never is. */
static void assert_bias(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    const bool unbiased = koksma_is_unbiased(spec), claimed = spec->pattern->claims & KOKSMA_CLAIM_UNBIASED;
    if ((claimed && !unbiased) || (unbiased && koksma_has_one_set(spec)) ||
        (unbiased != claimed && param_of(spec, "scramble", 0) == 0 && param_of(spec, "torus", 0) == 0)) {
        fail_claim(spec, points, "%s", unbiased ? "it is unbiased" : "it is not unbiased");
    }
    if (unbiased && !claimed && points->dim == 2) {
        claim_UNBIASED(spec, points, seed);
    }
}

static void check_set(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    assert_bias(spec, points, seed);
    assert_common(spec, points, seed);
    assert_ranges(spec, points, seed);
    for (size_t c = 0; c < n_claims; c++) {
        if (spec->pattern->claims & claims[c].claim) {
            claims[c].check(spec, points, seed);
        }
    }
}

static bool walk(const koksma_spec *spec, int dim)
{
    bool served = false;
    const size_t most = largest_count(spec->pattern->name, dim);
    for (size_t c = 0; c < N_COUNTS && counts[c] <= most; c++) {
        const uint64_t seeds = counts[c] > 128 ? 1 : SEEDS; /* most of the time is spent on the largest sets */
        for (uint64_t seed = 0; seed < seeds; seed++) {
            const koksma_run run = {.threads = 1};
            koksma_points points;
            assert_ok(koksma_points_init(&points, counts[c], dim));
            const koksma_status status = koksma_generate(spec, seed * 977, &run, &points);
            if (!status) {
                served = true;
                check_set(spec, &points, seed * 977);
            } else {
                assert_refusal(spec, status);
                if (spec->pattern->claims & KOKSMA_CLAIM_ANY_N) {
                    fail_msg("%s claims any n: %s", spec->pattern->name, koksma_error_text());
                }
            }
            koksma_points_fini(&points);
        }
    }
    return served;
}

/* KOKSMA_CLAIMS="a b" limits this test to the patterns a and b (scripts/check: those whose files changed). */
static bool wanted(const char *name)
{
    const char *names = getenv("KOKSMA_CLAIMS");
    for (const char *at = names; at && *at; at += strcspn(at, " "), at += strspn(at, " ")) {
        if (strcspn(at, " ") == strlen(name) && !strncmp(at, name, strlen(name))) {
            return true;
        }
    }
    return !names || !*names;
}

TEST_CASE(patterns_keep_their_claims)
{
    const koksma_pattern *p;
    for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
        koksma_spec specs[16];
        if (p->operand || p->alias_of || !wanted(p->name)) {
            continue;
        }
        const size_t n_specs = specs_of(p, specs, 16);
        for (size_t s = 0; s < n_specs; s++) {
            bool served = false;
            for (size_t d = 0; d < N_DIMS; d++) {
                if (dims[d] >= p->min_dim && dims[d] <= p->max_dim) {
                    served |= walk(&specs[s], dims[d]);
                }
            }
            assert_that(served, "%s served no n at all: %s", p->name, koksma_error_text());
        }
    }
}

/* Specs of the patterns whose operand is a vector or a file, with the file's text, for up to `dim` dimensions. `file`
   itself reads points that the test writes. Patterns that run code claim nothing. */
static const struct {
    const char *name, *operand, *text;
    int dim;
} operands[] = {
    {"lattice-vector", "1:182667:469891:498753:110745", NULL, 5},
    {"lattice-file", "claims_lattice.txt", "1 1\n2 182667\n3 469891\n4 498753\n5 110745\n", 5},
    {"lattice-file", "claims_lattice_3.txt", "# lattice\n3\n2187\n1\n608\n40\n", 3},
    {"net-file", "claims_net.txt", "d s a m_i\n2 1 0 1\n3 2 1 1 3\n4 3 1 1 3 1\n5 3 2 1 1 1\n", 5},
    {"net-file", "claims_net_5.txt", "# dnet\n5\n2\n4\n4\n125 25 5 1\n125 150 180 216\n", 2},
    {"file", "claims_points.npy", NULL, 3},
};

static void write_operand(const char *name, const char *operand, const char *text)
{
    if (text) {
        test_write(operand, text);
    } else if (!strcmp(name, "file")) {
        koksma_points points = test_points("random", 1000, 3, 9);
        assert_ok(koksma_points_write(operand, &points, NULL, NULL));
        koksma_points_fini(&points);
    }
}

TEST_CASE(patterns_with_operands_keep_their_claims)
{
    const koksma_pattern *p;
    for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
        bool served = false;
        if (!p->operand || p->claims == 0 || !wanted(p->name)) {
            continue;
        }
        for (size_t t = 0; t < sizeof operands / sizeof *operands; t++) {
            char text[100];
            koksma_spec spec;
            if (strcmp(operands[t].name, p->name) != 0) {
                continue;
            }
            write_operand(p->name, operands[t].operand, operands[t].text);
            snprintf(text, sizeof text, "%s:%s", p->name, operands[t].operand);
            assert_ok(koksma_pattern_spec(text, &spec));
            for (size_t d = 0; d < N_DIMS && dims[d] <= operands[t].dim; d++) {
                served |= walk(&spec, dims[d]);
            }
        }
        assert_that(served, "%s claims something; the table `operands` needs a spec of it", p->name);
    }
}

/* Who does not claim dimension-prefixes changes somewhere: the absence of the claim is a statement, too. */
TEST_CASE(others_change_with_the_dimension)
{
    const koksma_pattern *p;
    for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
        bool served = false, changes = false;
        if (p->operand || p->alias_of || p->claims & KOKSMA_CLAIM_DIMENSION_PREFIXES) {
            continue;
        }
        const koksma_spec spec = quick_spec_of(p);
        for (int at = 0; at < 3 * N_COUNTS && !changes; at++) {
            const int dim = p->min_dim + at % 3;
            koksma_points points;
            if (dim >= p->max_dim || counts[at / 3] > 64) {
                continue;
            }
            assert_ok(koksma_points_init(&points, counts[at / 3], dim));
            if (!koksma_generate(&spec, 1, NULL, &points)) {
                changes = !keeps_dimensions(&spec, &points, 1);
                served = true;
            }
            koksma_points_fini(&points);
        }
        assert_that(!served || changes, "%s keeps its coordinates when a dimension is added, and does not claim it",
                    p->name);
    }
}

/* Sets large enough for several blocks, of the patterns that are fast enough. */
TEST_CASE(large_sets_are_equal_on_any_threads)
{
    const koksma_pattern *p;
    for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
        koksma_spec specs[16];
        if (p->operand || p->alias_of) {
            continue;
        }
        const size_t n_specs = specs_of(p, specs, 16);
        for (size_t s = 0; s < n_specs; s++) {
            const int dim = p->min_dim > 2 ? p->min_dim : p->max_dim < 2 ? 1 : 2;
            koksma_points points;
            const koksma_run run = {.threads = 1};
            if (largest_count(p->name, dim) < test_repeats(1024, 64)) {
                continue;
            }
            assert_ok(koksma_points_init(&points, test_repeats(65536, 8192), dim));
            if (!koksma_generate(&specs[s], 5, &run, &points)) {
                assert_common(&specs[s], &points, 5);
                assert_ranges(&specs[s], &points, 5);
            }
            koksma_points_fini(&points);
        }
    }
}

TEST_CASE(wrong_arguments_are_refused)
{
    const koksma_pattern *p;
    for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
        koksma_spec spec;
        koksma_points points;
        char text[KOKSMA_MAX_SPEC];
        if (p->operand) {
            continue;
        }
        snprintf(text, sizeof text, "%s:nosuch=1", p->name);
        assert_int_equal(koksma_pattern_spec(text, &spec), KOKSMA_ARGUMENT);
        assert_ok(koksma_pattern_spec(p->name, &spec));
        const int outside[] = {p->min_dim - 1, p->max_dim + 1};
        for (int k = 0; k < 2; k++) {
            if (outside[k] >= 1 && outside[k] <= KOKSMA_MAX_DIM) {
                assert_ok(koksma_points_init(&points, 16, outside[k]));
                const koksma_status status = koksma_generate(&spec, 0, NULL, &points);
                assert_int_equal(status, KOKSMA_DIM);
                assert_refusal(&spec, status);
                koksma_points_fini(&points);
            }
        }
        for (int k = 0; p->params && p->params[k].name; k++) {
            const double bad[] = {p->params[k].min - 1, p->params[k].max + 1, NAN};
            for (int b = 0; b < 3; b++) {
                koksma_spec wrong = spec;
                wrong.params[k] = bad[b];
                assert_ok(koksma_points_init(&points, 16, p->min_dim));
                assert_int_equal(koksma_generate(&wrong, 0, NULL, &points), KOKSMA_ARGUMENT);
                koksma_points_fini(&points);
            }
        }
    }
}

TEST_CASE(aliases_are_their_patterns)
{
    const koksma_pattern *p;
    size_t aliases = 0;
    for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
        koksma_spec spec;
        char text[KOKSMA_MAX_SPEC];
        if (p->alias_of) {
            aliases++;
            assert_non_null(koksma_pattern_find(p->alias_of));
            assert_ok(koksma_pattern_spec(p->name, &spec));
            koksma_spec_text(&spec, text);
            assert_string_equal(text, p->alias_of);
            assert_int_equal(p->claims, koksma_pattern_find(p->alias_of)->claims);
        }
    }
    assert_true(aliases >= 1);
}
