/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma optimise --scene SCENE -n SPP`: reads the options, calls koksma_optimise_scene, writes the set to the file
 * as soon as there is one (to a stream at the end), and prints a row for each scene in which the set was tested.
 */
#include "rendering.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/study.h>

#include "cli.h"
#include "source.h"

typedef struct scene_job {
    const cli_arguments *arguments;
    cli_work work;
    koksma_scene_search options;
    char held_out[KOKSMA_MAX_HELD_OUT][KOKSMA_MAX_SPEC], against[KOKSMA_MAX_AGAINST][KOKSMA_MAX_SPEC];
    const char *held_out_texts[KOKSMA_MAX_HELD_OUT], *against_texts[KOKSMA_MAX_AGAINST];
    koksma_scene_optimum best;
} scene_job;

static koksma_status write_set(const scene_job *j, const koksma_scene_optimum *best)
{
    char comment[KOKSMA_MAX_SPEC + 256];
    snprintf(comment, sizeof comment,
             "optimised for the scene %.400s, %d samples a pixel\nmeasure %s\nphase %zu\nseed %llu\nkoksma %s",
             j->options.scene, j->options.spp, best->measure, best->phase, (unsigned long long)j->options.seed,
             koksma_version());
    return koksma_points_write(cli_text(j->arguments, "output", NULL), &best->points, comment, NULL);
}

/* Writes the set to a file: at first the first candidate, in case the search is interrupted, and later the chosen one. */
static koksma_status found(void *context, const koksma_scene_optimum *best)
{
    const scene_job *j = context;
    return cli_is_stream(cli_text(j->arguments, "output", "-")) ? KOKSMA_OK : write_set(j, best);
}

/* Prints the row of one scene or, if g->trials is 0, of the mean over the held-out scenes. */
static void put_gain(const scene_job *j, cli_rows *rows, const koksma_scene_gain *g, const char *role)
{
    const bool scene = g->trials > 0;
    const koksma_scene_optimum *best = &j->best;
    if (cli_is_stdout(cli_text(j->arguments, "output", "-"))) {
        return; /* standard output has the set */
    }
    cli_row_text(rows, "scene", g->scene);
    cli_row_text(rows, "role", role);
    cli_row_number(rows, "error", scene ? g->error : (double)NAN);
    cli_row_text(rows, "best_listed", scene ? g->best_listed : "-");
    cli_row_number(rows, "listed_error", scene ? g->listed_error : (double)NAN);
    cli_row_number(rows, "gain", g->gain);
    cli_row_number(rows, "gain_low", g->low);
    cli_row_number(rows, "gain_high", g->high);
    cli_row_number(rows, "shrinks_by", best->gains[0].gain - g->gain);
    if (cli_flag(j->arguments, "json")) {
        cli_row_whole(rows, "spp", (uint64_t)j->options.spp);
        cli_row_whole(rows, "width", (uint64_t)g->width);
        cli_row_whole(rows, "height", (uint64_t)g->height);
        cli_row_whole(rows, "trials", (uint64_t)g->trials);
        cli_row_flag(rows, "coherent", g->coherent);
        cli_row_flag(rows, "settled", g->settled);
        cli_row_number(rows, "share_x", best->shares[0]);
        cli_row_number(rows, "share_y", best->shares[1]);
        cli_row_number(rows, "share_xy", best->shares[2]);
        cli_row_whole(rows, "candidates", best->candidates);
        cli_row_whole(rows, "eliminated", best->eliminated);
        cli_row_text(rows, "measure", best->measure);
        cli_row_whole(rows, "phase", best->phase);
        cli_row_whole(rows, "seed", j->options.seed);
        cli_row_text(rows, "version", koksma_version());
    }
    cli_row_end(rows);
}

/* Replaces an alias by the name of its pattern, and returns whether that is listed already. */
static bool is_listed(const scene_job *j, char item[KOKSMA_MAX_SPEC])
{
    koksma_spec spec;
    if (!koksma_pattern_spec(item, &spec)) {
        koksma_spec_text(&spec, item);
    }
    size_t i = 0;
    while (i < j->options.n_against && strcmp(j->against[i], item) != 0) {
        i++;
    }
    return i < j->options.n_against;
}

/* Adds the patterns of --against; "all" leaves out those that do not make the points. */
static bool parse_against(scene_job *j)
{
    const char *list = cli_text(j->arguments, "against", NULL);
    const bool all = list && !strcmp(list, "all");
    koksma_scene_search *o = &j->options;
    char item[KOKSMA_MAX_SPEC], left_out[1024] = "";
    o->against = list ? j->against_texts : NULL;
    for (size_t at = 0; list && cli_pattern_item(list, at, item); at++) {
        koksma_render_options parsed = {0};
        if (all && koksma_plan_try(item, (size_t)o->spp, 2)) {
            const size_t used = strlen(left_out);
            snprintf(left_out + used, sizeof left_out - used, "%s%s", used ? ", " : "", item);
            continue;
        }
        if (koksma_render_patterns(item, &parsed)) {
            cli_usage_error(j->arguments, "%s", koksma_error_text());
            return false;
        }
        if (o->n_against == KOKSMA_MAX_AGAINST) {
            cli_usage_error(j->arguments, "--against: more than %d patterns", KOKSMA_MAX_AGAINST);
            return false;
        }
        if (all && is_listed(j, item)) {
            continue;
        }
        memcpy(j->against[o->n_against], item, sizeof item);
        j->against_texts[o->n_against] = j->against[o->n_against];
        o->n_against++;
    }
    if (*left_out && !cli_flag(j->arguments, "quiet")) {
        cli_say("optimise", "--against all leaves out patterns without such a set: %s", left_out);
    }
    return true;
}

static bool parse_held_out(scene_job *j)
{
    const char *held_out = cli_text(j->arguments, "held-out", NULL);
    koksma_scene_search *o = &j->options;
    char item[KOKSMA_MAX_SPEC];
    o->held_out = held_out ? j->held_out_texts : NULL;
    while (held_out && cli_list_item(held_out, o->n_held_out, item, sizeof item)) {
        if (!strcmp(item, o->scene)) {
            cli_usage_error(j->arguments, "--held-out: '%s' is the scene that the set is optimised for", o->scene);
            return false;
        }
        if (o->n_held_out == KOKSMA_MAX_HELD_OUT) {
            cli_usage_error(j->arguments, "--held-out: more than %d scenes", KOKSMA_MAX_HELD_OUT);
            return false;
        }
        memcpy(j->held_out[o->n_held_out], item, sizeof item);
        j->held_out_texts[o->n_held_out] = j->held_out[o->n_held_out];
        o->n_held_out++;
    }
    return true;
}

/* Prints the warnings about a scene. The library opens it again and reports what keeps it from being opened. */
static void say_warnings(const scene_job *j, const char *name)
{
    koksma_scene *scene;
    koksma_render_options options;
    if (cli_flag(j->arguments, "quiet") || cli_is_stream(name) || koksma_scene_open(name, &scene)) {
        return;
    }
    koksma_render_options_init(&options, scene);
    cli_scene_warnings(j->arguments, name, scene, &options, 3);
    koksma_scene_close(scene);
}

static bool parse(scene_job *j)
{
    const cli_arguments *arguments = j->arguments;
    koksma_scene_search *o = &j->options;
    uint64_t spp, candidates, phases, max_trials;
    if (!cli_refuse(arguments, "dim from keep projections power band weights steps time-limit",
                    "has no effect with --scene")) {
        return false;
    }
    if (arguments->n_operands) {
        cli_usage_error(arguments, "'%s': with --scene it takes no measure", arguments->operands[0]);
        return false;
    }
    if (!cli_text(arguments, "n", NULL) || !cli_text(arguments, "output", NULL)) {
        cli_usage_error(arguments, "%s, is missing",
                        cli_text(arguments, "n", NULL) ? "-o FILE, the file for the set"
                                                       : "-n SPP, the samples per pixel");
        return false;
    }
    if (!cli_whole(arguments, "n", 0, 1, 4096, &spp) || !cli_whole(arguments, "seed", 0, 0, UINT32_MAX, &o->seed) ||
        !cli_whole(arguments, "candidates", 8, 1, 1000, &candidates) ||
        !cli_whole(arguments, "phases", 4, 1, 1000, &phases) ||
        !cli_whole(arguments, "max-trials", 32, 8, KOKSMA_MAX_RANK_TRIALS, &max_trials) ||
        !cli_size(arguments, &o->width, &o->height) ||
        !cli_check_output(arguments, cli_text(arguments, "output", "-"))) {
        return false;
    }
    o->spp = (int)spp;
    o->candidates = candidates;
    o->phases = phases;
    o->max_trials = (long long)max_trials;
    return parse_against(j) && parse_held_out(j) && cli_work_begin(arguments, "optimising for a scene", &j->work);
}

/* Prints the rows, unless the set is on standard output, and the message. Returns the exit code. */
static int report(const scene_job *j)
{
    const koksma_scene_optimum *best = &j->best;
    const size_t held_out = best->n_gains ? best->n_gains - 1 : 0;
    const koksma_scene_gain mean = {.scene = "-", .gain = best->gain, .low = best->low, .high = best->high};
    cli_rows *rows = cli_rows_open(cli_flag(j->arguments, "json"));
    for (size_t i = 0; i < best->n_gains; i++) {
        put_gain(j, rows, &best->gains[i], i ? "held-out" : "optimised");
    }
    if (held_out && best->gain == best->gain) {
        put_gain(j, rows, &mean, "mean of held-out");
        if (!cli_flag(j->arguments, "quiet")) {
            const double home = best->gains[0].gain;
            cli_say("optimise",
                    "%zu of %zu candidates eliminated; gain over the best listed pattern: %.1f %% in %s, %.1f %% on "
                    "average in %zu held-out scenes, which is %.1f percentage points %s",
                    best->eliminated, best->candidates, 100 * home, j->options.scene, 100 * best->gain, held_out,
                    100 * fabs(home - best->gain), home < best->gain ? "more" : "less");
        }
    }
    return cli_rows_close(rows, (held_out ? best->gain : best->gains[0].gain) > 0 ? CLI_YES : CLI_NO);
}

int cli_optimise_scene(const cli_arguments *arguments)
{
    scene_job *j = calloc(1, sizeof *j);
    if (!j) {
        return cli_no_memory();
    }
    j->arguments = arguments;
    j->options.scene = cli_text(arguments, "scene", NULL);
    j->options.found = found;
    j->options.context = j;
    int code = parse(j) ? cli_try_output(arguments, cli_text(arguments, "output", "-")) : CLI_USAGE;
    if (!code) {
        say_warnings(j, j->options.scene);
        for (size_t i = 0; i < j->options.n_held_out; i++) {
            say_warnings(j, j->held_out[i]);
        }
        koksma_status status = koksma_optimise_scene(&j->options, &j->work.run, &j->best);
        cli_work_end();
        if (j->best.points.n && cli_is_stream(cli_text(arguments, "output", "-"))) {
            const koksma_status written = write_set(j, &j->best);
            status = status ? status : written;
        }
        code = j->best.n_gains ? report(j) : CLI_YES;
        code = status ? cli_fail(arguments, status) : code;
    }
    koksma_scene_optimum_fini(&j->best);
    free(j);
    return code;
}
