/* SPDX-License-Identifier: Apache-2.0 */
/* Operands that name points: files, - for standard input, and pattern:SPEC@N[@DIM]. */
#include "source.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char prefix[] = "pattern:";

/* Splits "SPEC@N" or "SPEC@N@DIM" at its last one or two '@'; *dim is 0 when no set has so many. */
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
        const long number = strtol(last + 1, &end, 10);
        *dim = number >= 1 && number <= KOKSMA_MAX_DIM ? (int)number : 0;
        if (last[1] < '0' || last[1] > '9' || *end) {
            return false;
        }
        *before = '\0';
        n_text = before + 1;
    }
    const unsigned long long count = strtoull(n_text, &end, 10);
    *n = count < SIZE_MAX ? (size_t)count : SIZE_MAX; /* 32 bits */
    return n_text[0] >= '0' && n_text[0] <= '9' && !*end;
}

bool cli_source_is_spec(const char *text)
{
    char copy[KOKSMA_MAX_SPEC];
    size_t n;
    int dim;
    snprintf(copy, sizeof copy, "%s", text);
    return strncmp(text, prefix, sizeof prefix - 1) != 0 && split(copy, &n, &dim);
}

int cli_source_open(const cli_arguments *arguments, const char *text, cli_source *source)
{
    char copy[KOKSMA_MAX_SPEC];
    *source = (cli_source){.is_pattern = strncmp(text, prefix, sizeof prefix - 1) == 0};
    if (!source->is_pattern) {
        return CLI_YES;
    }
    snprintf(copy, sizeof copy, "%s", text + sizeof prefix - 1);
    if (!split(copy, &source->n, &source->dim)) {
        return cli_usage_error(arguments, "'%s' is not of the form pattern:SPEC@N or pattern:SPEC@N@DIM", text);
    }
    if (source->dim == 0) {
        return cli_usage_error(arguments, "'%s': the number of dimensions is 1 to %d", text, KOKSMA_MAX_DIM);
    }
    const koksma_status status = koksma_pattern_spec(copy, &source->spec);
    return status ? cli_fail(arguments, status) : CLI_YES;
}

/* For the end of an error about a file: what was meant, if its name begins as a pattern's spec does; else "". */
static const char *hint(const char *operand, char *text, size_t size)
{
    char name[64];
    const size_t length = strcspn(operand, "@:");
    bool plausible = operand[length] && length < sizeof name && strlen(operand) + 32 < size;
    for (const char *s = operand; *s; s++) {
        plausible = plausible && !iscntrl((unsigned char)*s); /* an error is one line */
    }
    snprintf(name, sizeof name, "%.*s", plausible ? (int)length : 0, operand);
    if (!koksma_pattern_find(name)) {
        return "";
    }
    snprintf(text, size, "; did you mean %s%s%s?", prefix, operand, strchr(operand, '@') ? "" : "@N");
    return text;
}

int cli_source_points(const cli_arguments *arguments, const char *text, uint64_t seed, const koksma_run *run,
                      koksma_points *points)
{
    cli_source source;
    *points = (koksma_points){0};
    const int code = cli_source_open(arguments, text, &source);
    if (code) {
        return code;
    }
    koksma_status status;
    if (source.is_pattern) {
        status = koksma_points_init(points, source.n, source.dim);
        status = status ? status : koksma_generate(&source.spec, seed, run, points);
    } else {
        status = koksma_points_read(text, points);
    }
    if (status == KOKSMA_MISSING && !source.is_pattern) {
        char meant[KOKSMA_MAX_SPEC];
        cli_usage_error(arguments, "%s%s", koksma_error_text(), hint(text, meant, sizeof meant));
        return koksma_status_exit_code(status);
    }
    return status ? cli_fail(arguments, status) : CLI_YES;
}

bool cli_sources_check(const cli_arguments *arguments, int first, uint64_t trials, size_t n_warps)
{
    size_t n_stdin = 0;
    for (int i = first; i < arguments->n_operands; i++) {
        const char *text = arguments->operands[i];
        n_stdin += strcmp(text, "-") ? 0 : n_warps > 1 ? n_warps : 1;
        if (n_stdin > 1) {
            cli_usage_error(arguments, "-: stdin can be read once");
            return false;
        }
        if (trials > 1 && strncmp(text, prefix, sizeof prefix - 1) != 0) {
            char meant[KOKSMA_MAX_SPEC];
            cli_usage_error(arguments, "--trials: '%s' is one set; it takes pattern: sources%s", text,
                            hint(text, meant, sizeof meant));
            return false;
        }
    }
    return true;
}
