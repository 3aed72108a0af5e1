/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma rank --target-error`: how many samples of each pattern leave this error. */
#include "studying.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const states[] = {"checked", "extrapolated", "unknown", "refused"};

static void put_row(cli_rows *rows, const koksma_rank_options *options, double target, const koksma_target_row *row,
                    const koksma_target_ranking *ranking)
{
    cli_row_text(rows, "scene", options->scene);
    cli_row_text(rows, "pattern", options->patterns[row->pattern]);
    cli_row_number(rows, "target", target);
    if (row->state == KOKSMA_TARGET_CHECKED) {
        cli_row_whole(rows, "spp", (uint64_t)row->spp);
    } else {
        cli_row_json(rows, "spp", "null", "-");
    }
    cli_row_number(rows, "error", row->error);
    cli_row_number(rows, "low", row->low);
    cli_row_number(rows, "high", row->high);
    cli_row_number(rows, "needed", row->needed);
    cli_row_number(rows, "needed_low", row->needed_low);
    cli_row_number(rows, "needed_high", row->needed_high);
    cli_row_number(rows, "rate", row->rate);
    cli_row_number(rows, "rate_error", row->rate_error);
    cli_row_text(rows, "state", states[row->state]);
    cli_row_flag(rows, "coherent", row->coherent);
    cli_row_whole(rows, "trials", (uint64_t)row->trials);
    cli_row_whole(rows, "width", (uint64_t)ranking->width);
    cli_row_whole(rows, "height", (uint64_t)ranking->height);
    char metric[KOKSMA_MAX_SPEC];
    koksma_metric_text(options->metric, metric);
    cli_row_text(rows, "metric", metric);
    cli_row_end(rows);
}

/* Prints which pattern needs the fewest samples, and which patterns are refused. */
static void advise(const koksma_rank_options *options, double target, const koksma_target_row *rows,
                   const koksma_target_ranking *ranking, bool quiet)
{
    const koksma_target_row *first = &rows[0], *best = first;
    for (size_t i = 0; i < options->n_patterns && rows[i].state == KOKSMA_TARGET_CHECKED; i++) {
        best = best->coherent && !rows[i].coherent ? &rows[i] : best;
    }
    if (!quiet && first->state == KOKSMA_TARGET_CHECKED) {
        cli_say("rank", "%d samples of %s leave the error %.3g%s%s", best->spp, options->patterns[best->pattern],
                target, best->coherent ? ", in visible bands" : "",
                best != first ? "; patterns with fewer samples leave visible bands" : "");
    }
    if (!quiet && ranking->cut_short) {
        cli_say("rank", "the time was up before the error %.3g was reached by all patterns; --time-limit gives more",
                target);
    }
    for (size_t i = 0; i < options->n_patterns; i++) {
        if (rows[i].reason[0]) {
            cli_say("rank", "%s %s: %s", options->patterns[rows[i].pattern],
                    rows[i].state == KOKSMA_TARGET_REFUSED ? "is not ranked" : "does not get there", rows[i].reason);
        }
    }
}

/* Returns false, after an error, if an option says what --target-error chooses. */
static bool options_fit(const cli_arguments *arguments, uint64_t spp)
{
    if (!cli_refuse(arguments, "spp max-trials one-size", "has no effect with --target-error")) {
        return false;
    }
    if (spp) {
        cli_usage_error(arguments, "-p has @%llu, but --target-error chooses the number of samples",
                        (unsigned long long)spp);
    }
    return !spp;
}

int cli_rank_to_error(const cli_arguments *arguments, const koksma_rank_options *options, uint64_t spp)
{
    cli_work work;
    double target;
    if (!options_fit(arguments, spp) || !cli_real(arguments, "target-error", 0, 1e-300, 1e300, &target) ||
        !cli_work_begin(arguments, "ranking", &work)) {
        return CLI_USAGE;
    }
    work.limit_s = options->time_limit_s;
    koksma_target_row *table = malloc(options->n_patterns * sizeof *table);
    koksma_target_ranking ranking;
    if (!table) {
        return cli_no_memory();
    }
    const koksma_status status = koksma_rank_to_error(options, target, &work.run, table, &ranking);
    cli_work_end();
    bool all = true;
    cli_rows *rows = cli_rows_open(cli_flag(arguments, "json"));
    for (size_t i = 0; i < options->n_patterns && !status; i++) {
        put_row(rows, options, target, &table[i], &ranking);
        all = all && (table[i].state == KOKSMA_TARGET_CHECKED || table[i].state == KOKSMA_TARGET_REFUSED);
    }
    if (!status) {
        advise(options, target, table, &ranking, cli_flag(arguments, "quiet"));
    }
    free(table);
    const int code = status ? cli_fail(arguments, status) : all ? CLI_YES : CLI_NO;
    return cli_rows_close(rows, code);
}
