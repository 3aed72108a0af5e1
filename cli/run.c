/* SPDX-License-Identifier: Apache-2.0 */
/* The table of commands (commands.def), and their run: parses a command line by the command's table of options
   (getopt_long), and does what options ask for that have the same meaning in all commands. */
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <koksma/render.h>

#include "cli.h"
#include "source.h"

static const cli_command *const commands[] = {
#define COMMAND(name) &cli_command_##name,
#include "commands.def"
#undef COMMAND
    NULL,
};

const cli_command *cli_command_at(size_t i)
{
    return commands[i] ? cli_expand(commands[i], i) : NULL;
}

const cli_command *cli_command_find(const char *name)
{
    for (size_t i = 0; commands[i]; i++) {
        if (!strcmp(commands[i]->name, name)) {
            return cli_command_at(i);
        }
    }
    return NULL;
}

/* The letter of --help, which no option table may use. */
enum { LONG_BASE = 1000, HELP = LONG_BASE + CLI_MAX_OPTIONS, HELP_LETTER = 'h', PARSED = -1 };

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

/* Checks that a file to write has an ending that its option's argument lists, "FILE.txt|.csv", or no ending. */
static bool ending_fits(const cli_args *args, const char *argument, const char *path)
{
    const char *base = strrchr(path, '/') ? strrchr(path, '/') + 1 : path, *dot = strrchr(base, '.'),
               *comma = strchr(base, ','), *first = strchr(argument, '.');
    char all[64];
    if (!dot || dot == base || !dot[1] || !first) { /* ".", ".." and ".name" have no ending */
        return true;
    }
    for (const char *at = first; *at; at += strcspn(at, "|"), at += *at == '|') {
        const size_t length = strlen(base), ending = strcspn(at, "|");
        if (comma && comma - base > (ptrdiff_t)ending && !strncmp(comma - ending, at, ending)) {
            return !cli_error(args, "%s: it writes one file, not two", path);
        }
        if (length > ending && !strncmp(base + length - ending, at, ending)) {
            return true;
        }
    }
    return !cli_error(args, "%s: its name must end in %s", path, cli_alternatives(first, all, sizeof all));
}

/* Whether koksma wrote a file of points, as far as its text says: a search may continue in it. */
static bool is_ours(const char *path)
{
    char head[8] = "";
    FILE *f = fopen(path, "rb"); /* it is the output, a plain file */
    const bool ours = f && fread(head, 1, sizeof head, f) == sizeof head && !memcmp(head, "# koksma", sizeof head);
    if (f) {
        fclose(f);
    }
    const char *end = strrchr(path, '.');
    return ours || (end && (!strcmp(end, ".npy") || !strcmp(end, ".csv")));
}

/* Whether an item of a list is a file that `output` would replace; then it prints an error. */
static bool is_replaced(const cli_args *args, const char *list, const char *output)
{
    char item[KOKSMA_MAX_SPEC];
    for (size_t i = 0; cli_list_item(list, i, item, sizeof item); i++) {
        if (cli_reads(item, output)) {
            return cli_error(args, "--output %s: it would replace what is read, %s; choose another file", output,
                             item);
        }
    }
    return false;
}

/* Refuses an --output that is a file which the command reads, but that of --from, which a search continues. */
static bool keeps_inputs(const cli_args *args)
{
    const cli_option *options = args->command->options;
    const char *output = cli_given(args, "output");
    struct stat info;
    bool keeps = true;
    if (!output || stat(output, &info) || !S_ISREG(info.st_mode)) {
        return true;
    }
    for (int i = 0; i < args->n_operands && keeps; i++) {
        keeps = !is_replaced(args, args->operands[i], output);
    }
    for (int i = 0; options[i].name && keeps; i++) {
        const char *name = options[i].name, *value = args->values[i];
        keeps = !value || cli_has_word("output error-map", name) || (!strcmp(name, "from") && is_ours(value)) ||
                !is_replaced(args, value, output);
    }
    return keeps;
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
        if (value && argument && !strncmp(argument, "FILE.", 5) && !ending_fits(args, argument, value)) {
            return CLI_USAGE;
        }
    }
    if (!keeps_inputs(args) || !take_format(args)) {
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
