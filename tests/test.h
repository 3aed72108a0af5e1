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
#include <string.h>

#include <cmocka.h>

#include <koksma/koksma.h>

void test_add(const char *name, CMUnitTestFunction function, int line);
void test_around(CMFixtureFunction begin, CMFixtureFunction end);

/* TEST_CASE(name) { ... } is a test of cmocka, which tests/run_tests.c runs; `state` is what the group's beginning
   left. A file that needs more, as a function after each test, has a list and a main of its own. */
#define TEST_CASE(name)                                                                                              \
    static void name(void **state);                                                                                  \
    __attribute__((constructor)) static void add_##name(void)                                                        \
    {                                                                                                                \
        test_add(#name, name, __LINE__);                                                                             \
    }                                                                                                                \
    static void name(void **state __attribute__((unused)))

/* TEST_GROUP(begin, end): functions of cmocka before the first test and after the last, either may be NULL. */
#define TEST_GROUP(begin, end)                                                                                       \
    __attribute__((constructor)) static void add_group(void)                                                         \
    {                                                                                                                \
        test_around(begin, end);                                                                                     \
    }

/* Whether this program makes few trials: AddressSanitizer or ThreadSanitizer checks it, which takes 4 to 10 times longer,
   or it is of another machine, under an emulator (30 times; tests/CMakeLists.txt sets it). */
#ifndef TEST_FEW
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TEST_FEW 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TEST_FEW 1
#endif
#endif
#endif
#ifndef TEST_FEW
#define TEST_FEW 0
#endif

/* A number of trials, points, cases or steps: `full` in optimised builds, `few` where there are to be few; a constant if
   both are. A run with sanitizers looks for memory errors and undefined behaviour, one of another machine for what byte
   order, the size of long and rounding change: it runs every code path and every row of a table, and a few trials of each.
   Statistical power, large n and exhaustive walks belong to the optimised run; scripts/same-bits compares the bits of other
   machines. A tolerance that depends on the number of trials is computed from it, so that both runs can fail. */
#define test_repeats(full, few) (TEST_FEW ? (few) : (full))

/* Fails with a message that has the values, unless the condition holds. */
#define assert_that(condition, ...)                                                                                  \
    do {                                                                                                             \
        if (!(condition)) {                                                                                          \
            fail_msg(__VA_ARGS__);                                                                                   \
        }                                                                                                            \
    } while (0)

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

/* Writes a file. */
static inline void test_write_bytes(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static inline void test_write(const char *path, const char *text)
{
    test_write_bytes(path, text, strlen(text));
}

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
