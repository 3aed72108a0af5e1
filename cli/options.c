/* SPDX-License-Identifier: Apache-2.0 */
/* Parses a command line by the command's table of options (getopt_long), reads options, and reports errors
   of the command line. */
#include "cli.h"

#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/image.h>
#include <koksma/render.h>
#include <koksma/study.h>

#include "source.h"

/* The letter of --help, which no option table may use. */
enum { LONG_BASE = 1000, HELP = LONG_BASE + CLI_MAX_OPTIONS, HELP_LETTER = 'h' };

const cli_option *cli_option_of(const cli_option *options, const char *name)
{
    while (options->name && strcmp(options->name, name) != 0) {
        options++;
    }
    return options->name ? options : NULL;
}

/* Reports an option that does not exist or takes no argument. word: --NAME or --NAME=VALUE. */
static int unknown_option(const cli_args *args, const char *word)
{
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word + 2, "="), word + 2);
    if (!strcmp(name, "help") || cli_option_of(args->command->options, name)) {
        return cli_error(args, "option --%s takes no argument", name);
    }
    char meant[128], known[CLI_KNOWN] = "";
    const char *hint = cli_meant_option(args->command->options, name, meant);
    if (!*hint && *cli_known_as(args, name, known)) {
        return cli_error(args, "no option --%s%s", name, known);
    }
    return cli_error(args, "no option --%s; %s'koksma %s --help' names them", name, hint, args->command->name);
}

static int parse_failure(const cli_args *args, int code, char **argv)
{
    /* The faulty option is optopt if it is a short one; a long one is the word before optind. */
    if (optopt > 0 && optopt < LONG_BASE) {
        const cli_option *o = args->command->options;
        while (o->name && (!o->letter || (o->letter ^ optopt) != ('a' ^ 'A'))) { /* the other case of the letter */
            o++;
        }
        char known[128];
        const char name[] = {(char)optopt, '\0'};
        const char *meant = o->name ? known : cli_meant_option(args->command->options, name, known);
        if (o->name) {
            snprintf(known, sizeof known, "did you mean -%c? ", o->letter);
        }
        return code == ':' ? cli_error(args, "option -%c takes an argument", optopt)
                           : cli_error(args, "no option -%c; %s'koksma %s --help' names them", optopt, meant,
                                       args->command->name);
    }
    const char *word = argv[optind - 1];
    return code == ':' ? cli_error(args, "option %s takes an argument", word) : unknown_option(args, word);
}

/* Sets the value of option i. A second value is appended on a new line. Returns false when memory runs out. */
static bool add_value(cli_args *args, int i, const char *value)
{
    const char *before = args->values[i];
    if (!before || !*value) {
        args->values[i] = value;
        return true;
    }
    const size_t size = strlen(before) + strlen(value) + 2;
    char *joined = malloc(size);
    if (!joined) {
        return false;
    }
    snprintf(joined, size, "%s\n%s", before, value);
    free(args->joined[i]);
    args->values[i] = args->joined[i] = joined;
    return true;
}

enum { PARSED = -1 };

/* Parses the options. Returns PARSED, or the exit code when nothing is left to run. */
static int parse(cli_args *args, int argc, char **argv)
{
    const cli_command *command = args->command;
    struct option longs[CLI_MAX_OPTIONS + 2] = {{0}};
    char slip[128], shorts[2 * CLI_MAX_OPTIONS + 4] = {':', HELP_LETTER};
    int n = 0;
    for (; command->options[n].name; n++) {
        const cli_option *o = &command->options[n];
        longs[n] = (struct option){o->name, o->argument ? required_argument : no_argument, NULL, LONG_BASE + n};
        if (o->letter) {
            strncat(shorts, &o->letter, 1);
            strcat(shorts, o->argument ? ":" : "");
        }
    }
    longs[n] = (struct option){"help", no_argument, NULL, HELP};
    opterr = 0;
    optind = 0; /* 0 resets glibc's getopt completely, even if the previous parse stopped in the middle of a word */
    for (int code; (code = getopt_long(argc, argv, shorts, longs, NULL)) != -1;) {
        if (code == '?' || code == ':') {
            return parse_failure(args, code, argv);
        }
        const char *last = argv[optind - 1], *word = optarg == last ? argv[optind - 2] : last;
        /* getopt_long takes --allow for --allow-exec, which runs programs */
        const char *name = code < LONG_BASE ? NULL : code == HELP ? "help" : longs[code - LONG_BASE].name;
        if (name && strcspn(word + 2, "=") != strlen(name)) {
            return unknown_option(args, word);
        }
        if (code == HELP || code == HELP_LETTER) {
            cli_print_help(command);
            return CLI_YES;
        }
        if (cli_slip(command->options, word, optarg, slip)) {
            return cli_error(args, "%s", slip);
        }
        int i = code - LONG_BASE;
        if (code < LONG_BASE) {
            for (i = 0; command->options[i].letter != code; i++) {
            }
        }
        if (args->values[i] && command->options[i].argument && !strstr(command->options[i].argument, "...")) {
            return cli_error(args, "option --%s is given twice", command->options[i].name);
        }
        if (!add_value(args, i, optarg ? optarg : "")) {
            return cli_no_memory();
        }
    }
    args->n_operands = argc - optind;
    args->operands = argv + optind;
    return PARSED;
}

