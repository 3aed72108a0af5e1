/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma completion`: prints completion scripts for bash, zsh and fish, from the option tables that parse the
   command line. The text of an option's argument tells what to offer: alternatives with | between them, or a noun of
   the table `nouns` below. All other nouns are numbers, for which nothing is offered. The scripts ask the program for
   the names of patterns, measures and scenes while the user types. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include <koksma/adaptive.h>
#include <koksma/integrate.h>
#include <koksma/study.h>
#include <koksma/verify.h>

#include "cli.h"

enum { ANSWER_SIZE = 2048 };

/* The completions that a shell offers for an argument. */
typedef struct answer {
    char words[ANSWER_SIZE]; /* names, and calls of the script's function that prints the names in a table */
    bool list, files;        /* list: the argument is a list with commas; files: offer file names if no word fits */
} answer;

static const char *command_name_at(size_t i)
{
    const cli_command *command = cli_command_at(i);
    return command ? command->name : NULL;
}

static const char *property_name_at(size_t i)
{
    const koksma_property *property = koksma_property_at(i);
    return property ? property->name : NULL;
}

static const struct {
    const char *noun, *table; /* the table of `koksma list` that has the names */
    const char *(*name_at)(size_t i);
    bool files;
} nouns[] = {
    {"PATTERN", "patterns", NULL, false},
    {"MEASURE", "measures", NULL, false},
    {"INTEGRAND", "integrands", NULL, false},
    {"SCENE", "scenes", NULL, true},
    {"INTEGRATOR", "integrators", NULL, false},
    {"FILTER", "filters", NULL, false},
    {"METHOD", "adaptive", NULL, false},
    {"METRIC", "metrics", NULL, false},
    {"WARP", "warps", NULL, false},
    {"PROPERTY", NULL, property_name_at, false},
    {"COMMAND", NULL, command_name_at, false},
    {"PAPER", NULL, koksma_plan_name_at, true},
    {"PLAN", NULL, koksma_plan_name_at, true},
    {"FILE", NULL, NULL, true},
    {"DIR", NULL, NULL, true},
    {"OUT", NULL, NULL, true},
    {"PATH", NULL, NULL, true},
    {"PLACES", NULL, NULL, true},
    {"IMAGE", NULL, NULL, true},
    {"REFERENCE", NULL, NULL, true},
    {"RENDERER", NULL, NULL, true},
};

static void add_word(answer *a, const char *word, size_t length)
{
    const size_t used = strlen(a->words);
    snprintf(a->words + used, sizeof a->words - used, "%s%.*s", used ? " " : "", (int)length, word);
}

static void add_noun(answer *a, const char *call, const char *text, size_t length)
{
    for (size_t i = 0; i < sizeof nouns / sizeof *nouns; i++) {
        if (strlen(nouns[i].noun) != length || strncmp(nouns[i].noun, text, length) != 0) {
            continue;
        }
        a->files = a->files || nouns[i].files;
        if (nouns[i].table) {
            char text_of_call[64];
            snprintf(text_of_call, sizeof text_of_call, "%s %s)", call, nouns[i].table);
            add_word(a, text_of_call, strlen(text_of_call));
        }
        for (size_t k = 0; nouns[i].name_at && nouns[i].name_at(k); k++) {
            add_word(a, nouns[i].name_at(k), strlen(nouns[i].name_at(k)));
        }
    }
}

static const char lower[] = "abcdefghijklmnopqrstuvwxyz0123456789-", upper[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";

/* Adds what a shell may offer for the first word of `text`: alternatives with | between them, each a literal word or
   a noun. call: the text with which the script calls its function that prints the names in a table. */
static void add_answer(answer *a, const char *call, const char *text)
{
    const char *end = text + strcspn(text, " \n");
    for (const char *at = text + strspn(text, "["), *next; at < end; at = next + strspn(next, "|]")) {
        next = at + strcspn(at, "| \n");
        const char *comma = strstr(at, ",..");
        const size_t word = strspn(at, lower);
        a->list = a->list || (comma && comma < next);
        if (word > 0 && islower((unsigned char)*at) && strspn(at + word, "]") == (size_t)(next - at) - word) {
            add_word(a, at, word);
            continue;
        }
        for (const char *s = at; s < next; s += strspn(s, upper) ? strspn(s, upper) : 1) {
            add_noun(a, call, s, strspn(s, upper));
        }
    }
}

/* ---- Operands: the lines of a synopsis, "VERB FILE" or "FILE" ----------------------------------------- */

/* Returns line i (0..) of a command's synopsis, which begins after "koksma NAME ", or NULL past the end. */
static const char *usage_at(const cli_command *command, size_t i)
{
    const char *line = command->synopsis;
    while (line && i-- > 0) {
        line = strchr(line, '\n');
        line = line ? line + 1 : NULL;
    }
    return line;
}

/* Returns whether a usage begins with literal words to choose from, such as "run", that are followed by other
   operands. *verbs: these words. */
static bool has_verbs(const char *usage, answer *verbs)
{
    *verbs = (answer){.list = false};
    add_answer(verbs, "", usage);
    return islower((unsigned char)usage[strspn(usage, "[")]) && *verbs->words;
}

/* Returns the operand that follows the verbs of a usage, or "" if none follows. */
static const char *after_verbs(const char *usage)
{
    const char *next = usage + strcspn(usage, " \n");
    next += strspn(next, " ");
    return !strncmp(next, "[-", 2) ? "" : next + strspn(next, "'");
}

/* Returns what may be the first operand of a command. */
static answer first_operands(const cli_command *command, const char *call)
{
    answer all = {.list = false};
    const char *usage;
    for (size_t i = 0; (usage = usage_at(command, i)); i++) {
        add_answer(&all, call, usage);
    }
    return all;
}

/* ---- The scripts --------------------------------------------------------------------------------------- */

/* Prints a text for use between a shell's single quotes. */
static void put_quoted(const char *text)
{
    for (; *text; text++) {
        *text == '\'' ? fputs("'\\''", stdout) : putchar(*text);
    }
}

static void put_options(const cli_command *command)
{
    for (const cli_option *o = command->options; o->name; o++) {
        if (o->letter) {
            printf("-%c ", o->letter);
        }
        printf("--%s ", o->name);
    }
    fputs("-h --help", stdout);
}

/* Prints assignments to the shell variables `list`, `files` and `words`, in the common syntax of bash and zsh. */
static void put_answer(const answer *a)
{
    printf("%s%swords=\"%s\";;\n", a->list ? "list=yes; " : "", a->files ? "files=yes; " : "", a->words);
}

static void put_operand_cases(const cli_command *command, const char *call)
{
    printf("    *) case $earlier in\n");
    const char *usage;
    answer verbs;
    for (size_t i = 0; (usage = usage_at(command, i)); i++) {
        if (!has_verbs(usage, &verbs)) {
            continue;
        }
        printf("      ");
        for (char *word = verbs.words, *blank; word; word = blank ? blank + 1 : NULL) {
            blank = strchr(word, ' ');
            printf("%s*' %.*s '*", word == verbs.words ? "" : "|", blank ? (int)(blank - word) : (int)strlen(word),
                   word);
        }
        printf(") ");
        answer next = {.list = false};
        add_answer(&next, call, after_verbs(usage));
        put_answer(&next);
    }
    const answer first = first_operands(command, call);
    printf("      *) ");
    put_answer(&first);
    printf("      esac;;\n    esac;;\n");
}

/* Prints a `case` statement in the common syntax of bash and zsh. The statement sets the shell variables `words`,
   `list` and `files` according to the option before the cursor or, if it takes no argument, according to the
   operands. */
static void put_cases(void)
{
    static const char call[] = "$(_koksma_names";
    const cli_command *command;
    for (size_t i = 0; (command = cli_command_at(i)); i++) {
        printf("  %s)\n    options='", command->name);
        put_options(command);
        printf("'\n    case $before in\n");
        for (const cli_option *o = command->options; o->name; o++) {
            if (o->argument) {
                answer a = {.list = false};
                add_answer(&a, call, o->argument);
                printf(o->letter ? "    -%c|--%s) " : "    %c--%s) ", o->letter ? o->letter : ' ', o->name);
                printf("kind=argument; ");
                put_answer(&a);
            }
        }
        put_operand_cases(command, call);
    }
}

static void put_commands(void)
{
    const cli_command *command;
    for (size_t i = 0; (command = cli_command_at(i)); i++) {
        printf("%s%s", i ? " " : "", command->name);
    }
}

static const char names_function[] = "_koksma_names() { koksma list \"$1\" 2>/dev/null | sed 1d | cut -d' ' -f1; }\n";

/* Bash code that completes a word with a colon by means of `koksma completion spec`. Bash splits words at colons and
   equals signs and replaces only the part after the last of these. The code therefore removes the part before it from
   the completions. */
static const char bash_specs[] =
    "  local word=${COMP_LINE:0:COMP_POINT}; word=${word##* }\n"
    "  if [[ $word = *:* ]]; then\n"
    "    COMPREPLY=($(compgen -W \"$(koksma completion spec -- \"$word\" 2>/dev/null)\" -- \"$word\"))\n"
    "    [[ $COMP_WORDBREAKS != *:* ]] || COMPREPLY=(\"${COMPREPLY[@]#\"${word%\"${word##*[:=]}\"}\"}\")\n"
    "    if [ -n \"${COMPREPLY[*]}\" ]; then compopt -o nospace; return; fi\n"
    "    COMPREPLY=()\n"
    "  fi\n";

static void put_bash(void)
{
    printf("# bash completion for koksma, made by `koksma completion bash`.\n%s"
           "_koksma() {\n  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} done=''\n"
           "  local options='' words='' kind=operand list='' files='' earlier=\" ${COMP_WORDS[*]:2:COMP_CWORD-2} \"\n"
           "  COMPREPLY=()\n"
           "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n    COMPREPLY=($(compgen -W '",
           names_function);
    put_commands();
    /* bash treats an equals sign as a word, so the option may be two words before the cursor */
    printf("' -- \"$current\"))\n    return\n  fi\n%s"
           "  if [ \"$current\" = = ]; then current=''; "
           "elif [ \"$before\" = = ]; then before=${COMP_WORDS[COMP_CWORD-2]}; fi\n"
           "  case ${COMP_WORDS[1]} in\n",
           bash_specs);
    put_cases();
    printf("  esac\n"
           "  if [ $kind = operand ] && [ \"${current#-}\" != \"$current\" ]; then words=$options list=''; fi\n"
           "  if [ -n \"$list\" ]; then done=${current%%\"${current##*,}\"}; fi\n"
           "  COMPREPLY=($(compgen -P \"$done\" -W \"$words\" -- \"${current#\"$done\"}\"))\n"
           "  if [ -z \"$files\" ]; then compopt +o default; fi\n}\n"
           "complete -o default -F _koksma koksma\n");
}

static void put_zsh(void)
{
    printf("#compdef koksma\n# zsh completion for koksma, made by `koksma completion zsh`.\n%s"
           "local current=${words[CURRENT]} before=${words[CURRENT-1]} command=${words[2]}\n"
           "local options='' kind=operand list='' files='' earlier=\" ${words[3,CURRENT-1]} \"\n"
           "if (( CURRENT == 2 )); then\n  compadd -- ",
           names_function);
    put_commands();
    printf("\n  return\nfi\n"
           "if [[ $current = *:* ]]; then\n"
           "  local -a specs=(${(f)\"$(koksma completion spec -- $current 2>/dev/null)\"})\n"
           "  if (( $#specs )); then compadd -S '' -- $specs; return; fi\nfi\n"
           "if [[ $current = --*=* ]]; then before=${current%%%%=*}; current=${current#*=}; compset -P '*='; fi\n"
           "() {\n  local words=''\n  case $command in\n");
    put_cases();
    printf("  esac\n"
           "  if [[ $kind = operand && $current = -* ]]; then words=$options list=''; fi\n"
           "  if [[ -n $list ]]; then compset -P '*,'; fi\n"
           "  if [[ -n $words ]] && compadd -- ${=words}; then return; fi\n"
           "  if [[ -n $files ]]; then _files; fi\n}\n");
}

/* Prints the rest of a fish `complete` line: the words to offer, and whether to offer files. */
static void put_fish_answer(const answer *a)
{
    printf("%s", a->files ? "" : " -f");
    if (*a->words) {
        printf(a->list ? " -a \"(__koksma_list %s)\"\n" : " -a \"%s\"\n", a->words);
    } else {
        printf("\n");
    }
}

static void put_fish_operands(const cli_command *command, const char *call)
{
    const char *usage;
    answer verbs, all = {.list = false};
    for (size_t i = 0; (usage = usage_at(command, i)); i++) {
        if (has_verbs(usage, &verbs)) {
            answer next = {.list = false};
            add_answer(&all, "", usage);
            add_answer(&next, call, after_verbs(usage));
            printf("complete -c koksma -n '__koksma_in %s %s'", command->name, verbs.words);
            put_fish_answer(&next);
        }
    }
    const answer first = first_operands(command, call);
    printf("complete -c koksma -n '__koksma_in %s", command->name);
    printf(*all.words ? "; and not __koksma_in %s %s'" : "'", command->name, all.words);
    put_fish_answer(&first);
}

static void put_fish(void)
{
    static const char call[] = "(__koksma_names";
    const cli_command *command;
    printf("# fish completion for koksma, made by `koksma completion fish`.\n"
           "function __koksma_names\n    koksma list $argv[1] 2>/dev/null | sed 1d | cut -d' ' -f1\n"
           "    koksma completion spec -- (commandline -ct) 2>/dev/null\nend\n"
           "# Puts the finished items of a list before each word; words with a colon contain them already.\n"
           "function __koksma_list\n    set -l done (string match -r '.*,' -- (commandline -ct))\n"
           "    for word in $argv\n        string match -q '*:*' -- $word; and echo $word; or echo \"$done\"$word\n  "
           "  end\nend\n"
           "# True if the command is the first word and, given further words, one of them was typed after it.\n"
           "function __koksma_in\n    set -l typed (commandline -opc)\n"
           "    test \"$typed[2]\" = $argv[1]; or return\n    test (count $argv) -eq 1; and return\n"
           "    set -e typed[1..2]\n    for word in $argv[2..-1]\n        contains -- $word $typed; and return\n"
           "    end\n    return 1\nend\n");
    printf("complete -c koksma -s h -l help -d 'what it does'\n"
           "complete -c koksma -n 'string match -q \"pattern:*\" -- (commandline -ct)' -f "
           "-a '(koksma completion spec -- (commandline -ct))'\n");
    for (size_t i = 0; (command = cli_command_at(i)); i++) {
        printf("complete -c koksma -n __fish_use_subcommand -f -a %s -d '", command->name);
        put_quoted(command->summary);
        printf("'\n");
        for (const cli_option *o = command->options; o->name; o++) {
            printf("complete -c koksma -n '__koksma_in %s'", command->name);
            if (o->letter) {
                printf(" -s %c", o->letter);
            }
            printf(" -l %s%s -d '", o->name, o->argument ? " -r" : "");
            put_quoted(o->help);
            printf("'");
            answer a = {.list = false};
            if (o->argument) {
                add_answer(&a, call, o->argument);
                put_fish_answer(&a);
            } else {
                printf("\n");
            }
        }
        put_fish_operands(command, call);
    }
}

/* Returns the parameters of the pattern, measure, integrand or adaptive method `name`, or NULL if nothing has this
   name. */
static const koksma_param *params_of(const char *name)
{
    const koksma_pattern *pattern = koksma_pattern_find(name);
    const koksma_measure *measure = koksma_measure_find(name);
    const koksma_adaptive *adaptive = koksma_adaptive_find(name);
    const koksma_integrand *integrand = koksma_integrand_find(name);
    return pattern     ? pattern->params
           : measure   ? measure->params
           : integrand ? integrand->params
           : adaptive  ? adaptive->params
                       : NULL;
}

/* Prints the completions of a word that ends in an unfinished spec, such as "-p a,sobol:scr": "NAME=" for each
   parameter and modifier, or, after the "NAME=" of a parameter, its choices. After "pattern:" it prints the names of
   patterns. */
static int put_specs(const char *word)
{
    const char *colon = strrchr(word, ':'), *begin = colon, *last;
    char name[64];
    while (begin && begin > word && strchr(lower, begin[-1])) {
        begin--;
    }
    if (!colon) {
        return CLI_YES;
    }
    snprintf(name, sizeof name, "%.*s", (int)(colon - begin), begin);
    for (size_t i = 0; !strcmp(name, "pattern") && koksma_pattern_at(i); i++) {
        printf("%.*s%s\n", (int)(colon + 1 - word), word, koksma_pattern_at(i)->name);
    }
    last = strrchr(colon, ',') ? strrchr(colon, ',') : colon;
    const size_t key = strcspn(++last, "=");
    for (const koksma_param *p = params_of(name); p && p->name; p++) {
        if (!last[key]) {
            printf("%.*s%s=\n", (int)(last - word), word, p->name);
        }
        for (size_t i = 0; last[key] && p->choices && p->choices[i] && strlen(p->name) == key; i++) {
            if (!strncmp(p->name, last, key)) {
                printf("%.*s%s\n", (int)(last + key + 1 - word), word, p->choices[i]);
            }
        }
    }
    for (size_t i = 0; koksma_pattern_find(name) && !last[key] && koksma_modifier_at(i); i++) {
        printf("%.*s%s=\n", (int)(last - word), word, koksma_modifier_at(i)->name);
    }
    return CLI_YES;
}

static int run(const cli_arguments *arguments)
{
    if (arguments->n_operands == 2 && !strcmp(arguments->operands[0], "spec")) {
        return put_specs(arguments->operands[1]);
    }
    static const struct {
        const char *name;
        void (*put)(void);
    } shells[] = {{"bash", put_bash}, {"zsh", put_zsh}, {"fish", put_fish}};
    for (size_t i = 0; arguments->n_operands == 1 && i < sizeof shells / sizeof *shells; i++) {
        if (!strcmp(arguments->operands[0], shells[i].name)) {
            shells[i].put();
            return CLI_YES;
        }
    }
    char meant[96] = "";
    return cli_usage_error(
        arguments, "%sit takes one of bash, zsh, fish, or spec WORD",
        arguments->n_operands ? cli_meant_of(arguments->operands[0], "bash, zsh, fish, spec", meant) : "");
}

static const cli_option options[] = {{0}};

const cli_command cli_command_completion = {
    .name = "completion",
    .summary = "print a shell's completion script",
    .synopsis = "bash|zsh|fish\nspec WORD",
    .details = "To use it in bash, run: source <(koksma completion bash). 'make install' installs the scripts in the "
               "folders in which the shells search.\n"
               "spec: prints what may follow behind the colon of a pattern or measure, for the scripts.",
    .examples = "koksma completion bash >koksma.bash\n",
    .options = options,
    .run = run,
};
