/* SPDX-License-Identifier: Apache-2.0 */
/* What a word that the program does not know probably means: the nearest name of a table or list, the option that has
   the meaning of one of other programs, or a name or file that belongs elsewhere; and the messages that
   say so. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <koksma/adaptive.h>
#include <koksma/estimate.h>
#include <koksma/integrate.h>
#include <koksma/render.h>
#include <koksma/study.h>
#include <koksma/verify.h>
#include <koksma/warp.h>

#include "cli.h"
#include "curves.h"

static const char *meant_in(const char *word, koksma_name_at *name, const void *table, char text[96])
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
    return meant_in(word, listed_name, names, text);
}

bool cli_has_word(const char *words, const char *word)
{
    for (const char *at = words; *at; at += strcspn(at, " ")) {
        at += strspn(at, " ");
        if (strlen(word) == strcspn(at, " ") && !strncmp(at, word, strlen(word))) {
            return true;
        }
    }
    return false;
}

const char *cli_join(koksma_name_at *name, const void *table, const char *comma, const char *last, char *text,
                     size_t size)
{
    size_t used = 0;
    *text = '\0';
    for (size_t i = 0; name(table, i) && used < size; i++) {
        used += (size_t)snprintf(text + used, size - used, "%s%s",
                                 !i                   ? ""
                                 : name(table, i + 1) ? comma
                                                      : last,
                                 name(table, i));
    }
    return text;
}

/* ---- The names of tables ---------------------------------------------------------------------------------- */

#define NAME(noun, ith)                                                                                              \
    static const char *noun##_name(const void *table, size_t i)                                                      \
    {                                                                                                                \
        (void)table;                                                                                                 \
        return ith;                                                                                                  \
    }
#define NAME_OF(noun, at) NAME(noun, at(i) ? at(i)->name : NULL)
NAME_OF(pattern, koksma_pattern_at)
NAME_OF(measure, koksma_measure_at)
NAME_OF(integrand, koksma_integrand_at)
NAME_OF(estimator, koksma_estimator_at)
NAME_OF(interval, koksma_interval_at)
NAME_OF(integrator, koksma_integrator_at)
NAME_OF(filter, koksma_filter_at)
NAME_OF(adaptive, koksma_adaptive_at)
NAME_OF(metric, koksma_metric_at)
NAME_OF(warp, koksma_warp_at)
NAME_OF(property, koksma_property_at)
NAME_OF(use, koksma_use_at)
NAME_OF(curve, cli_curve_at)
NAME(scene, koksma_scene_name_at(i))
NAME(plan, koksma_plan_name_at(i))

static const char *const commands[] = {
#define COMMAND(name) #name,
#include "commands.def"
#undef COMMAND
    NULL,
};
NAME(command, commands[i])

const cli_noun cli_nouns[] = {
    {"SCENE", scene_name, true, "a scene", "", "koksma rank ", ""},
    {"PATTERN", pattern_name, false, "a pattern", "patterns", "koksma generate ", " -n 16"},
    {"MEASURE", measure_name, false, "a measure", "measures", "koksma measure points.txt -m ", ""},
    {"INTEGRAND", integrand_name, false, "an integrand", "", "koksma integrate ", " -p sobol -n 16"},
    {"INTEGRATOR", integrator_name, false, "an integrator", "integrator", "koksma rank ball --integrator ", ""},
    {"", curve_name, false, "a curve", "curve", "koksma curve ", " sobol@64"},
    {"", use_name, false, "a use", "", "koksma render ball -p ", "=sobol"},
    {"COMMAND", command_name, false, "a command", "", "koksma ", " --help"},
    {"ESTIMATOR", estimator_name, false, NULL, NULL, NULL, NULL},
    {"INTERVAL", interval_name, false, NULL, NULL, NULL, NULL},
    {"FILTER", filter_name, false, NULL, NULL, NULL, NULL},
    {"METHOD", adaptive_name, false, NULL, NULL, NULL, NULL},
    {"METRIC", metric_name, false, NULL, NULL, NULL, NULL},
    {"WARP", warp_name, false, NULL, NULL, NULL, NULL},
    {"PROPERTY", property_name, false, NULL, NULL, NULL, NULL},
    {"PAPER", plan_name, true, NULL, NULL, NULL, NULL},
    {"PLAN", plan_name, true, NULL, NULL, NULL, NULL},
    {NULL, NULL, false, NULL, NULL, NULL, NULL},
};

