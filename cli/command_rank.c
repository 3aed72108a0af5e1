/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma rank`: ranks patterns by the error that they leave in a scene, separately for each number of samples.
 * koksma_rank_patterns computes a ranking. This file has the lists of patterns, divides the time limit among the
 * rankings, prints the rows, and returns the exit code (1: the best pattern is undecided). rank_advice.c prints the
 * advice. Long because the options, what they exclude and their help stand together.
 */
#include <math.h>
#include <stdatomic.h>
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

/* The command of --with, and what its first picture tells of the time. */
typedef struct outside {
    const char *command;
    size_t patterns;
    int spp;
    bool quiet, reference; /* reference: the first pictures are those of a reference */
    atomic_bool timed;     /* a picture of the full number of samples has been timed */
} outside;

enum { REFERENCE_PICTURES = 16, FIRST_TRIALS = 8, LEAST_SAID_S = 5 };

/* Renders a picture for a koksma_rank_renderer whose context is an `outside`. After the first one a line says how long the
   pictures take on which the first rows wait, before most of that time is over. */
static koksma_status render_outside(void *context, const koksma_rank_picture *picture, const koksma_run *run,
                                    koksma_image *image)
{
    outside *o = context;
    const double start_s = cli_seconds();
    char one[CLI_NUMBER], all[CLI_NUMBER], more[CLI_NUMBER];
    const koksma_status status = koksma_rank_by_command((void *)o->command, picture, run, image);
    if (status || picture->spp < o->spp || atomic_exchange(&o->timed, true) || o->quiet) {
        return status;
    }
    const double s = cli_seconds() - start_s, reference_s = o->reference ? REFERENCE_PICTURES * s : 0;
    const double trials_s = s * FIRST_TRIALS * (double)o->patterns;
    if (reference_s + trials_s >= LEAST_SAID_S) {
        cli_say("rank", "a picture of %d samples took %s: %s%s%s the first %d of each of %zu samplers at most %s",
                picture->spp, cli_duration(s, one), o->reference ? "the reference's 16 take about " : "",
                o->reference ? cli_duration(reference_s, all) : "", o->reference ? ", and" : "", FIRST_TRIALS,
                o->patterns, cli_duration(trials_s, more));
    }
    return status;
}

/* Blurs a trial's image for a koksma_rank_process whose context is a standard deviation (double). */
static koksma_status blur_image(void *context, const koksma_image *image, const koksma_run *run, koksma_image *out)
{
    (void)run;
    return koksma_image_blur(image, *(const double *)context, out);
}

/* The text of --filter-with, or NULL. text: room for "blur:sd=" and a number. */
enum { PROCESS_TEXT = CLI_NUMBER + 16 };
static const char *process_text(const koksma_rank_options *options, char text[PROCESS_TEXT])
{
    char number[CLI_NUMBER];
    if (options->process != blur_image) {
        return options->process_context;
    }
    snprintf(text, PROCESS_TEXT, "blur:sd=%s", cli_number(*(const double *)options->process_context, number));
    return text;
}

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
static int parse_patterns(const cli_args *args, patterns *p, uint64_t *spp)
{
    const char *list = cli_text(args, "patterns", "modern");
    if (cli_text(args, "with", NULL) && !cli_text(args, "patterns", NULL)) {
        return cli_error(args, "--with needs --patterns, with names of samplers that the command knows");
    }
    char item[KOKSMA_MAX_SPEC];
    const char *given = method_uses_patterns(cli_text(args, "adaptive", NULL)) ? list : "n-rooks";
    list = expand_lists(given);
    const bool many = list != given || !strcmp(list, "all");
    for (size_t at = 0; cli_pattern_item(list, at, item); at++) {
        if (!cli_text(args, "with", NULL) && !cli_take_counts(args, item, spp)) {
            return CLI_USAGE;
        }
        static char text[KOKSMA_MAX_PATTERNS_TEXT];
        koksma_render_options options = {0}; /* only the patterns in this struct are used */
        if (p->n == MAX_PATTERNS) {
            return cli_error(args, "--patterns: more than %d", MAX_PATTERNS);
        }
        /* n-rooks remains the pattern of all uses that the text does not name */
        koksma_status status = koksma_pattern_spec("n-rooks", &options.pattern);
        if (cli_text(args, "with", NULL)) {
            memcpy(text, item, sizeof item);
        } else if (status || (status = koksma_render_patterns(item, &options))) {
            return cli_fail(args, status);
        } else {
            koksma_render_patterns_text(&options, text);
        }
        if (strlen(text) >= sizeof p->texts[p->n]) {
            return cli_error(args, "--patterns %.40s...: longer than %zu characters", text,
                             sizeof p->texts[p->n] - 1);
        }
        memcpy(p->texts[p->n], text, strlen(text) + 1);
        size_t i = 0;
        while (i < p->n && strcmp(p->texts[i], p->texts[p->n]) != 0) {
            i++;
        }
        if (i < p->n && !many) {
            return cli_error(args, "--patterns: '%s' is listed twice", p->texts[i]);
        }
        p->at[p->n] = p->texts[p->n];
        p->n += i == p->n; /* "all" lists some patterns under two names, and a list may hold what is named, too */
    }
    return CLI_YES;
}

static const char *const decisions[] = {"undecided", "best", "equal", "worse"};
static const char *const states[] = {"ranked", "too-slow", "refused"};
static const char *const check_states[] = {"unchecked", "confirmed", "overturned", "unsettled", "failed"};

/* Puts the result of a check at another size, the better pattern, and whether that pattern's error is coherent. name:
   "half_size" or so, with which the keys begin. */
static void put_check(const koksma_rank_options *options, const koksma_rank_check_result *result, const char *name)
{
    char key[32];
    cli_row_text(name, check_states[result->state]);
    if (result->state == KOKSMA_RANK_OVERTURNED) {
        snprintf(key, sizeof key, "%s_best", name);
        cli_row_text(key, options->patterns[result->pattern]);
    }
    if (result->state == KOKSMA_RANK_CONFIRMED || result->state == KOKSMA_RANK_OVERTURNED) {
        snprintf(key, sizeof key, "%s_coherent", name);
        cli_row_json(key, result->coherent ? "true" : "false", "");
    }
}

/* Adds the values of a whole ranking to a JSON row. advised: the index of the advised pattern, ignored if none is
   advised. */
static void put_ranking(const koksma_rank_options *options, const koksma_ranking *ranking, size_t advised)
{
    if (options->render) {
        cli_row("with %s", ((const outside *)options->render_context)->command);
    } else {
        cli_row("integrator %s filter %s", options->integrator->name, options->filter->name);
    }
    if (options->adaptive) {
        cli_row("adaptive %s", options->adaptive);
    }
    if (options->process) {
        char text[PROCESS_TEXT];
        cli_row("filter_with %s", process_text(options, text));
    }
    cli_row("reference_error %g settled? %d complete? %d cut_short? %d", ranking->reference_error, ranking->settled,
            ranking->complete, ranking->cut_short);
    if (ranking->advised) {
        cli_row("advised %s", options->patterns[advised]);
    }
    cli_row("within %g without_few? %d needed_trials %lld needed_s %g random_spp %g "
            "random_spp_low %g random_spp_high %g undecidable? %d",
            ranking->within, ranking->without_few, ranking->needed_trials, ranking->needed_s, ranking->random_spp,
            ranking->random_spp_low, ranking->random_spp_high, ranking->undecidable);
    for (int i = 0; i < KOKSMA_RANK_CHECKS; i++) {
        const koksma_rank_check *check = &ranking->checks[i];
        if (i) {
            cli_row("twice_width %d twice_height %d", check->width, check->height);
        } else {
            cli_row("half_width %d half_height %d", check->width, check->height);
        }
        put_check(options, &check->advice, i ? "twice_size" : "half_size");
        put_check(options, &check->first, i ? "twice_size_first" : "half_size_first");
    }
}

/* Prints row i of a ranking. Only JSON rows repeat the values of the whole ranking; in text output the advice on
   stderr has them. */
static void put_row(const koksma_rank_options *options, const koksma_rank_row *table, size_t i,
                    const koksma_ranking *ranking, bool json)
{
    const koksma_rank_row *row = &table[i];
    char metric[KOKSMA_MAX_SPEC];
    koksma_metric_text(options->metric, metric);
    cli_row("scene %s spp %d position %g pattern %s error %g low %g high %g behind %g behind_low %g behind_high %g "
            "trials %lld coherence %g",
            options->scene, options->spp, row->position ? (double)row->position : (double)NAN,
            options->patterns[row->pattern], row->mean, row->low, row->high, row->behind, row->behind_low,
            row->behind_high, row->trials, row->coherence.coherence);
    if (json) {
        cli_row("coherence_low %g coherence_high %g coherence_noise %g coherence_p %g", row->coherence.low,
                row->coherence.high, row->coherence.noise_high, row->coherence.p);
    }
    /* with fewer than 8 trials nothing is known of coherence, and never of another renderer's samplers */
    cli_row("coherent? %d unbiased? %d width %d height %d metric %s",
            isnan(row->coherence.coherence) ? -1 : row->coherence.coherent, options->render ? -1 : !row->biased,
            ranking->width, ranking->height, metric);
    if (json) {
        cli_row("robust %g top_share %g state %s decision %s reason %s", row->robust, row->top_share,
                states[row->state], decisions[row->decision], row->reason);
        put_ranking(options, ranking, table[ranking->advised_row].pattern);
    }
    cli_row_end();
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
        char names[MAX_PATTERNS * (KOKSMA_MAX_SPEC + 5)] = "";
        size_t n = 0, done = 0;
        for (size_t j = i; j < options->n_patterns; j++) {
            n += same_reason(options, &table[i], &table[j]);
        }
        for (size_t j = i; j < options->n_patterns; j++) {
            if (same_reason(options, &table[i], &table[j])) {
                said[j] = true;
                CLI_APPEND(names, sizeof names, "%s%s", cli_between(done++, n), options->patterns[table[j].pattern]);
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
static koksma_status rank_at(const cli_args *args, const koksma_rank_options *options, cli_work *work, bool *settled)
{
    koksma_rank_row table[MAX_PATTERNS];
    koksma_ranking ranking;
    koksma_rank_options asked = *options;
    first_look look = {.options = options, .at_once = work->visible};
    asked.look = cli_flag(args, "quiet") ? NULL : take_look;
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
        put_row(&shown, table, i, &ranking, cli_flag(args, "json"));
    }
    if (!cli_flag(args, "quiet")) {
        char text[PROCESS_TEXT];
        cli_rank_advise(&shown, table, &ranking, process_text(options, text));
    }
    if (look.waits && !ranking.n) {
        cli_rank_say_look(options, look.errors);
    }
    say_unranked(&shown, table, &ranking);
    *settled = cli_rank_decided(&ranking);
    return KOKSMA_OK;
}

/* Returns false, after an error, if an option is given that has no effect with, or without, --with. */
static bool options_fit(const cli_args *args)
{
    const bool with = cli_text(args, "with", NULL);
    if (with && !cli_refuse(args, "integrator filter depth lights scope adaptive unknown allow-exec",
                            "has no effect with --with, because RENDERER reads the scene and makes the points and "
                            "images")) {
        return false;
    }
    const char *adaptive = cli_text(args, "adaptive", NULL);
    if (!method_uses_patterns(adaptive) && cli_text(args, "patterns", NULL)) {
        return !cli_error(args, "--patterns has no effect: the adaptive method %.*s places its own samples",
                          (int)strcspn(adaptive, ":"), adaptive);
    }
    const char *reference = cli_text(args, "reference", NULL);
    if (!with && reference && !cli_is_image(reference)) {
        return !cli_error(
            args,
            "--reference %s: without --with it takes an image, such as reference.exr; Koksma's own references "
            "use the pattern sobol:scramble=owen",
            reference);
    }
    return true;
}

/* Reads --adaptive in its canonical form; *adaptive is NULL without it. Returns the exit code. */
static int parse_adaptive(const cli_args *args, char text[KOKSMA_MAX_SPEC], const char **adaptive)
{
    koksma_adaptive_options method;
    *adaptive = cli_text(args, "adaptive", NULL);
    const koksma_status status = *adaptive ? koksma_adaptive_parse(*adaptive, &method) : KOKSMA_OK;
    if (*adaptive && !status) {
        koksma_adaptive_text(&method, text);
        *adaptive = text;
    }
    return status ? cli_fail(args, status) : CLI_YES;
}

/* What the options say, except the number of samples. */
typedef struct request {
    patterns p;
    uint64_t spp;       /* N of a pattern SPEC@N, or 0 */
    char scene_spp[24]; /* the default of --spp */
    char adaptive[KOKSMA_MAX_SPEC], variant[256];
    cli_metrics metric;
    koksma_image reference; /* without pixels: references are rendered */
    outside outside;
    double blur; /* of --filter-with blur:sd=S */
    double time_limit_s;
    koksma_rank_options options;
} request;

/* Writes --scope, --lights and --depth as a plan's options; options->variant stays NULL without them. */
static void parse_variant(const cli_args *args, request *r)
{
    static const char *const names[] = {"scope", "lights", "depth"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const char *word = cli_text(args, names[i], NULL);
        if (word) {
            CLI_APPEND(r->variant, sizeof r->variant, "%s%s=%.64s", *r->variant ? ";" : "", names[i], word);
            r->options.variant = r->variant;
        }
    }
}

/* Refuses a command of --with that would make equal pictures of what is compared. many_spp: several numbers of samples are
   wanted. Returns the exit code. */
static int check_command(const cli_args *args, const request *r, bool many_spp)
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
            return cli_error(args, "--with: the command lacks %s, and the ranking %s", all[i].word, all[i].why);
        }
    }
    return CLI_YES;
}

/* Reads --with and --reference. Returns the exit code. */
static int parse_outside(const cli_args *args, request *r)
{
    koksma_rank_options *o = &r->options;
    const char *reference = cli_text(args, "reference", NULL), *command = cli_text(args, "with", NULL);
    if (cli_is_image(reference)) {
        if (cli_has_eight_bits(reference) && !command) {
            return cli_error(args,
                             "--reference %s: 8 bits are rounded and clipped, an error that looks like bands; "
                             "write it as .exr or .pfm",
                             reference);
        }
        const koksma_status status = koksma_image_read(reference, &r->reference);
        if (status) {
            return cli_fail(args, status);
        }
        o->reference_image = &r->reference;
        o->width = o->width || command ? o->width : r->reference.width;
        o->height = o->height || command ? o->height : r->reference.height;
    } else {
        o->reference = reference;
    }
    if (command) {
        r->outside = (outside){.command = strcmp(command, "mitsuba") != 0 ? command : mitsuba,
                               .patterns = r->p.n,
                               .quiet = cli_flag(args, "quiet"),
                               .reference = !o->reference_image};
        o->render = render_outside;
        o->render_context = &r->outside;
    }
    return CLI_YES;
}

/* Reads --filter-with: "blur:sd=S", or a command. Returns false after an error. */
static bool parse_process(const cli_args *args, request *r)
{
    static const char blur[] = "blur:sd=";
    const char *text = cli_text(args, "filter-with", NULL);
    if (text && !strncmp(text, blur, strlen(blur))) {
        char *end;
        r->blur = strtod(text + strlen(blur), &end);
        if (end == text + strlen(blur) || *end || !(r->blur > 0 && r->blur <= 100)) {
            return !cli_error(
                args, "--filter-with %s: it takes a standard deviation of 0 to 100 pixels, as in blur:sd=1.5", text);
        }
        r->options.process = blur_image;
        r->options.process_context = &r->blur;
    } else if (text && !strchr(text, '{')) {
        return !cli_error(args, "--filter-with %s: it takes blur:sd=S, or a command with {in} and {out}", text);
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
static int ask_scene(const cli_args *args, request *r)
{
    const bool with = cli_text(args, "with", NULL);
    koksma_scene *scene = NULL;
    size_t spp = 0, most = MOST_SCENE_SPP;
    strcpy(r->scene_spp, "16");
    koksma_status status = with ? KOKSMA_OK : koksma_scene_open(r->options.scene, &scene);
    if (scene) {
        const koksma_scene_counts counts = koksma_scene_count(scene);
        koksma_render_options defaults;
        koksma_render_options_init(&defaults, scene);
        defaults.integrator = cli_text(args, "integrator", NULL) ? r->options.integrator : defaults.integrator;
        r->options.integrator = defaults.integrator;
        const char *ending = strrchr(r->options.scene, '.');
        if (ending && strstr(".gltf .glb .obj .ply", ending) && !counts.paths && !cli_given(args, "integrator")) {
            cli_note(args, "%s: ranked by %s; a path tracer may need another pattern: --integrator path",
                     r->options.scene, r->options.integrator->name);
        }
        if (!cli_flag(args, "quiet")) {
            bool is_black;
            const bool odd = cli_scene_warnings(args, r->options.scene, scene, &defaults, 3);
            status =
                odd && !counts.lights ? KOKSMA_OK : cli_look(args, r->options.scene, scene, &defaults, &is_black);
        }
        koksma_scene_close(scene);
        spp = counts.spp;
        most = counts.paths ? MOST_PATHS_SPP : MOST_SCENE_SPP;
    }
    if (spp && !r->spp && !cli_text(args, "spp", NULL) && !cli_text(args, "target-error", NULL)) {
        const size_t taken = spp < most ? spp : most;
        snprintf(r->scene_spp, sizeof r->scene_spp, "%zu", taken);
        cli_note(args, "%s: its sampler takes %zu samples a pixel: ranking at %zu; --spp N chooses another number",
                 r->options.scene, spp, taken);
    }
    return status ? cli_fail(args, status) : CLI_YES;
}

/* Reads all options but --spp. Returns the exit code. */
static int parse_request(const cli_args *args, request *r)
{
    koksma_rank_options *o = &r->options;
    uint64_t max_trials;
    if (!options_fit(args)) {
        return CLI_USAGE;
    }
    if (args->n_operands != 1) {
        return cli_one_scene(args);
    }
    int code = parse_adaptive(args, r->adaptive, &o->adaptive);
    code = code ? code : parse_patterns(args, &r->p, &r->spp);
    if (code) {
        return code;
    }
    o->scene = args->operands[0];
    o->patterns = r->p.at;
    o->n_patterns = r->p.n;
    o->integrator = koksma_integrator_find("distribution");
    o->filter = koksma_filter_find("box");
    o->one_size = cli_flag(args, "one-size");
    o->metric = r->metric.specs;
    o->doubt = cli_flag(args, "quiet") ? NULL : say_doubt;
    parse_variant(args, r);
    if (!cli_real(args, "time-limit", 60, 0, 1e9, &r->time_limit_s) ||
        !cli_integrator_and_filter(args, &o->integrator, &o->filter) || !cli_size(args, &o->width, &o->height) ||
        !cli_whole(args, "max-trials", 4096, 8, KOKSMA_MAX_RANK_TRIALS, &max_trials) ||
        !cli_whole(args, "seed", 0, 0, UINT64_MAX, &o->seed) || !cli_one_metric(args, &r->metric) ||
        !parse_process(args, r)) {
        return CLI_USAGE;
    }
    o->max_trials = (long long)max_trials;
    code = ask_scene(args, r);
    return code ? code : parse_outside(args, r);
}

/* Makes a ranking for each number of samples. Returns the exit code. */
static int rank_all(const cli_args *args, request *r, const size_t *spps, size_t n_spp)
{
    cli_work work;
    if (!cli_work_begin(args, "ranking", &work)) {
        return CLI_USAGE;
    }
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
        status = rank_at(args, &r->options, &work, &settled);
        r->options.doubt = NULL; /* of the same reference */
        all_settled &= settled;
    }
    cli_work_end();
    const int code = status ? cli_fail(args, status) : all_settled ? CLI_YES : CLI_NO;
    return cli_rows_close(code);
}

static int run(const cli_args *args)
{
    request r = {.spp = 0};
    char counted[24];
    size_t spps[KOKSMA_MAX_SIZES], n_spp;
    int code = parse_request(args, &r);
    const char *list = cli_text(args, "spp", r.scene_spp);
    if (!code && cli_text(args, "target-error", NULL)) {
        r.options.time_limit_s = r.time_limit_s;
        r.options.one_size = true;
        code = check_command(args, &r, true);
        code = code ? code : cli_rank_to_error(args, &r.options, r.spp);
        koksma_image_fini(&r.reference);
        return code;
    }
    if (!code && r.spp) {
        snprintf(counted, sizeof counted, "%llu", (unsigned long long)r.spp);
        if (strcmp(cli_text(args, "spp", counted), counted) != 0) {
            code = cli_error(args, "-p has @%s and -n %s", counted, list);
        }
        list = counted;
    }
    if (!code && !cli_sizes(args, "spp", list, "", KOKSMA_MAX_SPP, spps, &n_spp)) {
        code = CLI_USAGE;
    }
    code = code ? code : check_command(args, &r, n_spp > 1);
    for (size_t i = 0; i < r.p.n && !code; i++) {
        cli_warn_file(args, r.p.at[i], n_spp > 1 ? 0 : spps[0]);
    }
    bool said = code || n_spp > 1 || list == r.scene_spp;
    for (size_t i = 0; i < r.p.n && !said; i++) {
        koksma_spec spec;
        said = !koksma_pattern_spec(r.p.at[i], &spec) && cli_warn_unbalanced(args, &spec, spps[0]);
    }
    code = code ? code : rank_all(args, &r, spps, n_spp);
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
        "The sequence of work depends on the command line, not on the machine: rounds of 8, 12, 16, 24, 32, ... "
        "trials until the best pattern, and the best pattern without bands, are decided; then such rounds at half "
        "and at twice the size, for the best three patterns without bands and the best three of all; then rounds "
        "that decide every pair. A pair is decided if the confidence interval of the ratio of its errors excludes "
        "1 (different) or lies within 2 % of 1 (equal). A longer time limit never changes which pattern is "
        "decided to be the best. If the time is up before, the advice names a pattern whose error exceeds that of "
        "the best by at most 5 % (within in --json), as far as the confidence intervals show one, at least "
        "without the 0.1 % of the pixels that err most (without_few); else it is 'undecided', with an estimate of "
        "the time needed.\n"
        "\n"
        "position: 1 + the number of patterns that are decided to be better. behind: relative difference to the "
        "first row, over the trials that both have. All decisions of a ranking hold together with 95 % "
        "probability, and so do the intervals of all errors and those of all differences; they include the error "
        "of the reference image. A pattern whose first 8 trials exceed its part of the time limit is postponed, "
        "and not ranked if no time is left. The advice goes to stderr. Its last line says how many samples of the "
        "pattern random leave as much error as those of the best pattern, by the rate n^-1/2.\n"
        "\n"
        "Errors are measured against the mean of 16 independent images of sobol:scramble=owen with as many "
        "samples as the patterns, at least 16; from 24 trials of a pattern on with 4 times, and from 96 trials "
        "with 16 times as many. Before, two images of each pattern give a first look: their difference tells the "
        "root mean square error, but no bias. It is printed where progress is shown, or if the time is up before "
        "the first row. --reference FILE takes an image in their place, as if it had no error, which no interval "
        "includes; it must have the size of the images (default: they have its size), and no other sizes are "
        "checked.\n"
        "\n"
        "coherence: the peak of the error's power spectrum divided by its mean, over the first 8 trials, and "
        "'coherent', as in koksma compare --help. A coherent error has bands or another pattern, which eyes "
        "notice more than noise of the same size. The advice therefore names the best pattern whose error is not "
        "coherent, and how much less error a coherent pattern leaves.\n"
        "\n"
        "unbiased: 'yes' means that the pattern or a modifier claims it (koksma list patterns), or that it is "
        "scrambled. Part of the error of other patterns may be bias, the same in every trial, which no number of "
        "images averages away. Nothing is known of samplers of --with.\n"
        "\n"
        "If the 0.1 % of the pixels with the largest error have at least half of the total error (top_share in "
        "--json), a warning tells that few pixels decide the order. 'robust' is the error without them, not "
        "corrected for the error of the reference as 'error' is.\n"
        "\n"
        "--adaptive ranks patterns as they are with a method of adaptive sampling: each image is that of koksma "
        "render --adaptive METHOD --budget N, with a quarter of N in the first round (divided by the sets that "
        "the method's parameter 'first' asks for). The reference has as many samples in every pixel. A method "
        "that places its own samples (hierarchical, selective) leaves no choice of patterns: the one row is the "
        "method's. Samples that decide about further ones and then count make pixels of one edge err alike "
        "(docs/findings/adaptive.md): the advice tells of bands, and no row is 'unbiased'.\n"
        "\n"
        "Only the integrator path renders light that surfaces reflect onto each other. PATTERN may set patterns "
        "of single uses or groups of uses, such as 'random;pixel+time=scan-time'. A pattern that has no set of N "
        "points is left out, and a message says why; one whose file is missing or malformed, or whose program "
        "fails or may not run (--allow-exec), ends the ranking before it renders.\n"
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
        "seed. Only this option and --filter-with run commands; options of Koksma's own renderer are refused with "
        "it. '--with mitsuba' ranks samplers of Mitsuba 3 and patterns of Koksma in a scene of Mitsuba, by a "
        "Python interpreter in which koksma and mitsuba are installed (environment variable KOKSMA_PYTHON; "
        "default: python3). It starts Mitsuba for every image and takes seconds for each; koksma.mitsuba.rank in "
        "Python starts it once.\n"
        "\n"
        "--filter-with tells whether the order stays after a denoiser or a filter: COMMAND is run for every "
        "image, with the EXR file to read in place of {in} and the one to write in place of {out}; {in.pfm}, "
        "{in.png}, {out.pfm} and {out.png} are files of other formats. The error is that of the processed image "
        "against the reference, which is not processed. --metric rmse:blur=S instead blurs both.\n"
        "\n"
        "--target-error prints how many samples of each pattern leave this error, fewest first. The errors of 1, "
        "4, 16, ... samples are measured by 8 images each, until one is at most ERROR; the number is narrowed by "
        "the power law of the errors, and checked by 8 images of fresh seeds. spp: the number found. error, low, "
        "high: the mean error of those images with its 95 % interval. needed, needed_low, needed_high: where the "
        "mean error is ERROR, by the rate, the slope of log error against log samples. A pattern that did not get "
        "there within the time limit is 'extrapolated' by its rate, with an interval that follows from the "
        "rate's, or 'unknown'.\n"
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
