/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma rank --target-error`: how many samples of each pattern leave this error. */
#include "studying.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char *const states[] = {"checked", "extrapolated", "unknown", "refused"};

static void put_row(const koksma_rank_options *options, double target, const koksma_target_row *row,
                    const koksma_target_ranking *ranking)
{
    char metric[KOKSMA_MAX_SPEC];
    koksma_metric_text(options->metric, metric);
    cli_row("scene %s pattern %s target %g spp %g error %g low %g high %g needed %g needed_low %g needed_high %g "
            "rate %g rate_error %g "
            "state %s coherent? %d trials %lld width %d height %d metric %s\n",
            options->scene, options->patterns[row->pattern], target,
            row->state == KOKSMA_TARGET_CHECKED ? row->spp : (double)NAN, row->error, row->low, row->high,
            row->needed, row->needed_low, row->needed_high, row->rate, row->rate_error, states[row->state],
            row->coherent, row->trials, ranking->width, ranking->height, metric);
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
static bool options_fit(const cli_args *args, uint64_t spp)
{
    if (!cli_refuse(args, "spp max-trials one-size", "has no effect with --target-error")) {
        return false;
    }
    if (spp) {
        cli_error(args, "-p has @%llu, but --target-error chooses the number of samples", (unsigned long long)spp);
    }
    return !spp;
}

int cli_rank_to_error(const cli_args *args, const koksma_rank_options *options, uint64_t spp)
{
    cli_work work;
    double target;
    if (!options_fit(args, spp) || !cli_real(args, "target-error", 0, 1e-300, 1e300, &target) ||
        !cli_work_begin(args, "ranking", &work)) {
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
    for (size_t i = 0; i < options->n_patterns && !status; i++) {
        put_row(options, target, &table[i], &ranking);
        all = all && (table[i].state == KOKSMA_TARGET_CHECKED || table[i].state == KOKSMA_TARGET_REFUSED);
    }
    if (!status) {
        advise(options, target, table, &ranking, cli_flag(args, "quiet"));
    }
    free(table);
    const int code = status ? cli_fail(args, status) : all ? CLI_YES : CLI_NO;
    return cli_rows_close(code);
}
