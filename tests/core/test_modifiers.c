/* SPDX-License-Identifier: Apache-2.0 */
/* Walks the table of modifiers: each behind every pattern keeps the claims and the values of measures that its line says
   it keeps, and no other measure's; and each is the map of its definition. */
#include <stdlib.h>
#include <string.h>

#include "claims/claims.h"
#include "core/random.h"
#include "core/spec.h"
#include "patterns/patterns.h"
#include "test.h"

static const struct {
    unsigned claim;
    claim_check *check;
} claims[] = {
#define KOKSMA_CLAIM(id, bit, name, meaning) {KOKSMA_CLAIM_##id, claim_##id},
#include <koksma/claims.def>
#undef KOKSMA_CLAIM
};

static const size_t counts[] = {4, 8, 9, 16, 27};
enum { N_COUNTS = sizeof counts / sizeof *counts };

static const koksma_modifier *modifier(const char *name, size_t *at)
{
    for (size_t i = 0; koksma_modifier_at(i); i++) {
        if (!strcmp(koksma_modifier_at(i)->name, name)) {
            *at = i;
            return koksma_modifier_at(i);
        }
    }
    fail_msg("no modifier %s", name);
    return NULL;
}

/* Pattern i in 2D or, if it has none there, the nearest; false: it makes no n points, or reads a file. */
static bool make(size_t i, size_t n, uint64_t seed, koksma_spec *spec, koksma_points *points)
{
    const koksma_pattern *p = koksma_pattern_at(i);
    if (p->operand || p->alias_of) {
        return false;
    }
    *spec = quick_spec_of(p);
    assert_ok(koksma_points_init(points, n, p->min_dim > 2 ? p->min_dim : p->max_dim < 2 ? p->max_dim : 2));
    const bool made = !koksma_generate(spec, seed, NULL, points);
    if (!made) {
        koksma_points_fini(points);
    }
    return made;
}

/* The sets of a pattern without a modifier are made once, because some patterns are slow: applying the modifier to one
   gives the set that the spec with the modifier makes. */
static void check_unbiased(const koksma_spec *spec, const koksma_points raw[MEANS_SETS])
{
    koksma_points sets[MEANS_SETS], made;
    for (size_t s = 0; s < MEANS_SETS; s++) {
        assert_ok(koksma_points_init(&sets[s], raw[s].n, raw[s].dim));
        memcpy(sets[s].xs, raw[s].xs, raw[s].n * (size_t)raw[s].dim * sizeof *raw[s].xs);
        koksma__modify(spec->modifiers, MEANS_SEED + s, &sets[s]);
    }
    assert_ok(koksma_points_init(&made, raw->n, raw->dim));
    for (size_t s = 0; s < MEANS_SETS; s += MEANS_SETS - 1) {
        assert_ok(koksma_generate(spec, MEANS_SEED + s, NULL, &made));
        assert_memory_equal(made.xs, sets[s].xs, made.n * (size_t)made.dim * sizeof *made.xs);
    }
    check_means_of(spec, sets, false);
    koksma_points_fini(&made);
    free_sets_of_means(sets);
}

/* raw: the pattern's sets without a modifier for check_unbiased, or NULL */
static void check_claims(const koksma_modifier *m, size_t at, koksma_spec spec, size_t n, int dim,
                         const koksma_points *raw)
{
    koksma_points points;
    spec.modifiers[at] = m->min;
    const unsigned left = koksma__claims_left(&spec, n);
    const bool power = !(n & (n - 1));
    assert_int_equal(left, (spec.pattern->claims & (m->claims | (power ? m->claims_binary : 0))) | m->gives);
    assert_int_equal(koksma_is_unbiased(&spec), !!(left & KOKSMA_CLAIM_UNBIASED));
    assert_ok(koksma_points_init(&points, n, dim));
    assert_ok(koksma_generate(&spec, 3, NULL, &points));
    for (size_t c = 0; c < n * (size_t)dim; c++) {
        if (!(points.xs[c] >= 0 && points.xs[c] < 1)) {
            fail_claim(&spec, &points, "coordinate %.17g", points.xs[c]);
        }
    }
    for (size_t c = 0; c < sizeof claims / sizeof *claims; c++) {
        if (left & claims[c].claim) {
            claims[c].check(&spec, &points, 3);
        }
    }
    if (left & KOKSMA_CLAIM_UNBIASED && raw) {
        check_unbiased(&spec, raw);
    }
    koksma_points_fini(&points);
}

