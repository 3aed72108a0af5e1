/* SPDX-License-Identifier: Apache-2.0 */
/* How large a set may be, and that no call believes a larger claim. */
#include <string.h>

#include <koksma/spectrum.h>
#include <koksma/verify.h>

#include "test.h"

static void fails_as_too_large(koksma_status status)
{
    assert_int_equal(status, KOKSMA_ARGUMENT);
    assert_that(strstr(koksma_error_text(), "fit into one set"), "the error is \"%s\"", koksma_error_text());
}

TEST_CASE(larger_sets_are_refused)
{
    koksma_points p;
    fails_as_too_large(koksma_points_init(&p, KOKSMA_MAX_COORDINATES + 1, 1));
    fails_as_too_large(koksma_points_init(&p, KOKSMA_MAX_COORDINATES / KOKSMA_MAX_DIM + 1, KOKSMA_MAX_DIM));
    fails_as_too_large(koksma_points_init(&p, SIZE_MAX, 2));
    assert_null(p.xs);
    assert_int_equal(koksma_points_init(&p, 1, KOKSMA_MAX_DIM + 1), KOKSMA_DIM);
    assert_ok(koksma_points_init(&p, KOKSMA_MAX_COORDINATES / 16 / KOKSMA_MAX_DIM, KOKSMA_MAX_DIM));
    assert_float_equal(p.xs[KOKSMA_MAX_COORDINATES / 16 - 1], 0, 0);
    koksma_points_fini(&p);
}

/* Structs that a caller filled in: what they claim is looked at before their coordinates are. */
TEST_CASE(claims_are_looked_at)
{
    double few[2] = {0.5, 0.5};
    koksma_points p = {KOKSMA_MAX_COORDINATES / 2 + 1, 2, few};
    koksma_spec random, star;
    koksma_value value;
    koksma_findings findings;
    koksma_spectrum spectrum;
    assert_ok(koksma_pattern_spec("random", &random));
    assert_ok(koksma_measure_spec("star", &star));
    assert_ok(koksma_spectrum_init(&spectrum, 4));
    fails_as_too_large(koksma_generate(&random, 1, NULL, &p));
    fails_as_too_large(koksma_evaluate(&star, &p, NULL, &value));
    fails_as_too_large(koksma_verify(&p, NULL, &findings));
    fails_as_too_large(koksma_spectrum_add(&spectrum, &p, KOKSMA_SPECTRUM_FAST, NULL));
    p = (koksma_points){SIZE_MAX, 1, few};
    fails_as_too_large(koksma_evaluate(&star, &p, NULL, &value));
    koksma_spectrum_fini(&spectrum);
}

/* A method's buffers, of less than 256 bytes for each coordinate, have a size. */
TEST_CASE(sizes_have_room)
{
    assert_true(KOKSMA_MAX_COORDINATES <= SIZE_MAX / 255);
}
