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
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/capacity.h"
#include "core/points.h"
#include "core/status.h"

double koksma__turn(double a)
{
    return a - nearbyint(a);
}

void koksma__append(char *text, size_t size, const char *format, ...)
{
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    const int length = koksma__vsnprintf(text + used, size - used, format, arguments);
    va_end(arguments);
    if (length > 0 && (size_t)length >= size - used && size > 4) {
        memcpy(text + size - 4, "...", 4);
    }
}

koksma_identity *koksma__identity(koksma__sample *s, const char *relation, const char *detail, ...)
{
    koksma_identities *all = s->found;
    if (koksma__reserve(&all->items, &all->capacity, all->count + 1, sizeof *all->items)) {
        return NULL;
    }
    koksma_identity *said = &all->items[all->count++];
    *said = (koksma_identity){.relation = relation};
    va_list arguments;
    va_start(arguments, detail);
    koksma__vsnprintf(said->detail, sizeof said->detail, detail, arguments);
    va_end(arguments);
    return said;
}

bool koksma_identity_names(const koksma_identity *identity)
{
    KOKSMA__REQUIRE_OR(false, identity);
    static const char *const none[] = {"scaled", "rounded", "property", "unknown"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        if (identity->relation && !strcmp(identity->relation, none[i])) {
            return false;
        }
    }
    return identity->relation != NULL;
}

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
