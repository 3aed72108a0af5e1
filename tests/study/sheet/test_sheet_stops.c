/* SPDX-License-Identifier: Apache-2.0 */
/* A datasheet asks within every set of points whether to go on, not only between them: a measure of one set may take
   seconds. Counted are calls, not seconds. After the call that says no, none makes a sheet. */
#include <stdlib.h>

#include <koksma/datasheet.h>

#include "test.h"

/* The measures of the plane are the first part of the work. */
#define MEASURES 0.4

typedef struct calls {
    long n, last;                /* number of calls so far, and that from which on the answer is no (0: none) */
    long in_measures, fractions; /* calls in the part of the measures, and different fractions among them: sets */
    double fraction;
} calls;

static bool keep_going(void *context, double fraction)
{
    calls *c = context;
    assert_true(fraction >= c->fraction && fraction <= 1);
    c->in_measures += fraction < MEASURES;
    c->fractions += fraction < MEASURES && fraction > c->fraction;
    c->fraction = fraction;
    c->n++;
    return !c->last || c->n < c->last;
}

static koksma_status sheet_of(const char *sampler, calls *c)
{
    const koksma_datasheet_options options = {
        .sampler = sampler, .beside = (const char *const[]){""}, .scenes = (const char *const[]){""}, .quick = true};
    const koksma_run run = {.threads = 1, .keep_going = keep_going, .context = c};
    char *json = NULL;
    const koksma_status status = koksma_datasheet(&options, &run, &json);
    assert_true(!status == (json != NULL));
    free(json);
    return status;
}

TEST_CASE(test_asks_within_sets)
{
    calls whole = {.n = 0};
    assert_ok(sheet_of("jittered", &whole));
    assert_true(whole.fractions > 10 && whole.in_measures > 50 * whole.fractions);
    for (long last = 1; last <= whole.n; last = last * 2 + 1) {
        calls c = {.last = last};
        assert_int_equal(sheet_of("jittered", &c), KOKSMA_INTERRUPTED);
        assert_true(c.n < last + 8); /* each of the calls that end asks no more than once */
    }
}
