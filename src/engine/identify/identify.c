/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_identify: where points come from. The tests run from those that leave least open to those that leave most:
 * equal points of a sequence, in any order; lattices, recurrences and grids; sequences behind a shift or scrambling;
 * the patterns of this library with a seed. They are repeated with a larger tolerance if the numbers may be rounded.
 * What names the points is confirmed for every coordinate of every point before it is said. Properties follow, if
 * nothing does.
 */
#include "identify/identify.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/points.h"
#include "core/status.h"

void koksma_identities_fini(koksma_identities *identities)
{
    if (identities) {
        free(identities->items);
        *identities = (koksma_identities){0};
    }
}

static koksma_status identify_with(koksma__sample *s)
{
    if (s->named) { /* with less tolerance digits were found to be permuted, in a way that may be due to rounding */
        return koksma__identify_scrambled(s);
    }
    koksma_status (*const tests[])(koksma__sample *) = {koksma__identify_plain, koksma__identify_fixed,
                                                        koksma__identify_progression, koksma__identify_scrambled};
    for (size_t i = 0; i < sizeof tests / sizeof *tests && !s->named; i++) {
        KOKSMA__TRY(tests[i](s));
    }
    return KOKSMA_OK;
}

static koksma_status identify(koksma__sample *s)
{
    double tolerances[KOKSMA__PRECISIONS];
    KOKSMA__TRY(koksma__map_to_cube(s));
    const bool mapped = s->found->count > 0;
    const int precisions = koksma__precisions(&s->points, tolerances);
    double tolerance = 0;
    s->before = s->found->count;
    s->scramble = KOKSMA__NO_RELATION;
    for (int i = 0; i < precisions && (!s->named || s->scramble == KOKSMA__NESTED); i++) {
        const int before = s->scramble;
        s->tolerance = mapped ? fmax(tolerances[i], 0x1p-47) : tolerances[i];
        KOKSMA__TRY(identify_with(s));
        tolerance = i == 0 || before != s->scramble || s->scramble == KOKSMA__NO_RELATION ? s->tolerance : tolerance;
    }
    s->tolerance = tolerance;
    for (int i = 0; i < precisions && (!s->named || i == 0); i++) {
        s->tolerance = s->named ? tolerance : tolerances[i];
        KOKSMA__TRY(koksma__identify_seeded(s));
    }
    if (s->named && s->tolerance > 0x1p-40) {
        koksma_identity *said = koksma__identity(s, "rounded", "coordinates were compared within %.3g", s->tolerance);
        KOKSMA__REQUIRE_MEMORY(said, sizeof *said);
        snprintf(said->what, sizeof said->what, "%s",
                 s->tolerance >= 0x1p-24 && s->tolerance <= 0x1p-24 ? "all coordinates are floats"
                                                                    : "all coordinates have few digits");
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
    koksma__sample s = {.run = run, .found = identities};
    KOKSMA__TRY(koksma_points_init(&s.points, points->n, points->dim));
    memcpy(s.points.xs, points->xs, points->n * (size_t)points->dim * sizeof *points->xs);
    const koksma_status status = identify(&s);
    koksma_points_fini(&s.points);
    if (status) {
        koksma_identities_fini(identities);
    }
    return status;
}
