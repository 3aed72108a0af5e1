/* SPDX-License-Identifier: Apache-2.0 */
/* What a word that the program does not know probably means: the nearest name of a table or list, the option that has
   the meaning of one of other programs, or a name or file that belongs elsewhere. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <koksma/integrate.h>
#include <koksma/render.h>

#include "cli.h"
#include "curves.h"

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
    {"sampler", {"patterns", "pattern"}},
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
    {"seeds", {"trials", "max-trials"}},
    {"epsilon", {"tolerance"}},
    {"alpha", {"confidence"}},
    {"iterations", {"steps"}},
    {"hdri", {"environment"}},
    {"ref", {"reference"}},
    {"out", {"output"}},
    {"file", {"output"}},
    {"rng", {"seed"}},
    {"random-state", {"seed"}},
    {"dimension", {"dim"}},
    {"ndim", {"dim"}},
    {"spp", {"n"}},
    {"trials", {"max-trials", "seed"}},
    {"outfile", {"output"}},
    {"json", {"output"}},
    {"type", {"curve"}},
    {"quick", {"time-limit"}},
};

/* Options of other programs for what is no option here. */
static const struct {
    const char *name, *why;
} no_options[] = {
    {"scene", "a scene is an operand, as in 'koksma rank ball'; "},
    {"input", "files are operands, without an option; "},
    {"i", "files are operands, without an option; "},
    {"f", "files are operands, without an option; "},
    {"o", "it writes to standard output, as in '> FILE'; "},
    {"gamma", "PNG has sRGB's curve, EXR and PFM linear light; "},
    {"gpu", "it runs on processors alone; "},
    {"scramble", "it is a parameter of patterns, as in sobol:scramble=owen; "},
    {"scrambling", "it is a parameter of patterns, as in sobol:scramble=owen; "},
    {"format", "the ending of the file's name chooses it; "},
    {"scale", "coordinates are divided in the file; "},
    {"fov", "the scene's camera has it; "},
    {"camera", "the scene's own is taken; "},
    {"denoise", "'koksma rank' has --filter-with for it; "},
    {"exposure", "EXR and PFM keep the light as it is; "},
    {"sigma", "it is a parameter of filters, as in gaussian:sigma=1; "},
    {"measure", "the measure is an operand, as in 'koksma optimise star'; "},
    {"pattern", "'koksma list patterns' names patterns; "},
    {"patterns", "'koksma list patterns' names patterns; "},
};

/* What names stand for, and a command that takes one, or an option, if the command has it. */
#define NAME(function, entry)                                                                                        \
    static const char *function(const void *table, size_t i)                                                         \
    {                                                                                                                \
        (void)table;                                                                                                 \
        return entry;                                                                                                \
    }
NAME(pattern, koksma_pattern_at(i) ? koksma_pattern_at(i)->name : NULL)
NAME(measure, koksma_measure_at(i) ? koksma_measure_at(i)->name : NULL)
NAME(scene, koksma_scene_name_at(i))
NAME(integrand, koksma_integrand_at(i) ? koksma_integrand_at(i)->name : NULL)
NAME(use, koksma_use_at(i) ? koksma_use_at(i)->name : NULL)
NAME(curve, cli_curve_at(i) ? cli_curve_at(i)->name : NULL)

static const struct {
    koksma_name_at *name;
    const char *what, *option, *before, *after;
} families[] = {
    {scene, "a scene", "", "koksma rank ", ""},
    {pattern, "a pattern", "patterns", "koksma generate ", " -n 16"},
    {measure, "a measure", "measures", "koksma measure points.txt -m ", ""},
    {integrand, "an integrand", "", "koksma integrate ", " -p sobol -n 16"},
    {cli_integrator_name, "an integrator", "integrator", "koksma rank ball --integrator ", ""},
    {curve, "a curve", "curve", "koksma curve ", " sobol@64"},
    {use, "a use", "", "koksma render ball -p ", "=sobol"},
    {cli_command_name, "a command", "", "koksma ", " --help"},
};

/* What files with an ending hold, and a command for them. */
static const struct {
    const char *endings, *holds, *before, *after;
} files[] = {
    {".txt .csv .npy", "a file of points", "koksma measure ", ""},
    {".json .pbrt .xml .gltf .glb .obj .ply", "a scene", "koksma rank ", ""},
    {".exr .png .pfm .jpg .jpeg", "an image", "koksma compare ", " other.exr"},
};

