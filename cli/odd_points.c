/* SPDX-License-Identifier: Apache-2.0 */
/* What in a file's points looks like a mistake, but can be measured. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cli.h"
#include "source.h"

void cli_warn_points(const cli_arguments *arguments, const char *path, const koksma_points *points, const char *said)
{
    char text[CLI_ODDITIES];
    if (!cli_given(arguments, "quiet") && koksma_points_oddities(points, text, sizeof text)) {
        for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
            if (!said || !strstr(said, line)) {
                cli_say(arguments->command->name, "%s: warning: %s", path, line);
            }
        }
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
            cli_warn_points(arguments, name, &points, NULL);
            if (n && n < points.n && !cli_given(arguments, "quiet")) {
                cli_say(arguments->command->name,
                        "note: %s: the first %llu of its %zu points; only a sequence is balanced at each number",
                        name, (unsigned long long)n, points.n);
            }
            koksma_points_fini(&points);
        }
    }
}