TEST_CASE(claims_are_kept)
{
    const koksma_modifier *m;
    size_t looked_at = 0;
    for (size_t i = 0; koksma_pattern_at(i); i++) {
        for (size_t c = 0; c < N_COUNTS; c++) {
            koksma_spec spec;
            koksma_points points, raw[MEANS_SETS];
            if (!make(i, counts[c], 3, &spec, &points)) {
                continue;
            }
            const bool means = counts[c] == 16 && points.dim <= 3;
            if (means) {
                make_sets_of_means(&spec, counts[c], points.dim, raw);
            }
            for (size_t at = 0; (m = koksma_modifier_at(at)); at++) {
                check_claims(m, at, spec, counts[c], points.dim, means ? raw : NULL);
            }
            if (means) {
                free_sets_of_means(raw);
            }
            looked_at++;
            koksma_points_fini(&points);
        }
    }
    assert_true(looked_at > 60);
}

static bool keeps(const koksma_modifier *m, const char *measure)
{
    const size_t length = strlen(measure);
    for (const char *at = m->measures; (at = strstr(at, measure)); at += length) {
        if ((at == m->measures || at[-1] == ' ') && (at[length] == ' ' || !at[length])) {
            return true;
        }
    }
    return !strcmp(m->measures, "*");
}

enum { MEASURES = 64 };

/* The exact measures of a set; NaN: not exact, or not of this set. */
static void measure_all(const koksma_points *points, double values[MEASURES])
{
    const koksma_measure *measure;
    const koksma_run run = {.threads = 1};
    for (size_t j = 0; (measure = koksma_measure_at(j)); j++) {
        koksma_spec what;
        koksma_value value;
        assert_true(j < MEASURES);
        assert_ok(koksma_measure_spec(measure->name, &what));
        const bool exact = measure->answer == KOKSMA_ANSWER_EXACT && !koksma_evaluate(&what, points, &run, &value);
        values[j] = exact ? value.value : (double)NAN;
    }
}

/* One pattern's 16 points with a modifier; before: their measures without it, which are kept where the table says so. */
static void compare_measures(const koksma_modifier *m, koksma_spec *spec, const koksma_points *b,
                             const double before[MEASURES], bool changed[MEASURES])
{
    const koksma_measure *measure;
    double after[MEASURES];
    measure_all(b, after);
    for (size_t j = 0; (measure = koksma_measure_at(j)); j++) {
        if (isnan(before[j])) {
            continue;
        }
        const bool equal =
            fabs(after[j] - before[j]) <= 1e-9 * fmax(1, fabs(before[j])) || (isinf(before[j]) && isinf(after[j]));
        if (!equal && keeps(m, measure->name)) {
            fail_claim(spec, b, "%s: %.17g, without it %.17g", measure->name, after[j], before[j]);
        }
        changed[j] = changed[j] || !equal;
    }
}

/* Where the table does not say that a value is kept, some pattern's changes: the lists are complete. */
TEST_CASE(measures_are_kept)
{
    const koksma_modifier *m;
    const koksma_measure *measure;
    bool changed[KOKSMA_MAX_MODIFIERS][MEASURES] = {{false}};
    for (size_t i = 0; koksma_pattern_at(i); i++) {
        koksma_spec spec;
        koksma_points a, b;
        double before[MEASURES];
        if (!make(i, 16, 5, &spec, &a)) {
            continue;
        }
        measure_all(&a, before);
        assert_ok(koksma_points_init(&b, 16, a.dim));
        for (size_t at = 0; (m = koksma_modifier_at(at)); at++) {
            memcpy(b.xs, a.xs, 16 * (size_t)a.dim * sizeof *a.xs);
            spec.modifiers[at] = m->max;
            koksma__modify(spec.modifiers, 5, &b); /* what koksma_generate makes: check_unbiased compares the bits */
            compare_measures(m, &spec, &b, before, changed[at]);
            spec.modifiers[at] = 0;
        }
        koksma_points_fini(&a);
        koksma_points_fini(&b);
    }
    for (size_t at = 0; (m = koksma_modifier_at(at)); at++) {
        for (size_t j = 0; (measure = koksma_measure_at(j)); j++) {
            assert_that(measure->answer != KOKSMA_ANSWER_EXACT || changed[at][j] || keeps(m, measure->name),
                        "%s changes no value of %s, and does not say so", m->name, measure->name);
        }
    }
}

