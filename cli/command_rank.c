/* SPDX-License-Identifier: Apache-2.0 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/study.h>

#include "cli.h"
#include "render_options.h"

enum { MAX_PATTERNS = 64 };

/* The seven of Shirley's thesis, and more that came later. */
static const char thesis[] = "n-rooks,jittered,half-jittered,poisson-disk:d=0.2,poisson-disk:d=0.1,regular,random";
static const char later[] =
    "n-rooks,jittered,half-jittered,regular,random,multi-jittered,correlated-multi-jittered,"
    "sobol:scramble=owen,halton:scramble=owen,pmj02,pmj02bn,orthogonal-array,r-sequence:shift=1,"
    "hammersley:shift=1,fibonacci:shift=1,best-candidate,"
    "gaussian-blue-noise";

typedef struct patterns {
    char texts[MAX_PATTERNS][KOKSMA_MAX_SPEC];
    const char *at[MAX_PATTERNS];
    size_t n;
} patterns;

static int parse_patterns(const cli_arguments *arguments, patterns *p)
{
    const char *list = cli_text(arguments, "patterns", "thesis");
    list = !strcmp(list, "thesis") ? thesis : !strcmp(list, "later") ? later : list;
    char item[KOKSMA_MAX_SPEC];
    while (cli_list_item(list, p->n, item, sizeof item)) {
        static char text[KOKSMA_MAX_PATTERNS_TEXT];
        koksma_render_options options = {0}; /* for its patterns only */
        if (p->n == MAX_PATTERNS) {
            return cli_usage_error(arguments, "--patterns: more than %d", MAX_PATTERNS);
        }
        koksma_status status = koksma_pattern_spec("n-rooks", &options.pattern); /* unless the text names another */
        status = status ? status : koksma_render_patterns(item, &options);
        if (status) {
            return cli_fail(arguments, status);
        }
        koksma_render_patterns_text(&options, text);
        if (strlen(text) >= sizeof p->texts[p->n]) {
            return cli_usage_error(arguments, "--patterns %.40s...: longer than %zu characters", text,
                                   sizeof p->texts[p->n] - 1);
        }
        memcpy(p->texts[p->n], text, strlen(text) + 1);
        for (size_t i = 0; i < p->n; i++) {
            if (!strcmp(p->texts[i], p->texts[p->n])) {
                return cli_usage_error(arguments, "--patterns: '%s' stands twice", p->texts[i]);
            }
        }
        p->at[p->n] = p->texts[p->n];
        p->n++;
    }
    return CLI_YES;
}

/* What holds for all rows of a ranking is for machines: a reader has it in the advice. */
static void put_row(cli_rows *rows, const koksma_rank_options *options, const koksma_rank_row *row,
                    const koksma_ranking *ranking, bool json)
{
    cli_row_text(rows, "scene", options->scene);
    cli_row_whole(rows, "spp", (uint64_t)options->spp);
    cli_row_whole(rows, "place", row->place);
    cli_row_text(rows, "pattern", options->patterns[row->pattern]);
    cli_row_rounded(rows, "error", row->mean, 4);
    cli_row_rounded(rows, "low", row->low, 4);
    cli_row_rounded(rows, "high", row->high, 4);
    cli_row_rounded(rows, "behind", row->behind, 3);
    cli_row_rounded(rows, "behind_low", row->behind_low, 3);
    cli_row_rounded(rows, "behind_high", row->behind_high, 3);
    cli_row_whole(rows, "trials", (uint64_t)ranking->trials);
    cli_row_whole(rows, "width", (uint64_t)ranking->width);
    cli_row_whole(rows, "height", (uint64_t)ranking->height);
    if (json) {
        cli_row_text(rows, "integrator", options->integrator->name);
        cli_row_text(rows, "filter", options->filter->name);
        cli_row_rounded(rows, "reference_error", ranking->reference_error, 2);
        cli_row_flag(rows, "settled", ranking->clear);
    }
    cli_row_end(rows);
}

/* The advice: the best, those that tie with it, what the next and the worst cost. */
static void advise(const koksma_rank_options *options, const koksma_rank_row *rows, const koksma_ranking *ranking)
{
    const koksma_rank_row *last = &rows[ranking->n - 1];
    size_t ties = 1;
    while (ties < ranking->n && rows[ties].place == 1) {
        ties++;
    }
    fprintf(stderr, "%s at %d samples a pixel: use ", options->scene, options->spp);
    for (size_t i = 0; i < ties; i++) {
        fprintf(stderr, "%s%s", i == 0 ? "" : i + 1 < ties ? ", " : " or ", options->patterns[rows[i].pattern]);
    }
    fprintf(stderr, "%s", ties > 1 ? ", which can't be told apart" : "");
    if (ties < ranking->n) {
        fprintf(stderr, "; %s leaves %.0f %% more error (%.0f to %.0f)", options->patterns[rows[ties].pattern],
                100 * rows[ties].behind, 100 * rows[ties].behind_low, 100 * rows[ties].behind_high);
        if (ties + 1 < ranking->n) {
            fprintf(stderr, ", %s %.0f %% more", options->patterns[last->pattern], 100 * last->behind);
        }
    }
    fprintf(stderr,
            ". %lld trials of %d x %d pixels (%s, %s filter) in %.1f s; the reference's own error is %.1g%s.\n",
            ranking->trials, ranking->width, ranking->height, options->integrator->name, options->filter->name,
            ranking->seconds, ranking->reference_error,
            ranking->clear       ? ""
            : ranking->cut_short ? "; not every place is settled, more time would tell"
                                 : "; not every place is settled, and a ranking takes no more trials");
}

