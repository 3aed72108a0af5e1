/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions that a program computes (koksma_values_by_command): points go to its standard input as text with 17
 * digits, values come from its standard output. core/platform/processes.h documents its limits and its end.
 */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/estimate.h>

#include "core/c_locale.h"
#include "core/platform/processes.h"
#include "core/status.h"

enum { COORDINATES = 1 << 20, DIGITS = 26, BYTES_A_VALUE = 64, BYTES_BESIDE = 1 << 16 };

/* The points as text. *size receives its length. */
static char *text_of(const koksma_points *points, size_t *size)
{
    const size_t dim = (size_t)points->dim, count = points->n * dim;
    char *text = malloc(count * DIGITS + 1);
    *size = 0;
    for (size_t i = 0; i < count && text; i++) {
        *size +=
            (size_t)koksma__snprintf(text + *size, DIGITS + 1, "%.17g%c", points->xs[i], (i + 1) % dim ? ' ' : '\n');
    }
    return text;
}

/* Reads n numbers. The text ends with a 0. */
static koksma_status parse(const char *command, const char *text, size_t n, double *values)
{
    size_t count = 0;
    while (isspace((unsigned char)*text)) {
        text++;
    }
    for (char *end; *text; count++) {
        const double value = koksma__strtod(text, &end);
        KOKSMA__FAIL_IF(end == text || (*end && !isspace((unsigned char)*end)), KOKSMA_MALFORMED,
                        "%s: value %zu is no number: '%.*s'", command, count,
                        (int)(strcspn(text, " \t\r\n") < 40 ? strcspn(text, " \t\r\n") : 40), text);
        if (count < n) {
            values[count] = value;
        }
        for (text = end; isspace((unsigned char)*text);) {
            text++;
        }
    }
    KOKSMA__FAIL_IF(count != n, KOKSMA_MALFORMED, "%s: it printed %zu values for %zu points", command, count, n);
    return KOKSMA_OK;
}

static koksma_status run_once(const koksma_values_command *c, const koksma_points *points, double *values)
{
    size_t input_size, size;
    char *input = text_of(points, &input_size), *output = NULL, *command = strdup(c->command);
    koksma_status status = input && command ? KOKSMA_OK : koksma__fail_memory(points->n * DIGITS);
    if (!status) {
        char *const arguments[] = {(char[]){"/bin/sh"}, (char[]){"-c"}, command, NULL};
        const koksma__child child = {.name = c->command,
                                     .arguments = arguments,
                                     .seconds = c->seconds,
                                     .most_output = points->n * BYTES_A_VALUE + BYTES_BESIDE,
                                     .most_memory = UINT64_MAX,
                                     .input = input,
                                     .input_size = input_size};
        status = koksma__child_run(&child, c->run, &output, &size);
    }
    char *text = status ? NULL : realloc(output, size + 1);
    if (!status && !text) {
        free(output);
        status = koksma__fail_memory(size + 1);
    } else if (!status) {
        text[size] = 0;
        status = strlen(text) == size
                     ? parse(c->command, text, points->n, values)
                     : koksma__fail(KOKSMA_MALFORMED, "%s: it printed bytes that are no text", c->command);
    }
    free(text);
    free(input);
    free(command);
    return status;
}

koksma_status koksma_values_by_command(void *context, const koksma_points *points, double *values)
{
    KOKSMA__REQUIRE(context, points, values);
    const koksma_values_command *c = context;
    KOKSMA__REQUIRE(c->command, points->xs);
    KOKSMA__REQUIRE_RUN(c->run);
    KOKSMA__FAIL_IF(!*c->command, KOKSMA_ARGUMENT, "command: it is empty");
    KOKSMA__FAIL_IF(!(c->seconds > 0), KOKSMA_ARGUMENT, "seconds: it takes more than 0, not %g", c->seconds);
    KOKSMA__FAIL_IF(points->dim < 1 || points->dim > KOKSMA_MAX_DIM, KOKSMA_DIM, "points: dim: %d dimensions",
                    points->dim);
    KOKSMA__FAIL_IF(points->n < 1 || points->n > KOKSMA_MAX_COORDINATES / (unsigned)points->dim, KOKSMA_ARGUMENT,
                    "points: n: %zu points", points->n);
    const size_t dim = (size_t)points->dim, most = COORDINATES / dim;
    for (size_t first = 0; first < points->n; first += most) {
        const koksma_points part = {points->n - first < most ? points->n - first : most, points->dim,
                                    points->xs + first * dim};
        KOKSMA__TRY(run_once(c, &part, values + first));
    }
    return KOKSMA_OK;
}