/* x and y under a modifier, in one dimension, for a seed. */
static void pair_under(size_t at, uint64_t seed, double x, double y, double out[2])
{
    koksma_points points = {2, 1, out};
    double values[KOKSMA_MAX_MODIFIERS] = {0};
    out[0] = x;
    out[1] = y;
    values[at] = 1;
    koksma__modify(values, seed, &points);
}

/* Owen's definition: images of x and y agree in as many leading digits as x and y do; the first digit at which they
   differ is flipped in half of the cases, and what follows is independent. A digital shift flips the same in both. */
TEST_CASE(digits_are_scrambled_by_definition)
{
    enum { SEEDS = test_repeats(4000, 400), TOP = 12 };
    size_t owen = 0, digital = 0;
    modifier("owen", &owen);
    modifier("digital-shift", &digital);
    for (int common = 0; common < TOP; common++) {
        const double x = 0x0.5bp0, y = x + (((int)floor(ldexp(x, common + 1)) & 1) ? -1 : 1) * ldexp(1, -common - 1);
        size_t flipped = 0, agree = 0;
        for (uint64_t seed = 0; seed < SEEDS; seed++) {
            double u[2], v[2];
            pair_under(owen, seed, x, y, u);
            pair_under(digital, seed, x, y, v);
            const uint64_t a = (uint64_t)(u[0] * 0x1p53), b = (uint64_t)(u[1] * 0x1p53), differ = a ^ b;
            assert_int_equal(differ >> (53 - common), 0);
            assert_int_equal(differ >> (52 - common) & 1, 1);
            flipped += (a >> (52 - common) & 1) != ((uint64_t)(x * 0x1p53) >> (52 - common) & 1);
            agree += differ >> (51 - common) & 1;
            assert_int_equal((uint64_t)(v[0] * 0x1p53) ^ (uint64_t)(v[1] * 0x1p53),
                             (uint64_t)(x * 0x1p53) ^ (uint64_t)(y * 0x1p53));
        }
        const double bound = 4.5 * sqrt(SEEDS / 4.0);
        assert_near((double)flipped, SEEDS / 2.0, bound);
        assert_near((double)agree, SEEDS / 2.0, bound);
    }
}

/* Fails unless all counts that `from` and `to` index are as equal as those of a uniform distribution, by chi-squared: at
   most its quantile of 1 - 1e-5 (Wilson & Hilferty 1931). Without `same` only from != to are cells. */
static void assert_uniform_pairs(const char *what, uint32_t base, bool same, const size_t (*seen)[8], size_t sum)
{
    const double cells = base * (same ? base : base - 1.0), df = cells - 1, expected = (double)sum / cells;
    const double cube = 1 - 2 / (9 * df) + 4.265 * sqrt(2 / (9 * df));
    double squared = 0;
    for (uint32_t i = 0; i < base; i++) {
        for (uint32_t j = 0; j < base; j++) {
            squared += same || i != j ? pow((double)seen[i][j] - expected, 2) / expected : 0;
        }
    }
    assert_that(squared < df * cube * cube * cube, "base %u, %s: chi-squared is %g with %g degrees of freedom", base,
                what, squared, df);
}

/* Owen's definition in a base: images agree in as many leading digits as x and y do and differ in the next; the pair of
   digits there goes to each ordered pair of different digits equally often, so each digit to each value; the digits after
   it are uniform and independent. */
static void assert_scrambled_in(size_t at, uint32_t base)
{
    enum { SEEDS = test_repeats(4000, 800) };
    for (int common = 0; common < 6; common++) {
        const double parts = pow(base, common + 1), cell = floor(0.61 * pow(base, common)) * base;
        const double x = cell / parts, y = (cell + 1) / parts;
        size_t pairs[8][8] = {{0}}, next[8][8] = {{0}};
        for (uint64_t seed = 0; seed < SEEDS; seed++) {
            double xs[2] = {x, y}, values[KOKSMA_MAX_MODIFIERS] = {0};
            koksma_points points = {2, 1, xs};
            values[at] = base;
            koksma__modify(values, seed, &points);
            const uint64_t a = (uint64_t)(xs[0] * parts * base), b = (uint64_t)(xs[1] * parts * base);
            assert_int_equal(a / base / base, b / base / base);
            assert_int_not_equal(a / base % base, b / base % base);
            pairs[a / base % base][b / base % base]++;
            next[a % base][b % base]++;
        }
        assert_uniform_pairs("the first digits that differ", base, false, (const size_t(*)[8])pairs, SEEDS);
        assert_uniform_pairs("the digits after them", base, true, (const size_t(*)[8])next, SEEDS);
    }
}