/* Takes --format where it says how rows are printed: in `study export` it is the format of a file. */
static bool take_format(const cli_args *args)
{
    const cli_option *option = cli_option_of(args->command->options, "format");
    int format = CLI_TEXT;
    if (option && !strcmp(option->argument, "text|csv|latex") && !cli_choice(args, "format", &format)) {
        return false;
    }
    cli_set_format(cli_given(args, "json") ? CLI_JSON : format);
    return format == CLI_TEXT || !cli_flag(args, "json") ||
           !cli_error(args, "--format %s excludes --json", cli_text(args, "format", NULL));
}

/* Reads the options that have the same meaning in all commands. Returns the exit code. */
static int read_shared_options(cli_args *args)
{
    uint64_t digits = CLI_DIGITS;
    const cli_option *options = args->command->options;
    for (int i = 0; options[i].name; i++) {
        const char *argument = options[i].argument, *value = args->values[i];
        const bool names_path = !strcmp(options[i].name, "output") ||
                                (argument && (!strcmp(argument, "DIR") || !strncmp(argument, "FILE", 4)));
        if (names_path && value && !*value) {
            return cli_error(args, "--%s: the name is empty; it takes the name of a %s", options[i].name,
                             !strcmp(argument, "DIR")    ? "folder"
                             : !strcmp(argument, "PATH") ? "file or folder"
                                                         : "file");
        }
        if (value && argument && !strncmp(argument, "FILE.", 5) && !cli_ending_fits(args, argument, value)) {
            return CLI_USAGE;
        }
    }
    if (!cli_keeps_inputs(args) || !take_format(args)) {
        return CLI_USAGE;
    }
    if (cli_option_of(options, "digits")) {
        if (!cli_whole(args, "digits", CLI_DIGITS, 1, 17, &digits)) {
            return CLI_USAGE;
        }
        cli_set_style((int)digits, cli_flag(args, "long"));
    }
    if (cli_option_of(options, "allow-exec")) {
        double seconds;
        const bool allowed = cli_flag(args, "allow-exec");
        if (!cli_real(args, "exec-seconds", 60, 1e-3, 86400, &seconds)) {
            return CLI_USAGE;
        }
        const bool is_integrand = !strcmp(args->command->name, "integrate") && cli_text(args, "with", NULL) != NULL;
        if (!allowed && !is_integrand && cli_text(args, "exec-seconds", NULL)) {
            return cli_error(args, "--exec-seconds needs --allow-exec");
        }
        koksma_allow_exec(allowed ? seconds : 0);
    }
    if (cli_option_of(options, "unknown")) {
        int refuse = 0;
        if (!cli_choice(args, "unknown", &refuse)) {
            return CLI_USAGE;
        }
        koksma_scene_refuse_unknown(refuse);
    }
    return cli_option_of(options, "patterns") && cli_option_of(options, "n") ? cli_sources_expand(args) : CLI_YES;
}

int cli_run(const cli_command *command, int argc, char **argv)
{
    cli_args args = {.command = command};
    int code = parse(&args, argc, argv);
    if (code == PARSED) {
        code = read_shared_options(&args);
        code = code ? code : command->run(&args);
    }
    for (int i = 0; i < CLI_MAX_OPTIONS; i++) {
        free(args.joined[i]);
    }
    cli_sources_free(&args);
    cli_work_end();
    return cli_end_output(code);
}

const char *cli_text(const cli_args *args, const char *name, const char *fallback)
{
    const cli_option *option = cli_option_of(args->command->options, name);
    if (!option) {
        abort(); /* a bug: the option table lacks this name */
    }
    const char *value = args->values[option - args->command->options];
    return value ? value : fallback;
}

