/* SPDX-License-Identifier: Apache-2.0 */
/* Sets of one call are those of single calls, for every pattern that makes 16 points, on any number of threads. */
#include <string.h>

#include "test.h"

enum { SETS = 700, N = 16, DIM = 2, COUNT = SETS * N * DIM };

static double many[COUNT], one[N * DIM], values[SETS];

TEST_CASE(sets_are_those_of_single_calls)
{
    static const char *const measures[] = {"l2-star", "star", "min-distance"};
    const koksma_run run = {.threads = 3};
    size_t tried = 0;
    for (size_t p = 0; koksma_pattern_at(p); p++) {
        koksma_spec spec;
        koksma_points all = {SETS * N, DIM, many}, single = {N, DIM, one};
        const size_t some = koksma_pattern_at(p)->claims & KOKSMA_CLAIM_INDEPENDENT ? SETS : 5;
        all.n = some * N;
        if (koksma_pattern_at(p)->operand || koksma_pattern_spec(koksma_pattern_at(p)->name, &spec) ||
            koksma_generate(&spec, 0, NULL, &single)) {
            continue;
        }
        assert_ok(koksma_generate_sets(&spec, 90, some, &run, &all));
        for (size_t s = 0; s < some; s += 1 + s / 9) {
            assert_ok(koksma_generate(&spec, 90 + s, NULL, &single));
            assert_memory_equal(one, many + s * N * DIM, sizeof one);
        }
        for (size_t m = 0; m < 3; m++) {
            koksma_spec measure;
            assert_ok(koksma_measure_spec(measures[m], &measure));
            assert_ok(koksma_evaluate_sets(&measure, &all, some, &run, values));
            for (size_t s = 0; s < some; s += 1 + s / 3) {
                koksma_value value;
                const koksma_points set = {N, DIM, many + s * N * DIM};
                assert_ok(koksma_evaluate(&measure, &set, NULL, &value));
                assert_near(values[s], value.value, 0);
            }
        }
        tried++;
    }
    assert_true(tried > 20);
}

static bool no(void *context, double fraction_done)
{
    (void)context;
    (void)fraction_done;
    return false;
}

TEST_CASE(bad_sets_are_refused)
{
    koksma_points all = {SETS * N, DIM, many};
    koksma_spec spec, measure;
    const koksma_run stopped = {.threads = 2, .keep_going = no};
    assert_ok(koksma_pattern_spec("n-rooks", &spec));
    assert_ok(koksma_measure_spec("star", &measure));
    assert_int_equal(koksma_generate_sets(&spec, 0, 0, NULL, &all), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_generate_sets(&spec, 0, 11, NULL, &all), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_generate_sets(&spec, UINT64_MAX - SETS + 2, SETS, NULL, &all), KOKSMA_ARGUMENT);
    assert_ok(koksma_generate_sets(&spec, UINT64_MAX - SETS + 1, SETS, NULL, &all));
    assert_int_equal(koksma_generate_sets(&spec, 0, SETS, &stopped, &all), KOKSMA_INTERRUPTED);
    assert_int_equal(koksma_evaluate_sets(&measure, &all, 11, NULL, values), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_evaluate_sets(&spec, &all, SETS, NULL, values), KOKSMA_ARGUMENT);
    assert_ok(koksma_pattern_spec("jittered", &spec));
    all.n = 3 * 15;
    assert_int_equal(koksma_generate_sets(&spec, 0, 3, NULL, &all), KOKSMA_N);
}