const cli_noun *cli_noun_of(const char *noun, size_t length)
{
    const cli_noun *n = cli_nouns;
    while (n->noun && (strlen(n->noun) != length || strncasecmp(n->noun, noun, length) != 0)) {
        n++;
    }
    return n->noun ? n : NULL;
}

int cli_no_member(const cli_args *args, const char *noun, const char *word)
{
    char meant[96];
    return cli_error(args, "no %s '%s'; %s'koksma list %ss' names them", noun, word,
                     meant_in(word, cli_noun_of(noun, strlen(noun))->name, NULL, meant), noun);
}

/* ---- Options ---------------------------------------------------------------------------------------------- */

int cli_takes(const cli_args *args, const char *what, const char *word, const char *names)
{
    char meant[96] = "";
    return cli_error(args, "%s%sit takes %s", what, word ? cli_meant_of(word, names, meant) : "", names);
}

static const char *option_name(const void *options, size_t i)
{
    return i ? ((const cli_option *)options)[i - 1].name : "help";
}

/* Names that other programs give to options, and what has that meaning here, the first that the command has; or why there
   is no such option. */
static const struct {
    const char *theirs, *ours, *why;
} foreign_options[] = {
    {"samples num-samples sample-count", "spp n", NULL},
    {"samples-per-pixel", "spp", NULL},
    {"count", "n spp", NULL},
    {"points num-points spp", "n", NULL},
    {"sampler", "patterns pattern", NULL},
    {"metric", "measures", NULL},
    {"measure", "metric", NULL},
    {"timeout max-time quick", "time-limit", NULL},
    {"csv latex tex", "format", NULL},
    {"max-depth bounces", "depth", NULL},
    {"error", "target-error tolerance", NULL},
    {"tol epsilon", "tolerance", NULL},
    {"width height resolution res", "size", NULL},
    {"skip offset start", "first", NULL},
    {"jobs cores", "threads", NULL},
    {"verbose", "long", NULL},
    {"precision", "digits", NULL},
    {"replicates repeat", "trials", NULL},
    {"seeds", "trials max-trials", NULL},
    {"trials", "max-trials seed", NULL},
    {"alpha", "confidence", NULL},
    {"iterations", "steps", NULL},
    {"hdri", "environment", NULL},
    {"ref", "reference", NULL},
    {"out outfile file json", "output", NULL},
    {"rng random-state", "seed", NULL},
    {"dimension ndim", "dim", NULL},
    {"type", "curve", NULL},
    {"scene", "", "a scene is an operand, as in 'koksma rank ball'; "},
    {"input i f", "", "files are operands, without an option; "},
    {"o", "", "it writes to standard output, as in '> FILE'; "},
    {"gamma", "", "PNG has sRGB's curve, EXR and PFM linear light; "},
    {"gpu", "", "it runs on processors alone; "},
    {"scramble scrambling", "", "it is a parameter of patterns, as in sobol:scramble=owen; "},
    {"format", "", "the ending of the file's name chooses it; "},
    {"scale", "", "coordinates are divided in the file; "},
    {"fov", "", "the scene's camera has it; "},
    {"camera", "", "the scene's own is taken; "},
    {"denoise", "", "'koksma rank' has --filter-with for it; "},
    {"exposure", "", "EXR and PFM keep the light as it is; "},
    {"sigma", "", "it is a parameter of filters, as in gaussian:sigma=1; "},
    {"measure", "", "the measure is an operand, as in 'koksma optimise star'; "},
    {"pattern patterns", "", "'koksma list patterns' names patterns; "},
};

/* The first of the words that names an option, or NULL. */
static const cli_option *first_option(const cli_option *options, const char *words)
{
    const cli_option *found = NULL;
    char name[32];
    for (const char *at = words; !found && *at; at += strcspn(at, " "), at += *at == ' ') {
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at, " "), at);
        found = cli_option_of(options, name);
    }
    return found;
}