const char *cli_given(const cli_args *args, const char *name)
{
    return cli_option_of(args->command->options, name) ? cli_text(args, name, NULL) : NULL;
}

bool cli_flag(const cli_args *args, const char *name)
{
    return cli_text(args, name, NULL) != NULL;
}

const char *cli_alternatives(const char *argument, char *text, size_t size)
{
    *text = '\0';
    for (const char *at = argument; *at; at += *at == '|') {
        const size_t length = strcspn(at, "|");
        CLI_APPEND(text, size, "%s%.*s", !*text ? "" : at[length] ? ", " : " or ", (int)length, at);
        at += length;
    }
    return text;
}

bool cli_choice(const cli_args *args, const char *name, int *choice)
{
    const char *text = cli_text(args, name, NULL), *at = cli_option_of(args->command->options, name)->argument;
    char all[256], meant[96];
    cli_alternatives(at, all, sizeof all);
    for (int i = 0; text && *at; i++, at += strcspn(at, "|"), at += *at == '|') {
        if (strlen(text) == strcspn(at, "|") && !strncmp(text, at, strlen(text))) {
            *choice = i;
            return true;
        }
    }
    if (text && cli_option_of(args->command->options, text)) {
        cli_error(args, "--%s %s: it takes %s; did you mean --%s?", name, text, all, text);
    } else if (text) {
        cli_error(args, "--%s %s: %sit takes %s", name, text, cli_meant_of(text, all, meant), all);
    }
    return !text;
}

bool cli_refuse(const cli_args *args, const char *names, const char *why, ...)
{
    char name[32], text[256];
    va_list list;
    for (const char *at = names; *at; at += strcspn(at, " "), at += *at == ' ') {
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at, " "), at);
        if (cli_flag(args, name)) {
            va_start(list, why);
            vsnprintf(text, sizeof text, why, list);
            va_end(list);
            return !cli_error(args, "--%s %s", name, text);
        }
    }
    return true;
}

bool cli_digits(const char *text, uint64_t *out, const char **end)
{
    char *after;
    errno = 0;
    *out = text[0] >= '0' && text[0] <= '9' ? strtoull(text, &after, 10) : 0;
    *end = text[0] >= '0' && text[0] <= '9' ? after : text;
    if (*end != text && **end == 'e' && (*end)[1] >= '0' && (*end)[1] <= '9') {
        const unsigned long zeros = strtoul(*end + 1, &after, 10);
        *end = after;
        for (unsigned long k = 0; k<zeros && * out> 0 && !errno; k++) {
            errno = *out > UINT64_MAX / 10 ? ERANGE : 0;
            *out *= 10;
        }
    }
    return *end != text && !errno;
}

bool cli_is_whole(const cli_args *args, const char *name, const char *text, uint64_t min, uint64_t max, uint64_t *out)
{
    const char *end;
    uint64_t value;
    if (!cli_digits(text, &value, &end) || *end || value < min || value > max) {
        return !cli_error(
            args, "%s%s %s: it takes %s from %llu to %llu", name[1] ? "--" : "-", name, cli_text(args, name, text),
            strchr(cli_text(args, name, text), ',') ? "one whole number, without commas," : "a whole number",
            (unsigned long long)min, (unsigned long long)max);
    }
    *out = value;
    return true;
}

bool cli_whole(const cli_args *args, const char *name, uint64_t fallback, uint64_t min, uint64_t max, uint64_t *out)
{
    const char *text = cli_text(args, name, NULL);
    *out = fallback;
    return !text || cli_is_whole(args, name, text, min, max, out);
}

bool cli_trials(const cli_args *args, uint64_t fallback, uint64_t max, uint64_t *seed, uint64_t *trials)
{
    if (!cli_whole(args, "seed", 0, 0, UINT64_MAX, seed) || !cli_whole(args, "trials", fallback, 1, max, trials)) {
        return false;
    }
    return !cli_text(args, "trials", NULL) || cli_seeds_fit(args, *seed, *trials);
}

bool cli_seeds_fit(const cli_args *args, uint64_t seed, uint64_t trials)
{
    const uint64_t more = trials - 1;
    if (more > UINT64_MAX - seed) {
        return !cli_error(
            args,
            "--seed %llu: %llu trials end at this seed + %llu, but seeds end at %llu; --seed %llu or less would do",
            (unsigned long long)seed, (unsigned long long)trials, (unsigned long long)more,
            (unsigned long long)UINT64_MAX, (unsigned long long)(UINT64_MAX - more));
    }
    return true;
}

