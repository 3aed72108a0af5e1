/* SPDX-License-Identifier: Apache-2.0 */
/* libkoksma in a program whose locale has a decimal comma: points, specs and errors as text. */
#include <koksma/verify.h>

#include "comma.h"

static void make_points(FILE *out)
{
    static const char *const endings[] = {"txt", "csv", "npy"};
    koksma_points points = test_points("random", 5, 3, 7), again;
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        char path[64];
        snprintf(path, sizeof path, "%s/points.%s", test_folder, endings[i]);
        assert_ok(koksma_points_write(path, &points, NULL, NULL));
        test_take_file(out, path);
        assert_ok(koksma_points_read(path, &again));
        assert_true(again.n == 5 && again.dim == 3);
        assert_memory_equal(again.xs, points.xs, 15 * sizeof *points.xs);
        koksma_points_fini(&again);
    }
    koksma_points_fini(&points);
}

/* Where the point is not read, the first line is taken for a header. */
static void read_points(FILE *out)
{
    char path[64];
    koksma_points points;
    snprintf(path, sizeof path, "%s/three.txt", test_folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("0.5 0.25\n1 1\n0 1\n", file);
    fclose(file);
    assert_ok(koksma_points_read(path, &points));
    fprintf(out, "%zu points of %d coordinates\n", points.n, points.dim);
    fwrite(points.xs, sizeof *points.xs, points.n * (size_t)points.dim, out);
    assert_true(points.n == 3 && points.xs[1] == 0.25);
    koksma_points_fini(&points);
}

static void make_specs(FILE *out)
{
    static const char *const texts[] = {"poisson-disk:d=0.2", "poisson-disk:d=0.2,torus=0",
                                        "gaussian-jittered:sigma=0.125", "poisson-disk:d=1.5e-3",
                                        "poisson-disk:d=0,2"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        koksma_spec spec;
        char text[KOKSMA_MAX_SPEC];
        if (koksma_pattern_spec(texts[i], &spec)) {
            fprintf(out, "%s\n", koksma_error_text());
        } else {
            koksma_spec_text(&spec, text);
            fprintf(out, "%s\n", text);
        }
    }
}

static bool see_comma(void *context, double fraction_done)
{
    (void)fraction_done;
    *(bool *)context = half_is("0,5");
    return true;
}

/* What is called back is the host's code: it keeps the host's locale. */
static void make_errors(FILE *out)
{
    koksma_spec spec;
    koksma_points points;
    koksma_findings findings;
    bool comma = !half_is("0,5");
    koksma_value value;
    const koksma_run run = {.threads = 2, .keep_going = see_comma, .context = &comma};
    assert_ok(koksma_pattern_spec("poisson-disk:d=0.25", &spec));
    assert_ok(koksma_points_init(&points, 1000, 2));
    assert_int_not_equal(koksma_generate(&spec, 7, &run, &points), KOKSMA_OK);
    fprintf(out, "%s\n", koksma_error_text());
    assert_non_null(strstr(koksma_error_text(), "d=0.25"));
    assert_ok(koksma_pattern_spec("poisson-disk:d=0.02", &spec));
    assert_ok(koksma_generate(&spec, 7, &run, &points));
    assert_ok(koksma_measure_spec("l2-star", &spec));
    assert_ok(koksma_evaluate(&spec, &points, &run, &value));
    assert_true(comma == half_is("0,5"));
    assert_ok(koksma_verify(&points, &run, &findings));
    for (size_t i = 0; i < findings.count; i++) {
        fprintf(out, "%s %s\n", findings.items[i].property, findings.items[i].detail);
    }
    koksma_findings_fini(&findings);
    points.xs[3] = 1.5;
    assert_int_equal(koksma_verify(&points, &run, &findings), KOKSMA_ARGUMENT);
    fprintf(out, "%s\n", koksma_error_text());
    koksma_points_fini(&points);
}

TEST_CASE(points_are_written_and_read)
{
    test_same_with_comma(*state, make_points);
    test_same_with_comma(*state, read_points);
}

TEST_CASE(specs_are_parsed_and_told)
{
    test_same_with_comma(*state, make_specs);
}

TEST_CASE(errors_and_findings_are_told)
{
    test_same_with_comma(*state, make_errors);
}

TEST_GROUP(test_comma_begin, test_comma_end)
