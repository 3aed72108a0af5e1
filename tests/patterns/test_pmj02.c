/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What Christensen, Kensler & Kilpatrick 2018 state of the errors of progressive multi-jittered (0,2) sequences, for their
 * functions and 100 sequences: at powers of two the root mean square error falls about as N^-1.5 for the smooth
 * functions, as N^-0.75 for the edges of a disk and a triangle, and as N^-1 for a step along an axis, where that of random
 * points falls as N^-0.5; and any prefix is well distributed. The nets behind it are claims (net2-prefixes, classes).
 * docs/findings/integration.md has the slopes.
 */
#include "pattern_sets.h"

enum { SEQUENCES = 100, N = 4096, STEP = 4 };

/* Slopes of log error against log N from 64 to 4,096 points; of steps 0: see below. */
static const double slopes[INTEGRANDS] = {-1.5, -1.5, -1.5, -0.75, 0, 0, -0.75};

/* errors[n][f]: the root mean square error of the first n points. */
static void errors_of(const char *spec, double errors[N + 1][INTEGRANDS])
{
    for (size_t n = 0; n <= N; n++) {
        for (int k = 0; k < INTEGRANDS; k++) {
            errors[n][k] = 0;
        }
    }
    for (uint64_t seed = 0; seed < SEQUENCES; seed++) {
        koksma_points points = test_points(spec, N, 2, seed);
        double sums[INTEGRANDS] = {0};
        for (size_t i = 0; i < N; i++) {
            add_integrands(points.xs + 2 * i, sums);
            for (int k = 0; k < INTEGRANDS; k++) {
                const double error = sums[k] / (double)(i + 1) - integrands[k].mean;
                errors[i + 1][k] += error * error / SEQUENCES;
            }
        }
        koksma_points_fini(&points);
    }
    for (size_t n = 0; n <= N; n++) {
        for (int k = 0; k < INTEGRANDS; k++) {
            errors[n][k] = sqrt(errors[n][k]);
        }
    }
}

TEST_CASE(errors_fall_as_published)
{
    static const char *const specs[] = {"pmj02", "pmj02:shuffle=1", "pmj02bn:levels=4"};
    static double errors[N + 1][INTEGRANDS], random[N + 1][INTEGRANDS];
    errors_of("random", random);
    for (size_t s = 0; s < sizeof specs / sizeof *specs; s++) {
        errors_of(specs[s], errors);
        for (int k = 0; k < INTEGRANDS; k++) {
            double slope = 0; /* least squares over n = 64, 256, 1024, 4096 */
            for (int j = 0; j < 4; j++) {
                slope += (2 * j - 3) * log2(errors[64u << 2 * j][k]) / 20;
            }
            /* from 100 sequences a slope has a standard error of .02; N^-1.5 has a power of log N before it, so that
               slopes up to 4,096 points are about -1.42 */
            assert_that(slopes[k] >= 0 || fabs(slope - slopes[k]) < 0.15,
                        "%s, %s: the error falls as N^%.2f, not N^%.2f", specs[s], integrands[k].name, slope,
                        slopes[k]);
            for (size_t n = 16; n <= N; n++) {
                assert_that(errors[n][k] < 0.75 * random[n][k],
                            "%s, %s: the first %zu points have %.2f of the error of random points", specs[s],
                            integrands[k].name, n, errors[n][k] / random[n][k]);
            }
        }
        /* a step along an axis: of 2^m points one stratum of 1/2^m is in doubt, so that the error is below N^-1 */
        for (size_t n = 2; n <= N; n *= 2) {
            assert_true(errors[n][STEP] < 1 / (double)n && errors[n][STEP + 1] < 1 / (double)n);
        }
    }
}
