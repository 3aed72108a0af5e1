/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma rank`: ranks patterns by the error that they leave in a scene, separately for each number of samples.
 * koksma_rank_patterns computes a ranking. This file has the lists of patterns, divides the time limit among the
 * rankings, prints the rows, and returns the exit code (1: the best pattern is undecided). rank_advice.c prints the
 * advice. Long because the options, what they exclude and their help stand together.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/adaptive.h>
#include <koksma/study.h>

#include "cli.h"
#include "rendering.h"
#include "source.h"
#include "studying.h"

enum { MAX_PATTERNS = 64 };

/* Lists of patterns by a name. The default has those that leave the least error in the project's own studies, each with its
   plainer relatives down to random; "thesis" has the seven of Shirley's thesis, and "later" five of these and twelve newer
   ones. */
static const char *const lists[][2] = {
    {"modern", "sobol:scramble=owen,pmj02,correlated-multi-jittered,multi-jittered,n-rooks,jittered,random"},
    {"thesis", "n-rooks,jittered,half-jittered,poisson-disk:d=0.2,poisson-disk:d=0.1,regular,random"},
    {"later", "n-rooks,jittered,half-jittered,regular,random,multi-jittered,correlated-multi-jittered,sobol:scramble="
              "owen,halton:scramble=owen,pmj02,pmj02bn:levels=4,orthogonal-array,r-sequence:shift=1,hammersley:shift="
              "1,fibonacci:shift=1,best-candidate,gaussian-blue-noise"},
};

/* --with mitsuba. The last line that is printed is the reason of a failure: LLVM aborts without one. */
static const char mitsuba[] =
    "\"${KOKSMA_PYTHON:-python3}\" -m koksma.mitsuba {scene} {pattern} {spp} {seed} {width} {height} {out} || "
    "{ code=$?; [ $code -lt 128 ] || echo \"Mitsuba's process was killed by signal $((code - 128)); variants "
    "llvm_... need LLVM 17 or later: DRJIT_LIBLLVM_PATH=/path/to/libLLVM.so, or "
    "KOKSMA_MITSUBA_VARIANT=scalar_rgb\"; exit $code; }";

typedef struct patterns {
    char texts[MAX_PATTERNS][KOKSMA_MAX_SPEC];
    const char *at[MAX_PATTERNS];
    size_t n;
} patterns;

/* Returns false for a method of adaptive sampling that places its own samples, whatever the pattern is. method: NULL
   or a text. */
static bool method_uses_patterns(const char *method)
{
    koksma_adaptive_options adaptive;
    return !method || koksma_adaptive_parse(method, &adaptive) || !adaptive.method->own_samples;
}

/* Returns the list of patterns with the names of lists replaced by what they stand for; the same text if it has none. */
static const char *expand_lists(const char *list)
{
    static char out[MAX_PATTERNS * KOKSMA_MAX_SPEC];
    char item[KOKSMA_MAX_SPEC];
    size_t used = 0, named = 0;
    for (size_t i = 0; cli_list_item(list, i, item, sizeof item); i++) {
        const char *text = item;
        for (size_t k = 0; k < sizeof lists / sizeof *lists; k++) {
            named += !strcmp(item, lists[k][0]);
            text = strcmp(item, lists[k][0]) ? text : lists[k][1];
        }
        used += (size_t)snprintf(out + used, used < sizeof out ? sizeof out - used : 0, "%s%s", i ? "," : "", text);
    }
    return named && used < sizeof out ? out : list;
}

/* Reads --patterns. *spp receives N if a pattern is given as SPEC@N. Returns the exit code. */
static int parse_patterns(const cli_arguments *arguments, patterns *p, uint64_t *spp)
{
    const char *list = cli_text(arguments, "patterns", "modern");
    if (cli_text(arguments, "with", NULL) && !cli_text(arguments, "patterns", NULL)) {
        return cli_usage_error(arguments, "--with needs --patterns, with names of samplers that the command knows");
    }
    char item[KOKSMA_MAX_SPEC];
    const char *given = method_uses_patterns(cli_text(arguments, "adaptive", NULL)) ? list : "n-rooks";
    list = expand_lists(given);
    const bool many = list != given || !strcmp(list, "all");
    for (size_t at = 0; cli_pattern_item(list, at, item); at++) {
        if (!cli_text(arguments, "with", NULL) && !cli_take_counts(arguments, item, spp)) {
            return CLI_USAGE;
        }
        static char text[KOKSMA_MAX_PATTERNS_TEXT];
        koksma_render_options options = {0}; /* only the patterns in this struct are used */
        if (p->n == MAX_PATTERNS) {
            return cli_usage_error(arguments, "--patterns: more than %d", MAX_PATTERNS);
        }
        /* n-rooks remains the pattern of all uses that the text does not name */
        koksma_status status = koksma_pattern_spec("n-rooks", &options.pattern);
        if (cli_text(arguments, "with", NULL)) {
            memcpy(text, item, sizeof item);
        } else if (status || (status = koksma_render_patterns(item, &options))) {
            return cli_fail(arguments, status);
        } else {
            koksma_render_patterns_text(&options, text);
        }
        if (strlen(text) >= sizeof p->texts[p->n]) {
            return cli_usage_error(arguments, "--patterns %.40s...: longer than %zu characters", text,
                                   sizeof p->texts[p->n] - 1);
        }
        memcpy(p->texts[p->n], text, strlen(text) + 1);
        size_t i = 0;
        while (i < p->n && strcmp(p->texts[i], p->texts[p->n]) != 0) {
            i++;
        }
        if (i < p->n && !many) {
            return cli_usage_error(arguments, "--patterns: '%s' is listed twice", p->texts[i]);
        }
        p->at[p->n] = p->texts[p->n];
        p->n += i == p->n; /* "all" lists some patterns under two names, and a list may hold what is named, too */
    }
    return CLI_YES;
}

static const char *const decisions[] = {"undecided", "best", "equal", "worse"};
static const char *const states[] = {"ranked", "too-slow", "refused"};
static const char *const check_sizes[KOKSMA_RANK_CHECKS][2] = {{"half_width", "half_height"},
                                                               {"twice_width", "twice_height"}};
/* Keys of the columns for a check at another size: its result, the better pattern, and whether that pattern's error
   is coherent. */
static const char *const advice_names[KOKSMA_RANK_CHECKS][3] = {
    {"half_size", "half_size_best", "half_size_coherent"}, {"twice_size", "twice_size_best", "twice_size_coherent"}};
static const char *const first_names[KOKSMA_RANK_CHECKS][3] = {
    {"half_size_first", "half_size_first_best", "half_size_first_coherent"},
    {"twice_size_first", "twice_size_first_best", "twice_size_first_coherent"}};
static const char *const check_states[] = {"unchecked", "confirmed", "overturned", "unsettled", "failed"};

static void put_check(cli_rows *rows, const koksma_rank_options *options, const koksma_rank_check_result *result,
                      const char *const names[3])
{
    cli_row_text(rows, names[0], check_states[result->state]);
    if (result->state == KOKSMA_RANK_OVERTURNED) {
        cli_row_text(rows, names[1], options->patterns[result->pattern]);
    }
    if (result->state == KOKSMA_RANK_CONFIRMED || result->state == KOKSMA_RANK_OVERTURNED) {
        cli_row_flag(rows, names[2], result->coherent);
    }
}

/* Adds the values of a whole ranking to a JSON row. advised: the index of the advised pattern, ignored if none is
   advised. */
static void put_ranking(cli_rows *rows, const koksma_rank_options *options, const koksma_ranking *ranking,
                        size_t advised)
{
    if (options->render) {
        cli_row_text(rows, "with", ((const cli_outside *)options->render_context)->command);
    } else {
        cli_row_text(rows, "integrator", options->integrator->name);
        cli_row_text(rows, "filter", options->filter->name);
    }
    if (options->adaptive) {
        cli_row_text(rows, "adaptive", options->adaptive);
    }
    if (options->process) {
        char text[CLI_PROCESS_TEXT];
        cli_row_text(rows, "filter_with", cli_process_text(options, text));
    }
    cli_row_number(rows, "reference_error", ranking->reference_error);
    cli_row_flag(rows, "settled", ranking->settled);
    cli_row_flag(rows, "complete", ranking->complete);
    cli_row_flag(rows, "cut_short", ranking->cut_short);
    if (ranking->advised) {
        cli_row_text(rows, "advised", options->patterns[advised]);
    }
    cli_row_number(rows, "within", ranking->within);
    cli_row_flag(rows, "without_few", ranking->without_few);
    cli_row_whole(rows, "needed_trials", (uint64_t)ranking->needed_trials);
    cli_row_number(rows, "needed_s", ranking->needed_s);
    cli_row_number(rows, "random_spp", ranking->random_spp);
    cli_row_number(rows, "random_spp_low", ranking->random_spp_low);
    cli_row_number(rows, "random_spp_high", ranking->random_spp_high);
    cli_row_flag(rows, "undecidable", ranking->undecidable);
    for (int i = 0; i < KOKSMA_RANK_CHECKS; i++) {
        const koksma_rank_check *check = &ranking->checks[i];
        cli_row_whole(rows, check_sizes[i][0], (uint64_t)check->width);
        cli_row_whole(rows, check_sizes[i][1], (uint64_t)check->height);
        put_check(rows, options, &check->advice, advice_names[i]);
        put_check(rows, options, &check->first, first_names[i]);
    }
}

/* Prints row i of a ranking. Only JSON rows repeat the values of the whole ranking; in text output the advice on
   stderr has them. */
static void put_row(cli_rows *rows, const koksma_rank_options *options, const koksma_rank_row *table, size_t i,
                    const koksma_ranking *ranking, bool json)
{
    const koksma_rank_row *row = &table[i];
    cli_row_text(rows, "scene", options->scene);
    cli_row_whole(rows, "spp", (uint64_t)options->spp);
    if (row->position) {
        cli_row_whole(rows, "position", row->position);
    } else {
        cli_row_number(rows, "position", (double)NAN);
    }
    cli_row_text(rows, "pattern", options->patterns[row->pattern]);
    cli_row_number(rows, "error", row->mean);
    cli_row_number(rows, "low", row->low);
    cli_row_number(rows, "high", row->high);
    cli_row_number(rows, "behind", row->behind);
    cli_row_number(rows, "behind_low", row->behind_low);
    cli_row_number(rows, "behind_high", row->behind_high);
    cli_row_whole(rows, "trials", (uint64_t)row->trials);
    cli_row_number(rows, "coherence", row->coherence.coherence);
    if (json) {
        cli_row_number(rows, "coherence_low", row->coherence.low);
        cli_row_number(rows, "coherence_high", row->coherence.high);
        cli_row_number(rows, "coherence_noise", row->coherence.noise_high);
        cli_row_number(rows, "coherence_p", row->coherence.p);
    }
    if (isnan(row->coherence.coherence)) { /* fewer than 8 trials */
        cli_row_json(rows, "coherent", "null", "-");
    } else {
        cli_row_flag(rows, "coherent", row->coherence.coherent);
    }
    if (options->render) { /* nothing is known of the other renderer's samplers */
        cli_row_json(rows, "unbiased", "null", "-");
    } else {
        cli_row_flag(rows, "unbiased", !row->biased);
    }
    cli_row_whole(rows, "width", (uint64_t)ranking->width);
    cli_row_whole(rows, "height", (uint64_t)ranking->height);
    char metric[KOKSMA_MAX_SPEC];
    koksma_metric_text(options->metric, metric);
    cli_row_text(rows, "metric", metric);
    if (json) {
        cli_row_number(rows, "robust", row->robust);
        cli_row_number(rows, "top_share", row->top_share);
        cli_row_text(rows, "state", states[row->state]);
        cli_row_text(rows, "decision", decisions[row->decision]);
        cli_row_text(rows, "reason", row->reason);
        put_ranking(rows, options, ranking, table[ranking->advised_row].pattern);
    }
    cli_row_end(rows);
}

/* Returns the reason why a pattern is not ranked. Most reasons begin with the pattern's name, which is left out,
   because the message lists the names. */
static const char *reason_of(const koksma_rank_options *options, const koksma_rank_row *row)
{
    const char *name = options->patterns[row->pattern];
    const size_t length = strlen(name);
    const bool repeats = !strncmp(row->reason, name, length) && !strncmp(row->reason + length, ": ", 2);
    return row->reason + (repeats ? length + 2 : 0);
}

/* Returns whether two patterns are not ranked for the same reason. All slow patterns count as equal, although their
   texts differ in the numbers of trials. */
static bool same_reason(const koksma_rank_options *options, const koksma_rank_row *a, const koksma_rank_row *b)
{
    return a->state == b->state &&
           (a->state == KOKSMA_RANK_TOO_SLOW || !strcmp(reason_of(options, a), reason_of(options, b)));
}

/* Prints the patterns that are not ranked: one line for each reason, with all patterns that it concerns. */
static void say_unranked(const koksma_rank_options *options, const koksma_rank_row *table,
                         const koksma_ranking *ranking)
{
    bool said[MAX_PATTERNS] = {false};
    for (size_t i = ranking->n; i < options->n_patterns; i++) {
        /* if no pattern is ranked, the advice already says that the time was too short; print only other reasons */
        if (said[i] || (!ranking->n && table[i].state != KOKSMA_RANK_REFUSED)) {
            continue;
        }
        char names[MAX_PATTERNS * (KOKSMA_MAX_SPEC + 5)];
        size_t used = 0, last = i, n = 0;
        for (size_t j = i; j < options->n_patterns; j++) {
            said[j] |= same_reason(options, &table[i], &table[j]);
            last = same_reason(options, &table[i], &table[j]) ? j : last;
        }
        for (size_t j = i; j <= last; j++) {
            if (same_reason(options, &table[i], &table[j])) {
                used += (size_t)snprintf(names + used, sizeof names - used, "%s%s",
                                         !n         ? ""
                                         : j < last ? ", "
                                                    : " and ",
                                         options->patterns[table[j].pattern]);
                n++;
            }
        }
        if (n > 1 && table[i].state == KOKSMA_RANK_TOO_SLOW) {
            cli_say("rank",
                    "%s are not ranked: too slow: fewer than 8 trials of each were done within the time limit",
                    names);
        } else {
            cli_say("rank", "%s %s not ranked: %s", names, n > 1 ? "are" : "is", reason_of(options, &table[i]));
        }
    }
}

/* The first look at a ranking: printed at once where the progress is shown, else only if the ranking gets no further. */
typedef struct first_look {
    const koksma_rank_options *options;
    bool at_once, waits;
    double errors[MAX_PATTERNS];
} first_look;

static void take_look(void *context, const double *errors)
{
    first_look *look = context;
    memcpy(look->errors, errors, look->options->n_patterns * sizeof *errors);
    look->waits = !look->at_once;
    if (look->at_once) {
        cli_work_end();
        cli_rank_say_look(look->options, errors);
    }
}

static void say_doubt(void *context, const char *line)
{
    (void)context;
    cli_work_end();
    cli_say("rank", "warning: %s", line);
}

/* Ranks the patterns for one number of samples, and prints the rows and the advice. *settled: whether it is decided which
   pattern to use. */
static koksma_status rank_at(const cli_arguments *arguments, const koksma_rank_options *options, cli_work *work,
                             cli_rows *rows, bool *settled)
{
    koksma_rank_row table[MAX_PATTERNS];
    koksma_ranking ranking;
    koksma_rank_options asked = *options;
    first_look look = {.options = options, .at_once = work->visible};
    asked.look = cli_flag(arguments, "quiet") ? NULL : take_look;
    asked.look_context = &look;
    const koksma_status status = koksma_rank_patterns(&asked, &work->run, table, &ranking);
    cli_work_end();
    if (status) {
        return status;
    }
    koksma_rank_options shown = *options;
    if (!method_uses_patterns(options->adaptive)) { /* its own samples take the place of the pattern in the row */
        shown.patterns = &shown.adaptive;
    }
    for (size_t i = 0; i < options->n_patterns; i++) {
        put_row(rows, &shown, table, i, &ranking, cli_flag(arguments, "json"));
    }
    if (!cli_flag(arguments, "quiet")) {
        cli_rank_advise(&shown, table, &ranking);
    }
    if (look.waits && !ranking.n) {
        cli_rank_say_look(options, look.errors);
    }
    say_unranked(&shown, table, &ranking);
    *settled = cli_rank_decided(&ranking);
    return KOKSMA_OK;
}

/* Returns false, after an error, if an option is given that has no effect with, or without, --with. */
static bool options_fit(const cli_arguments *arguments)
{
    const bool with = cli_text(arguments, "with", NULL);
    if (with && !cli_refuse(arguments, "integrator filter depth lights scope adaptive unknown allow-exec",
                            "has no effect with --with, because RENDERER reads the scene and makes the points and "
                            "images")) {
        return false;
    }
    const char *adaptive = cli_text(arguments, "adaptive", NULL);
    if (!method_uses_patterns(adaptive) && cli_text(arguments, "patterns", NULL)) {
        cli_usage_error(arguments, "--patterns has no effect: the adaptive method %.*s places its own samples",
                        (int)strcspn(adaptive, ":"), adaptive);
        return false;
    }
    const char *reference = cli_text(arguments, "reference", NULL);
    if (!with && reference && !cli_is_image(reference)) {
        cli_usage_error(
            arguments,
            "--reference %s: without --with it takes an image, such as reference.exr; Koksma's own references "
            "use the pattern sobol:scramble=owen",
            reference);
        return false;
    }
    return true;
}

/* Reads --adaptive in its canonical form; *adaptive is NULL without it. Returns the exit code. */
static int parse_adaptive(const cli_arguments *arguments, char text[KOKSMA_MAX_SPEC], const char **adaptive)
{
    koksma_adaptive_options method;
    *adaptive = cli_text(arguments, "adaptive", NULL);
    const koksma_status status = *adaptive ? koksma_adaptive_parse(*adaptive, &method) : KOKSMA_OK;
    if (*adaptive && !status) {
        koksma_adaptive_text(&method, text);
        *adaptive = text;
    }
    return status ? cli_fail(arguments, status) : CLI_YES;
}

/* What the options say, except the number of samples. */
typedef struct request {
    patterns p;
    uint64_t spp;       /* N of a pattern SPEC@N, or 0 */
    char scene_spp[24]; /* the default of --spp */
    char adaptive[KOKSMA_MAX_SPEC], variant[256];
    cli_metrics metric;
    koksma_image reference; /* without pixels: references are rendered */
    cli_outside outside;
    double blur; /* of --filter-with blur:sd=S */
    double time_limit_s;
    koksma_rank_options options;
} request;

/* Writes --scope, --lights and --depth as a plan's options; options->variant stays NULL without them. */
static void parse_variant(const cli_arguments *arguments, request *r)
{
    static const char *const names[] = {"scope", "lights", "depth"};
    size_t used = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const char *word = cli_text(arguments, names[i], NULL);
        if (word) {
            used += (size_t)snprintf(r->variant + used, sizeof r->variant - used, "%s%s=%.64s", used ? ";" : "",
                                     names[i], word);
            r->options.variant = r->variant;
        }
    }
}

/* Refuses a command of --with that would make equal pictures of what is compared. many_spp: several numbers of samples are
   wanted. Returns the exit code. */
static int check_command(const cli_arguments *arguments, const request *r, bool many_spp)
{
    const char *sizes = "is checked at half and twice the size, too; --one-size leaves that out";
    const bool many = r->p.n > 1,
               sized = many && r->options.width && !r->options.one_size && !r->options.reference_image;
    const struct {
        const char *word, *why;
        bool needed;
    } all[] = {{"{pattern}", "compares patterns", many},
               {"{spp}", "takes several numbers of samples", many_spp},
               {"{width}", sizes, sized},
               {"{height}", sizes, sized}};
    for (size_t i = 0; r->outside.command && i < sizeof all / sizeof *all; i++) {
        if (all[i].needed && !strstr(r->outside.command, all[i].word)) {
            return cli_usage_error(arguments, "--with: the command lacks %s, and the ranking %s", all[i].word,
                                   all[i].why);
        }
    }
    return CLI_YES;
}

/* Reads --with and --reference. Returns the exit code. */
static int parse_outside(const cli_arguments *arguments, request *r)
{
    koksma_rank_options *o = &r->options;
    const char *reference = cli_text(arguments, "reference", NULL), *command = cli_text(arguments, "with", NULL);
    if (cli_is_image(reference)) {
        if (cli_has_eight_bits(reference) && !command) {
            return cli_usage_error(arguments,
                                   "--reference %s: 8 bits are rounded and clipped, an error that looks like bands; "
                                   "write it as .exr or .pfm",
                                   reference);
        }
        const koksma_status status = koksma_image_read(reference, &r->reference);
        if (status) {
            return cli_fail(arguments, status);
        }
        o->reference_image = &r->reference;
        o->width = o->width || command ? o->width : r->reference.width;
        o->height = o->height || command ? o->height : r->reference.height;
    } else {
        o->reference = reference;
    }
    if (command) {
        r->outside = (cli_outside){.command = strcmp(command, "mitsuba") != 0 ? command : mitsuba,
                                   .patterns = r->p.n,
                                   .quiet = cli_flag(arguments, "quiet"),
                                   .reference = !o->reference_image};
        o->render = cli_render_outside;
        o->render_context = &r->outside;
    }
    return CLI_YES;
}

/* Reads --filter-with: "blur:sd=S", or a command. Returns false after an error. */
static bool parse_process(const cli_arguments *arguments, request *r)
{
    static const char blur[] = "blur:sd=";
    const char *text = cli_text(arguments, "filter-with", NULL);
    if (text && !strncmp(text, blur, strlen(blur))) {
        char *end;
        r->blur = strtod(text + strlen(blur), &end);
        if (end == text + strlen(blur) || *end || !(r->blur > 0 && r->blur <= 100)) {
            cli_usage_error(arguments,
                            "--filter-with %s: it takes a standard deviation of 0 to 100 pixels, as in blur:sd=1.5",
                            text);
            return false;
        }
        r->options.process = cli_blur;
        r->options.process_context = &r->blur;
    } else if (text && !strchr(text, '{')) {
        cli_usage_error(arguments, "--filter-with %s: it takes blur:sd=S, or a command with {in} and {out}", text);
        return false;
    } else if (text) {
        r->options.process = koksma_rank_process_by_command;
        r->options.process_context = (void *)text;
    }
    return true;
}

enum { MOST_SCENE_SPP = 64, MOST_PATHS_SPP = 16 };

/* Takes from the scene what the command line leaves open: the integrator, which is path where the scene asks for it, and
   the number of samples. That is the number of the scene's own sampler, up to what can be ranked within the default time
   limit. Returns the exit code. */
static int ask_scene(const cli_arguments *arguments, request *r)
{
    const bool with = cli_text(arguments, "with", NULL);
    koksma_scene *scene = NULL;
    size_t spp = 0, most = MOST_SCENE_SPP;
    strcpy(r->scene_spp, "16");
    koksma_status status = with ? KOKSMA_OK : koksma_scene_open(r->options.scene, &scene);
    if (scene) {
        const koksma_scene_counts counts = koksma_scene_count(scene);
        koksma_render_options defaults;
        koksma_render_options_init(&defaults, scene);
        defaults.integrator = cli_text(arguments, "integrator", NULL) ? r->options.integrator : defaults.integrator;
        r->options.integrator = defaults.integrator;
        const char *ending = strrchr(r->options.scene, '.');
        if (ending && strstr(".gltf .glb .obj .ply", ending) && !counts.paths &&
            !cli_given(arguments, "integrator") && !cli_flag(arguments, "quiet")) {
            cli_say("rank", "%s: ranked by %s; a path tracer may need another pattern: --integrator path",
                    r->options.scene, r->options.integrator->name);
        }
        if (!cli_flag(arguments, "quiet")) {
            bool is_black;
            const bool odd = cli_scene_warnings(arguments, r->options.scene, scene, &defaults, 3);
            status = odd && !counts.lights ? KOKSMA_OK
                                           : cli_look(arguments, r->options.scene, scene, &defaults, &is_black);
        }
        koksma_scene_close(scene);
        spp = counts.spp;
        most = counts.paths ? MOST_PATHS_SPP : MOST_SCENE_SPP;
    }
    if (spp && !r->spp && !cli_text(arguments, "spp", NULL) && !cli_text(arguments, "target-error", NULL)) {
        const size_t taken = spp < most ? spp : most;
        snprintf(r->scene_spp, sizeof r->scene_spp, "%zu", taken);
        if (!cli_flag(arguments, "quiet")) {
            cli_say("rank",
                    "%s: its sampler takes %zu samples a pixel: ranking at %zu; --spp N chooses another number",
                    r->options.scene, spp, taken);
        }
    }
    return status ? cli_fail(arguments, status) : CLI_YES;
}

/* Reads all options but --spp. Returns the exit code. */
static int parse_request(const cli_arguments *arguments, request *r)
{
    koksma_rank_options *o = &r->options;
    uint64_t max_trials;
    if (!options_fit(arguments)) {
        return CLI_USAGE;
    }
    if (arguments->n_operands != 1) {
        return cli_one_scene(arguments);
    }
    int code = parse_adaptive(arguments, r->adaptive, &o->adaptive);
    code = code ? code : parse_patterns(arguments, &r->p, &r->spp);
    if (code) {
        return code;
    }
    o->scene = arguments->operands[0];
    o->patterns = r->p.at;
    o->n_patterns = r->p.n;
    o->integrator = koksma_integrator_find("distribution");
    o->filter = koksma_filter_find("box");
    o->one_size = cli_flag(arguments, "one-size");
    o->metric = r->metric.specs;
    o->doubt = cli_flag(arguments, "quiet") ? NULL : say_doubt;
    parse_variant(arguments, r);
    if (!cli_real(arguments, "time-limit", 60, 0, 1e9, &r->time_limit_s) ||
        !cli_integrator_and_filter(arguments, &o->integrator, &o->filter) ||
        !cli_size(arguments, &o->width, &o->height) ||
        !cli_whole(arguments, "max-trials", 4096, 8, KOKSMA_MAX_RANK_TRIALS, &max_trials) ||
        !cli_whole(arguments, "seed", 0, 0, UINT64_MAX, &o->seed) || !cli_one_metric(arguments, &r->metric) ||
        !parse_process(arguments, r)) {
        return CLI_USAGE;
    }
    o->max_trials = (long long)max_trials;
    code = ask_scene(arguments, r);
    return code ? code : parse_outside(arguments, r);
}

/* Makes a ranking for each number of samples. Returns the exit code. */
static int rank_all(const cli_arguments *arguments, request *r, const size_t *spps, size_t n_spp)
{
    cli_work work;
    if (!cli_work_begin(arguments, "ranking", &work)) {
        return CLI_USAGE;
    }
    cli_rows *rows = cli_rows_open(cli_flag(arguments, "json"));
    koksma_status status = KOKSMA_OK;
    bool all_settled = true;
    const double start_s = work.started_s;
    work.limit_s = r->time_limit_s;
    for (size_t i = 0; !status && i < n_spp; i++) {
        cli_work_part(&work, i, n_spp);
        const double left_s = fmax(r->time_limit_s - (cli_seconds() - start_s), r->time_limit_s > 0 ? 1e-3 : 0);
        bool settled = false;
        r->options.spp = r->outside.spp = (int)spps[i];
        r->options.time_limit_s = left_s / (double)(n_spp - i);
        atomic_store(&r->outside.timed, false);
        status = rank_at(arguments, &r->options, &work, rows, &settled);
        r->options.doubt = NULL; /* of the same reference */
        all_settled &= settled;
    }
    cli_work_end();
    const int code = status ? cli_fail(arguments, status) : all_settled ? CLI_YES : CLI_NO;
    return cli_rows_close(rows, code);
}

static int run(const cli_arguments *arguments)
{
    request r = {.spp = 0};
    char counted[24];
    size_t spps[KOKSMA_MAX_SIZES], n_spp;
    int code = parse_request(arguments, &r);
    const char *list = cli_text(arguments, "spp", r.scene_spp);
    if (!code && cli_text(arguments, "target-error", NULL)) {
        r.options.time_limit_s = r.time_limit_s;
        r.options.one_size = true;
        code = check_command(arguments, &r, true);
        code = code ? code : cli_rank_to_error(arguments, &r.options, r.spp);
        koksma_image_fini(&r.reference);
        return code;
    }
    if (!code && r.spp) {
        snprintf(counted, sizeof counted, "%llu", (unsigned long long)r.spp);
        if (strcmp(cli_text(arguments, "spp", counted), counted) != 0) {
            code = cli_usage_error(arguments, "-p has @%s and -n %s", counted, list);
        }
        list = counted;
    }
    if (!code && !cli_sizes(arguments, "spp", list, "", KOKSMA_MAX_SPP, spps, &n_spp)) {
        code = CLI_USAGE;
    }
    code = code ? code : check_command(arguments, &r, n_spp > 1);
    for (size_t i = 0; i < r.p.n && !code; i++) {
        cli_warn_file(arguments, r.p.at[i], n_spp > 1 ? 0 : spps[0]);
    }
    bool said = code || n_spp > 1 || list == r.scene_spp;
    for (size_t i = 0; i < r.p.n && !said; i++) {
        koksma_spec spec;
        said = !koksma_pattern_spec(r.p.at[i], &spec) && cli_warn_unbalanced(arguments, &spec, spps[0]);
    }
    code = code ? code : rank_all(arguments, &r, spps, n_spp);
    koksma_image_fini(&r.reference);
    return code;
}

static const cli_option options[] = {
    {'n', "spp", "N,..",
     "numbers of samples per pixel; each gets its own ranking (default: that of "
     "the scene's own sampler, at most 64, or 16 where it is ranked by path; else 16)"},
    {'p', "patterns", "PATTERN,..|modern|thesis|later|all", "patterns to rank, also SPEC@N (default: modern)"},
    {0, "target-error", "ERROR", "print how many samples of each pattern leave this error, instead of a ranking"},
    {0, "size", "WxH",
     "image size (default: that of the scene, halved until it has at most 19,200 pixels, in a medium "
     "4,800)"},
    {0, "with", "RENDERER|mitsuba",
     "shell command of another renderer, with {scene}, {pattern}, {spp}, {seed}, {out}"},
    {0, "reference", "FILE|PATTERN",
     "a finished reference, taken as exact; with --with also the sampler of the reference (default: the first)"},
    {0, "filter-with", "blur:sd=S|COMMAND",
     "process each image, not the reference: a Gaussian blur, or a shell command with {in} and {out}, such as a "
     "denoiser"},
    {0, "one-size", NULL, "do not check the best patterns at half and twice the size"},
    CLI_INTEGRATOR_OPTION,
    CLI_FILTER_OPTION,
    {0, "depth", "D", "the most bounces (default: the integrator's)"},
    {0, "lights", "all|one|power|uniform|auto", "lights that get a shadow ray, as in 'koksma render' (default: all)"},
    {0, "scope", "pixel|image", "what one point set covers (default: pixel)"},
    {'s', "seed", "S", "seed of all images: another one gives an independent ranking (default: 0)"},
    {0, "adaptive", "METHOD", "render all patterns adaptively, N being the budget; see 'koksma list adaptive'"},
    {'m', "metric", "METRIC",
     "error metric by which patterns are ranked: mae (default), rmse, relmse, smape, grain, ldr-flip or "
     "hdr-flip, with parameters"},
    {0, "time-limit", "S", "time limit in seconds for all rankings together; 0: no limit (default: 60)"},
    CLI_UNKNOWN_OPTION,
    {0, "max-trials", "N", "largest number of images of each pattern at each size, 8 to 65536 (default: 4096)"},
    CLI_ROW_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_rank = {
    .name = "rank",
    .summary = "rank patterns by the error that they leave in a scene",
    .synopsis = "SCENE [--spp N,..|--target-error ERROR] [--patterns PATTERN,..|modern|thesis|later|all] [--size "
                "WxH] [--one-size] [--integrator INTEGRATOR] [--filter FILTER] [--depth D] [--lights "
                "all|one|power|uniform|auto] [--scope pixel|image] [--seed S] [--reference FILE] [--adaptive "
                "METHOD] [--metric METRIC] [--time-limit S] [--max-trials N] [--with RENDERER [--reference "
                "PATTERN]] [--filter-with blur:sd=S|COMMAND] [--json]",
    .details =
        "Renders the scene many times with every pattern and ranks the patterns by the error of the image: the "
        "mean over the images of --metric, by default the mean absolute error in luminance. Each pattern is used "
        "with the modifiers in its spec, such as shift=1.\n"
        "\n"
        "The sequence of work depends on the command line, not on the machine. It begins with rounds of 8, 12, 16, "
        "24, 32, ... trials until the best pattern, and the best pattern without bands, are decided. Then such "
        "rounds are made at half and at twice the size, for the best three patterns without bands and the best "
        "three of all; a remark appears if another pattern is the best at that size. The last rounds decide every "
        "pair of patterns. A pair is decided if the confidence interval of the ratio of its errors excludes 1 "
        "(different) or lies within 2 % of 1 (equal). A time limit ends the sequence early; a longer limit never "
        "changes which pattern is decided to be the best. If the time is up before, the advice names a pattern whose "
        "error exceeds that of the best by at most 5 % (within in --json), as far as the confidence intervals show "
        "one; if they do not, the errors without the 0.1 % of the pixels that err most may (without_few); else the "
        "answer is 'undecided', with an estimate of the time needed.\n"
        "\n"
        "position: 1 + the number of patterns that are decided to be better. behind: relative difference to the "
        "first row, over the trials that both have; the errors are over all trials of each, so that their quotient "
        "may differ a little. All decisions of a ranking hold together with 95 % probability, and so do the "
        "intervals of all errors and those of all differences; they include the error of the reference image. A "
        "pattern whose first 8 trials exceed its part of the time limit is postponed until the others are decided; "
        "if no time is left it is not ranked, and the advice is that of the others. The advice goes to stderr. Its "
        "last line says how many samples of the pattern random leave as much error as those of the best pattern, "
        "by the rate n^-1/2 of independent samples and the two measured errors.\n"
        "\n"
        "Errors are measured against the mean of 16 independent images of sobol:scramble=owen with as many samples "
        "as the patterns, at least 16. From 24 trials of a pattern on they have 4 times as many samples, and from "
        "96 trials 16 times as many, so that the first rows need little time. Before, two images of each pattern "
        "give a first look: their difference tells the root mean square error, but no bias. It is printed where "
        "progress is shown, or if the time is up before the first row. All intervals include the reference's own "
        "error. --reference FILE takes an image in their place, as if it had no error, which no interval includes; "
        "it must "
        "have the size of the images (default: they have its size), and no other sizes are checked.\n"
        "\n"
        "coherence: the peak of the error's power spectrum divided by its mean, with the allowance for blue noise "
        "that koksma compare --help has, over the first 8 trials. 'coherent' means that white noise has a "
        "coherence this large with a probability below 0.5 % (koksma compare --help). A coherent error has bands "
        "or another pattern, which eyes notice more than noise of the same size. The advice therefore names the "
        "best pattern whose error is not coherent, and how much less error a coherent pattern leaves.\n"
        "\n"
        "unbiased: 'yes' means that the pattern or a modifier claims it (koksma list patterns), or that it is "
        "scrambled. Part of the error of other patterns may be bias, the same in every trial, which no number of "
        "images averages away; the advice names them. Nothing is known of samplers of --with.\n"
        "\n"
        "If the 0.1 % of the pixels with the largest error have at least half of the total error (top_share in "
        "--json), a warning tells that few pixels decide the order. 'robust' is the error without them, not "
        "corrected for the error of the reference as 'error' is. Each image is compared 17 times: with the "
        "reference, which is the mean of 16 images, and with the 16 means that leave out one of these images. At "
        "160 x 120 pixels this takes 0.7 s for hdr-flip and some milliseconds for mae.\n"
        "\n"
        "--adaptive ranks patterns as they are with a method of adaptive sampling: each image of each pattern is "
        "that of koksma render --adaptive METHOD --budget N, with a quarter of N in the first round (divided by "
        "the sets that the method's parameter 'first' asks for). So all patterns may take the same number of "
        "samples. The reference has as many in every pixel. A method that places its own samples (hierarchical, "
        "selective) leaves no choice of patterns: the one row is the method's. The advice says in how many "
        "patterns' images the method leaves\n"
        "bands: samples that decide about further ones and then count make pixels of one edge err alike "
        "(docs/findings/adaptive.md). Therefore no row is 'unbiased'.\n"
        "\n"
        "Only the integrator path renders light that surfaces reflect onto each other. "
        "PATTERN may set patterns of single uses or groups of uses, such as 'random;pixel+time=scan-time'.\n"
        "modern: sobol:scramble=owen and pmj02, which the project's own studies put first, "
        "correlated-multi-jittered, multi-jittered, n-rooks, jittered and random. thesis: the seven patterns of "
        "Shirley 1991. later: five of these and twelve newer ones.\n"
        "\n"
        "--with ranks the samplers of another renderer: RENDERER is run by the shell for every image, with texts "
        "in place of {scene}, {pattern}, {spp}, {seed} (0 to 2^31 - 1), {width}, {height} and {out}, the EXR file "
        "to write; {out.pfm} and {out.png} ask for other formats. Each text stands in single quotes, so that the "
        "shell's arithmetic needs a variable: s={seed}; echo $((s % 3)). SCENE and PATTERN can then be any texts. "
        "Without --size images have the default size of the renderer, and other sizes are not checked. The "
        "reference is the mean of 16 images by the sampler --reference, which must be unbiased and depend on the "
        "seed. If the pictures of the first rows take more than 5 s, a line after the first picture says how long. "
        "Only this option and --filter-with run commands. --integrator, --filter, --depth, --lights, --scope, "
        "--adaptive, --unknown and --allow-exec, which concern Koksma's own renderer, are refused with it. '--with "
        "mitsuba' ranks samplers of Mitsuba 3 and patterns of Koksma in a scene of Mitsuba. It needs a Python "
        "interpreter in which koksma and mitsuba are installed (environment variable KOKSMA_PYTHON; default: "
        "python3). It starts Mitsuba for every image and takes seconds for each; koksma.mitsuba.rank in Python "
        "starts it once.\n"
        "\n"
        "--filter-with tells whether the order stays after a denoiser or a filter: COMMAND is run for every image, "
        "with the EXR file to read in place of {in} and the one to write in place of {out}; {in.pfm}, {in.png}, "
        "{out.pfm} and {out.png} are files of other formats. The error is that of the processed image against the "
        "reference, which is not processed: what a filter blurs counts as error. --metric rmse:blur=S instead "
        "blurs both.\n"
        "\n"
        "A pattern that has no set of N points is left out, and a message says why. A pattern whose file is "
        "missing or malformed, or whose program fails or may not run (--allow-exec), ends the ranking before it "
        "renders.\n"
        "\n"
        "--target-error prints how many samples of each pattern leave this error, fewest first. The errors of 1, "
        "4, 16, ... samples, or of the next numbers that the pattern can make, are measured by 8 images each, "
        "until one is at most ERROR; the number is narrowed by the power law of the errors, and checked by 8 "
        "images of fresh seeds. spp: the number found. error, low, high: the mean error of those images with its "
        "95 % interval, the reference's own error included. needed, needed_low, needed_high: where the mean error "
        "is ERROR, by the rate, the slope of log error against log samples. A pattern that did not get there "
        "within the time limit is 'extrapolated' by its rate, with an interval that follows from the rate's, or "
        "'unknown'.\n"
        "\n"
        "Exit codes: 0 the pattern to use is decided for every number of samples; 1 it is undecided for at least "
        "one, or with --target-error a pattern did not reach it; 2, 3, 4 and 130 as for all commands (koksma "
        "--help).\n",
    .examples = "koksma rank ball --spp 16 -p random,n-rooks,sobol:scramble=owen\n"
                "koksma rank balls --spp 4,16 -p random,jittered,sobol:scramble=owen\n"
                "koksma rank ball --target-error 0.01 -p random,n-rooks,sobol:scramble=owen\n"
                "koksma rank cornell --integrator path --time-limit 300\n"
                "koksma rank balls --spp 4 --size 32x24 --metric ldr-flip\n"
                "koksma rank glossy --spp 16 --adaptive contrast -p random,n-rooks,pmj02\n"
                "koksma rank s.xml -p a,b --with './r {scene} {pattern} {spp} {seed} {out}'\n",
    .options = options,
    .run = run,
};
