/* SPDX-License-Identifier: Apache-2.0 */
/* Parses a command line by the command's table of options (getopt_long), prints the table as --help, and reports errors
   of the command line. */
#include "cli.h"

#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <koksma/image.h>
#include <koksma/render.h>
#include <koksma/study.h>

#include "source.h"

/* The letter of --help, which no option table may use. */
enum { LONG_BASE = 1000, HELP = LONG_BASE + CLI_MAX_OPTIONS, HELP_LETTER = 'h' };

static bool complained; /* true: an error was printed, so cli_no_memory() prints nothing */

enum { LEFT = 22, HELP_COLUMN = 29 }; /* the width of "--NAME ARGUMENT", and the column where the help begins */

static void print_option(char letter, const char *name, const char *argument, const char *help)
{
    char left[160];
    const int used = snprintf(left, sizeof left, argument ? "--%s %s" : "--%s", name, argument);
    printf(letter ? "  -%c, " : "  %c   ", letter ? letter : ' ');
    if (used > LEFT) {
        cli_fill_use(left, HELP_COLUMN - LEFT - 1, HELP_COLUMN - LEFT + 3);
        printf("%*s", HELP_COLUMN, "");
    } else {
        printf("%-*s ", LEFT, left);
    }
    cli_fill(help, HELP_COLUMN, HELP_COLUMN);
}

void cli_print_help(const cli_command *command)
{
    char paragraph[CLI_PARAGRAPH];
    bool apart;
    cli_fill(command->summary, (size_t)printf("koksma %s: ", command->name), 2);
    printf("\n");
    const char *begin = "usage:";
    for (const char *use = command->synopsis; use; use = strchr(use, '\n')) {
        use += *use == '\n';
        const int column = printf("%-6s koksma %s ", begin, command->name);
        cli_fill_use(use, (size_t)column, (size_t)column);
        begin = "";
    }
    printf("\n");
    for (const cli_option *o = command->options; o->name; o++) {
        print_option(o->letter, o->name, o->argument, o->help);
    }
    print_option(HELP_LETTER, "help", NULL, "this text");
    printf(command->details ? "\n" : "");
    for (const char *at = command->details; at && (at = cli_next_paragraph(at, paragraph, &apart));) {
        printf(apart ? "\n" : "");
        cli_fill(paragraph, 0, cli_is_heading(paragraph) ? 2 : 0);
    }
    if (command->examples) {
        printf("\nexamples:\n");
        for (const char *at = command->examples; *at; at += strcspn(at, "\n"), at += *at == '\n') {
            printf("  %.*s\n", (int)strcspn(at, "\n"), at);
        }
    }
}

const cli_option *cli_option_of(const cli_option *options, const char *name)
{
    while (options->name && strcmp(options->name, name) != 0) {
        options++;
    }
    return options->name ? options : NULL;
}

/* Reports an option that does not exist or takes no argument. word: --NAME or --NAME=VALUE. */
static int unknown_option(const cli_arguments *arguments, const char *word)
{
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word + 2, "="), word + 2);
    if (!strcmp(name, "help") || cli_option_of(arguments->command->options, name)) {
        return cli_usage_error(arguments, "option --%s takes no argument", name);
    }
    char meant[128], known[CLI_KNOWN] = "";
    const char *hint = cli_meant_option(arguments->command->options, name, meant);
    if (!*hint && *cli_known_as(arguments, name, known)) {
        return cli_usage_error(arguments, "no option --%s%s", name, known);
    }
    return cli_usage_error(arguments, "no option --%s; %s'koksma %s --help' names them", name, hint,
                           arguments->command->name);
}

static int parse_failure(const cli_arguments *arguments, int code, char **argv)
{
    /* The faulty option is optopt if it is a short one; a long one is the word before optind. */
    if (optopt > 0 && optopt < LONG_BASE) {
        const cli_option *o = arguments->command->options;
        while (o->name && (!o->letter || (o->letter ^ optopt) != ('a' ^ 'A'))) { /* the other case of the letter */
            o++;
        }
        char known[128];
        const char name[] = {(char)optopt, '\0'};
        const char *meant = o->name ? known : cli_meant_option(arguments->command->options, name, known);
        if (o->name) {
            snprintf(known, sizeof known, "did you mean -%c? ", o->letter);
        }
        return code == ':' ? cli_usage_error(arguments, "option -%c takes an argument", optopt)
                           : cli_usage_error(arguments, "no option -%c; %s'koksma %s --help' names them", optopt,
                                             meant, arguments->command->name);
    }
    const char *word = argv[optind - 1];
    return code == ':' ? cli_usage_error(arguments, "option %s takes an argument", word)
                       : unknown_option(arguments, word);
}

