/* SPDX-License-Identifier: Apache-2.0 */
/* What koksma_identify says of sets of every pattern here, with random parameters, modifiers, seeds and numbers of points,
   is true: where it says that points are equal to, another order of or some of what a spec makes, that spec is run again
   and compared, and points behind a shift differ from its points by one vector. KOKSMA_SETS="60" or "60 120" says how
   many sets, or which; a set takes about a second, most of it for seeds. */
#include <koksma/identify.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/random.h"
#include "test.h"

enum { LARGEST = 1 << 15 };

static uint64_t drawn;

static uint64_t draw(uint64_t below)
{
    return koksma__random_seed(0x1d, drawn++, 0) % below;
}

/* ---- The points that a statement describes ---- */

/* Makes the points of the spec of a statement, from its first or from 0 on. */
static bool make(const koksma_identity *said, size_t n, int dim, uint64_t first, koksma_points *points)
{
    koksma_spec spec;
    assert_ok(koksma_pattern_spec(said->spec, &spec));
    assert_ok(koksma_points_init(points, n, dim));
    const bool ranges = koksma_has_ranges(&spec) && koksma_is_sequence(&spec);
    const koksma_status status = ranges ? koksma_generate_range(&spec, said->seed, first + n, first, NULL, points)
                                        : koksma_generate(&spec, said->seed, NULL, points);
    assert_true(ranges || first == 0 || !strcmp(said->relation, "reordered"));
    return status == KOKSMA_OK;
}

/* Fails unless each point is the one that the statement says: of the same number, of any number or behind a shift. */
static void check(const char *made_by, const koksma_points *points, const koksma_identity *said, double slack)
{
    const bool shifted = !strcmp(said->relation, "shifted"), part = !strcmp(said->relation, "part");
    const bool any = part || !strcmp(said->relation, "reordered");
    if (!*said->spec || !(any || shifted || !strcmp(said->relation, "equal"))) {
        return;
    }
    const size_t dim = (size_t)points->dim;
    const uint64_t first = any && !strncmp(said->what, "rank-1", 6) ? 0 : said->first;
    const char *to = part ? strstr(said->detail, " to ") : NULL;
    const size_t n = to ? (size_t)(strtoull(to + 4, NULL, 10) - first + 1) : points->n;
    koksma_points again = {0};
    const bool made = n <= LARGEST && make(said, n, points->dim, first, &again);
    assert_that(made || any, "%s: said to be %s %s, which fails: %s", made_by, said->relation, said->spec,
                koksma_error_text());
    for (size_t i = 0; made && i < points->n; i++) {
        double best = INFINITY;
        for (size_t j = any ? 0 : i; j < (any ? n : i + 1); j++) {
            double worst = 0;
            for (size_t k = 0; k < dim; k++) {
                double d = points->xs[i * dim + k] - again.xs[j * dim + k];
                d -= shifted ? points->xs[k] - again.xs[k] : 0;
                worst = fmax(worst, fabs(shifted ? d - nearbyint(d) : d));
            }
            best = fmin(best, worst);
        }
        assert_that(best <= (shifted ? 4 : 1) * slack,
                    "%s: said to be %s of %s from %llu with seed %llu, but point %zu is not", made_by, said->relation,
                    said->spec, (unsigned long long)said->first, (unsigned long long)said->seed, i);
    }
    koksma_points_fini(&again);
}

/* ---- The sets ---- */