bool cli_sizes(const cli_args *args, const char *name, const char *list, const char *also, uint64_t max,
               size_t sizes[KOKSMA_MAX_SIZES], size_t *n)
{
    const char *item = list;
    for (*n = 0; item;) {
        const char *end;
        uint64_t k;
        if (!cli_digits(item, &k, &end) || k == 0 || k > max || (*end && *end != ',') || *n == KOKSMA_MAX_SIZES) {
            return !cli_error(args, "--%s %s: it takes %sup to %d numbers from 1 to %llu, as in 16,64,256", name,
                              list, also, KOKSMA_MAX_SIZES, (unsigned long long)max);
        }
        for (size_t i = 0; i < *n; i++) {
            if (sizes[i] == k) {
                return !cli_error(args, "--%s: %llu is given twice", name, (unsigned long long)k);
            }
        }
        sizes[(*n)++] = k;
        item = *end ? end + 1 : NULL;
    }
    return true;
}

bool cli_size(const cli_args *args, int *width, int *height)
{
    const char *text = cli_text(args, "size", NULL);
    int used = 0;
    if (text && (sscanf(text, "%6dx%6d%n", width, height, &used) != 2 || text[used] || *width < 1 || *height < 1)) {
        return !cli_error(args, "--size %s: it takes WIDTHxHEIGHT, such as 512x384, each 1 to 65536", text);
    }
    if (text && (*width > KOKSMA_MAX_IMAGE_SIDE || *height > KOKSMA_MAX_IMAGE_SIDE ||
                 (size_t)*width * (size_t)*height > KOKSMA_MAX_PIXELS)) {
        return !cli_error(args, "--size %s: each side must be 1 to %d, and the number of pixels at most %zu", text,
                          KOKSMA_MAX_IMAGE_SIDE, (size_t)KOKSMA_MAX_PIXELS);
    }
    return true;
}

bool cli_real(const cli_args *args, const char *name, double fallback, double min, double max, double *out)
{
    const char *text = cli_text(args, name, NULL);
    *out = fallback;
    if (!text) {
        return true;
    }
    char *end;
    const double value = strtod(text, &end);
    if (end == text || *end || !(value >= min && value <= max)) {
        char percent[64];
        const bool is_percent = strchr(text, '%') || (max <= 1 && value > 1 && value <= 100);
        snprintf(percent, sizeof percent, "; %.4g %% is %.4g", value, value / 100);
        return !cli_error(args, "--%s %s: it takes a number from %g to %g%s", name, text, min, max,
                          is_percent           ? percent
                          : end > text && *end ? ", without a unit"
                                               : "");
    }
    *out = value;
    return true;
}

size_t cli_reals(const char *list, double min, double max, double *out, size_t most)
{
    char item[64], *end;
    size_t n = 0;
    while (cli_list_item(list, n, item, sizeof item)) {
        const double value = strtod(item, &end);
        if (n == most || end == item || *end || !(value >= min && value <= max)) {
            return 0;
        }
        out[n++] = value;
    }
    return n;
}

static bool is_use(const char *name, size_t length)
{
    size_t i = 0;
    while (koksma_use_at(i) &&
           (strlen(koksma_use_at(i)->name) != length || strncmp(koksma_use_at(i)->name, name, length) != 0)) {
        i++;
    }
    return koksma_use_at(i) != NULL;
}

/* Returns the end of the list item that starts at s. Commas separate the items, but they also separate the parameters
   of one spec: "a:x=1,y=2,b" has the items "a:x=1,y=2" and "b". A comma separates parameters if a ':' is before it in
   the item and a parameter's "key=" follows. Otherwise it ends the item. So it ends the item before a spec with
   parameters of its own, "b:x=1", in which the ':' comes before the '='; before patterns joined by '+' or ';', if
   that comes before any '='; and before "USE=PATTERN", because no parameter has the name of a use. */
static const char *item_end(const char *s)
{
    bool has_parameters = false;
    for (;; s++) {
        has_parameters |= *s == ':';
        if (!*s) {
            return s;
        }
        if (*s == ',') {
            const size_t stop = strcspn(s + 1, ",:=+;");
            if (!has_parameters || s[1 + stop] != '=' || is_use(s + 1, stop)) {
                return s;
            }
        }
    }
}

bool cli_list_item(const char *list, size_t i, char *item, size_t size)
{
    const char *start = list;
    for (;; i--) {
        const char *end = item_end(start);
        if (i == 0) {
            snprintf(item, size, "%.*s", (int)(end - start), start);
            return true;
        }
        if (!*end) {
            return false;
        }
        start = end + 1;
    }
}
