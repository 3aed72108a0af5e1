/* SPDX-License-Identifier: Apache-2.0 */
/* Sets so large that threads share the work of one level: the bits are those of one thread, and sequences go on as
   they began in a set that one thread made by another way. */
#include <string.h>

#include "test.h"

static koksma_points made(const char *text, size_t n, int dim, int threads)
{
    koksma_spec spec;
    koksma_points points;
    const koksma_run run = {.threads = threads};
    assert_ok(koksma_pattern_spec(text, &spec));
    assert_ok(koksma_points_init(&points, n, dim));
    assert_ok(koksma_generate(&spec, 5, &run, &points));
    return points;
}

TEST_CASE(large_sets_are_the_same)
{
    static const struct {
        const char *text;
        int dim;
        bool sequence;
    } cases[] = {{"pmj02", 2, true},
                 {"sobol:scramble=owen", 2, true},
                 {"sobol:scramble=owen", 3, true},
                 {"sobol", 5, true},
                 {"sobol:scramble=hash-owen", 2, true},
                 {"halton:scramble=owen", 2, true},
                 {"halton:scramble=owen", 9, true},
                 {"faure", 3, true},
                 {"faure:scramble=owen", 3, true},
                 {"hammersley:scramble=owen", 3, false},
                 {"random", 2, true},
                 {"n-rooks", 2, false},
                 {"latin-hypercube", 3, false}};
    enum { N = 300001, FEW = 1000 };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        koksma_points one = made(cases[i].text, N, cases[i].dim, 1), three = made(cases[i].text, N, cases[i].dim, 3);
        const size_t bytes = sizeof(double) * (size_t)cases[i].dim;
        assert_memory_equal(one.xs, three.xs, N * bytes);
        if (cases[i].sequence) {
            koksma_points few = made(cases[i].text, FEW, cases[i].dim, 1);
            if (memcmp(few.xs, one.xs, FEW * bytes) != 0) {
                fail_msg("%s in %d dimensions: the first of many points are others", cases[i].text, cases[i].dim);
            }
            koksma_points_fini(&few);
        }
        koksma_points_fini(&one);
        koksma_points_fini(&three);
    }
}