/* In bases 2 to 5 and 7; a net in the base stays one. */
TEST_CASE(digits_of_a_base_are_scrambled_by_definition)
{
    static const uint32_t bases[] = {2, 3, 4, 5, 7};
    size_t at = 0;
    modifier("owen-base", &at);
    for (size_t i = 0; i < sizeof bases / sizeof *bases; i++) {
        assert_scrambled_in(at, bases[i]);
    }
    static const struct {
        const char *measure, *pattern;
        size_t n;
        int dim;
    } nets[] = {{"t-value:base=3", "faure", 243, 3}, {"t-value:base=5", "faure", 125, 5},
                {"t-value:base=2", "sobol", 64, 2},  {"t-value:base=4", "sz", 256, 4},
                {"t-value:base=4", "sz", 64, 4},     {"t-value:base=3", "ternary-quads", 243, 3},
                {"t-value:base=7", "faure", 343, 7}};
    for (size_t i = 0; i < sizeof nets / sizeof *nets; i++) {
        koksma_spec spec, what;
        koksma_points points;
        koksma_value value;
        assert_ok(koksma_pattern_spec(nets[i].pattern, &spec));
        assert_ok(koksma_measure_spec(nets[i].measure, &what));
        spec.modifiers[at] = nets[i].measure[strlen(nets[i].measure) - 1] - '0';
        assert_ok(koksma_points_init(&points, nets[i].n, nets[i].dim));
        assert_ok(koksma_generate(&spec, 9, NULL, &points));
        assert_ok(koksma_evaluate(&what, &points, NULL, &value));
        assert_true(value.value == 0);
        assert_true(points.xs[0] != 0);
        koksma_points_fini(&points);
    }
}

/* A value is 0 or a whole number in the modifier's range; a text and a struct with any other are refused by the same
   words. */
TEST_CASE(limits_are_the_same_in_texts_and_structs)
{
    const koksma_modifier *m;
    for (size_t at = 0; (m = koksma_modifier_at(at)); at++) {
        const double values[] = {0, m->min, m->max, m->min - 1, m->max + 1, m->min + 0.5, -1};
        for (size_t v = 0; v < sizeof values / sizeof *values; v++) {
            char text[KOKSMA_MAX_SPEC], said[KOKSMA_MAX_SPEC] = "";
            double xs[8];
            koksma_points points = {4, 2, xs};
            koksma_spec spec;
            const bool allowed = values[v] == 0 || (v < 3 && values[v] >= m->min);
            snprintf(text, sizeof text, "sobol:%s=%.1f", m->name, values[v]);
            assert_int_equal(koksma_pattern_spec(text, &spec), allowed ? KOKSMA_OK : KOKSMA_ARGUMENT);
            if (!allowed) {
                snprintf(said, sizeof said, "%s", koksma_error_text());
            }
            assert_ok(koksma_pattern_spec("sobol", &spec));
            spec.modifiers[at] = values[v];
            assert_int_equal(koksma_generate(&spec, 0, NULL, &points), allowed ? KOKSMA_OK : KOKSMA_ARGUMENT);
            assert_true(allowed || !strcmp(said, koksma_error_text()));
        }
    }
}

/* tent is 1 - |2x - 1|, below 1; behind a shift the mean over a lattice of x^2 y has a far smaller error than without. */
TEST_CASE(tents_fold_the_cube)
{
    size_t at = 0;
    modifier("tent", &at);
    double xs[] = {0, 0.25, 0.5, 0.75, 1 - 0x1p-53, 0x1p-53, 0.3}, values[KOKSMA_MAX_MODIFIERS] = {0};
    const double expected[] = {0, 0.5, 1 - 0x1p-53, 0.5, 0x1p-52, 0x1p-52, 0.6};
    koksma_points points = {7, 1, xs};
    values[at] = 1;
    koksma__modify(values, 5, &points);
    for (size_t i = 0; i < 7; i++) {
        assert_true(xs[i] == expected[i]);
    }
    double squares[2] = {0};
    for (int tent = 0; tent < 2; tent++) {
        for (uint64_t seed = 0; seed < 50; seed++) {
            koksma_spec spec;
            assert_ok(koksma_pattern_spec(tent ? "lattice-rank1:shift=1,tent=1" : "lattice-rank1:shift=1", &spec));
            assert_ok(koksma_points_init(&points, 1021, 2));
            assert_ok(koksma_generate(&spec, seed, NULL, &points));
            double sum = 0;
            for (size_t i = 0; i < points.n; i++) {
                sum += points.xs[2 * i] * points.xs[2 * i] * points.xs[2 * i + 1];
            }
            squares[tent] += pow(sum / (double)points.n - 1.0 / 6, 2);
            koksma_points_fini(&points);
        }
    }
    assert_true(squares[1] < squares[0] / 1000);
}

