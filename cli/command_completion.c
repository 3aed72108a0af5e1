/* SPDX-License-Identifier: Apache-2.0 */
/* Scripts for shells, from the tables that parse the command line. What an argument is, is told by the word that the
   table has for it; names of patterns, measures and scenes are asked of the program while the user types. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "cli.h"

/* Shell code that prints the words for an argument, one a line; NULL: files. text is the table's word for it. */
static const char *words_of(const char *text, char *room, size_t size)
{
    static const struct {
        const char *word, *table;
    } tables[] = {{"PATTERN", "patterns"}, {"MEASURE", "measures"}, {"SCENE", "scenes"},
                  {"NAMES", "measures"},   {"I", "integrators"},    {"F", "filters"}};
    const size_t first = strcspn(text, " "); /* of a synopsis the first word counts */
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++) {
        const size_t length = strlen(tables[i].word);
        const char *at = strstr(text, tables[i].word);
        if (at && at < text + first && (at == text || !isalpha((unsigned char)at[-1])) &&
            !isalpha((unsigned char)at[length])) {
            snprintf(room, size, "koksma list %s 2>/dev/null | sed 1d | cut -d' ' -f1", tables[i].table);
            return room;
        }
    }
    /* "[a|b]" and "a|b" are the words themselves. */
    if (memchr(text, '|', first) && islower((unsigned char)text[text[0] == '['])) {
        size_t used = (size_t)snprintf(room, size, "printf '%%s\\n' ");
        for (size_t i = 0; i < first && used + 1 < size; i++) {
            room[used++] = text[i] == '|' || text[i] == '[' || text[i] == ']' ? ' ' : text[i];
        }
        room[used] = '\0';
        return room;
    }
    return NULL;
}

/* For a shell's single quotes. */
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
    fputs("--help", stdout);
}

/* A `case` of both bash and zsh: sets `words` by the option before the cursor, else by the operands. */
static void put_cases(void)
{
    char room[512];
    const cli_command *command;
    for (size_t i = 0; (command = cli_command_at(i)); i++) {
        printf("  %s)\n    options='", command->name);
        put_options(command);
        printf("'\n    case $before in\n");
        for (const cli_option *o = command->options; o->name; o++) {
            if (o->argument) {
                const char *words = words_of(o->argument, room, sizeof room);
                printf(o->letter ? "    -%c|--%s) " : "    %c--%s) ", o->letter ? o->letter : ' ', o->name);
                printf("kind=argument; words=$(%s);;\n", words ? words : ":");
            }
        }
        const char *words = words_of(command->synopsis, room, sizeof room);
        printf("    *) words=$(%s);;\n    esac;;\n", words ? words : ":");
    }
}

static void put_commands(void)
{
    const cli_command *command;
    for (size_t i = 0; (command = cli_command_at(i)); i++) {
        printf("%s%s", i ? " " : "", command->name);
    }
}

static void put_bash(void)
{
    printf("# bash completion for koksma, made by `koksma completion bash`.\n"
           "_koksma() {\n  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
           "  local options='' words='' kind=operand\n  COMPREPLY=()\n"
           "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n    COMPREPLY=($(compgen -W '");
    put_commands();
    printf("' -- \"$current\"))\n    return\n  fi\n  case ${COMP_WORDS[1]} in\n");
    put_cases();
    printf("  esac\n"
           "  if [ $kind = operand ] && [ \"${current#-}\" != \"$current\" ]; then words=$options; fi\n"
           "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n}\n"
           "complete -o default -F _koksma koksma\n");
}

static void put_zsh(void)
{
    printf("#compdef koksma\n# zsh completion for koksma, made by `koksma completion zsh`.\n"
           "local current=${words[CURRENT]} before=${words[CURRENT-1]} command=${words[2]}\n"
           "local options='' kind=operand\n"
           "if (( CURRENT == 2 )); then\n  compadd -- ");
    put_commands();
    printf("\n  return\nfi\n() {\n  local words=''\n  case $command in\n");
    put_cases();
    printf("  esac\n"
           "  if [[ $kind = operand && $current = -* ]]; then words=$options; fi\n"
           "  if [[ -n $words ]]; then compadd -- ${=words}; else _files; fi\n}\n");
}

static void put_fish(void)
{
    char room[512];
    const cli_command *command;
    printf("# fish completion for koksma, made by `koksma completion fish`.\n");
    for (size_t i = 0; (command = cli_command_at(i)); i++) {
        printf("complete -c koksma -n __fish_use_subcommand -f -a %s -d '", command->name);
        put_quoted(command->summary);
        printf("'\n");
        for (const cli_option *o = command->options; o->name; o++) {
            printf("complete -c koksma -n '__fish_seen_subcommand_from %s'", command->name);
            if (o->letter) {
                printf(" -s %c", o->letter);
            }
            printf(" -l %s%s -d '", o->name, o->argument ? " -r" : "");
            put_quoted(o->help);
            printf("'");
            const char *words = o->argument ? words_of(o->argument, room, sizeof room) : NULL;
            if (words) {
                printf(" -f -a \"(%s)\"", words);
            }
            printf("\n");
        }
        const char *words = words_of(command->synopsis, room, sizeof room);
        if (words) {
            printf("complete -c koksma -n '__fish_seen_subcommand_from %s' -a \"(%s)\"\n", command->name, words);
        }
    }
}

static int run(const cli_arguments *arguments)
{
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
    return cli_usage_error(arguments, "it takes one of bash, zsh, fish");
}

static const cli_option options[] = {{0}};

const cli_command cli_command_completion = {
    .name = "completion",
    .summary = "print a shell's completion script",
    .synopsis = "bash|zsh|fish",
    .details = "In bash: source <(koksma completion bash). 'make install' puts the scripts where the shells look.",
    .options = options,
    .run = run,
};
