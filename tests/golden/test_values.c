/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Known values of measures: the lines of values.txt, which says at its top how a line is written. A case needs no C. Each
 * number may be a formula, since most known values are.
 */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "test.h"

enum { MAX_CASE = 4096 };

/* ---- Formulas: + - * / ^, parentheses, sqrt(), pi ------------------------------------------------------------ */

static double sum_of(const char **at);

static void skip_blanks(const char **at)
{
    *at += strspn(*at, " \t");
}

static double factor_of(const char **at)
{
    double x;
    skip_blanks(at);
    const bool root = !strncmp(*at, "sqrt(", 5), negative = **at == '-';
    if (negative) {
        ++*at;
        return -factor_of(at);
    }
    if (root || **at == '(') {
        *at += root ? 5 : 1;
        x = sum_of(at);
        x = root ? sqrt(x) : x;
        assert_int_equal(**at, ')');
        ++*at;
    } else if (!strncmp(*at, "pi", 2)) {
        x = M_PI;
        *at += 2;
    } else {
        char *end;
        x = strtod(*at, &end);
        assert_that(end != *at, "no number at '%s'", *at);
        *at = end;
    }
    skip_blanks(at);
    if (**at == '^') {
        ++*at;
        x = pow(x, factor_of(at));
    }
    return x;
}

static double product_of(const char **at)
{
    double x = factor_of(at);
    for (skip_blanks(at); **at == '*' || **at == '/'; skip_blanks(at)) {
        const char sign = *(*at)++;
        const double y = factor_of(at);
        x = sign == '*' ? x * y : x / y;
    }
    return x;
}

static double sum_of(const char **at)
{
    double x = product_of(at);
    for (skip_blanks(at); **at == '+' || **at == '-'; skip_blanks(at)) {
        const char sign = *(*at)++;
        const double y = product_of(at);
        x = sign == '+' ? x + y : x - y;
    }
    return x;
}

/* ---- Points --------------------------------------------------------------------------------------------------- */

/* "[x y, x y]" */
static koksma_points listed_points(const char *text)
{
    double xs[256];
    size_t count = 0, n = 1;
    koksma_points points;
    for (const char *at = text + 1; *at && *at != ']' && count < 256; skip_blanks(&at)) {
        n += *at == ',';
        at += *at == ',';
        xs[count++] = sum_of(&at);
    }
    assert_int_equal(count % n, 0);
    assert_ok(koksma_points_init(&points, n, (int)(count / n)));
    memcpy(points.xs, xs, count * sizeof *xs);
    return points;
}

/* SPEC@N or SPEC@N@DIM */
static koksma_points generated_points(const char *spec, uint64_t seed)
{
    char text[256];
    snprintf(text, sizeof text, "%s", spec);
    char *at = strchr(text, '@'), *dim = at ? strchr(at + 1, '@') : NULL;
    if (!at) {
        fail_msg("%s: neither SPEC@N nor a file", text);
        return (koksma_points){0};
    }
    *at = 0;
    return test_points(text, strtoul(at + 1, NULL, 10), dim ? atoi(dim + 1) : 2, seed);
}

static koksma_points points_of(const char *text)
{
    koksma_points points;
    char path[1024];
    if (*text == '[') {
        return listed_points(text);
    }
    if (!strstr(text, ".npy")) {
        return generated_points(text, 0);
    }
    snprintf(path, sizeof path, "%s/golden/%s", KOKSMA_TESTS, text);
    assert_ok(koksma_points_read(path, &points));
    return points;
}

/* ---- Cases ---------------------------------------------------------------------------------------------------- */

/* The mean of a measure over the seeds 0 .. sets - 1, or with "^2" at its end of the square; and its standard error. */
static double mean_of(const char *spec, uint64_t sets, char *measure, double *error)
{
    char *power = strstr(measure, "^2");
    double sum = 0, squares = 0;
    if (power) {
        *power = 0;
    }
    for (uint64_t seed = 0; seed < sets; seed++) {
        koksma_points points = generated_points(spec, seed);
        const double value = test_measure(measure, &points).value, x = power ? value * value : value;
        sum += x / (double)sets;
        squares += x * x / (double)sets;
        koksma_points_fini(&points);
    }
    *error = sqrt(fmax(squares - sum * sum, 0) / (double)(sets - 1));
    return sum;
}

/* "SPEC@N@DIM x SETS; FACTOR; MEASURE = MEAN +- ERROR; .." Returns the number of means. */
static size_t check_means(char *spec, uint64_t sets, double factor, char *rest)
{
    size_t count = 0;
    for (char *item; (item = strtok_r(NULL, ";", &rest)); count++) {
        item += strspn(item, " ");
        char *equals = strstr(item, " = "), *give = strstr(item, " +- ");
        assert_non_null(equals);
        *equals = 0;
        const char *at = equals + 3, *margin = give ? give + 4 : "0";
        double error;
        const double expected = sum_of(&at), known = sum_of(&margin), mean = mean_of(spec, sets, item, &error);
        assert_that(fabs(mean - expected) <= factor * hypot(error, known) + 1e-8,
                    "%s: the mean of %s is %.7g +- %.2g, and should be %.7g", spec, item, mean, error, expected);
    }
    return count;
}

/* "POINTS; TOLERANCE; MEASURE = VALUE; MEASURE = VALUE .." Returns the number of values. */
static size_t check_case(char *text)
{
    size_t count = 0;
    char *rest = NULL, name[256];
    char *set = strtok_r(text, ";", &rest), *bound = strtok_r(NULL, ";", &rest);
    assert_non_null(bound);
    snprintf(name, sizeof name, "%s", set);
    const char *at = bound;
    const double tolerance = sum_of(&at);
    char *sets = strstr(set, " x ");
    if (sets) {
        *sets = 0;
        return check_means(set, strtoul(sets + 3, NULL, 10), tolerance, rest);
    }
    koksma_points points = points_of(set);
    for (char *item; (item = strtok_r(NULL, ";", &rest)); count++) {
        item += strspn(item, " ");
        char *equals = strstr(item, " = ");
        assert_non_null(equals);
        *equals = 0;
        at = equals + 3;
        const double expected = sum_of(&at), value = test_measure(item, &points).value;
        if (!(fabs(value - expected) <= tolerance) || *at) {
            fail_msg("%s: %s is %.17g, and should be %.17g%s", name, item, value, expected, *at ? at : "");
        }
    }
    koksma_points_fini(&points);
    return count;
}

TEST_CASE(values_are_known)
{
    char path[1024], line[1024], text[MAX_CASE] = "";
    size_t count = 0;
    snprintf(path, sizeof path, "%s/golden/values.txt", KOKSMA_TESTS);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    for (bool more = true; more;) {
        more = fgets(line, sizeof line, file);
        line[more ? strcspn(line, "\n") : 0] = 0;
        if (*line == '#') {
            continue;
        }
        if (*text && !isblank((unsigned char)*line)) {
            count += check_case(text);
            *text = 0;
        }
        assert_true(strlen(text) + strlen(line) < MAX_CASE);
        strcat(text, line);
    }
    fclose(file);
    assert_true(count > 500);
}