/* Draws a spec: a pattern with one of the words of a parameter and a modifier, or without. */
static bool draw_spec(const koksma_pattern *p, char text[KOKSMA_MAX_SPEC])
{
    static const char *const modifiers[] = {"", "", "", "shift=1", "digital-shift=1", "owen=1"};
    const char *modifier = modifiers[draw(6)];
    int used = snprintf(text, KOKSMA_MAX_SPEC, "%s", p->name);
    const char *separator = ":";
    for (const koksma_param *param = p->params; param && param->name; param++) {
        size_t words = 0;
        for (; param->choices && param->choices[words]; words++) {
        }
        if (words && draw(2)) {
            used += snprintf(text + used, KOKSMA_MAX_SPEC - (size_t)used, "%s%s=%s", separator, param->name,
                             param->choices[draw(words)]);
            separator = ",";
        }
    }
    if (*modifier) {
        snprintf(text + used, KOKSMA_MAX_SPEC - (size_t)used, "%s%s", separator, modifier);
    }
    koksma_spec spec;
    return koksma_pattern_spec(text, &spec) == KOKSMA_OK;
}

/* Changes points as users do. Returns the tolerance with which the changed points may be told from others. */
static double change(koksma_points *points, char *text, size_t size)
{
    const size_t dim = (size_t)points->dim, count = points->n * dim, kind = draw(6);
    double slack = 0x1p-46;
    if (kind == 0) {
        for (size_t i = 0; i < points->n; i++) {
            for (size_t k = 0; 2 * k + 1 < dim; k++) {
                const double x = points->xs[i * dim + k];
                points->xs[i * dim + k] = points->xs[i * dim + dim - 1 - k];
                points->xs[i * dim + dim - 1 - k] = x;
            }
        }
    }
    for (size_t i = 0; i < count && kind == 1; i++) {
        points->xs[i] = (double)(float)points->xs[i];
        slack = 0x1p-23;
    }
    if (kind == 2 && points->n > 8) { /* the points from the third on */
        points->n -= 2;
        memmove(points->xs, points->xs + 2 * dim, points->n * dim * sizeof *points->xs);
    }
    static const char *const names[] = {", reversed", ", as float", ", from the third", "", "", ""};
    snprintf(text, size, "%s", names[kind]);
    return slack;
}

static void check_set(const koksma_pattern *p)
{
    char text[KOKSMA_MAX_SPEC], made_by[KOKSMA_MAX_SPEC + 100], how[40];
    koksma_spec spec;
    koksma_points points;
    const int dims[] = {1, 2, 3, 4, 6};
    const int dim = dims[draw(5)];
    const size_t n = draw(2) ? (size_t)4 << draw(6) : 3 + draw(200);
    const uint64_t seed = draw(3) ? draw(1000) : draw((uint64_t)1 << 40);
    if (!draw_spec(p, text) || dim < p->min_dim || dim > p->max_dim) {
        return;
    }
    assert_ok(koksma_pattern_spec(text, &spec));
    assert_ok(koksma_points_init(&points, n, dim));
    if (koksma_generate(&spec, seed, NULL, &points) == KOKSMA_OK) {
        koksma_identities all;
        const size_t whole = points.n;
        const double slack = change(&points, how, sizeof how);
        snprintf(made_by, sizeof made_by, "%s, n %zu, dim %d, seed %llu%s", text, n, dim, (unsigned long long)seed,
                 how);
        assert_ok(koksma_identify(&points, NULL, &all));
        for (size_t i = 0; i < all.count; i++) {
            check(made_by, &points, &all.items[i], slack);
        }
        koksma_identities_fini(&all);
        points.n = whole;
    }
    koksma_points_fini(&points);
}

TEST_CASE(what_is_said_of_sets_of_ours_is_true)
{
    const char *sets = getenv("KOKSMA_SETS");
    char *end = NULL;
    size_t n = sets ? strtoul(sets, &end, 10) : (size_t)test_repeats(3, 1), from = 0;
    if (end && *end) {
        from = n;
        n = strtoul(end, NULL, 10);
    }
    size_t patterns = 0;
    while (koksma_pattern_at(patterns)) {
        patterns++;
    }
    for (size_t i = from; i < n; i++) {
        const koksma_pattern *p = koksma_pattern_at(i % patterns);
        for (drawn = i << 16; p->operand || p->runs_code;) {
            p = koksma_pattern_at(draw(patterns));
        }
        check_set(p);
    }
}
