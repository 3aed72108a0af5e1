/* SPDX-License-Identifier: Apache-2.0 */
/* The box in which a pattern's points are furthest from their share. */
#include <koksma/koksma.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    koksma_points points = {0};
    koksma_spec pattern, star;
    koksma_value value;
    const int failed = koksma_pattern_spec(argc > 1 ? argv[1] : "n-rooks", &pattern) ||
                       koksma_measure_spec("star", &star) || koksma_points_init(&points, 16, 2) ||
                       koksma_generate(&pattern, 7, NULL, &points) || koksma_evaluate(&star, &points, NULL, &value);
    if (failed) {
        fprintf(stderr, "worst_box: %s\n", koksma_error_text());
    } else {
        printf("%.9g %g..%g x %g..%g\n", value.value, value.witness.lo[0], value.witness.hi[0], value.witness.lo[1],
               value.witness.hi[1]);
    }
    koksma_points_fini(&points);
    return failed;
}