/* Sets the value of option i. A second value is appended on a new line. Returns false when memory runs out. */
static bool add_value(cli_arguments *arguments, int i, const char *value)
{
    const char *before = arguments->values[i];
    if (!before || !*value) {
        arguments->values[i] = value;
        return true;
    }
    const size_t size = strlen(before) + strlen(value) + 2;
    char *joined = malloc(size);
    if (!joined) {
        return false;
    }
    snprintf(joined, size, "%s\n%s", before, value);
    free(arguments->joined[i]);
    arguments->values[i] = arguments->joined[i] = joined;
    return true;
}

enum { PARSED = -1 };

/* Parses the options. Returns PARSED, or the exit code when nothing is left to run. */
static int parse(cli_arguments *arguments, int argc, char **argv)
{
    const cli_command *command = arguments->command;
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
            return parse_failure(arguments, code, argv);
        }
        const char *last = argv[optind - 1], *word = optarg == last ? argv[optind - 2] : last;
        /* getopt_long takes --allow for --allow-exec, which runs programs */
        const char *name = code < LONG_BASE ? NULL : code == HELP ? "help" : longs[code - LONG_BASE].name;
        if (name && strcspn(word + 2, "=") != strlen(name)) {
            return unknown_option(arguments, word);
        }
        if (code == HELP || code == HELP_LETTER) {
            cli_print_help(command);
            return CLI_YES;
        }
        if (cli_slip(command->options, word, optarg, slip)) {
            return cli_usage_error(arguments, "%s", slip);
        }
        int i = code - LONG_BASE;
        if (code < LONG_BASE) {
            for (i = 0; command->options[i].letter != code; i++) {
            }
        }
        if (arguments->values[i] && command->options[i].argument && !strstr(command->options[i].argument, "...")) {
            return cli_usage_error(arguments, "option --%s is given twice", command->options[i].name);
        }
        if (!add_value(arguments, i, optarg ? optarg : "")) {
            return cli_no_memory();
        }
    }
    arguments->n_operands = argc - optind;
    arguments->operands = argv + optind;
    return PARSED;
}

/* Returns whether an option names a file or folder with an empty text, which no system accepts; it then prints an
   error. */
static bool is_empty_name(const cli_arguments *arguments, const cli_option *o, const char *value)
{
    const bool folder = o->argument && !strcmp(o->argument, "DIR"), output = !strcmp(o->name, "output");
    const bool names_path = folder || output || (o->argument && !strncmp(o->argument, "FILE", 4));
    if (!names_path || !value || *value) {
        return false;
    }
    cli_usage_error(arguments, "--%s: the name is empty; it takes the name of a %s", o->name,
                    folder                         ? "folder"
                    : !strcmp(o->argument, "PATH") ? "file or folder"
                                                   : "file");
    return true;
}

/* Takes --format where it says how rows are printed: in `study export` it is the format of a file. */
static bool take_format(const cli_arguments *arguments)
{
    const cli_option *option = cli_option_of(arguments->command->options, "format");
    int format = CLI_TEXT;
    if (option && !strcmp(option->argument, "text|csv|latex")) {
        if (!cli_choice(arguments, "format", &format)) {
            return false;
        }
        if (format != CLI_TEXT && cli_flag(arguments, "json")) {
            cli_usage_error(arguments, "--format %s excludes --json", cli_text(arguments, "format", NULL));
            return false;
        }
    }
    cli_set_format(format);
    return true;
}

/* Reads the options that have the same meaning in all commands. Returns the exit code. */
static int read_shared_options(cli_arguments *arguments)
{
    uint64_t digits = CLI_DIGITS;
    const cli_option *options = arguments->command->options;
    for (int i = 0; options[i].name; i++) {
        const char *argument = options[i].argument, *value = arguments->values[i];
        if (is_empty_name(arguments, &options[i], value)) {
            return CLI_USAGE;
        }
        if (value && argument && !strncmp(argument, "FILE.", 5) && !cli_ending_fits(arguments, argument, value)) {
            return CLI_USAGE;
        }
    }
    if (!cli_keeps_inputs(arguments)) {
        return CLI_USAGE;
    }
    if (cli_option_of(options, "digits")) {
        if (!cli_whole(arguments, "digits", CLI_DIGITS, 1, 17, &digits)) {
            return CLI_USAGE;
        }
        cli_set_style((int)digits, cli_flag(arguments, "long"));
        if (!take_format(arguments)) {
            return CLI_USAGE;
        }
    }
    if (cli_option_of(options, "allow-exec")) {
        double seconds;
        const bool allowed = cli_flag(arguments, "allow-exec");
        if (!cli_real(arguments, "exec-seconds", 60, 1e-3, 86400, &seconds)) {
            return CLI_USAGE;
        }
        const bool is_integrand =
            !strcmp(arguments->command->name, "integrate") && cli_text(arguments, "with", NULL) != NULL;
        if (!allowed && !is_integrand && cli_text(arguments, "exec-seconds", NULL)) {
            return cli_usage_error(arguments, "--exec-seconds needs --allow-exec");
        }
        koksma_allow_exec(allowed ? seconds : 0);
    }
    if (cli_option_of(options, "unknown")) {
        int refuse = 0;
        if (!cli_choice(arguments, "unknown", &refuse)) {
            return CLI_USAGE;
        }
        koksma_scene_refuse_unknown(refuse);
    }
    return cli_option_of(options, "patterns") && cli_option_of(options, "n") ? cli_sources_expand(arguments)
                                                                             : CLI_YES;
}

