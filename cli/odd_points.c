/* SPDX-License-Identifier: Apache-2.0 */
/* What in a file's points looks like a mistake, but can be measured. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli.h"
#include "source.h"

void cli_warn_small(const cli_arguments *arguments, const char *path, const koksma_points *points)
{
    double largest = 0;
    for (size_t i = 0; i < points->n * (size_t)points->dim; i++) {
        largest = fmax(largest, points->xs[i]);
    }
    if (points->n >= 16 && largest > 0 && largest < 0.02 && !cli_given(arguments, "quiet")) {
        cli_say(arguments->command->name,
                "%s: warning: all coordinates are at most %.3g; is the unit or --scale right?", path, largest);
    }
}

enum { MOST_COMPARED = 1 << 16 }; /* rows of a file that are looked at for equal ones, in 20 ms */
static size_t row_size;

static int by_values(const void *a, const void *b)
{
    const double *const p = *(const double *const *)a, *const q = *(const double *const *)b;
    const int order = memcmp(p, q, row_size);
    return order ? order : (p > q) - (p < q);
}

/* Warns of points that a file has more than once. */
static void warn_of_twins(const char *command, const char *path, const koksma_points *points)
{
    const size_t n = points->n, dim = (size_t)points->dim;
    const double **rows = n <= MOST_COMPARED ? malloc(n * sizeof *rows) : NULL, *first = NULL, *twin = NULL;
    size_t twins = 0;
    if (!rows) {
        return;
    }
    row_size = dim * sizeof(double);
    for (size_t i = 0; i < n; i++) {
        rows[i] = points->xs + i * dim;
    }
    qsort(rows, n, sizeof *rows, by_values);
    for (size_t i = 1; i < n; i++) {
        if (!memcmp(rows[i], rows[i - 1], row_size)) {
            first = !twins || rows[i] < twin ? rows[i - 1] : first;
            twin = !twins++ || rows[i] < twin ? rows[i] : twin;
        }
    }
    free(rows);
    if (twins) {
        cli_say(command, "%s: warning: %zu of %zu points equal earlier ones; the first is point %zu, like point %zu",
                path, twins, n, (size_t)(twin - points->xs) / dim + 1, (size_t)(first - points->xs) / dim + 1);
    }
}

void cli_warn_points(const cli_arguments *arguments, const char *path, const koksma_points *points)
{
    const char *command = arguments->command->name;
    const size_t n = points->n, dim = (size_t)points->dim;
    if (n < 2 || dim < 2 || cli_given(arguments, "quiet")) {
        return;
    }
    for (size_t k = 0; k < dim; k++) {
        size_t same = 1, counted = 1; /* rows with the value of the first, and with 1 more than the row before */
        while (same < n && points->xs[same * dim + k] == points->xs[k]) {
            same++;
        }
        while (counted < n && points->xs[counted * dim + k] == points->xs[k] + (double)counted) {
            counted++;
        }
        if (same == n) {
            cli_say(command, "%s: warning: column %zu is %.9g in all rows; is it a coordinate?", path, k + 1,
                    points->xs[k]);
        } else if (counted == n && k == 0) {
            cli_say(command, "%s: warning: the first column counts the rows; if it is an index, leave it out", path);
        }
    }
    cli_warn_small(arguments, path, points);
    warn_of_twins(command, path, points);
    if (dim > 3 && 2 * n < dim) {
        cli_say(command, "%s: warning: a point in %zu dimensions on each of %zu lines; are rows and columns swapped?",
                path, dim, n);
    }
}

bool cli_warn_unbalanced(const cli_arguments *arguments, const koksma_spec *spec, uint64_t n)
{
    const unsigned in_twos = KOKSMA_CLAIM_NET2_PREFIXES | KOKSMA_CLAIM_LATTICE_PREFIXES;
    uint64_t below = 1;
    while (below <= n / 2) {
        below *= 2;
    }
    const bool is_so = spec->pattern && spec->pattern->claims & in_twos && below != n;
    if (is_so && !cli_given(arguments, "quiet")) {
        cli_say(arguments->command->name, "note: %s is balanced at powers of 2: %llu or %llu points, not %llu",
                spec->pattern->name, (unsigned long long)below, 2 * (unsigned long long)below, (unsigned long long)n);
    }
    return is_so;
}

void cli_warn_file(const cli_arguments *arguments, const char *pattern, uint64_t n)
{
    const char *use = strstr(pattern, "=file:"), *path = use ? use + 6 : pattern + 5;
    char name[KOKSMA_MAX_SPEC];
    koksma_points points;
    struct stat info;
    if (use || !strncmp(pattern, "file:", 5)) {
        snprintf(name, sizeof name, "%.*s", (int)strcspn(path, ",;@\n"), path);
        const bool plain = !stat(name, &info) && S_ISREG(info.st_mode); /* a pipe is refused, without reading it */
        if (plain && !koksma_points_read(name, &points)) {
            cli_warn_points(arguments, name, &points);
            if (n && n < points.n && !cli_given(arguments, "quiet")) {
                cli_say(arguments->command->name,
                        "note: %s: the first %llu of its %zu points; only a sequence is balanced at each number",
                        name, (unsigned long long)n, points.n);
            }
            koksma_points_fini(&points);
        }
    }
}
