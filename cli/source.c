/* SPDX-License-Identifier: Apache-2.0 */
#include "source.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char prefix[] = "pattern:";

/* Splits "SPEC@N" or "SPEC@N@DIM" at its last one or two '@'. */
static bool split(char *text, size_t *n, int *dim)
{
    char *last = strrchr(text, '@');
    if (!last) {
        return false;
    }
    *last = '\0';
    char *before = strrchr(text, '@'), *end;
    char *n_text = last + 1;
    *dim = 2;
    if (before && before[1 + strspn(before + 1, "0123456789")] == '\0') {
        *dim = (int)strtol(last + 1, &end, 10);
        if (last[1] < '0' || last[1] > '9' || *end) {
            return false;
        }
        *before = '\0';
        n_text = before + 1;
    }
    *n = strtoull(n_text, &end, 10);
    return n_text[0] >= '0' && n_text[0] <= '9' && !*end;
}

static koksma_status generate(const char *text, size_t n, int dim, uint64_t seed, const koksma_run *run,
                              koksma_points *points)
{
    koksma_spec spec;
    koksma_status status = koksma_pattern_spec(text, &spec);
    if (!status) {
        status = koksma_points_init(points, n, dim);
    }
    return status ? status : koksma_generate(&spec, seed, run, points);
}

int cli_source_points(const cli_arguments *arguments, const char *source, uint64_t seed, const koksma_run *run,
                      koksma_points *points)
{
    koksma_status status;
    *points = (koksma_points){0};
    if (strncmp(source, prefix, sizeof prefix - 1) != 0) {
        status = koksma_points_read(source, points);
    } else {
        char text[KOKSMA_MAX_SPEC];
        size_t n;
        int dim;
        snprintf(text, sizeof text, "%s", source + sizeof prefix - 1);
        if (!split(text, &n, &dim)) {
            return cli_usage_error(arguments, "'%s' is not of the form pattern:SPEC@N or pattern:SPEC@N@DIM", source);
        }
        status = generate(text, n, dim, seed, run, points);
    }
    return status ? cli_fail(arguments, status) : CLI_YES;
}