int cli_run(const cli_command *command, int argc, char **argv)
{
    cli_arguments arguments = {.command = command};
    complained = false;
    int code = parse(&arguments, argc, argv);
    if (code == PARSED) {
        code = read_shared_options(&arguments);
        code = code ? code : command->run(&arguments);
    }
    for (int i = 0; i < CLI_MAX_OPTIONS; i++) {
        free(arguments.joined[i]);
    }
    cli_sources_free(&arguments);
    cli_work_end();
    return cli_end_output(code);
}

const char *cli_text(const cli_arguments *arguments, const char *name, const char *fallback)
{
    const cli_option *option = cli_option_of(arguments->command->options, name);
    if (!option) {
        abort(); /* a bug: the option table lacks this name */
    }
    const char *value = arguments->values[option - arguments->command->options];
    return value ? value : fallback;
}

const char *cli_given(const cli_arguments *arguments, const char *name)
{
    return cli_option_of(arguments->command->options, name) ? cli_text(arguments, name, NULL) : NULL;
}

bool cli_flag(const cli_arguments *arguments, const char *name)
{
    return cli_text(arguments, name, NULL) != NULL;
}

bool cli_choice(const cli_arguments *arguments, const char *name, int *choice)
{
    const char *text = cli_text(arguments, name, NULL),
               *at = cli_option_of(arguments->command->options, name)->argument;
    char all[256] = "", meant[96];
    for (int i = 0; text && *at; i++) {
        const size_t used = strlen(all), length = strcspn(at, "|");
        if (strlen(text) == length && !strncmp(text, at, length)) {
            *choice = i;
            return true;
        }
        snprintf(all + used, sizeof all - used, "%s%.*s", !used ? "" : at[length] ? ", " : " or ", (int)length, at);
        at += length + (at[length] == '|');
    }
    if (text && cli_option_of(arguments->command->options, text)) {
        cli_usage_error(arguments, "--%s %s: it takes %s; did you mean --%s?", name, text, all, text);
    } else if (text) {
        cli_usage_error(arguments, "--%s %s: %sit takes %s", name, text, cli_meant_of(text, all, meant), all);
    }
    return !text;
}