const char *cli_meant_option(const cli_option *options, const char *name, char text[128])
{
    for (size_t i = 0; i < sizeof foreign_options / sizeof *foreign_options; i++) {
        const cli_option *meant = first_option(options, foreign_options[i].ours);
        if (cli_has_word(foreign_options[i].theirs, name) && (meant || foreign_options[i].why)) {
            const bool is_choice = meant && !strcmp(meant->name, "format") && strstr(meant->argument, name);
            snprintf(text, 128, meant ? "did you mean --%s%s%s? " : "%s%s%s",
                     meant ? meant->name : foreign_options[i].why, is_choice ? " " : "", is_choice ? name : "");
            return text;
        }
    }
    const char *closest = koksma_closest_name(name, option_name, options);
    size_t used = (size_t)snprintf(text, 128, closest ? "did you mean --%s? " : "%.0s", closest ? closest : "");
    for (size_t i = 0; !closest && strlen(name) > 1 && options[i].name; i++) {
        if (!strncmp(options[i].name, name, strlen(name)) && used < 100) {
            used += (size_t)snprintf(text + used, 128 - used, used ? "or --%s? " : "did you mean --%s? ",
                                     options[i].name);
        }
    }
    return text;
}

bool cli_slip(const cli_option *options, const char *word, const char *value, char text[128])
{
    char name[32];
    const bool is_short = *word == '-' && word[1] != '-';
    *text = '\0';
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word, "="), word);
    if (is_short && strlen(name) > 2 && cli_option_of(options, name + 1)) {
        snprintf(text, 128, "%s: did you mean -%s?", name, name);
    } else if (is_short && value && *value == '=' && value == word + 2) {
        snprintf(text, 128, "%.60s: write %s %.40s", word, name, value + 1);
    }
    bool is_option = value && value[0] == '-' && value[1] == '-' && cli_option_of(options, value + 2);
    for (size_t i = 0; value && options[i].name; i++) {
        is_option |= *value == '-' && options[i].letter && value[1] == options[i].letter && !value[2];
    }
    if (is_option) {
        snprintf(text, 128, "%s takes a value, and '%.60s' is an option", name, value);
    }
    return *text;
}

/* ---- Words in the wrong place ----------------------------------------------------------------------------- */

/* What files with an ending hold, and a command for them. */
static const struct {
    const char *endings, *holds, *before, *after;
} files[] = {
    {".txt .csv .npy", "a file of points", "koksma measure ", ""},
    {".json .pbrt .xml .gltf .glb .obj .ply", "a scene", "koksma rank ", ""},
    {".exr .png .pfm .jpg .jpeg", "an image", "koksma compare ", " other.exr"},
};

static bool is_member(const cli_noun *noun, const char *name)
{
    const char *member;
    for (size_t i = 0; (member = noun->name(NULL, i)) && strcmp(member, name) != 0; i++) {
    }
    return member;
}

/* Writes "; 'WORD' is WHAT, as in '..'". */
static const char *say_known(const char *word, const char *what, const char *before, const char *after,
                             char text[CLI_KNOWN])
{
    snprintf(text, CLI_KNOWN, "; '%s' is %s, as in '%s%s%s'", word, what, before, word, after);
    return text;
}

const char *cli_known_as(const cli_args *args, const char *word, char text[CLI_KNOWN])
{
    char name[64];
    *text = '\0';
    const char *base = strrchr(word, '/') ? strrchr(word, '/') + 1 : word, *dot = strrchr(base, '.');
    if (strlen(word) >= CLI_KNOWN / 4 || strpbrk(word, "'\n")) {
        return text;
    }
    if (!strncmp(word, "http://", 7) || !strncmp(word, "https://", 8) || !strcmp(word, "help")) {
        snprintf(text, CLI_KNOWN,
                 *word == 'h' && word[1] == 't' ? "; only files are read: download it first"
                                                : "; --help describes the command");
        return text;
    }
    if (!strcmp(word, "all") && args && cli_option_of(args->command->options, "patterns")) {
        snprintf(text, CLI_KNOWN, "; every pattern is -p all");
        return text;
    }
    if (!strncmp(word, "\xe2\x80", 2)) { /* an en or em dash, of a word processor */
        snprintf(text, CLI_KNOWN, "; it begins with a long dash, options begin with -");
        return text;
    }
    struct stat info;
    if (!stat(word, &info) && S_ISDIR(info.st_mode)) {
        snprintf(text, CLI_KNOWN, "; '%s' is a folder", word);
        return text;
    }
    const cli_option *options = args ? args->command->options : NULL;
    for (size_t i = 0; dot && i < sizeof files / sizeof *files && !access(word, R_OK); i++) {
        if (cli_has_word(files[i].endings, dot)) {
            const bool points = i == 0 && options;
            return say_known(word, files[i].holds,
                             points && !strcmp(args->command->name, "optimise")    ? "koksma optimise star --from "
                             : points && !strcmp(args->command->name, "mask")      ? "--filter file:"
                             : points && first_option(options, "patterns pattern") ? "-p file:"
                                                                                   : files[i].before,
                             files[i].after, text);
        }
    }
    snprintf(name, sizeof name, "%.*s", (int)strcspn(base, ":@."), base);
    if (base != word || dot) {
        snprintf(text, CLI_KNOWN, is_member(cli_nouns, name) ? "; did you mean '%s'?" : "%.0s", name);
        return text;
    }
    const cli_noun *found = NULL; /* the first that has the name, or one whose example is of this command */
    for (const cli_noun *n = cli_nouns; n->what; n++) {
        const char *example = n->before + strlen("koksma "), *own = args ? args->command->name : " ";
        found = is_member(n, name) && (!found || !strncmp(example, own, strlen(own))) ? n : found;
    }
    const cli_option *option = found && options ? cli_option_of(options, found->option) : NULL;
    const char before[] = {'-', option ? option->letter : '\0', ' ', '\0'};
    return !found      ? text
           : before[1] ? say_known(word, found->what, before, "", text)
                       : say_known(name, found->what, found->before, found->after, text);
}

