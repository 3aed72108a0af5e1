/* SPDX-License-Identifier: Apache-2.0 */
#include "curves.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "source.h"

bool cli_curves_begin(const cli_arguments *arguments, cli_curves *c)
{
    *c = (cli_curves){.arguments = arguments};
    c->method = cli_flag(arguments, "exact") ? KOKSMA_SPECTRUM_EXACT : KOKSMA_SPECTRUM_FAST;
    return cli_whole(arguments, "seed", 0, 0, UINT64_MAX, &c->seed) &&
           cli_whole(arguments, "trials", 1, 1, 1000000000, &c->trials) &&
           cli_whole(arguments, "half", 0, 1, KOKSMA_SPECTRUM_MAX_HALF, &c->half) &&
           cli_whole(arguments, "bins", 100, 1, 1000000, &c->bins) &&
           cli_real(arguments, "r-max", 0, 1e-6, 0.5, &c->r_max) && cli_work_begin(arguments, "curves", &c->work);
}

/* Whether word is one of words; all of them as in "a, b or c" in text, of `size` characters. */
static bool find_word(const char *words, const char *word, char *text, size_t size)
{
    bool found = false;
    size_t used = 0;
    for (const char *at = words; *at; at += strspn(at, " ")) {
        const size_t length = strcspn(at, " ");
        const char *joint = at == words ? "" : at[length] ? ", " : " or ";
        found = found || (strlen(word) == length && !strncmp(at, word, length));
        used += (size_t)snprintf(text + used, size - used, "%s%.*s", joint, (int)length, at);
        at += length;
    }
    return found;
}

bool cli_options_fit(const cli_arguments *arguments, const cli_kinds *table, const char *kind, const char *before)
{
    for (const cli_kinds *row = table; row->option; row++) {
        char kinds[128];
        if (cli_flag(arguments, row->option) && !find_word(row->kinds, kind, kinds, sizeof kinds)) {
            cli_usage_error(arguments, "--%s goes with %s%s", row->option, before, kinds);
            return false;
        }
    }
    return true;
}

/* Calls add for the points of each trial; a set that is not of the plane ends it. */
static int for_each_set(cli_curves *c, const char *source,
                        koksma_status (*add)(cli_curves *c, const koksma_points *points, void *context),
                        void *context)
{
    int code = CLI_YES;
    for (uint64_t t = 0; t < c->trials && !code; t++) {
        koksma_points points;
        code = cli_source_points(c->arguments, source, c->seed + t, &c->work.run, &points);
        if (!code) {
            const koksma_status status = add(c, &points, context);
            cli_work_end(&c->work);
            code = status              ? cli_fail(c->arguments, status)
                   : cli_interrupted() ? koksma_status_exit_code(KOKSMA_INTERRUPTED)
                                       : CLI_YES;
        }
        koksma_points_fini(&points);
    }
    return code;
}

typedef struct spectrum_sum {
    koksma_spectrum *spectrum;
    double per_root;
} spectrum_sum;

static koksma_status add_spectrum(cli_curves *c, const koksma_points *points, void *context)
{
    const spectrum_sum *s = context;
    koksma_status status = KOKSMA_OK;
    if (s->spectrum->sets == 0) {
        const double wish = fmin(ceil(s->per_root * sqrt((double)points->n)), CLI_DEFAULT_HALF);
        status = koksma_spectrum_init(s->spectrum, c->half ? (int)c->half : (int)wish);
    }
    return status ? status : koksma_spectrum_add(s->spectrum, points, c->method, &c->work.run);
}

int cli_curves_spectrum(cli_curves *c, const char *source, double per_root, koksma_spectrum *out)
{
    *out = (koksma_spectrum){0};
    spectrum_sum s = {out, per_root};
    return for_each_set(c, source, add_spectrum, &s);
}

typedef struct pairs_sum {
    koksma_tally *tallies;
    double *values, r_max;
} pairs_sum;

static koksma_status add_pairs(cli_curves *c, const koksma_points *points, void *context)
{
    pairs_sum *s = context;
    if (!(s->r_max > 0)) {
        s->r_max = fmin(4 / sqrt((double)points->n), 0.5);
    }
    const koksma_status status = koksma_pair_correlation(points, s->r_max, c->bins, &c->work.run, s->values);
    for (uint64_t b = 0; b < c->bins && !status; b++) {
        koksma_tally_add(&s->tallies[b], s->values[b]);
    }
    return status;
}

int cli_curves_pairs(cli_curves *c, const char *source, koksma_tally *tallies, double *r_max)
{
    pairs_sum s = {tallies, malloc(c->bins * sizeof(double)), c->r_max};
    const int code = s.values ? for_each_set(c, source, add_pairs, &s) : cli_no_memory();
    free(s.values);
    *r_max = s.r_max;
    return code;
}
