/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Several tests at once: p-values from resamples, and Holm's step-down correction ("A simple sequentially rejective
 * multiple test procedure", Scandinavian Journal of Statistics 6, 1979). The smallest of n p-values is multiplied by
 * n, the next by n - 1 and so on; a product smaller than the previous result is replaced by that result. This is
 * Bonferroni's test with the closed testing principle.
 */
#include "stats/holm.h"

#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "stats/statistics.h"

double koksma__resampled_p(const double *values, double a, const double *b, double c, size_t samples)
{
    size_t up = 0, down = 0, n = 0;
    for (size_t i = 0; i < samples; i++) {
        const double x = values[i] * a, y = b ? b[i] * c : 0;
        if (!isnan(x - y)) {
            const int sign = koksma__compare(x, y);
            up += sign >= 0;
            down += sign <= 0;
            n++;
        }
    }
    return fmin(1, 2 * (1 + (double)(up < down ? up : down)) / (double)(n + 1));
}

typedef struct test {
    double p;
    size_t index;
} test;

static int compare_tests(const void *a, const void *b)
{
    const test *x = a, *y = b;
    return x->p != y->p ? (x->p > y->p) - (x->p < y->p) : (x->index > y->index) - (x->index < y->index);
}

koksma_status koksma__holm(double *p, size_t n)
{
    test *tests = malloc((n + 1) * sizeof *tests);
    KOKSMA__REQUIRE_MEMORY(tests, (n + 1) * sizeof *tests);
    for (size_t i = 0; i < n; i++) {
        tests[i] = (test){p[i], i};
    }
    qsort(tests, n, sizeof *tests, compare_tests);
    double most = 0;
    for (size_t i = 0; i < n; i++) {
        most = fmax(most, fmin(1, (double)(n - i) * tests[i].p));
        p[tests[i].index] = most;
    }
    free(tests);
    return KOKSMA_OK;
}