const char *cli_meant_option(const cli_option *options, const char *name, char text[128])
{
    const cli_option *meant = NULL;
    for (size_t i = 0; i < sizeof foreign_options / sizeof *foreign_options; i++) {
        for (int k = 0; !meant && !strcmp(name, foreign_options[i].name) && k < 2 && foreign_options[i].ours[k];
             k++) {
            meant = cli_option_of(options, foreign_options[i].ours[k]);
        }
    }
    if (meant) {
        const bool is_choice = strcmp(meant->name, "format") == 0 && strstr(meant->argument, name);
        snprintf(text, 128, "did you mean --%s%s%s? ", meant->name, is_choice ? " " : "", is_choice ? name : "");
        return text;
    }
    for (size_t i = 0; i < sizeof no_options / sizeof *no_options; i++) {
        if (!strcmp(name, no_options[i].name)) {
            return no_options[i].why;
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

static bool is_member(size_t family, const char *name)
{
    const char *member;
    for (size_t i = 0; (member = families[family].name(NULL, i)) && strcmp(member, name) != 0; i++) {
    }
    return member;
}

/* Whether the example of a family is of this command. */
static bool is_taken(size_t family, const cli_arguments *arguments)
{
    const char *example = families[family].before + strlen("koksma "),
               *name = arguments ? arguments->command->name : " ";
    return !strncmp(example, name, strlen(name));
}

/* Writes "; 'WORD' is WHAT, as in '..'". */
static const char *say_known(const char *word, const char *what, const char *before, const char *after,
                             char text[CLI_KNOWN])
{
    snprintf(text, CLI_KNOWN, "; '%s' is %s, as in '%s%s%s'", word, what, before, word, after);
    return text;
}

const char *cli_known_as(const cli_arguments *arguments, const char *word, char text[CLI_KNOWN])
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
    if (!strcmp(word, "all") && arguments && cli_option_of(arguments->command->options, "patterns")) {
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
    for (size_t i = 0; dot && dot[1] && i < sizeof files / sizeof *files && !access(word, R_OK); i++) {
        const char *at = strstr(files[i].endings, dot);
        if (at && (!at[strlen(dot)] || at[strlen(dot)] == ' ')) {
            const cli_option *options = i == 0 && arguments ? arguments->command->options : NULL;
            const bool as_pattern =
                options && (cli_option_of(options, "patterns") || cli_option_of(options, "pattern"));
            const bool as_filter = options && !strcmp(arguments->command->name, "mask");
            const bool as_first = options && !strcmp(arguments->command->name, "optimise");
            return say_known(word, files[i].holds,
                             as_first     ? "koksma optimise star --from "
                             : as_filter  ? "--filter file:"
                             : as_pattern ? "-p file:"
                                          : files[i].before,
                             files[i].after, text);
        }
    }
    snprintf(name, sizeof name, "%.*s", (int)strcspn(base, ":@."), base);
    const bool whole = base == word && !dot;
    enum { FAMILIES = sizeof families / sizeof *families, OF_SCENES = 0 };
    if (!whole) {
        snprintf(text, CLI_KNOWN, is_member(OF_SCENES, name) ? "; did you mean '%s'?" : "%.0s", name);
        return text;
    }
    size_t found = FAMILIES; /* the first family that has the name, or one that the command takes */
    for (size_t f = 0; f < FAMILIES; f++) {
        found = is_member(f, name) && (found == FAMILIES || is_taken(f, arguments)) ? f : found;
    }
    if (found == FAMILIES) {
        return text;
    }
    const cli_option *option = arguments ? cli_option_of(arguments->command->options, families[found].option) : NULL;
    const char letter = option ? option->letter : '\0', before[] = {'-', letter, ' ', '\0'};
    return letter ? say_known(word, families[found].what, before, "", text)
                  : say_known(name, families[found].what, families[found].before, families[found].after, text);
}

int cli_explain(const cli_arguments *arguments, koksma_status status, const char *text, char known[CLI_KNOWN])
{
    const char *quote = strncmp(text, "no ", 3) || !strncmp(text, "no warp", 7) ? NULL : strchr(text, '\'');
    const char *word = quote ? quote + 1 : text;
    const char *end = quote                      ? strchr(word, '\'')
                      : status == KOKSMA_MISSING ? strstr(text, ": can't be read: No such")
                                                 : NULL;
    char name[CLI_KNOWN];
    snprintf(name, sizeof name, "%.*s", end ? (int)(end - word) : 0, word);
    return *cli_known_as(arguments, name, known) && quote ? (int)(end + 1 - text) : (int)strlen(text);
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
    {NULL, "no points in the file", "are all lines comments?"},
    {"datasheet", "is outside [0,1]", "divide coordinates by the size"},
    {"atlas", "is outside [0,1]", "divide coordinates by the size"},
    {NULL, "'%PDF-", "it is a PDF"},
    {NULL, "'v' is not a number", "is it a model?"},
    {NULL, "'&' is not a number", "the marks of LaTeX, & and \\\\, have to go"},
    {NULL, "is not a whole number below 2^64", "a file of points is file:PATH"},
    {NULL, ", but --at ", "a point has commas, as in 0.5,0.5"},
    {NULL, "--time-limit ", "seconds, as in 60"},
    {NULL, "--output goes with power", "--format csv prints the others, 'koksma plot --curve' draws them"},
    {NULL, ": no parameter 'base", "the bases are the first primes"},
    {NULL, "--output: it takes power of one", "'koksma plot --curve power' draws several"},
    {NULL, "--warp disk", "concentric-disk and polar-disk map to it"},
    {NULL, "--curve spectrum", "power is the spectrum"},
    {"mask", "'check' and files", "a size is --size 64x64"},
    {"integrate", "ended with exit code", "it gets 2 coordinates a line, or as many as -d says"},
    {"integrate", "no integrand '", "--with takes a program for one's own"},
    {"integrate", "are more than --max-points", "raise that, or lower -n"},
    {"optimise", "which differs from -n or -d", "leave these out"},
    {NULL, "no built-in plan", "'koksma list plans' names them"},
    {NULL, " values for ", "a number a line, one for each point"},
    {NULL, "is no number: '", "a number a line, one for each point"},
    {NULL, "coordinate that the points do not have", "coordinates count from 0, as in 0+1"},
    {NULL, "files have no numbers of 8 bits", ".png and .raw have"},
    {NULL, "expected near end of file", "is it empty, or cut off?"},
    {NULL, "string or '}' expected near ','", "is there a comma too many?"},
    {NULL, "mismatched tag", "each <tag> ends by </tag> or />"},
    {NULL, ": comment: unknown field; it has title", "a scene has 'note'; a plan is run by 'koksma study run'"},
    {NULL, ": name: unknown field; it has title", "a plan is run by 'koksma study run'"},
    {"study", "image: unknown field", "a scene is rendered by 'koksma render'"},
    {"study", "'[' or '{' expected", "a scene is rendered by 'koksma render'"},
    {NULL, ".material: it takes a text", "the name of one in 'materials'"},
    {NULL, "clamp: 0 is not", "without it nothing is clamped"},
    {NULL, ".albedo[0]: ", "colours of 0 to 255 are divided by 255"},
    {NULL, ": no material '", "'materials' has to have it"},
    {NULL, "no kind 'diffuse'", "it is lambert here"},
    {NULL, "no kind 'matte'", "it is lambert here"},
    {NULL, "no kind 'glass'", "it is dielectric here"},
    {NULL, "no kind 'metal'", "it is conductor here"},
    {NULL, "no kind 'cube'", "it is box here"},
};

const char *cli_remedy(const char *command, const char *text)
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
                cli_meant(word, cli_command_name, NULL, meant));
    }
}

const char *cli_operand_hint(const cli_arguments *arguments, const char *operand, char text[CLI_KNOWN])
{
    static const char *const outputs[] = {".txt", ".csv", ".npy", ".png", ".exr", ".pfm", ".jpg", ".svg", ".pdf"};
    const size_t length = strlen(operand);
    for (size_t i = 0; cli_option_of(arguments->command->options, "output") && i < sizeof outputs / sizeof *outputs;
         i++) {
        if (length > 4 && !strcmp(operand + length - 4, outputs[i])) {
            return "; -o FILE names the file to write";
        }
    }
    return *operand && strspn(operand, "0123456789") == length ? "; -n N gives a number of points or samples"
                                                               : cli_known_as(arguments, operand, text);
}
