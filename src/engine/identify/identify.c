/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_identify: where points come from. The tests run from those that leave least open to those that leave most:
 * equal points of a sequence, in any order; lattices, recurrences and grids; sequences behind a shift or scrambling; any of
 * these beside an equidistant coordinate; the patterns of this library with a seed; the structure of points of no known
 * source. They are repeated with a larger tolerance if the numbers may be rounded.
 * What names the points is confirmed for every coordinate of every point before it is said. Properties follow, if
 * nothing does.
 */
#include "identify/identify.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/points.h"
#include "core/status.h"

void koksma_identities_fini(koksma_identities *identities)
{
    if (identities) {
        free(identities->items);
        *identities = (koksma_identities){0};
    }
}

/* With less tolerance digits were found to be permuted, in a way that may be due to rounding: rounded points of a sequence
   as it is are that, else a nested one is looked for again. */
static koksma_status identify_rounded(koksma__sample *s)
{
    koksma_identities *found = s->found;
    const size_t count = found->count;
    s->named = false;
    KOKSMA__TRY(koksma__identify_plain(s));
    if (!s->named) {
        s->named = true;
        return s->scramble == KOKSMA__NESTED ? koksma__identify_scrambled(s) : KOKSMA_OK;
    }
    memmove(&found->items[s->before], &found->items[count], (found->count - count) * sizeof *found->items);
    found->count -= count - s->before;
    s->scramble = KOKSMA__NO_RELATION;
    return KOKSMA_OK;
}

static koksma_status identify_with(koksma__sample *s)
{
    if (s->named) {
        return identify_rounded(s);
    }
    koksma_status (*const tests[])(koksma__sample *) = {koksma__identify_plain, koksma__identify_fixed,
                                                        koksma__identify_progression, koksma__identify_scrambled};
    for (size_t i = 0; i < sizeof tests / sizeof *tests && !s->named; i++) {
        KOKSMA__TRY(tests[i](s));
    }
    return KOKSMA_OK;
}

/* Tries one tolerance after the other. */
static koksma_status identify_within(koksma__sample *s, const double *tolerances, int precisions)
{
    double tolerance = 0;
    s->before = s->found->count;
    s->scramble = KOKSMA__NO_RELATION;
    for (int i = 0; i < precisions && (!s->named || s->scramble == KOKSMA__NESTED || s->scramble == KOKSMA__LINEAR);
         i++) {
        const int before = s->scramble;
        s->tolerance = tolerances[i];
        KOKSMA__TRY(identify_with(s));
        tolerance = i == 0 || before != s->scramble || s->scramble == KOKSMA__NO_RELATION ? s->tolerance : tolerance;
    }
    s->tolerance = s->named ? tolerance : tolerances[precisions - 1];
    return KOKSMA_OK;
}

/* Finds a coordinate that is (i + *offset) / *whole, where *whole is about the number of points. Returns -1 for none. */
static int find_equidistant(const koksma__sample *s, double tolerance, double *offset, double *whole)
{
    const size_t n = s->points.n, dim = (size_t)s->points.dim;
    for (size_t k = 0; k < dim && n > 4; k++) {
        const double first = s->points.xs[k], step = (s->points.xs[(n - 1) * dim + k] - first) / (double)(n - 1);
        bool all = step > 0;
        for (size_t i = 0; i < n && all; i++) {
            all = fabs(s->points.xs[i * dim + k] - first - step * (double)i) <= 2 * tolerance + 0x1p-50;
        }
        *whole = nearbyint(1 / step);
        *offset = first * *whole;
        if (all && *whole + 2 >= (double)n && *whole <= (double)n + 2) {
            return (int)k;
        }
    }
    return -1;
}

/* Points of Hammersley's kind: identifies what is beside an equidistant coordinate. */
static koksma_status identify_beside(koksma__sample *s, const double *tolerances, int precisions)
{
    double offset, whole;
    const size_t dim = (size_t)s->points.dim, count = s->found->count;
    const int beside = find_equidistant(s, tolerances[precisions - 1], &offset, &whole);
    if (beside < 0 || dim < 2) {
        return KOKSMA_OK;
    }
    koksma__sample rest = *s;
    KOKSMA__TRY(koksma_points_init(&rest.points, s->points.n, s->points.dim - 1));
    for (size_t i = 0; i < s->points.n * dim; i++) {
        const size_t point = i / dim, k = i % dim;
        if (k != (size_t)beside) {
            rest.points.xs[point * (dim - 1) + k - (k > (size_t)beside)] = s->points.xs[i];
        }
    }
    const koksma_status status = identify_within(&rest, tolerances, precisions);
    koksma_points_fini(&rest.points);
    KOKSMA__TRY(status);
    s->named = rest.named;
    s->tolerance = rest.tolerance;
    for (size_t i = count; i < s->found->count; i++) {
        koksma_identity *said = &s->found->items[i];
        char what[sizeof said->what];
        snprintf(what, sizeof what, "%s", said->what);
        koksma__snprintf(said->what, sizeof said->what, "Hammersley: coordinate %d is (i%+.6g) / %.0f beside %.*s",
                         beside, offset, whole, (int)(sizeof what - 60), what);
        *said->spec = 0;
    }
    return KOKSMA_OK;
}

static koksma_status identify(koksma__sample *s, const koksma_points *points)
{
    double tolerances[KOKSMA__PRECISIONS];
    KOKSMA__TRY(koksma__map_to_cube(s));
    const int precisions = koksma__precisions(s, points, tolerances);
    KOKSMA__TRY(identify_within(s, tolerances, precisions));
    if (!s->named) {
        KOKSMA__TRY(identify_beside(s, tolerances, precisions));
    }
    KOKSMA__TRY(koksma__identify_seeded(s));
    for (int i = 0; i < precisions && !s->named; i++) {
        s->tolerance = tolerances[i];
        KOKSMA__TRY(koksma__identify_structure(s));
    }
    if (s->named && s->tolerance > 0x1p-40) {
        koksma_identity *said = koksma__identity(s, "rounded", "coordinates were compared within %.3g", s->tolerance);
        KOKSMA__REQUIRE_MEMORY(said, sizeof *said);
        snprintf(said->what, sizeof said->what, "%s",
                 s->floats ? "all coordinates are floats" : "all coordinates have few digits");
    }
    if (!s->named) {
        koksma_identity *said = koksma__identity(s, "unknown", "no sequence, lattice or pattern that is known here");
        KOKSMA__REQUIRE_MEMORY(said, sizeof *said);
    }
    return koksma__identify_properties(s);
}

koksma_status koksma_identify(const koksma_points *points, const koksma_run *run, koksma_identities *identities)
{
    KOKSMA__REQUIRE(points, identities);
    KOKSMA__REQUIRE_RUN(run);
    *identities = (koksma_identities){0};
    KOKSMA__FAIL_IF(!points->xs || points->n == 0, KOKSMA_ARGUMENT, "identify: there are no points");
    KOKSMA__TRY(koksma__points_fit(points->n, points->dim));
    koksma__sample s = {.run = run, .found = identities, .width = 1, .largest = 1};
    KOKSMA__TRY(koksma_points_init(&s.points, points->n, points->dim));
    memcpy(s.points.xs, points->xs, points->n * (size_t)points->dim * sizeof *points->xs);
    const koksma_status status = identify(&s, points);
    koksma_points_fini(&s.points);
    if (status) {
        koksma_identities_fini(identities);
    }
    return status;
}
