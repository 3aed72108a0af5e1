/* SPDX-License-Identifier: Apache-2.0 */
/* What R's .C calls: points of a pattern, and their value of a measure. Points are columns, as R stores matrices. */
#include <R.h>
#include <koksma/koksma.h>

static void check(koksma_status status)
{
    if (status) {
        error("%s", koksma_error_text());
    }
}

void koksma_r_generate(char **pattern, double *seed, int *dim, int *n, double *xs)
{
    koksma_spec spec;
    koksma_points points = {(size_t)*n, *dim, xs};
    check(koksma_pattern_spec(*pattern, &spec));
    check(koksma_generate(&spec, (uint64_t)*seed, NULL, &points));
}

void koksma_r_measure(char **measure, int *dim, int *n, double *xs, double *value)
{
    koksma_spec spec;
    koksma_points points = {(size_t)*n, *dim, xs};
    koksma_value of_points;
    check(koksma_measure_spec(*measure, &spec));
    check(koksma_evaluate(&spec, &points, NULL, &of_points));
    *value = of_points.value;
}
