/* SPDX-License-Identifier: Apache-2.0 */
/* Means of the measures of Shirley 1991 over 1,000 sets of 16 points for its seven patterns, within three standard
   errors of values found with an independent implementation from 20,000 sets (whose own error is the +- below). */
#include "test.h"

enum { SETS = 1000, N = 16 };

static const char *const measures[] = {"star", "l2-star", "extreme", "extreme:grid=20"};

static const struct {
    const char *pattern;
    double mean[4], error[4];
} expected[] = {
    {"n-rooks", {0.16685, 0.04682, 0.26432, 0.21725}, {0.00019, 0.00006, 0.00018, 0.00018}},
    {"half-jittered", {0.18677, 0.04641, 0.32808, 0.25978}, {0.00015, 0.00002, 0.00021, 0.00022}},
    {"jittered", {0.19518, 0.04960, 0.31713, 0.25950}, {0.00021, 0.00004, 0.00028, 0.00027}},
    {"poisson-disk:d=0.2", {0.20000, 0.05296, 0.32760, 0.26122}, {0.00025, 0.00007, 0.00034, 0.00031}},
    {"regular", {0.234375, 0.0597257549, 0.4375, 0.36}, {1e-9, 1e-9, 1e-9, 1e-9}},
    {"poisson-disk:d=0.1", {0.24829, 0.07392, 0.35565, 0.30184}, {0.00035, 0.00015, 0.00034, 0.00034}},
    {"random", {0.28827, 0.08912, 0.40432, 0.35205}, {0.00044, 0.00019, 0.00043, 0.00043}},
};

static void means_of_sixteen_points(void **state)
{
    (void)state;
    for (size_t p = 0; p < sizeof expected / sizeof *expected; p++) {
        double sum[4] = {0}, squares[4] = {0};
        for (uint64_t seed = 0; seed < SETS; seed++) {
            koksma_points points = test_points(expected[p].pattern, N, 2, 1 + seed);
            for (int m = 0; m < 4; m++) {
                const double value = test_measure(measures[m], &points).value;
                sum[m] += value;
                squares[m] += value * value;
            }
            koksma_points_fini(&points);
        }
        for (int m = 0; m < 4; m++) {
            const double mean = sum[m] / SETS, variance = fmax(squares[m] / SETS - mean * mean, 0);
            const double error = hypot(sqrt(variance / SETS), expected[p].error[m]);
            if (!(fabs(mean - expected[p].mean[m]) <= 3 * error + 1e-8)) {
                fail_msg("%s %s: mean %.6f, expected %.6f, %.2f standard errors away", expected[p].pattern,
                         measures[m], mean, expected[p].mean[m], fabs(mean - expected[p].mean[m]) / error);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(means_of_sixteen_points)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
