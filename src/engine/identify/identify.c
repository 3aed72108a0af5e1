/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_identify: where points come from. The tests run from those that leave least open to those that leave most:
 * equal points of a sequence, in any order; lattices, recurrences and grids; sequences behind a shift or scrambling; the
 * patterns of this library with a seed; the strata of points of no known source. They are repeated with a larger
 * tolerance if the numbers may be rounded. What names the points is confirmed for every coordinate of every point
 * before it is said.
 */
#include "identify/sample.h"

#include <math.h>
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

static koksma_status identify(koksma__sample *s, const koksma_points *points)
{
    double tolerances[KOKSMA__PRECISIONS];
    KOKSMA__TRY(koksma__map_to_cube(s));
    const int precisions = koksma__precisions(s, points, tolerances);
    KOKSMA__TRY(identify_within(s, tolerances, precisions));
    KOKSMA__TRY(koksma__identify_seeded(s));
    if (!s->named && s->few_digits > 0 &&
        points->n * (size_t)points->dim >= 16) { /* 16 are equal with chance 2^-90 */
        s->tolerance = s->few_digits;
        KOKSMA__TRY(koksma__identify_plain(s));
    }
    for (int i = 0; i < precisions && !s->named; i++) {
        s->tolerance = tolerances[i];
        KOKSMA__TRY(koksma__identify_structure(s));
    }
    if (!s->named) {
        return koksma__say(s, "unknown", "", "", 0, "no sequence, lattice or pattern that is known here%s",
                           s->few_digits > 0 ? ", as far as so few digits tell: more decimals tell more" : "");
    }
    if (s->tolerance > 0x1p-40) {
        return koksma__say(s, "rounded", s->floats ? "all coordinates are floats" : "all coordinates have few digits",
                           "", 0, "coordinates were compared within %.3g", s->tolerance);
    }
    return KOKSMA_OK;
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