static koksma_status rank_at(const cli_arguments *arguments, const koksma_rank_options *options, cli_work *work,
                             cli_rows *rows)
{
    koksma_rank_row table[MAX_PATTERNS];
    koksma_ranking ranking;
    const koksma_status status = koksma_rank(options, &work->run, table, &ranking);
    cli_work_end(work);
    if (status) {
        return status;
    }
    for (size_t i = 0; i < ranking.n; i++) {
        put_row(rows, options, &table[i], &ranking, cli_flag(arguments, "json"));
    }
    if (!cli_flag(arguments, "quiet")) {
        advise(options, table, &ranking);
    }
    for (size_t i = ranking.n; i < options->n_patterns; i++) {
        fprintf(stderr, "koksma rank: %s is left out: %s\n", options->patterns[table[i].pattern], table[i].reason);
    }
    return KOKSMA_OK;
}

/* Sample count i of "4,16,64"; 0 past the end, -1 when it is none. */
static long spp_at(const char *list, size_t i)
{
    for (; i > 0; i--) {
        list = strchr(list, ',');
        if (!list) {
            return 0;
        }
        list++;
    }
    char *end;
    const long value = strtol(list, &end, 10);
    return (*end && *end != ',') || value < 1 || value > 1 << 20 || list[0] < '0' || list[0] > '9' ? -1 : value;
}

static int run(const cli_arguments *arguments)
{
    cli_work work;
    patterns p = {.n = 0};
    double time_limit_s;
    int width = 0, height = 0;
    const koksma_integrator *integrator = koksma_integrator_find("distribution");
    const koksma_filter *filter = koksma_filter_find("box");
    const char *list = cli_text(arguments, "spp", "4,16,64");
    if (arguments->n_operands != 1) {
        return cli_usage_error(arguments, "it takes one scene, such as ball or ./scene.json");
    }
    size_t n_spp = 0;
    for (; spp_at(list, n_spp); n_spp++) {
        if (spp_at(list, n_spp) < 0) {
            return cli_usage_error(arguments, "--spp %s: it takes numbers of samples, such as 4,16,64", list);
        }
    }
    int code = parse_patterns(arguments, &p);
    if (code || !cli_real(arguments, "time-limit", 60, 0.1, 1e9, &time_limit_s) ||
        !cli_integrator_and_filter(arguments, &integrator, &filter) || !cli_size(arguments, &width, &height) ||
        !cli_work_begin(arguments, "ranking", &work)) {
        return code ? code : CLI_USAGE;
    }
    cli_rows *rows = cli_rows_open(cli_flag(arguments, "json"));
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < n_spp; i++) {
        const koksma_rank_options options = {.scene = arguments->operands[0],
                                             .patterns = p.at,
                                             .n_patterns = p.n,
                                             .spp = (int)spp_at(list, i),
                                             .width = width,
                                             .height = height,
                                             .integrator = integrator,
                                             .filter = filter,
                                             .time_limit_s = time_limit_s / (double)n_spp};
        status = rank_at(arguments, &options, &work, rows);
    }
    cli_work_end(&work);
    code = status ? cli_fail(arguments, status) : CLI_YES;
    const int rows_code = cli_rows_close(rows);
    return code ? code : rows_code;
}

static const cli_option options[] = {
    {'n', "spp", "N,..", "samples a pixel, one ranking for each (default: 4,16,64)"},
    {'p', "patterns", "PATTERN,..|thesis|later", "what is ranked (default: thesis)"},
    {0, "size", "WxH", "pixels (default: the scene's, halved until a ranking fits into the time)"},
    CLI_INTEGRATOR_OPTION,
    CLI_FILTER_OPTION,
    {0, "time-limit", "S", "seconds, for all rankings together (default: 60)"},
    CLI_ROW_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_rank = {
    .name = "rank",
    .summary = "which pattern leaves the least error in a scene",
    .synopsis = "SCENE [--spp N,..] [--patterns PATTERN,..|thesis|later] [--size WxH]\n"
                "  [--integrator INTEGRATOR] [--filter FILTER] [--time-limit S] [--json]",
    .details =
        "Renders the scene again and again with every pattern until the ranking is clear or the time is up, 4,096\n"
        "times at most: each pattern's mean absolute error with its 95 % interval; patterns that can't be told\n"
        "apart share a place. 'behind' is the relative difference to the best. The advice goes to stderr. Light\n"
        "between surfaces is only in what --integrator path and irradiance-cache render.\n"
        "PATTERN may name patterns of single uses or groups of uses, as in 'random;pixel+time=scan-time' (in "
        "quotes).\n"
        "thesis: the seven patterns of Shirley 1991; later: 17 with those that came after.",
    .options = options,
    .run = run,
};