bool cli_refuse(const cli_arguments *arguments, const char *names, const char *why, ...)
{
    char name[32], text[256];
    va_list list;
    for (const char *at = names; *at; at += strcspn(at, " "), at += *at == ' ') {
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at, " "), at);
        if (cli_flag(arguments, name)) {
            va_start(list, why);
            vsnprintf(text, sizeof text, why, list);
            va_end(list);
            cli_usage_error(arguments, "--%s %s", name, text);
            return false;
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

bool cli_is_whole(const cli_arguments *arguments, const char *name, const char *text, uint64_t min, uint64_t max,
                  uint64_t *out)
{
    const char *end;
    uint64_t value;
    if (!cli_digits(text, &value, &end) || *end || value < min || value > max) {
        cli_usage_error(arguments, "%s%s %s: it takes %s from %llu to %llu", name[1] ? "--" : "-", name,
                        cli_text(arguments, name, text),
                        strchr(cli_text(arguments, name, text), ',') ? "one whole number, without commas,"
                                                                     : "a whole number",
                        (unsigned long long)min, (unsigned long long)max);
        return false;
    }
    *out = value;
    return true;
}

bool cli_whole(const cli_arguments *arguments, const char *name, uint64_t fallback, uint64_t min, uint64_t max,
               uint64_t *out)
{
    const char *text = cli_text(arguments, name, NULL);
    *out = fallback;
    return !text || cli_is_whole(arguments, name, text, min, max, out);
}

bool cli_trials(const cli_arguments *arguments, uint64_t fallback, uint64_t max, uint64_t *seed, uint64_t *trials)
{
    if (!cli_whole(arguments, "seed", 0, 0, UINT64_MAX, seed) ||
        !cli_whole(arguments, "trials", fallback, 1, max, trials)) {
        return false;
    }
    return !cli_text(arguments, "trials", NULL) || cli_seeds_fit(arguments, *seed, *trials);
}

bool cli_seeds_fit(const cli_arguments *arguments, uint64_t seed, uint64_t trials)
{
    const uint64_t more = trials - 1;
    if (more > UINT64_MAX - seed) {
        cli_usage_error(
            arguments,
            "--seed %llu: %llu trials end at this seed + %llu, but seeds end at %llu; --seed %llu or less would do",
            (unsigned long long)seed, (unsigned long long)trials, (unsigned long long)more,
            (unsigned long long)UINT64_MAX, (unsigned long long)(UINT64_MAX - more));
        return false;
    }
    return true;
}

bool cli_sizes(const cli_arguments *arguments, const char *name, const char *list, const char *also, uint64_t max,
               size_t sizes[KOKSMA_MAX_SIZES], size_t *n)
{
    const char *item = list;
    for (*n = 0; item;) {
        const char *end;
        uint64_t k;
        if (!cli_digits(item, &k, &end) || k == 0 || k > max || (*end && *end != ',') || *n == KOKSMA_MAX_SIZES) {
            cli_usage_error(arguments, "--%s %s: it takes %sup to %d numbers from 1 to %llu, as in 16,64,256", name,
                            list, also, KOKSMA_MAX_SIZES, (unsigned long long)max);
            return false;
        }
        for (size_t i = 0; i < *n; i++) {
            if (sizes[i] == k) {
                cli_usage_error(arguments, "--%s: %llu is given twice", name, (unsigned long long)k);
                return false;
            }
        }
        sizes[(*n)++] = k;
        item = *end ? end + 1 : NULL;
    }
    return true;
}

bool cli_size(const cli_arguments *arguments, int *width, int *height)
{
    const char *text = cli_text(arguments, "size", NULL);
    int used = 0;
    if (text && (sscanf(text, "%6dx%6d%n", width, height, &used) != 2 || text[used] || *width < 1 || *height < 1)) {
        cli_usage_error(arguments, "--size %s: it takes WIDTHxHEIGHT, such as 512x384, each 1 to 65536", text);
        return false;
    }
    if (text && (*width > KOKSMA_MAX_IMAGE_SIDE || *height > KOKSMA_MAX_IMAGE_SIDE ||
                 (size_t)*width * (size_t)*height > KOKSMA_MAX_PIXELS)) {
        cli_usage_error(arguments, "--size %s: each side must be 1 to %d, and the number of pixels at most %zu", text,
                        KOKSMA_MAX_IMAGE_SIDE, (size_t)KOKSMA_MAX_PIXELS);
        return false;
    }
    return true;
}

bool cli_real(const cli_arguments *arguments, const char *name, double fallback, double min, double max, double *out)
{
    const char *text = cli_text(arguments, name, NULL);
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
        cli_usage_error(arguments, "--%s %s: it takes a number from %g to %g%s", name, text, min, max,
                        is_percent           ? percent
                        : end > text && *end ? ", without a unit"
                                             : "");
        return false;
    }
    *out = value;
    return true;
}

const char *cli_one_line(const char *text)
{
    static char lines[4][4096];
    static size_t next;
    char *line = lines[next++ % (sizeof lines / sizeof *lines)];
    snprintf(line, sizeof *lines, "%s", text);
    koksma_text_escape(line, sizeof *lines);
    return line;
}

void cli_say(const char *command, const char *format, ...)
{
    va_list list;
    char text[4096];
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    koksma_text_escape(text, sizeof text);
    cli_work_end();
    fprintf(stderr, *command ? "koksma %s: %s\n" : "koksma%s: %s\n", command, text);
}

/* Whether this is another MPI rank than 0 of a command whose ranks work together. All of them find the same mistake in
   the command line, and rank 0 reports it. */
static bool is_other_rank(const cli_arguments *arguments)
{
    const char *name = arguments->command->name;
    return (!strcmp(name, "study") || !strcmp(name, "reproduce")) && koksma_study_mpi_rank() > 0;
}

static void say_error(const cli_arguments *arguments, const char *text)
{
    const char *command = arguments->command->name, *remedy = cli_remedy(command, text);
    cli_say(command, "%s%s%s", text, !*remedy ? "" : text[strlen(text) - 1] == '?' ? " " : "; ", remedy);
}

int cli_usage_error(const cli_arguments *arguments, const char *format, ...)
{
    va_list list;
    char text[4096];
    complained = true;
    if (is_other_rank(arguments)) { /* mpirun may end all ranks once one has failed: rank 0 has time to say why */
        nanosleep(&(struct timespec){.tv_sec = 5}, NULL);
        return CLI_USAGE;
    }
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    say_error(arguments, text);
    return CLI_USAGE;
}

int cli_fail(const cli_arguments *arguments, koksma_status status)
{
    char known[CLI_KNOWN], all[4096];
    const char *text = koksma_error_text();
    complained = true;
    snprintf(all, sizeof all, "%.*s%s", cli_explain(arguments, status, text, known), text, known);
    say_error(arguments, all);
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
