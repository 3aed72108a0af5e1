/* SPDX-License-Identifier: Apache-2.0 */
/* What every test program includes: cmocka with the headers that it wants first, and comparisons of doubles. */
#ifndef KOKSMA_TESTS_TEST_H
#define KOKSMA_TESTS_TEST_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include <koksma/koksma.h>

/* Fails with both numbers unless |a - b| <= bound; NaN fails. */
#define assert_near(a, b, bound)                                                                                     \
    do {                                                                                                             \
        const double a_ = (a), b_ = (b), bound_ = (bound);                                                           \
        if (!(fabs(a_ - b_) <= bound_)) {                                                                            \
            fail_msg("%s = %.17g and %s = %.17g differ by %.3g, more than %.3g", #a, a_, #b, b_, fabs(a_ - b_),      \
                     bound_);                                                                                        \
        }                                                                                                            \
    } while (0)

/* Fails with the library's text unless the call succeeds. */
#define assert_ok(call)                                                                                              \
    do {                                                                                                             \
        if ((call) != KOKSMA_OK) {                                                                                   \
            fail_msg("%s: %s", #call, koksma_error_text());                                                          \
        }                                                                                                            \
    } while (0)

/* A fresh set of points by spec; the test ends it with koksma_points_fini. */
static inline koksma_points test_points(const char *text, size_t n, int dim, uint64_t seed)
{
    koksma_spec spec;
    koksma_points points;
    assert_ok(koksma_pattern_spec(text, &spec));
    assert_ok(koksma_points_init(&points, n, dim));
    assert_ok(koksma_generate(&spec, seed, NULL, &points));
    return points;
}

static inline koksma_value test_measure(const char *text, const koksma_points *points)
{
    koksma_spec spec;
    koksma_value value;
    assert_ok(koksma_measure_spec(text, &spec));
    assert_ok(koksma_evaluate(&spec, points, NULL, &value));
    return value;
}

#endif