/* Writes to `known` what the word is that an error of the library is about, "no pattern 'star'" or a missing file, as
   cli_known_as does. Returns how much of the error's text stays before it. */
static int explain(const cli_args *args, koksma_status status, const char *text, char known[CLI_KNOWN])
{
    const char *quote = strncmp(text, "no ", 3) || !strncmp(text, "no warp", 7) ? NULL : strchr(text, '\'');
    const char *word = quote ? quote + 1 : text;
    const char *end = quote                      ? strchr(word, '\'')
                      : status == KOKSMA_MISSING ? strstr(text, ": can't be read: No such")
                                                 : NULL;
    char name[CLI_KNOWN];
    snprintf(name, sizeof name, "%.*s", end ? (int)(end - word) : 0, word);
    return *cli_known_as(args, name, known) && quote ? (int)(end + 1 - text) : (int)strlen(text);
}

/* What part of an error's text is about, in a command or (NULL) all, and what would work. */
static const struct {
    const char *command, *says, *remedy;
} remedies[] = {
    {NULL, "can't be written: it is a directory", "add the name of a file"},
    {NULL, "its folder isn't there", "mkdir -p makes it"},
    {"measure", "can't be read: it is a directory", "name the files in it, as in folder/*"},
    {NULL, "--dim 0.", "a distance is a parameter, as in poisson-disk:d=0.2"},
    {NULL, ": no parameter 'skip'", "--first N begins at a later point"},
    {NULL, ": no parameter 'seed'", "the seed is an option, as in --seed 7"},
    {NULL, "not float16, float32", "numpy.asarray(points, float) has such a type"},
    {NULL, "the shape is not (n,) or (n, dim)", "a file has one set"},
    {NULL, "coordinate nan is", "is a value missing?"},
    {NULL, ", but the file has ", "was it cut off?"},
    {NULL, "--output goes with power", "--format csv prints the others, 'koksma plot --curve' draws them"},
    {NULL, "no points in the file", "are all lines comments?"},
    {NULL, "'%PDF-", "it is a PDF"},
    {NULL, "'&' is not a number", "the marks of LaTeX, & and \\\\, have to go"},
    {NULL, "is not a whole number below 2^64", "a file of points is file:PATH"},
    {NULL, ", but --at ", "a point has commas, as in 0.5,0.5"},
    {NULL, "--time-limit ", "seconds, as in 60"},
    {NULL, ": no parameter 'base", "the bases are the first primes"},
    {NULL, "--output: it takes power of one", "'koksma plot --curve power' draws several"},
    {NULL, "--warp disk", "concentric-disk and polar-disk map to it"},
    {"mask", "'check' and files", "a size is --size 64x64"},
    {"integrate", "ended with exit code", "it gets 2 coordinates a line, or as many as -d says"},
    {"integrate", "no integrand '", "--with takes a program for one's own"},
    {"optimise", "which differs from -n or -d", "leave these out"},
    {NULL, "no built-in plan", "'koksma list plans' names them"},
    {NULL, " values for ", "a number a line, one for each point"},
    {NULL, "is no number: '", "a number a line, one for each point"},
    {NULL, "coordinate that the points do not have", "coordinates count from 0, as in 0+1"},
    {NULL, "expected near end of file", "is it empty, or cut off?"},
    {NULL, ": comment: unknown field; it has title", "a scene has 'note'; a plan is run by 'koksma study run'"},
    {NULL, ": name: unknown field; it has title", "a plan is run by 'koksma study run'"},
    {"study", "image: unknown field", "a scene is rendered by 'koksma render'"},
    {"study", "'[' or '{' expected", "a scene is rendered by 'koksma render'"},
};