/* shift adds the same vector to all points; phase=K is shift with seed K. */
TEST_CASE(shifts_move_all_points_alike)
{
    size_t at = 0, phase = 0;
    modifier("shift", &at);
    modifier("phase", &phase);
    for (size_t i = 0; koksma_pattern_at(i); i++) {
        koksma_spec spec;
        koksma_points a, b;
        if (!make(i, 16, 3, &spec, &a)) {
            continue;
        }
        const size_t dim = (size_t)a.dim;
        assert_ok(koksma_points_init(&b, 16, a.dim));
        spec.modifiers[at] = 1;
        assert_ok(koksma_generate(&spec, 3, NULL, &b));
        for (size_t j = 0; j < 16 * dim; j++) {
            const double u = b.xs[j] - a.xs[j] - (b.xs[j % dim] - a.xs[j % dim]);
            assert_near(u - floor(u + 0.5), 0, 1e-12);
        }
        spec.modifiers[at] = 0;
        spec.modifiers[phase] = 3;
        assert_ok(koksma_generate(&spec, 3, NULL, &a));
        assert_memory_equal(a.xs, b.xs, 16 * dim * sizeof *a.xs);
        koksma_points_fini(&a);
        koksma_points_fini(&b);
    }
}

/* Texts: every modifier behind every pattern, none is also a pattern's parameter, and a path ends before them. */
TEST_CASE(texts_are_read_and_printed)
{
    const koksma_modifier *m;
    const koksma_pattern *p;
    char text[KOKSMA_MAX_SPEC], wrong[KOKSMA_MAX_SPEC], all[KOKSMA_MAX_SPEC] = "";
    koksma_spec spec;
    for (size_t at = 0; (m = koksma_modifier_at(at)); at++) {
        snprintf(all + strlen(all), sizeof all - strlen(all), ",%s=%.0f", m->name, m->max);
        for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
            for (int k = 0; p->params && p->params[k].name; k++) {
                assert_string_not_equal(p->params[k].name, m->name);
            }
            snprintf(text, sizeof text, "%s:%s%s=%.0f", p->name, p->operand ? "a,b=c/d," : "", m->name, m->min);
            assert_ok(koksma_pattern_spec(text, &spec));
            assert_true(spec.modifiers[at] > 0);
            koksma_spec_text(&spec, wrong);
            assert_string_equal(strchr(wrong, ':'), strchr(text, ':'));
            static const char *const values[] = {"-1", "x", "1e10", "", "0.5"};
            for (size_t v = 0; v < sizeof values / sizeof *values - !!p->operand; v++) {
                snprintf(wrong, sizeof wrong, "%s:%s%s=%s", p->name, p->operand ? "a," : "", m->name, values[v]);
                assert_int_equal(koksma_pattern_spec(wrong, &spec), KOKSMA_ARGUMENT);
                assert_non_null(strstr(koksma_error_text(), m->name));
            }
            koksma_points points;
            assert_ok(koksma_pattern_spec(text, &spec));
            assert_ok(koksma_points_init(&points, 4, p->min_dim));
            spec.modifiers[at] = NAN;
            assert_int_equal(koksma_generate(&spec, 0, NULL, &points), KOKSMA_ARGUMENT);
            koksma_points_fini(&points);
        }
    }
    snprintf(text, sizeof text, "file:x,shift=2.txt%.400s", all);
    assert_ok(koksma_pattern_spec(text, &spec));
    assert_string_equal(spec.path, "x,shift=2.txt");
    koksma_spec_text(&spec, wrong);
    assert_string_equal(wrong, text);
}
