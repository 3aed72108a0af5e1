/* SPDX-License-Identifier: Apache-2.0 */
/* What a word that the program does not know probably means: the nearest name of a table or list, or the option that has
   the meaning of one of other programs. */
#include <stdio.h>
#include <string.h>

#include "cli.h"

const char *cli_meant(const char *word, koksma_name_at *name, const void *table, char text[96])
{
    const char *closest = koksma_closest_name(word, name, table);
    closest = closest && strcmp(closest, word) ? closest : NULL; /* then something else is wrong */
    snprintf(text, 96, closest ? "did you mean '%s'? " : "%.0s", closest ? closest : "");
    return text;
}

enum { MAX_LISTED = 64 };

static const char *listed_name(const void *names, size_t i)
{
    return i < MAX_LISTED ? ((const char *const *)names)[i] : NULL;
}

const char *cli_meant_of(const char *word, const char *list, char text[96])
{
    char words[1024];
    const char *names[MAX_LISTED] = {NULL};
    size_t n = 0;
    snprintf(words, sizeof words, "%s", list);
    for (char *at = strtok(words, ", |"); at && n < MAX_LISTED; at = strtok(NULL, ", |")) {
        if (strcmp(at, "or") != 0) {
            names[n++] = at;
        }
    }
    return cli_meant(word, listed_name, names, text);
}

static const char *option_name(const void *options, size_t i)
{
    return i ? ((const cli_option *)options)[i - 1].name : "help";
}

/* Names that other programs give to options, and what has that meaning here, the first that the command has. */
static const struct {
    const char *name, *ours[2];
} foreign_options[] = {
    {"samples", {"spp", "n"}},
    {"samples-per-pixel", {"spp"}},
    {"num-samples", {"spp", "n"}},
    {"sample-count", {"spp", "n"}},
    {"count", {"n", "spp"}},
    {"points", {"n"}},
    {"num-points", {"n"}},
    {"sampler", {"patterns"}},
    {"metric", {"measures", "metric"}},
    {"measure", {"metric"}},
    {"timeout", {"time-limit"}},
    {"max-time", {"time-limit"}},
    {"csv", {"format"}},
    {"latex", {"format"}},
    {"tex", {"format"}},
    {"max-depth", {"depth"}},
    {"bounces", {"depth"}},
    {"error", {"target-error", "tolerance"}},
    {"tol", {"tolerance"}},
    {"width", {"size"}},
    {"height", {"size"}},
    {"resolution", {"size"}},
    {"res", {"size"}},
    {"skip", {"first"}},
    {"offset", {"first"}},
    {"start", {"first"}},
    {"jobs", {"threads"}},
    {"cores", {"threads"}},
    {"verbose", {"long"}},
    {"precision", {"digits"}},
    {"replicates", {"trials"}},
    {"repeat", {"trials"}},
    {"ref", {"reference"}},
    {"out", {"output"}},
    {"file", {"output"}},
    {"rng", {"seed"}},
    {"random-state", {"seed"}},
    {"dimension", {"dim"}},
    {"ndim", {"dim"}},
};

static const cli_option *find(const cli_option *options, const char *name)
{
    while (options->name && strcmp(options->name, name) != 0) {
        options++;
    }
    return options->name ? options : NULL;
}

const char *cli_meant_option(const cli_option *options, const char *name, char text[128])
{
    const cli_option *meant = NULL;
    for (size_t i = 0; i < sizeof foreign_options / sizeof *foreign_options; i++) {
        for (int k = 0; !meant && !strcmp(name, foreign_options[i].name) && k < 2 && foreign_options[i].ours[k];
             k++) {
            meant = find(options, foreign_options[i].ours[k]);
        }
    }
    if (meant) {
        const bool is_choice = strcmp(meant->name, "format") == 0 && strstr(meant->argument, name);
        snprintf(text, 128, "did you mean --%s%s%s? ", meant->name, is_choice ? " " : "", is_choice ? name : "");
        return text;
    }
    if (!strncmp(name, "scramble", 8)) {
        return "it is a parameter of patterns, as in sobol:scramble=owen; ";
    }
    const char *closest = koksma_closest_name(name, option_name, options);
    snprintf(text, 128, closest ? "did you mean --%s? " : "%.0s", closest ? closest : "");
    return text;
}