static const char *remedy_of(const char *command, const char *text)
{
    size_t i = 0;
    const size_t n = sizeof remedies / sizeof *remedies;
    while (i < n &&
           ((remedies[i].command && strcmp(remedies[i].command, command) != 0) || !strstr(text, remedies[i].says))) {
        i++;
    }
    return i < n ? remedies[i].remedy : "";
}

void cli_no_command(const char *command, const char *word)
{
    static const struct {
        const char *name, *ours;
    } elsewhere[] = {{"check", "scene check"}, {"diff", "compare"},    {"-v", "--version"},
                     {"sample", "generate"},   {"show", "plot"},       {"error", "compare"},
                     {"convert", "generate"},  {"evaluate", "measure"}};
    char known[CLI_KNOWN], meant[96];
    const char *name = !strncmp(word, "koksma-", 7) ? word + 7 : word;
    for (size_t i = 0; i < sizeof elsewhere / sizeof *elsewhere; i++) {
        if (!strcmp(name, elsewhere[i].name)) {
            cli_say(command, "no command '%s'; did you mean 'koksma %s'?", word, elsewhere[i].ours);
            return;
        }
    }
    if (*cli_known_as(NULL, name, known)) {
        cli_say(command, "no command '%s'%s", word, known);
    } else {
        cli_say(command, "no command '%s'; %s'koksma --help' names them", word,
                meant_in(word, command_name, NULL, meant));
    }
}

const char *cli_operand_hint(const cli_args *args, const char *operand, char text[CLI_KNOWN])
{
    const char *dot = strrchr(operand, '.');
    if (dot > operand && cli_option_of(args->command->options, "output") &&
        cli_has_word(".txt .csv .npy .png .exr .pfm .jpg .svg .pdf", dot)) {
        return "; -o FILE names the file to write";
    }
    return *operand && !operand[strspn(operand, "0123456789")] ? "; -n N gives a number of points or samples"
                                                               : cli_known_as(args, operand, text);
}

/* ---- Messages --------------------------------------------------------------------------------------------- */

static bool complained; /* an error was printed, so cli_no_memory() prints nothing */

void cli_note(const cli_args *args, const char *format, ...)
{
    va_list list;
    char text[4096];
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    if (!cli_given(args, "quiet")) {
        cli_say(args->command->name, "%s", text);
    }
}

static void say_error(const cli_args *args, const char *text)
{
    const char *command = args->command->name, *remedy = remedy_of(command, text);
    cli_say(command, "%s%s%s", text, !*remedy ? "" : text[strlen(text) - 1] == '?' ? " " : "; ", remedy);
}

int cli_error(const cli_args *args, const char *format, ...)
{
    va_list list;
    char text[4096];
    complained = true;
    if (cli_has_word("study reproduce", args->command->name) && koksma_study_mpi_rank() > 0) {
        /* all ranks find the same mistake; mpirun may end all once one has failed: rank 0 has time to say why */
        nanosleep(&(struct timespec){.tv_sec = 5}, NULL);
        return CLI_USAGE;
    }
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    say_error(args, text);
    return CLI_USAGE;
}

int cli_fail(const cli_args *args, koksma_status status)
{
    char known[CLI_KNOWN], all[4096];
    const char *text = koksma_error_text();
    complained = true;
    snprintf(all, sizeof all, "%.*s%s", explain(args, status, text, known), text, known);
    say_error(args, all);
    return koksma_status_exit_code(status);
}

int cli_no_memory(void)
{
    if (!complained) {
        fputs("koksma: out of memory\n", stderr);
    }
    complained = true;
    return koksma_status_exit_code(KOKSMA_MEMORY);
}
